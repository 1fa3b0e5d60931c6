"""Doctests, types, and that the documented names are there."""

import doctest
import importlib
import pathlib
import re
import shutil
import subprocess
import sys

import pytest
from conftest import ROOT

import lobelia

PACKAGE = pathlib.Path(lobelia.__file__).parent
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE | doctest.IGNORE_EXCEPTION_DETAIL


@pytest.mark.parametrize("name", ["lobelia", "lobelia._lobes", "lobelia._record"])
def test_examples_of_docstrings_run(name):
    result = doctest.testmod(importlib.import_module(name), optionflags=FLAGS)
    assert result.failed == 0
    assert result.attempted > 0 or name == "lobelia._record"


def test_everything_public_has_a_docstring():
    for name in lobelia.__all__:
        assert getattr(lobelia, name).__doc__, name


def test_types_are_strict(tmp_path):
    if not shutil.which("mypy"):
        pytest.skip("mypy is not installed")
    usage = tmp_path / "usage.py"
    usage.write_text((ROOT / "tests/program/python/usage.py").read_text())
    config = tmp_path / "mypy.ini"  # Debian has no stubs for these
    config.write_text("[mypy-pandas.*,matplotlib.*]\nignore_missing_imports = True\n")
    done = subprocess.run(
        ["mypy", "--strict", "--config-file", str(config), "--python-executable", sys.executable, "--cache-dir",
         str(tmp_path / "cache"), str(usage), *map(str, sorted(PACKAGE.glob("*.py*")))],
        capture_output=True, text=True, cwd=PACKAGE.parent,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_stub_names_what_the_module_has():
    import ast

    stub = ast.parse((PACKAGE / "_lobelia.pyi").read_text())
    named = {one.name for one in stub.body if isinstance(one, (ast.FunctionDef, ast.ClassDef))}
    there = {name for name in vars(lobelia._lobelia) if not name.startswith("_")} - {"version"}
    assert named == there


def test_every_snippet_of_the_page_runs(tmp_path, monkeypatch):
    pytest.importorskip("pandas")
    monkeypatch.chdir(tmp_path)
    page = (ROOT / "docs/python.md").read_text()
    text = re.sub("^```.*$", "", page, flags=re.MULTILINE)
    test = doctest.DocTestParser().get_doctest(text, {}, "python.md", "docs/python.md", 0)
    result = doctest.DocTestRunner(optionflags=FLAGS & ~doctest.IGNORE_EXCEPTION_DETAIL).run(test)
    assert result.failed == 0
    assert result.attempted > 20


def test_commands_of_the_page_are_those_of_other_tests():
    page = (ROOT / "docs/python.md").read_text()
    blocks = page.split("```")[1::2]
    assert [block.strip() for block in blocks if block.startswith("\n")] == [
        'export PYTHONPATH="$PWD/build/release/python"',  # all tests run so
        "pip wheel ./program/python",  # test_wheel.py
        "pytest --lobelia-update",  # test_plugin.py
    ]

"""The wheel: built by one command, installed apart, and imported without the build tree."""

import os
import subprocess
import sys
import zipfile

import pytest
from conftest import ROOT

CODE = """
import lobelia
image = lobelia.render(lobelia.scenes()["head_on"], width=32, height=32)
lobelia.write("a.exr", image)
assert lobelia.compare("a.exr", image).passed
print(lobelia.__file__)
"""


def test_the_wheel_works_where_it_is_unpacked(tmp_path):
    pytest.importorskip("pip")
    build = os.environ["LOBELIA_BUILD"]
    made = subprocess.run([sys.executable, "-m", "pip", "wheel", "--no-index", "--no-deps", "--wheel-dir",
                           tmp_path, "--config-settings", f"build={build}", ROOT / "program/python"],
                          capture_output=True, text=True)  # fmt: skip
    assert made.returncode == 0, made.stdout + made.stderr
    (wheel,) = tmp_path.glob("lobelia-*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    for name in ("py.typed", "_lobelia.pyi", "scenes/head_on.xml", "lobelia_picture_reader"):
        assert f"lobelia/{name}" in names
    assert not any(name.startswith("lobelia/__pycache__") for name in names)

    place = tmp_path / "site"
    subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps",
                    "--target", place, wheel], check=True)  # fmt: skip
    environment = {**os.environ, "PYTHONPATH": str(place), "LOBELIA_BUILD": ""}
    done = subprocess.run([sys.executable, "-c", CODE], cwd=tmp_path, env=environment,
                          capture_output=True, text=True)  # fmt: skip
    assert done.stdout.strip() == str(place / "lobelia/__init__.py"), done.stderr

    suite = tmp_path / "test_entry_point.py"
    suite.write_text("def test_it(lobelia_compare):\n    assert lobelia_compare\n")
    run = subprocess.run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", suite],
                         cwd=tmp_path, env=environment, capture_output=True, text=True)  # fmt: skip
    assert "1 passed" in run.stdout, run.stdout + run.stderr

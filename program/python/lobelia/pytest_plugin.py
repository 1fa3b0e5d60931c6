"""pytest plug-in: a fixture that compares a picture with a reference.

def test_highlight(lobelia_compare):
    lobelia_compare(render(), "references/highlight.exr")

A reference's path is from the test's file. `--lobelia-update` writes the references instead of judging by them. A
failure leaves a page of HTML in the folder of `--lobelia-report`.
"""

from __future__ import annotations

import html
import pathlib
import re
from typing import Any, Callable, Union

import pytest

import lobelia

_DEFAULT_FOLDER = "lobelia-report"


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("lobelia", "pictures compared by Lobelia")
    group.addoption(
        "--lobelia-update", action="store_true", help="write the references that do not pass"
    )
    group.addoption(
        "--lobelia-report",
        metavar="DIR",
        default=_DEFAULT_FOLDER,
        help=f"folder for the pages of failures; default: {_DEFAULT_FOLDER}",
    )


def _page(title: str, result: lobelia.Comparison) -> str:
    return (
        f"<!doctype html><meta charset='utf-8'><title>{html.escape(title)}</title>"
        f"<h1>{html.escape(title)}</h1>{result._repr_html_()}"
        f"<h2>Record</h2><pre>{html.escape(result.to_json())}</pre>"
    )


@pytest.fixture
def lobelia_compare(request: pytest.FixtureRequest) -> Callable[..., lobelia.Comparison]:
    """compare(image, reference, **options): as lobelia.compare, but it fails the test unless the verdict passes."""

    def compare(
        image: Any, reference: Union[str, pathlib.Path], **options: Any
    ) -> lobelia.Comparison:
        __tracebackhide__ = True
        path = pathlib.Path(request.path).parent / reference
        update = request.config.getoption("--lobelia-update")
        if not path.exists():
            if not update:
                pytest.fail(
                    f"{path}: there is no reference; --lobelia-update writes it", pytrace=False
                )
            return write(path, image, options)
        result: lobelia.Comparison = lobelia.compare(image, path, **options)
        if result.passed:
            return result
        if update:
            return write(path, image, options)
        name = re.sub(r"[^A-Za-z0-9_.-]+", "-", f"{request.node.nodeid}-{path.stem}")
        folder = pathlib.Path(request.config.getoption("--lobelia-report"))
        folder = pathlib.Path(request.config.invocation_params.dir) / folder
        folder.mkdir(parents=True, exist_ok=True)
        page = folder / f"{name[-150:].lstrip('.')}.html"
        page.write_text(_page(request.node.nodeid, result), encoding="utf-8")
        pytest.fail(f"{result.why or result.verdict}\n{result}\nreport: {page}", pytrace=False)

    def write(path: pathlib.Path, image: Any, options: Any) -> lobelia.Comparison:
        path.parent.mkdir(parents=True, exist_ok=True)
        is_file = isinstance(image, (str, pathlib.PurePath))
        lobelia.write(path, lobelia.read(image) if is_file else image)
        result: lobelia.Comparison = lobelia.compare(image, path, **options)
        return result

    return compare

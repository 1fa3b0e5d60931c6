"""The pytest plug-in, in test suites of its own."""

import pytest

SUITE = """
    import numpy as np
    import lobelia

    def picture(factor):
        x = np.linspace(0, 1, 40, dtype=np.float32)
        return np.repeat((factor * np.outer(x, x))[:, :, None], 3, 2)

    def test_highlight(lobelia_compare):
        result = lobelia_compare(picture({factor}), "references/highlight.exr")
        assert result.passed
"""


@pytest.fixture
def suite(pytester):
    def run(factor, *options):
        pytester.makepyfile(test_it=SUITE.replace("{factor}", str(factor)))
        return pytester.runpytest_inprocess(
            "-p", "lobelia.pytest_plugin", "-p", "no:cacheprovider", *options
        )

    run.path = pytester.path
    return run


def test_a_missing_reference_fails_and_says_what_to_type(suite):
    result = suite(1)
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*there is no reference; --lobelia-update writes it*"])
    assert not (suite.path / "references").exists()


def test_update_writes_the_reference_which_then_passes(suite):
    suite(1, "--lobelia-update").assert_outcomes(passed=1)
    assert (suite.path / "references/highlight.exr").exists()
    suite(1).assert_outcomes(passed=1)
    assert not (suite.path / "lobelia-report").exists()


def test_a_failure_has_its_reason_and_a_page_where_it_is_wanted(suite):
    suite(1, "--lobelia-update")
    before = (suite.path / "references/highlight.exr").read_bytes()
    result = suite(2)
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*max_rel_peak is 1, limit 0.01*", "*verdict: differs*", "report: *.html*"])
    (page,) = (suite.path / "lobelia-report").iterdir()
    text = page.read_text()
    assert "test_it.py::test_highlight" in text
    assert text.count("data:image/png;base64,") == 3
    assert (suite.path / "references/highlight.exr").read_bytes() == before
    suite(2, "--lobelia-report", "out/pages").assert_outcomes(failed=1)
    assert len(list((suite.path / "out/pages").iterdir())) == 1


def test_update_replaces_what_differs_and_keeps_what_passes(suite):
    suite(1, "--lobelia-update")
    reference = suite.path / "references/highlight.exr"
    before = reference.stat().st_mtime_ns
    suite(1, "--lobelia-update").assert_outcomes(passed=1)
    assert reference.stat().st_mtime_ns == before
    suite(2, "--lobelia-update").assert_outcomes(passed=1)
    suite(2).assert_outcomes(passed=1)

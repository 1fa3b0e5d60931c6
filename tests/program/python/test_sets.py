"""Folders of pictures, projects, and noise that is known."""

import json

import numpy as np
import pytest

import lobelia


@pytest.fixture
def folders(image, tmp_path, monkeypatch):
    """One pair passes, one differs, one reference has no picture."""
    monkeypatch.chdir(tmp_path)
    for folder in ("mine", "references"):
        (tmp_path / folder).mkdir()
        lobelia.write(f"{folder}/same.exr", image)
    lobelia.write("mine/other.exr", image * np.float32(1.1))
    lobelia.write("references/other.exr", image)
    lobelia.write("references/lonely.exr", image)


def of_command(command, *words):
    code, text, _ = command("compare", *words, "--json", "-")
    return code, json.loads(text)


def test_folders_give_the_record_of_the_command_line(folders, command):
    result = lobelia.compare("mine", "references", limits={"rmse": 1})
    code, record = of_command(command, "mine", "references", "--fail=rmse=1")
    assert isinstance(result, lobelia.ComparisonSet)
    assert result.to_dict() == record
    assert (code, result.passed, bool(result)) == (1, False, False)
    assert [pair.name for pair in result.pairs] == ["other.exr", "same.exr"]
    assert result.missing == ["lonely.exr"]
    assert str(result).startswith("2 pairs: 1 pass, 1 differ")
    assert "other.exr" in result.to_markdown()


def test_names_that_differ_make_pairs_by_a_pattern_or_a_table(image, command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("a_mine.exr", "a_reference.exr"):
        lobelia.write(name, image)
    by_pattern = lobelia.compare(".", pattern="{scene}_{engine}.exr", sets="engine=mine,reference")
    assert by_pattern and by_pattern.pairs[0].name == "a"
    (tmp_path / "pairs.csv").write_text("mine,reference\na_mine.exr,a_reference.exr\n")
    by_table = lobelia.compare(pairs="pairs.csv")
    assert by_table.to_dict() == of_command(command, "--pairs", "pairs.csv")[1]
    frames = lobelia.compare(*[_frames(image, folder) for folder in ("x", "y")])
    assert [pair.name for pair in frames.pairs] == ["0001", "0002"]


def _frames(image, folder):
    for number in (1, 2):
        lobelia.write(f"{folder}{number}.exr", image)
    return f"{folder}%d.exr"


def test_a_project_judges_as_on_the_command_line(folders, command, tmp_path):
    (tmp_path / "references/lonely.exr").unlink()
    (tmp_path / "lobelia.toml").write_text(
        'judged = ["mine"]\nreferences = ["references"]\nfail = ["rmse=1"]\n'
        '[[rules]]\nmatch = "same*"\nfail = ["max_abs=0"]\n'
        '[[known]]\nmatch = "other.exr"\nreason = "brighter"\nexpires = 2099-12-31\n'
    )
    result = lobelia.compare(project="lobelia.toml")
    code, record = of_command(command, "--project", "lobelia.toml")
    assert result.to_dict() == record
    assert (code, result.passed) == (0, True)
    assert result.pairs[0].known.reason == "brighter"


def test_a_set_shows_its_progress_and_is_a_dataframe(folders):
    seen = []
    result = lobelia.compare("mine", "references", progress=seen.append)
    assert seen[-1] == 1
    pytest.importorskip("pandas")
    frame = result.to_dataframe().set_index("name")
    assert list(frame["verdict"]) == ["differs", "pass"]
    assert frame["rmse"]["same.exr"] == 0 and frame["rmse"]["other.exr"] > 0


def test_what_makes_no_set_is_an_error(folders, image):
    with pytest.raises(lobelia.UsageError, match="a and b are required"):
        lobelia.compare()
    with pytest.raises(lobelia.UsageError, match="a is no path"):
        lobelia.compare(image, "references")
    with pytest.raises(lobelia.InputError, match="is a folder|is not a folder"):
        lobelia.compare("mine/same.exr", "references")
    with pytest.raises(lobelia.UsageError, match="--reference-floor needs"):
        lobelia.compare(".", pattern="{x}/{name}", sets="x=mine,references", reference_floor="mine")
    with pytest.raises(lobelia.InputError, match="nowhere.ocio"):
        lobelia.compare(image, image, ocio="nowhere.ocio")


def test_known_noise_gives_a_profile_the_errors_of_the_command_line(scene, command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    rng = np.random.default_rng(1)
    clean = lobelia.render(scene)
    one, two = (clean + rng.normal(0, 1e-3, clean.shape).astype(np.float32) for _ in range(2))
    error = np.full_like(clean, 1e-3)
    for name, picture in (("a", one), ("two", two), ("error", error)):
        lobelia.write(f"{name}.exr", picture)
    for words, noise in ((["--replicate", "two.exr"], {"replicate": two}),
                         (["--replicate", "two.exr"], {"replicate": ["two.exr"]}),
                         (["--error", "error.exr"], {"error": "error.exr"})):  # fmt: skip
        _, text, _ = command("profile", "a.exr", "--scene", scene, "--light", 0, *words, "--json", "-")
        assert lobelia.profile(one, scene=scene, light=0, **noise).to_dict() == json.loads(text)
        _, text, _ = command("profile", "a.exr", *words, "--json", "-")
        assert lobelia.profile("a.exr", **noise).to_dict() == json.loads(text)
    _, text, _ = command("profile", "a.exr", "two.exr", "--b-error", "error.exr", "--json", "-")
    of_b = json.loads(text.replace('"two"', '"b"'))
    assert lobelia.profile(one, two, b_error=error).highlights[0].to_dict()["images"] == of_b["highlights"][0]["images"]
    with pytest.raises(lobelia.UsageError, match="either its error or its replicates"):
        lobelia.profile(one, replicate=two, error=error)
    with pytest.raises(lobelia.UsageError, match="need a reference"):
        lobelia.profile(one, b_error=error)
    with pytest.raises(lobelia.InputError, match="replicate"):
        lobelia.profile(one, replicate=two[:9])

"""Rendering, comparing and measuring pictures."""

import _thread
import concurrent.futures
import json
import os
import subprocess
import sys
import textwrap
import threading

import numpy as np
import pytest

import lobelia


def test_a_render_equals_the_command_line_bit_for_bit(scene, command, tmp_path):
    image = lobelia.render(scene, width=80, height=60, exponent=16)
    assert (image.shape, image.dtype) == ((60, 80, 3), np.float32)
    code, _, _ = command("render", scene, "--width", 80, "--height", 60, "--exponent", 16,
                         "-o", tmp_path / "a.exr")  # fmt: skip
    assert code == 0
    assert np.array_equal(image, lobelia.read(tmp_path / "a.exr"))


def test_a_scene_is_a_path_a_text_or_a_dict(scene):
    small = {"width": 20, "height": 20}
    image = lobelia.render(scene, **small)
    assert np.array_equal(image, lobelia.render(str(scene), **small))
    assert np.array_equal(image, lobelia.render(scene.read_text(), **small))
    assert np.array_equal(image, lobelia.render({"scene": scene, **small}))
    assert np.array_equal(image, lobelia.render(lobelia.scene_xml(scene, **small)))
    with pytest.raises(lobelia.UsageError, match="'scene'"):
        lobelia.render(small)
    with pytest.raises(lobelia.UsageError, match="a scene is"):
        lobelia.render(3)


def test_a_picture_knows_its_record_and_shows_itself(image):
    assert image.record.kind == "render"
    assert image.record.highlights[0].exponent == 64
    assert image._repr_png_().startswith(b"\x89PNG")
    assert image[0]._repr_png_() is None
    assert (image * 2).record is None and image.copy().record is None
    assert np.zeros((4, 4, 3), np.float32).view(lobelia.Picture)._repr_png_().startswith(b"\x89PNG")


def test_progress_rises_to_1(scene):
    seen = []
    lobelia.render(scene, seen.append, width=600, height=600, samples=64)
    assert seen == sorted(seen)
    assert seen[-1] == 1


def test_an_exception_of_progress_stops_the_render(scene):
    def stop(fraction):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        lobelia.render(scene, stop, width=4000, height=4000, samples=256)
    assert lobelia.render(scene, width=8, height=8).shape == (8, 8, 3)


def test_ctrl_c_stops_a_render_and_the_next_one_works():
    code = textwrap.dedent("""
        import os, signal, lobelia
        scene = lobelia.scenes()["oblique_45"]
        def stop(fraction):
            os.kill(os.getpid(), signal.SIGINT)
        try:
            lobelia.render(scene, stop, width=8000, height=8000, samples=1024)
        except KeyboardInterrupt:
            print("stopped", lobelia.render(scene, width=8, height=8).shape)
    """)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stdout == "stopped (8, 8, 3)\n", done.stderr


def test_other_threads_run_meanwhile(scene):
    """The render, of an hour, ends because another thread could run."""
    started = threading.Event()

    def interrupt():
        started.wait()
        _thread.interrupt_main()

    thread = threading.Thread(target=interrupt)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        lobelia.render(scene, lambda _: started.set(), width=8000, height=8000, samples=4096)
    thread.join()


def test_a_comparison_has_a_verdict_maps_and_pictures(image):
    result = lobelia.compare(image, image * np.float32(1.5))
    assert not result.passed and not result
    assert result.verdict == "differs"
    assert "limit" in result.why
    assert str(result).splitlines()[-1] == "verdict: differs"
    assert result.metrics["rmse"] > 0
    assert result.not_measured == result["notMeasured"]
    assert np.array_equal(result.image_a, image)
    assert not result.image_a.flags.writeable
    assert set(result.maps) >= {"ciede2000"}
    for name in result.maps:
        if name != "flip.hdr" and "exposure" not in name:
            assert result.maps[name].shape == image.shape[:2]
            assert result.map_png(name).startswith(b"\x89PNG")
    assert result.to_dict()["verdict"] == "differs"
    assert lobelia.compare(image, image).passed


def test_maps_of_exposures_need_exposures(image):
    hdr = [name for name in lobelia.compare(image, image).maps if "hdr" in name]
    for name in hdr:
        with pytest.raises(lobelia.UsageError, match="exposures"):
            lobelia.compare(image, image).maps[name]
        seen = lobelia.compare(image, image, exposures="-2,2")
        assert seen.maps[name].shape == image.shape[:2]
        assert seen.map_png(name).startswith(b"\x89PNG")


def test_html_is_escaped(image, tmp_path):
    name = tmp_path / "<script>&.exr"
    broken = image.copy()
    broken[0, 0] = np.nan  # of which the reason names the file
    lobelia.write(name, broken)
    shown = lobelia.compare(name, image)._repr_html_()
    assert "<script>" not in shown
    assert "&lt;script&gt;&amp;.exr" in shown
    record = lobelia.Record({"kind": "<script>alert(1)</script>"})
    assert "<script>" not in record._repr_html_()
    assert "&lt;script&gt;" in record._repr_html_()


@pytest.mark.parametrize(
    ("bad", "sentence"),
    [
        (np.zeros(4, np.float32), r"its shape is \(4\)"),
        (np.zeros((4, 4, 2), np.float32), r"its shape is \(4, 4, 2\)"),
        (np.zeros((4, 4, 5), np.uint8), r"its shape is \(4, 4, 5\)"),
        (np.zeros((0, 4, 3), np.float32), "4 x 0 pixels"),
        (np.zeros((4, 4, 3), np.uint16), "its values are uint16"),
        (np.zeros((4, 4, 3), np.int8), "its values are int8"),
        (np.zeros((4, 4, 3), bool), "its values are bool"),
        (np.zeros((4, 4, 3), complex), "its values are complex128"),
        (np.zeros((4, 4, 3), object), "no array of numbers"),
        (np.broadcast_to(np.float32(0), (40000, 1, 3)), "1 x 40000 pixels"),
        (np.broadcast_to(np.float32(0), (30000, 30000, 3)), "30000 x 30000 pixels"),
        ([[["x"]]], "no array of numbers"),
    ],
)
def test_what_is_no_picture_is_refused(bad, sentence, image):
    with pytest.raises(lobelia.InputError, match=sentence):
        lobelia.compare(bad, image)
    with pytest.raises(lobelia.InputError):
        lobelia.profile(bad)
    with pytest.raises(lobelia.InputError):
        lobelia.write("unwritten.exr", bad)


def test_a_picture_that_is_none_is_said_to_be_required(image):
    for pair in ((None, image), (image, None)):
        with pytest.raises(lobelia.UsageError, match="a and b are required"):
            lobelia.compare(*pair)
    with pytest.raises(lobelia.InputError, match="no array of numbers"):
        lobelia.profile(None)


def test_other_layouts_are_converted(image):
    for same in (np.asfortranarray(image), image.astype(np.float64), image.tolist(),
                 np.flip(np.ascontiguousarray(np.flip(image, 0)), 0)):  # fmt: skip
        assert lobelia.compare(np.asarray(same, dtype=getattr(same, "dtype", float)), image).passed


def test_what_is_not_finite_is_a_verdict(image):
    for value in (np.nan, np.inf, -np.inf):
        broken = image.copy()
        broken[3, 4, 1] = value
        result = lobelia.compare(broken, image)
        assert result.verdict == "non-finite" and not result.passed
        assert (result.nonfinite.first.a.x, result.nonfinite.first.a.y) == (4, 3)
        assert "<b>non-finite</b>" in result._repr_html_()


def test_several_numbers_of_an_option_are_a_tuple_or_a_list(image):
    for part in ((1, 2, 5, 6), [1, 2, 5, 6], tuple(np.array([1, 2, 5, 6])), np.array([1, 2, 5, 6]), "1,2,5,6"):
        crop = lobelia.compare(image, image, crop=part).crop
        assert (crop.x, crop.y, crop.width, crop.height) == (1, 2, 5, 6)
    result = lobelia.compare(image, image, exposures=(-2, 2), tolerance=(1e-3, 1e-6, 0))
    text = lobelia.compare(image, image, exposures="-2,2", tolerance="1e-3,1e-6,0")
    assert result.to_dict() == text.to_dict()
    with pytest.raises(lobelia.InputError, match="--crop 0,0,999,1"):
        lobelia.compare(image, image, crop=(0, 0, 999, 1))


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda s, a: lobelia.render(s, model="phong"), ["render", "S", "--model", "phong"]),
        (lambda s, a: lobelia.render(s, exponent=1e12), ["render", "S", "--exponent", "1e12"]),
        (lambda s, a: lobelia.render(s, width=0), ["render", "S", "--width", "0"]),
        (lambda s, a: lobelia.render("absent.xml"), ["render", "absent.xml"]),
        (lambda s, a: lobelia.compare(a, a, limits={"rms": 1}), ["compare", "A", "A", "--fail", "rms=1"]),
        (lambda s, a: lobelia.compare(a, a, limits={"ssim": 99}), ["compare", "A", "A", "--fail", "ssim=99"]),
        (lambda s, a: lobelia.compare(a, a, metrics="rms"), ["compare", "A", "A", "--metrics", "rms"]),
        (lambda s, a: lobelia.compare(a, a, crop="0,0,999,1"), ["compare", "A", "A", "--crop", "0,0,999,1"]),
        (lambda s, a: lobelia.compare(a, "absent.exr"), ["compare", "A", "absent.exr"]),
        (lambda s, a: lobelia.compare(a, a, layer="Z"), ["compare", "A", "A", "--layer", "Z"]),
        (lambda s, a: lobelia.profile(a, region=(0, 0, 999, 9)), ["profile", "A", "--region", "0,0,999,9"]),
        (lambda s, a: lobelia.profile(a, scene=s, filter="boks"), ["profile", "A", "--scene", "S", "--filter", "boks"]),
        (lambda s, a: lobelia.reference(s, "povrey"), ["reference", "S", "--engine", "povrey"]),
        (lambda s, a: lobelia.write("no/such/folder.exr", lobelia.read(a)), None),
    ],
)  # fmt: skip
def test_errors_have_the_sentence_and_the_code_of_the_command_line(
    call, words, scene, image, command, tmp_path
):
    picture = tmp_path / "a.exr"
    lobelia.write(picture, image)
    with pytest.raises(lobelia.Error) as raised:
        call(scene, picture)
    if words is None:
        assert raised.value.exit_code == 4
        return
    words = [{"S": scene, "A": picture}.get(word, word) for word in words]
    if words[0] in ("render", "reference"):
        words += ["-o", tmp_path / "out.exr"]
    code, _, said = command(*words)
    assert raised.value.exit_code == code
    # The list of all metrics grows with those that this process has measured.
    assert str(raised.value).split("; there are ")[0] in said


def test_names_of_files_need_not_be_utf8(image, tmp_path):
    name = os.fsdecode(os.fsencode(tmp_path) + b"/\xff.exr")
    with pytest.raises(lobelia.InputError, match=r"\\xff.exr"):
        lobelia.read(name)
    lobelia.write(name, image)
    assert lobelia.compare(name, image).a.endswith("\\xff.exr")


def test_the_module_may_be_found_by_a_relative_path(tmp_path):
    package = os.path.dirname(os.path.dirname(lobelia.__file__))
    code = f"""
import os, sys
os.chdir({package!r})
sys.path[:] = ["."] + [one for one in sys.path if one != {package!r}]
import lobelia
os.chdir({str(tmp_path)!r})
lobelia.write("a.exr", lobelia.render(lobelia.scenes()["head_on"], width=8, height=8))
print(lobelia.read("a.exr").shape)
"""
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment)
    assert done.stdout == "(8, 8, 3)\n", done.stderr


def test_several_threads_may_call_at_once(scene, image, tmp_path):
    lobelia.write(tmp_path / "a.exr", image)
    expected = lobelia.compare(image, image).to_dict()["metrics"]

    def work(i):
        one = lobelia.render(scene, width=96, height=96)
        assert np.array_equal(one, lobelia.read(tmp_path / "a.exr"))
        return lobelia.compare(one, image).to_dict()["metrics"] == expected

    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        assert all(pool.map(work, range(24)))


def test_an_accuracy_chooses_the_settings(scene):
    chosen = lobelia.render(scene, accuracy="1e-3", width=64, height=64).record.accuracy
    assert chosen.reached.value <= 1e-3
    with pytest.raises(lobelia.UsageError, match="excludes"):
        lobelia.render(scene, accuracy="1e-3", precision="float64")


def test_unknown_options_get_a_suggestion(scene, image):
    with pytest.raises(lobelia.UsageError, match="'sampels' is unknown.*did you mean 'samples'"):
        lobelia.render(scene, sampels=3)
    with pytest.raises(lobelia.UsageError, match="'tolerence'"):
        lobelia.compare(image, image, tolerence="1,1,1")


def test_warnings_are_warnings(scene):
    with pytest.warns(lobelia.Warning, match="the paper gives its coefficients"):
        lobelia.render(scene, exponent=4, normalisation="paper", width=8, height=8)


def test_every_fault_of_a_scene_is_a_line():
    with pytest.raises(lobelia.InputError) as raised:
        lobelia.render("<scene version='1'><sphere/><light/></scene>")
    assert len(raised.value.lines) >= 2
    assert all(line.startswith("scene:1:") for line in raised.value.lines)


def test_a_profile_without_a_scene_finds_a_gaussian():
    y, x = np.mgrid[0:80, 0:100]
    spot = 3 * np.exp(-((x + 0.5 - 40) ** 2 + (y + 0.5 - 30) ** 2) / (2 * 6.0**2))
    found = lobelia.profile(np.repeat(spot[:, :, None], 3, 2))
    assert found.kind == "blobs"
    figures = found.highlights[0].images["a"]
    assert (figures.peak.x, figures.peak.y) == pytest.approx((40, 30), abs=0.05)
    assert figures.peak.radiance == pytest.approx(3, rel=1e-2)
    assert figures.gaussian_sigma_pixels.major == pytest.approx(6, rel=2e-2)
    with pytest.raises(lobelia.UsageError, match="need a scene"):
        lobelia.profile(spot, light=0)
    with pytest.raises(lobelia.UsageError, match="without a scene"):
        lobelia.profile(spot, scene="a.xml", at=(1, 1))


def test_the_analytic_reference_agrees_with_a_render(scene):
    theirs = lobelia.reference(scene, "analytic", width=96, height=96)
    ours = lobelia.render(scene, width=96, height=96)
    assert theirs.record.kind == "reference"
    assert lobelia.compare(ours, theirs).passed


def test_an_engine_that_is_no_program_is_an_engine_error(scene, tmp_path):
    with pytest.raises(lobelia.EngineError, match="POV-Ray"):
        lobelia.reference(scene, "povray", program=str(tmp_path / "absent"))


def test_a_farm_gives_its_record_and_goes_on(scene, tmp_path):
    grid = tmp_path / "grid.xml"
    grid.write_text(f"""<grid version="1" title="Two">
      <scene file="{scene}"/><film width="32" height="32"/>
      <axis name="exponent" values="16, 64"/><engine name="analytic"/></grid>""")
    seen = []
    record = lobelia.farm(grid, tmp_path / "out", seen.append)
    assert record.kind == "farm" and seen[-1] == 1
    assert [cell.status for cell in record.cells] == ["pass", "pass"]
    before = (tmp_path / "out" / "farm.json").read_bytes()
    assert lobelia.farm(grid, tmp_path / "out").to_dict()["cells"] == record.to_dict()["cells"]
    assert json.loads(before)["title"] == "Two"
    with pytest.raises(lobelia.InputError):
        lobelia.farm(scene, tmp_path / "other")


def test_a_farm_that_is_stopped_goes_on_from_there(scene, tmp_path):
    grid = tmp_path / "grid.xml"
    grid.write_text(f"""<grid version="1"><scene file="{scene}"/><film width="300" height="300"/>
      <axis name="exponent" values="16, 32, 64, 128, 256"/><engine name="analytic"/></grid>""")

    def stop(fraction):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        lobelia.farm(grid, tmp_path / "out", stop)
    record = lobelia.farm(grid, tmp_path / "out")
    assert {cell.status for cell in record.cells} == {"pass"}
    assert not list((tmp_path / "out").rglob("*.part*"))


def test_a_farm_has_the_identity_of_the_module_and_not_of_python(scene, tmp_path):
    """Otherwise two versions of the package would share results."""
    grid = tmp_path / "grid.xml"
    grid.write_text(f"""<grid version="1"><scene file="{scene}"/><film width="8" height="8"/>
      <axis name="exponent" values="16"/></grid>""")
    lobelia.farm(grid, tmp_path / "out")
    cell = next((tmp_path / "out" / "cells").glob("*/cell.json"))
    program = json.loads(cell.read_text())["madeFrom"]["program"]
    notes = subprocess.run(["readelf", "-n", os.path.realpath(lobelia._lobelia.__file__)],
                           capture_output=True, text=True)  # fmt: skip
    if notes.returncode != 0:
        pytest.skip("readelf is not installed")
    assert program.split()[-1] in notes.stdout

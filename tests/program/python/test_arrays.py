"""Pictures as arrays of every kind: grey, with alpha, of codes, and with masked values."""

import numpy as np
import pytest

import lobelia


def test_masked_values_count_as_equal(image):
    broken = image.copy()
    broken[3, 4, 1] = np.nan
    broken[5:9, 6:9] += 1
    masked = np.ma.masked_array(broken, mask=np.zeros(image.shape, bool))
    assert lobelia.compare(masked, image).verdict == "non-finite"
    masked[3, 4, 1] = np.ma.masked
    assert lobelia.compare(masked, image).verdict == "differs"
    masked[5:9, 6:9] = np.ma.masked
    result = lobelia.compare(masked, image)
    assert result.passed and result.metrics["max_abs"] == 0
    assert result.ignored.pixels == 13
    assert lobelia.compare(image, masked).passed
    assert lobelia.compare(masked[..., 0], image[..., 0]).ignored.pixels == 12
    beside = lobelia.compare(masked, image, ignore="rect:0,0,2,2")
    assert beside.ignored.pixels == 17
    with pytest.raises(lobelia.InputError, match="covers every pixel"):
        lobelia.compare(np.ma.masked_all_like(image), image)


def test_masked_values_are_refused_where_nothing_can_be_left_out(image):
    masked = np.ma.masked_array(image, mask=np.zeros(image.shape, bool))
    masked[3, 4, 1] = np.ma.masked
    for bad in (masked, list(masked), [list(row) for row in masked]):
        calls = [lambda: lobelia.profile(bad), lambda: lobelia.profile(image, error=bad),
                 lambda: lobelia.write("unwritten.exr", bad)]  # fmt: skip
        if isinstance(bad, list):
            calls += [lambda: lobelia.compare(bad, image), lambda: lobelia.compare(image, bad)]
        for call in calls:
            with pytest.raises(lobelia.InputError, match="masked values"):
                call()
    filled = masked.filled(0)
    assert lobelia.compare(filled, filled).passed


def test_grey_is_three_equal_channels(image):
    grey = image[..., 1]
    whole = np.repeat(grey[..., None], 3, axis=2)
    for same in (grey, grey[..., None]):
        assert np.array_equal(lobelia.compare(same, whole).image_a, whole)
        assert lobelia.compare(same, whole).passed
    lobelia.profile(grey)


def test_codes_are_read_as_those_of_a_png(image, tmp_path):
    lobelia.write(tmp_path / "shown.png", image)
    light = lobelia.read(tmp_path / "shown.png")
    codes = np.round(255 * np.where(light <= 0.0031308, 12.92 * light,
                                    1.055 * light ** (1 / 2.4) - 0.055)).astype(np.uint8)  # fmt: skip
    result = lobelia.compare(codes, tmp_path / "shown.png")
    assert result.metrics["max_abs"] == 0
    assert np.array_equal(result.image_a, light)
    # A file's rounding is known, and so is that of codes.
    dark = codes // 4
    lobelia.write(tmp_path / "dark.exr", lobelia.compare(dark, dark).image_a)
    by_codes = lobelia.compare(dark, np.maximum(dark, 1) - 1)
    assert by_codes.limits[0].limit > 0.01


def test_alpha_of_an_array_is_judged(image):
    alpha = np.full(image.shape[:2] + (1,), 0.5, np.float32)
    whole = np.concatenate([image, alpha], axis=2)
    assert lobelia.compare(whole, whole).passed
    other = whole.copy()
    other[..., 3] = 0.75
    result = lobelia.compare(other, whole)
    assert result.metrics["max_abs"] == 0
    assert result.verdict == "differs"
    assert lobelia.compare(other, whole, ignore_alpha=True).passed
    assert not lobelia.compare(image, whole)
    opaque = whole.copy()
    opaque[..., 3] = 1
    assert lobelia.compare(image, opaque).passed
    with pytest.raises(lobelia.InputError, match="alpha"):
        lobelia.write("unwritten.exr", whole)

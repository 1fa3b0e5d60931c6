"""Lobelia: normalised specular highlights, rendered, measured and compared.

>>> import lobelia
>>> scene = lobelia.scenes()["oblique_45"]
>>> image = lobelia.render(scene, width=64, height=64)
>>> image.shape
(64, 64, 3)
>>> lobelia.compare(image, image).passed
True

Pictures are (height, width, 3) float32 arrays of scene-linear light with Rec. 709 primaries, row 0 at the top, or paths
of files. Options have the names of the command line with underscores: `--target-error 0.01` is `target_error=0.01`.
Long work runs without the GIL. Ctrl-C stops it.
"""

from __future__ import annotations

import os
import pathlib
import warnings as _warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Dict, List, Optional, Tuple, Union, overload

import numpy as np
from numpy.typing import ArrayLike

from . import _lobelia
from ._errors import (
    EngineError,
    Error,
    InputError,
    InternalError,
    NoResourcesError,
    OutputError,
    UsageError,
)
from ._errors import Warning as Warning  # not in __all__, where it would hide Python's
from ._lobes import (
    Lobe, albedo, catalogue, coefficient, lobe, lobes, models, normalisation_constant, radiance,
)
from ._record import Comparison, ComparisonSet, Picture, Record

__version__ = _lobelia.version
__all__ = [
    "Comparison", "ComparisonSet", "EngineError", "Error", "InputError", "InternalError", "Lobe", "NoResourcesError",
    "OutputError", "Picture", "Record", "UsageError", "albedo", "catalogue", "coefficient",
    "compare", "cost", "engines", "farm", "lobe", "lobes", "models", "normalisation_constant", "profile", "radiance",
    "read", "reference", "render", "scene_xml", "scenes", "write",
]  # fmt: skip

PathLike = Union[str, "os.PathLike[str]"]
PictureLike = Union[PathLike, ArrayLike]
SceneLike = Union[PathLike, Mapping[str, Any]]
Progress = Optional[Callable[[float], object]]


def scenes() -> Dict[str, pathlib.Path]:
    """The scenes that come with Lobelia, by name.

    >>> sorted(scenes())[:2]
    ['behind_120', 'grazing_80']
    """
    folder = pathlib.Path(__file__).parent / "scenes"
    return {file.stem: file for file in sorted(folder.glob("*.xml"))}


def engines() -> List[str]:
    """The names of the reference engines, installed or not.

    >>> "povray" in engines()
    True
    """
    return _lobelia.engine_names()


def read(path: PathLike) -> Picture:
    """Reads a picture as linear light: OpenEXR, PNG, JPEG, TIFF and more (docs/pictures.md)."""
    return Picture(_lobelia.read(path))


def write(path: PathLike, image: ArrayLike, exposure: float = 0) -> None:
    """Writes a float32 OpenEXR, or with the ending .png an 8-bit sRGB picture that is `exposure` stops brighter."""
    _lobelia.write(path, image, exposure)


def _split(scene: SceneLike, options: Mapping[str, Any]) -> Tuple[PathLike, Dict[str, Any]]:
    """The scene, and the overrides of its dict below those that are given."""
    if not isinstance(scene, Mapping):
        return scene, dict(options)
    inside = dict(scene)
    if "scene" not in inside:
        raise UsageError("a dict of overrides needs the key 'scene', a path or a text of XML")
    return inside.pop("scene"), {**inside, **options}


def _warn(lines: Sequence[str]) -> None:
    for line in lines:
        _warnings.warn(line, Warning, stacklevel=3)


def scene_xml(scene: SceneLike, **overrides: Any) -> str:
    """The scene with its overrides, as a scene file that reads back to the same numbers.

    >>> "modified_phong" in scene_xml(scenes()["head_on"], model="modified_phong")
    True
    """
    source, options = _split(scene, overrides)
    return _lobelia.scene_xml(source, options)


def render(scene: SceneLike, progress: Progress = None, **options: Any) -> Picture:
    """Renders a scene to (height, width, 3) float32, in radiance.

    `scene` is a path, a text of XML, or a dict of overrides with one of these under the key "scene":
    `{"scene": "a.xml", "exponent": 64}`. `progress` is called with the fraction done, 0 to 1, on this thread. If it
    raises, rendering stops.

    Options: `model`, `lobe`, `formula`, `normalisation`, `exponent`, `width` and `height` in pixels, `samples` of a
    pixel and `seed` replace what the scene says. `threads` (0 is all processors), `effects` ("as-called-for", "all"),
    `precision`, `target_error` (relative), `time_limit` in seconds and `max_samples` say how to render. `accuracy`
    ("1e-3" of the peak, or "de2000=1") chooses the cheapest settings: `record.accuracy` says which, and what was
    reached, unless `accuracy_check` is "none".

    The result's `record` is what the command line writes beside a picture.

    >>> render({"scene": scenes()["head_on"], "exponent": 16}, width=32, height=32).record.highlights[0].exponent
    16.0
    """
    source, given = _split(scene, options)
    image, record, lines = _lobelia.render(source, given, progress)
    _warn(lines)
    return Picture(image, Record.parse(record))


def reference(scene: SceneLike, engine: str, **options: Any) -> Picture:
    """Has a reference engine render the scene (docs/agreement.md). Raises EngineError if it is missing or fails.

    `engine` is one of `engines()`. Options: those of `render` that replace what the scene says; `program`, the
    engine's path; `precision`, `shading`, `points`, `threads`, `time_limit` in seconds.

    >>> reference(scenes()["head_on"], "analytic", width=16, height=16).shape
    (16, 16, 3)
    """
    source, given = _split(scene, options)
    image, record, lines = _lobelia.reference(source, engine, given)
    _warn(lines)
    return Picture(image, Record.parse(record))


Limits = Union[Mapping[str, Union[float, str]], Sequence[str], None]


def _limits(limits: Limits) -> List[str]:
    if limits is None:
        return []
    if isinstance(limits, Mapping):
        return [f"{name}={value!s}" for name, value in limits.items()]
    return [limits] if isinstance(limits, str) else list(limits)


@overload
def compare(
    a: Optional[PathLike] = None,
    b: Optional[PathLike] = None,
    metrics: Union[str, Sequence[str], None] = None,
    limits: Limits = None,
    *,
    warnings: Limits = None,
    default_limits: bool = True,
    progress: Progress = None,
    **options: Any,
) -> Any: ...
@overload
def compare(
    a: PictureLike,
    b: PictureLike,
    metrics: Union[str, Sequence[str], None] = None,
    limits: Limits = None,
    *,
    warnings: Limits = None,
    default_limits: bool = True,
    progress: Progress = None,
    **options: Any,
) -> Comparison: ...
def compare(
    a: Optional[PictureLike] = None,
    b: Optional[PictureLike] = None,
    metrics: Union[str, Sequence[str], None] = None,
    limits: Limits = None,
    *,
    warnings: Limits = None,
    default_limits: bool = True,
    progress: Progress = None,
    **options: Any,
) -> Union[Comparison, ComparisonSet]:
    """Compares picture `a` with the reference `b`: metrics, and a verdict with its reasons.

    Each is a path or an array: (height, width) or (height, width, 1) is grey, (height, width, 3) is RGB, (height, width, 4)
    has alpha. Floats are linear light, multiplied by alpha; uint8 are sRGB codes, as a PNG has them. An array is copied
    once, to float32, because the comparison keeps its pictures. `metrics` names what to measure (docs/metrics.md). `limits` are
    `{"rmse": 0.001}` or `["rmse=0.001"]`, and add to the default limits unless `default_limits` is false.

    Options are those of `lobelia compare`: `tolerance="6e-4,1e-8,3"`, `scene`, `mask`, `ignore`, `crop`, `exposure`,
    `exposures`, `a_replicate`, `a_error` and more; `layer`, `layer_type`, `all_layers` and `ignore_alpha` for two files. Several
    numbers may be a tuple, a list or an array, as in `crop=(x, y, width, height)`. Pixels that a numpy.ma.MaskedArray masks
    count as equal, as those of `ignore`.

    The result is true if the verdict is pass or same. It has `metrics`, `limits`, `maps` and `why`.

    Two folders or sequences give a ComparisonSet, by the rules of the command line (docs/comparing.md). So do
    `pattern` and `sets`, which say how names make pairs; `pairs`, a table of files; `also_accept`; and `project`, a
    lobelia.toml. `progress` is called with the fraction of a set that is done.

    Metrics do not look at Ctrl-C: KeyboardInterrupt comes when the comparison is done.

    >>> import numpy as np
    >>> image = render(scenes()["oblique_45"], width=64, height=64)
    >>> result = compare(image, image * np.float32(1.1), limits={"rmse": 1e-3})
    >>> result.passed
    False
    >>> result.maps["ciede2000"].shape
    (64, 64)
    """
    given = dict(options)
    given["fail"] = _limits(limits)
    given["warn"] = _limits(warnings)
    if metrics is not None:
        given["metrics"] = metrics if isinstance(metrics, str) else ",".join(metrics)
    given["no_default_limits"] = not default_limits
    done = _lobelia.compare(a, b, given, progress)
    return ComparisonSet(done) if isinstance(done, _lobelia.ComparedSet) else Comparison(done)


Replicates = Union[PictureLike, Sequence[Any], None]


def _with_noise(
    picture: PictureLike, error: Optional[PictureLike], replicates: Replicates
) -> Tuple[PictureLike, Optional[PictureLike], List[Any]]:
    if error is not None and replicates is not None:
        raise UsageError("the noise of a picture is either its error or its replicates")
    if replicates is None:
        return picture, error, []
    if isinstance(replicates, (list, tuple)):
        return picture, error, list(replicates)
    return picture, error, [replicates]


def profile(
    image: PictureLike,
    reference: Optional[PictureLike] = None,
    *,
    scene: Optional[SceneLike] = None,
    light: Optional[int] = None,
    sphere: Optional[int] = None,
    at: Optional[Tuple[float, float]] = None,
    region: Optional[Tuple[int, int, int, int]] = None,
    least: float = 0.1,
    replicate: Replicates = None,
    error: Optional[PictureLike] = None,
    b_replicate: Replicates = None,
    b_error: Optional[PictureLike] = None,
    **overrides: Any,
) -> Record:
    """Measures the highlights of a picture: peak, widths, energy and curve (docs/profiles.md).

    With `scene` it measures each highlight of the scene and compares it with the formula; `light` and `sphere` choose
    one, and `overrides` are those of `render` and `filter`: "box", "gaussian,1.5" or "none" for how the pictures were
    averaged over their pixels. Without a scene it looks for highlights: `at` = (x, y) in pixels from
    the upper left corner chooses one, `region` = (x, y, width, height) is where to look, and `least` is the share of
    the brightest highlight below which others are left out.

    Figures have standard errors. They are better if the noise is known: `replicate` is another, independent picture of
    the same from as many samples, or a list of these. The picture becomes the mean of all. Or `error` is the picture of
    its standard errors. `b_replicate` and `b_error` are those of the reference.

    The kind of the record is profile or profiles with a scene, blob or blobs without. Pictures are named a and b.

    >>> image = render(scenes()["oblique_45"])
    >>> one = profile(image, scene=scenes()["oblique_45"], light=0)
    >>> round(one.images["a"].half_width_degrees, 2)
    8.42
    """
    pictures = [_with_noise(image, error, replicate)]
    if reference is not None:
        pictures.append(_with_noise(reference, b_error, b_replicate))
    elif b_error is not None or b_replicate is not None:
        raise UsageError("b_error and b_replicate need a reference")
    if scene is None:
        if light is not None or sphere is not None or overrides:
            raise UsageError("light, sphere and overrides need a scene")
        return Record.parse(_lobelia.blobs(pictures, at, region, least))
    if at is not None or region is not None:
        raise UsageError("at and region are for pictures without a scene")
    source, options = _split(scene, overrides)
    return Record.parse(_lobelia.profiles(pictures, source, light, sphere, options))


def cost(
    *scenes: PathLike,
    level: Union[str, Sequence[str], None] = None,
    effort: str = "usual",
    progress: Progress = None,
    **options: Any,
) -> Record:
    """Measures what accuracy costs: error and time of every variant (docs/cost.md). It takes minutes.

    `level` chooses benchmarks; `effort` is "quick", "usual" or "thorough".
    """
    given = {**options, "level": level, "effort": effort}
    return Record.parse(_lobelia.cost(list(scenes), given, progress))


def farm(
    grid: PathLike, directory: PathLike, progress: Progress = None, **options: Any
) -> Record:
    """Renders and compares every cell of a grid (docs/farm.md), on this machine.

    It writes cells and records into `directory` as `lobelia farm` does, and returns the record of the whole,
    farm.json. What is in the cache is not made again. After Ctrl-C the same call goes on from there. Failures and absent
    engines are warnings; each of `cells` has its status.

    Options: `cache`, `filter`, `threads`, `time_limit`, `no_progress_limit`, `attempts`, `memory`, `disk`,
    `fail_fast`, `again`, `require_engines`, `allow_commands`, and an engine's name for its path.
    """
    record, lines = _lobelia.farm(grid, directory, options, progress)
    _warn(lines)
    return Record.parse(record)

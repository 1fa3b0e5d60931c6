"""Checked by mypy --strict; never run."""

import numpy as np

import lobelia
import lobelia.plot


def use(image: lobelia.Picture) -> bool:
    names: list[str] = lobelia.lobes() + lobelia.models()
    value = lobelia.lobe(names[0]).value(np.zeros(3), 16.0)
    rendered: lobelia.Picture = lobelia.render({"scene": "a.xml"}, print, exponent=64)
    result: lobelia.Comparison = lobelia.compare(rendered, "b.exr", limits={"rmse": 1e-3})
    of_folders: lobelia.ComparisonSet = lobelia.compare("mine", "references", progress=print)
    of_project: lobelia.ComparisonSet = lobelia.compare(project="lobelia.toml")
    record: lobelia.Record = lobelia.profile(image, scene="a.xml", replicate=["b.exr", rendered])
    lobelia.plot.profile(record)
    lobelia.plot.difference(result)
    lobelia.write("a.exr", image + value)
    return result.passed and of_folders.passed and bool(of_project) and bool(record.to_dict())

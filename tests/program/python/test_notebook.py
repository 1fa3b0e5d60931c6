"""Tests that need pandas, matplotlib or Jupyter."""

import os

import numpy as np
import pytest
from conftest import ROOT

import lobelia


def test_a_comparison_is_a_dataframe_of_its_metrics(image):
    pandas = pytest.importorskip("pandas")
    result = lobelia.compare(image, image * np.float32(1.1), limits={"rmse": 1e-9})
    frame = result.to_dataframe()
    assert isinstance(frame, pandas.DataFrame)
    assert list(frame["metric"]) == list(result.metrics)
    row = frame.set_index("metric").loc["rmse"]
    assert row["value"] == result.metrics["rmse"] and row["limit"] == 1e-9 and not row["pass"]


def test_a_profile_is_a_dataframe_of_its_curve(image, scene):
    pytest.importorskip("pandas")
    one = lobelia.profile(image, scene={"scene": scene, "width": 96, "height": 96}, light=0)
    frame = one.to_dataframe()
    assert list(frame["angle_degrees"]) == one.curve.angle_degrees
    assert frame["a"].max() == pytest.approx(one.images["a"].peak, rel=0.05)


def test_cost_is_a_dataframe_of_its_variants(small_scene):
    pytest.importorskip("pandas")
    record = lobelia.cost(small_scene, level="picture", effort="quick")
    frame = record.to_dataframe()
    assert len(frame) == sum(len(table.ways) for table in record.tables)
    assert {"table", "variant"} <= set(frame.columns)


def test_plots_show_what_the_records_say(image, scene):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import lobelia.plot

    small = {"scene": scene, "width": 96, "height": 96}
    one = lobelia.profile(image, scene=small, light=0)
    ax = lobelia.plot.profile(one)
    assert [line.get_label() for line in ax.lines] == [name for name in one.curve if name not in ("angleDegrees", "pixels")]
    assert list(ax.lines[0].get_xdata()) == one.curve.angle_degrees
    assert lobelia.plot.profile(lobelia.profile(image)).lines
    assert lobelia.plot.profile(lobelia.profile(image, scene=small)).lines
    ax = lobelia.plot.difference(lobelia.compare(image, image * np.float32(1.1)))
    assert ax.images[0].get_array().shape == image.shape[:2]


def test_the_tutorial_runs(tmp_path):
    nbformat = pytest.importorskip("nbformat")
    execute = pytest.importorskip("nbconvert.preprocessors")
    pytest.importorskip("ipykernel")
    pytest.importorskip("pandas")
    pytest.importorskip("matplotlib")
    os.environ["JUPYTER_ALLOW_INSECURE_WRITES"] = "1"
    notebook = nbformat.read(ROOT / "docs/python_tutorial.ipynb", 4)
    execute.ExecutePreprocessor(timeout=None, kernel_name="python3").preprocess(
        notebook, {"metadata": {"path": str(tmp_path)}}
    )
    outputs = [out for cell in notebook.cells for out in cell.get("outputs", [])]
    kinds = {kind for out in outputs for kind in out.get("data", {})}
    assert {"image/png", "text/html"} <= kinds

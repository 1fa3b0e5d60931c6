"""Plots by matplotlib: a highlight's curves, a map of differences."""

from __future__ import annotations

from typing import Any, Dict, Optional

import numpy as np

from ._errors import UsageError
from ._record import Comparison, Record


def _axes(ax: Optional[Any]) -> Any:
    if ax is not None:
        return ax
    import matplotlib.pyplot

    return matplotlib.pyplot.subplots()[1]


def _draw(ax: Any, curve: Dict[str, Any], along: str, label: str) -> None:
    for name, radiance in curve.items():
        if name not in (along, "pixels"):
            ax.plot(curve[along], np.array(radiance, float), label=label.format(name))


def profile(record: Record, ax: Optional[Any] = None) -> Any:
    """The curves of a profile over the angle, or of a blob over the offset. Returns the axes.

    Of a record with several highlights it is the first.
    """
    values = record.to_dict()
    for several in ("profiles", "highlights"):
        if values.get(several):
            values = values[several][0]
            break
    ax = _axes(ax)
    if "curve" in values:
        _draw(ax, values["curve"], "angleDegrees", "{}")
        ax.set_xlabel("angle in degrees")
    elif "curves" in values:
        for axis, curve in values["curves"].items():
            _draw(ax, curve, "offsetPixels", "{}, " + axis + " axis")
        ax.set_xlabel("offset in pixels")
    else:
        raise UsageError(f"a record of kind '{values.get('kind')}' has no curves")
    ax.set_ylabel("radiance")
    ax.legend()
    return ax


def difference(comparison: Comparison, name: str = "ciede2000", ax: Optional[Any] = None) -> Any:
    """A map of the difference with its scale. Returns the axes."""
    ax = _axes(ax)
    shown = ax.imshow(comparison.maps[name], cmap="magma")
    ax.figure.colorbar(shown, ax=ax, label=name)
    ax.set_axis_off()
    return ax

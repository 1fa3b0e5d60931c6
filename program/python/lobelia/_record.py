"""Results: records as the command line writes them, comparisons, and pictures."""

from __future__ import annotations

import base64
import html
import json
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, Dict, Generic, List, TypeVar, Union

import numpy as np
from numpy.typing import NDArray

from . import _lobelia

if TYPE_CHECKING:
    import pandas


def _snake(key: str) -> str:
    return "".join("_" + c.lower() if c.isupper() else c for c in key)


def _camel(name: str) -> str:
    first, *rest = name.split("_")
    return first + "".join(word[:1].upper() + word[1:] for word in rest)


def _wrapped(value: Any) -> Any:
    if isinstance(value, dict):
        return Record(value)
    if isinstance(value, list):
        return [_wrapped(one) for one in value]
    return value


def _short(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(value) + "}"
    if isinstance(value, list):
        return f"{len(value)} items" if len(value) != 1 else "1 item"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


class Record(Mapping[str, Any]):
    """A record of Lobelia, as in its JSON files (docs/records.md).

    Keys are attributes in Python's spelling: `record.not_measured` is the key "notMeasured", and
    `record["notMeasured"]` is the same. Numbers that are not finite are the texts "nan", "inf" and "-inf".
    """

    def __init__(self, values: Dict[str, Any]) -> None:
        self._values = values

    @classmethod
    def parse(cls, text: str) -> Record:
        """The record of a JSON text."""
        values = json.loads(text)
        if not isinstance(values, dict):
            raise ValueError("a record is a JSON object")
        return cls(values)

    def __getitem__(self, key: str) -> Any:
        return _wrapped(self._values[key])

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __getattr__(self, name: str) -> Any:
        values = self.__dict__.get("_values", {})
        for key in (name, _camel(name)):
            if key in values:
                return _wrapped(values[key])
        raise AttributeError(
            f"the record has no key '{name}'; it has {', '.join(_snake(key) for key in values)}"
        )

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *(_snake(key) for key in self._values)]

    def to_dict(self) -> Dict[str, Any]:
        """A copy as plain dicts and lists, equal to the JSON file."""
        copied: Dict[str, Any] = json.loads(json.dumps(self._values))
        return copied

    def to_json(self) -> str:
        """The JSON text, indented. Unlike the file's text it may be formatted in another way."""
        return json.dumps(self._values, indent=2)

    def to_dataframe(self) -> pandas.DataFrame:
        """The record's main list as a pandas.DataFrame: a row for each metric, variant, cell or highlight."""
        import pandas

        return pandas.DataFrame(_rows(self._values))

    def __repr__(self) -> str:
        kind = self._values.get("kind", "record")
        return f"<lobelia {kind}: {', '.join(_snake(key) for key in self._values)}>"

    def __str__(self) -> str:
        return "\n".join(f"{_snake(key)}: {_short(value)}" for key, value in self._values.items())

    def _repr_html_(self) -> str:
        return _table([(_snake(key), _short(value)) for key, value in self._values.items()])


def _rows(values: Dict[str, Any]) -> List[Dict[str, Any]]:
    if "metrics" in values:
        limits = {limit["metric"]: limit for limit in values.get("limits", [])}
        return [
            {
                "metric": name,
                "value": float(value),
                "limit": limits.get(name, {}).get("limit"),
                "pass": limits.get(name, {}).get("pass"),
            }
            for name, value in values["metrics"].items()
        ]
    if values.get("kind") == "comparison-set":
        return [
            {
                "name": pair["name"],
                "verdict": pair.get("comparison", {}).get("verdict", "error"),
                **{
                    name: float(value)
                    for name, value in pair.get("comparison", {}).get("metrics", {}).items()
                },
            }
            for pair in values["pairs"]
        ]
    if "tables" in values:
        return [
            {
                "table": table["id"],
                "variant": variant["name"],
                **variant.get("settings", {}),
                **{f"error.{name}": float(e) for name, e in variant.get("errors", {}).items()},
                "seconds": variant.get("seconds", {}).get("median"),
                "count": variant.get("count"),
            }
            for table in values["tables"]
            for variant in table["ways"]
        ]
    if "cells" in values:
        return [
            {"cell": cell["id"], **cell.get("axes", {}), "status": cell["status"]}
            for cell in values["cells"]
        ]
    if "curve" in values:
        curve = {_snake(name): numbers for name, numbers in values["curve"].items()}
        return [dict(zip(curve, map(float, row))) for row in zip(*curve.values())]
    for key in ("profiles", "highlights", "models"):
        if isinstance(values.get(key), list):
            rows: List[Dict[str, Any]] = values[key]
            return rows
    return [values]


def _table(rows: List[tuple[str, str]]) -> str:
    cells = "".join(
        f"<tr><th style='text-align:left'>{html.escape(name)}</th><td>{html.escape(value)}</td></tr>"
        for name, value in rows
    )
    return f"<table>{cells}</table>"


def _img(png: bytes, title: str) -> str:
    data = base64.b64encode(png).decode("ascii")
    return (
        f"<figure style='display:inline-block;margin:4px'>"
        f"<img alt='{html.escape(title, quote=True)}' src='data:image/png;base64,{data}'>"
        f"<figcaption>{html.escape(title)}</figcaption></figure>"
    )


class Maps(Mapping[str, NDArray[np.float32]]):
    """Maps of the difference by name, each (height, width) float32, measured when they are asked for."""

    def __init__(self, compared: _lobelia.Compared) -> None:
        self._compared = compared
        self._names = _lobelia.map_names()

    def __getitem__(self, name: str) -> NDArray[np.float32]:
        return self._compared.map(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


_Compared = TypeVar("_Compared", _lobelia.Compared, _lobelia.ComparedSet)


class _Judged(Record, Generic[_Compared]):
    """A record that is true if its verdict passes."""

    def __init__(self, compared: _Compared) -> None:
        super().__init__(json.loads(compared.record))
        self._compared: _Compared = compared

    @property
    def passed(self) -> bool:
        """Whether the verdict is pass or same; of a set, whether every pair passes or is known to differ, and no
        picture is missing or misnamed."""
        return self._compared.passed

    def __bool__(self) -> bool:
        return self.passed


class Comparison(_Judged[_lobelia.Compared]):
    """The record of a comparison, with its verdict, its pictures and its maps.

    It keeps both pictures in memory, as they were compared: with a layer chosen and cut to `crop`.
    """

    @property
    def why(self) -> str:
        """Why it does not pass, as a sentence; empty if it does."""
        return self._compared.why

    @property
    def maps(self) -> Maps:
        """Maps of the difference: `comparison.maps["ciede2000"]`."""
        return Maps(self._compared)

    @property
    def image_a(self) -> Picture:
        """The judged picture, (height, width, 3) float32. It is read-only and not copied."""
        return Picture(self._compared.a)

    @property
    def image_b(self) -> Picture:
        """The reference, likewise."""
        return Picture(self._compared.b)

    def map_png(self, name: str) -> bytes:
        """A map in colours, as the bytes of a PNG file."""
        return self._compared.map_png(name)

    def _limit_lines(self) -> List[tuple[str, str]]:
        return [
            (
                limit["metric"],
                f"{_short(limit['value'])} is {'within' if limit['pass'] else 'OUTSIDE'} "
                f"{_short(limit['limit'])}",
            )
            for limit in self._values.get("limits", [])
        ]

    def __str__(self) -> str:
        lines = [f"{self._values['a']} against {self._values['b']}"]
        if self._compared.highlight:
            lines.append(f"  {self._compared.highlight}")
        lines += [f"  {name:<26} {text}" for name, text in self._limit_lines()]
        lines.append(f"verdict: {self._compared.verdict}")
        return "\n".join(lines)

    def __repr__(self) -> str:
        return f"<lobelia comparison: {self._compared.verdict}>"

    def _repr_html_(self) -> str:
        shown = _img(self.image_a._repr_png_(), "a") + _img(self.image_b._repr_png_(), "b")
        if self._values["verdict"] != "non-finite":
            shown += _img(self.map_png("ciede2000"), "ciede2000")
        return (
            f"<p><b>{html.escape(self._compared.verdict)}</b> "
            f"{html.escape(self._compared.why or self._compared.highlight)}</p>"
            f"{shown}{_table(self._limit_lines())}"
        )

    def _repr_png_(self) -> bytes:
        return self.map_png("ciede2000")


class ComparisonSet(_Judged[_lobelia.ComparedSet]):
    """The record of a set of pairs, with a verdict over all of them.

    Each of `pairs` has its name and its comparison. `missing` are references without a picture, which fail; `extra` are
    pictures without a reference, which do not. `misnamed`, if there are any, are files that nearly are frames of a
    sequence; they fail.
    """

    @property
    def why(self) -> str:
        """The counts, as a sentence; empty if it passes."""
        return "" if self.passed else self._compared.text

    def to_markdown(self) -> str:
        """What `lobelia compare --markdown` writes: the counts, and what does not pass, the worst first."""
        return self._compared.markdown

    def __str__(self) -> str:
        return self._compared.text

    def __repr__(self) -> str:
        return f"<lobelia comparison set: {self._compared.text}>"


class Picture(np.ndarray):  # type: ignore[type-arg]
    """(height, width, 3) float32, scene-linear light with Rec. 709 primaries, row 0 at the top.

    It is an array that a notebook shows as a picture, brightened until its peak is white. `record` is that of the
    render that made it. A copy, a part or a result of arithmetic has None.
    """

    record: Union[Record, None]

    def __new__(cls, values: NDArray[np.float32], record: Union[Record, None] = None) -> Picture:
        made = np.asarray(values).view(cls)
        made.record = record
        return made

    def __array_finalize__(self, other: Any) -> None:
        self.record = None

    def to_png(self, exposure: float = 0) -> bytes:
        """The bytes of an 8-bit sRGB PNG, `exposure` stops brighter."""
        return _lobelia.png(np.asarray(self), exposure)

    def _is_picture(self) -> bool:
        return self.ndim == 3 and self.shape[2] == 3 and self.size > 0

    def _repr_png_(self) -> Any:
        if not self._is_picture():
            return None
        peak = float(np.max(self, initial=0, where=np.isfinite(self)))
        return self.to_png(-float(np.log2(peak)) if peak > 0 else 0)

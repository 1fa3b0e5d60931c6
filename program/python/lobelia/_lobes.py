"""Lobes and models on arrays."""

from __future__ import annotations

from typing import Any, Callable, List, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _lobelia
from ._errors import UsageError
from ._record import Record

Floats = Union[NDArray[np.float32], NDArray[np.float64]]


def lobes() -> List[str]:
    """The names of the lobes, in the catalogue's order. Of the family csK it has the usual members.

    >>> "cs16" in lobes()
    True
    """
    return _lobelia.lobe_names()


def models() -> List[str]:
    """The names of the models, in the catalogue's order.

    >>> "phong_rdf" in models()
    True
    """
    return _lobelia.model_names()


def catalogue(exponent: float = 64) -> Record:
    """All models and lobes with their formulas, and what is measured of them at an exponent.

    >>> catalogue(64).lobes[0].name == lobes()[0]
    True
    """
    return Record.parse(_lobelia.catalogue(exponent))


class Lobe(_lobelia.Lobe):
    """A lobe: a function of s = 1 - cosine of the lobe's angle, and of the exponent n. It is 1 at s = 0.

    >>> lobe("cs16")
    <lobelia lobe cs16>
    """

    def value(self, s: ArrayLike, n: ArrayLike) -> Any:
        """The lobe at s (0 to 2) for exponents n (0 to 1e8), broadcast together.

        Of float32 arrays the result is float32, by the SIMD kernels of the renderer. Otherwise it is float64, by the
        lobe in double precision. NaN gives NaN. Scalars give a scalar.

        >>> import numpy as np
        >>> lobe("cs16").value(np.array([0.0, 0.5, 1.0]), 16.0)
        array([1.00000000e+00, 1.52587891e-05, 0.00000000e+00])
        >>> lobe("cosine").value(np.zeros((3, 1), np.float32), np.ones(2, np.float32)).dtype
        dtype('float32')
        """
        _refuse_masked(s=s, n=n)
        dtype = np.result_type(np.asarray(s), np.asarray(n))
        if dtype.kind not in "fiub":
            raise UsageError(f"s and n are numbers, not {dtype}")
        if dtype in (np.float32, np.float16):
            return _evaluate(self._value32, s, n=n)
        return _evaluate(self._value64, s, n=n)

    def sample(self, u: ArrayLike, n: ArrayLike) -> Any:
        """s (0 to 1) with a density like the lobe's, from uniform numbers u in [0, 1), for exponents n. float64.

        It follows the lobe exactly for cosine, csK and spherical_gaussian, nearly for the others: divide by
        `density`.
        """
        _refuse_masked(u=u, n=n)
        return _evaluate(self._sample, u, n=n)

    def density(self, s: ArrayLike, n: ArrayLike) -> Any:
        """The density of `sample` over s. Its integral from 0 to 1 is 1. float64."""
        _refuse_masked(s=s, n=n)
        return _evaluate(self._density, s, n=n)

    def __repr__(self) -> str:
        return f"<lobelia lobe {self.name}>"


def lobe(name: str, formula: str = "") -> Lobe:
    """The lobe of a name. Of csK any even K from 2 to 1024 is known. "expression" takes a formula.

    >>> lobe("expression", "1 / (1 + n * s)").value(0.5, 2.0)
    0.5
    >>> lobe("cs17")
    Traceback (most recent call last):
    ...
    lobelia.UsageError: ...
    """
    return Lobe(name, formula)


def _refuse_masked(**arrays: ArrayLike) -> None:
    for name, array in arrays.items():
        _lobelia.refuse_masked(array, name)


def _evaluate(function: Callable[..., Any], *others: ArrayLike, n: ArrayLike) -> Any:
    """function(n, *others) on arrays broadcast together: flat, and sorted by n, so that what depends on n alone is made
    once for each of its values."""
    try:
        *rest, exponents = np.broadcast_arrays(*others, n)
    except ValueError:
        shapes = ["(" + ", ".join(map(str, np.shape(one))) + ")" for one in (*others, n)]
        raise UsageError(f"shapes {', '.join(shapes)} cannot be broadcast together") from None
    if np.size(n) == 1 and others:
        values = function(np.ravel(n), *map(np.ravel, rest))
        return values.reshape(exponents.shape)[()]
    order = np.argsort(exponents, axis=None, kind="stable")
    in_order = function(exponents.ravel()[order], *(one.ravel()[order] for one in rest))
    values = np.empty_like(in_order)
    values[order] = in_order
    return values.reshape(exponents.shape)[()]


def _highlight(model: str, lobe_: Union[str, Lobe], normalisation: str) -> _lobelia.Highlight:
    prepared = lobe_ if isinstance(lobe_, Lobe) else Lobe(lobe_)
    return _lobelia.Highlight(model, prepared, normalisation)


def coefficient(
    model: str, lobe: Union[str, Lobe], exponent: ArrayLike, normalisation: str = "exact"
) -> Any:
    """The factor of the lobe in radiance per unit irradiance (1/sr). float64, shaped as `exponent`.

    `normalisation` is "exact", from the integral, or "paper", as the paper prints it.

    >>> import math
    >>> math.isclose(coefficient("phong_rdf", "cosine", 64), 65 / (2 * math.pi))
    True
    """
    _refuse_masked(exponent=exponent)
    return _evaluate(_highlight(model, lobe, normalisation).coefficient, n=exponent)


def normalisation_constant(
    model: str, lobe: Union[str, Lobe], exponent: ArrayLike, normalisation: str = "exact"
) -> Any:
    """The factor of the lobe that makes the model's integral 1: four times the coefficient for a distribution of normals.

    >>> normalisation_constant("blinn_phong_ndf", "cosine", 64) / coefficient("blinn_phong_ndf", "cosine", 64)
    4.0
    """
    _refuse_masked(exponent=exponent)
    return _evaluate(_highlight(model, lobe, normalisation).normalisation_constant, n=exponent)


def albedo(
    model: str,
    lobe: Union[str, Lobe],
    exponent: ArrayLike,
    incidence: ArrayLike = 0.0,
    normalisation: str = "exact",
    of_light: bool = False,
) -> Any:
    """The share of light that is reflected, for incidences in radians (0 to 89.99 degrees). float64, broadcast.

    It is the albedo towards an eye under a uniform sky, or with `of_light` the share of a beam. Both are one where
    the model is reciprocal. By quadrature, about 50 microseconds each.

    >>> round(albedo("modified_phong", "cosine", 64), 6)
    1.0
    """
    _refuse_masked(exponent=exponent, incidence=incidence)
    albedo_of = _highlight(model, lobe, normalisation).albedo
    return _evaluate(lambda n, angle: albedo_of(n, angle, of_light), incidence, n=exponent)


def radiance(
    model: str,
    lobe: Union[str, Lobe],
    exponent: ArrayLike,
    n_dot_l: ArrayLike,
    s: ArrayLike,
    n_dot_v: ArrayLike = 1.0,
    normalisation: str = "exact",
) -> Any:
    """A model's radiance per unit irradiance normal to the beam (1/sr): coefficient, lobe and cosines. float64, broadcast.

    `n_dot_l` is the cosine of the light's incidence; the result is 0 unless it is above 0. `s` is 1 - cosine of the
    model's angle: between L and the mirrored eye for Phong models, between N and the half vector for Blinn's. `n_dot_v` is
    the cosine of the eye, which matters to a model with shadowing alone; the result is 0 unless it is above 0.
    """
    _refuse_masked(exponent=exponent, n_dot_l=n_dot_l, n_dot_v=n_dot_v, s=s)
    return _evaluate(_highlight(model, lobe, normalisation).radiance, n_dot_l, n_dot_v, s, n=exponent)

"""Lobes and models against formulas that are written here by hand."""

import functools
import math

import numpy as np
import pytest

import lobelia
from lobelia._errors import error_of


@functools.cache
def catalogue():
    return lobelia.catalogue(16)


def cs(order, s, n):
    return np.maximum(0, 1 - n * s / order) ** order


def cosine(s, n):
    return np.maximum(0, 1 - s) ** n


def test_float32_gives_float32_and_all_else_float64():
    lobe = lobelia.lobe("cs16")
    s32 = np.zeros(3, np.float32)
    assert lobe.value(s32, np.float32(16)).dtype == np.float32
    assert lobe.value(s32, np.ones(3, np.float32)).dtype == np.float32
    assert lobe.value(s32, np.ones(3)).dtype == np.float64
    assert lobe.value(np.zeros(3), 16).dtype == np.float64
    assert lobe.value(0, 16) == 1
    assert np.ndim(lobe.value(0, 16)) == 0


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize(
    "shapes",
    [((), ()), ((5,), ()), ((), (5,)), ((5, 1), (7,)), ((7,), (5, 1)), ((3, 1, 4), (2, 1)),
     ((0,), ()), ((0, 3), (3,)), ((1100,), (1,)), ((2, 3), (2, 3))],
)  # fmt: skip
def test_arguments_are_broadcast_as_numpy_does(shapes, dtype):
    random = np.random.default_rng(1)
    s = random.uniform(0, 1, shapes[0]).astype(dtype)
    n = random.uniform(1, 8, shapes[1]).astype(dtype)
    value = lobelia.lobe("cs16").value(s, n)
    assert np.shape(value) == np.broadcast_shapes(*shapes)
    assert np.allclose(value, cs(16, s.astype(float), n.astype(float)), rtol=1e-5)


def test_strides_do_not_matter():
    s = np.linspace(0, 1, 600).reshape(20, 30)
    for view in (s[::2, ::-3], s.T, s[:, :1]):
        assert np.array_equal(lobelia.lobe("cosine").value(view, 9.0),
                              lobelia.lobe("cosine").value(np.array(view), 9.0))  # fmt: skip


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_nan_stays_nan(dtype):
    for name in lobelia.lobes():
        value = lobelia.lobe(name).value(np.array([0.1, np.nan, 0], dtype), dtype(8))
        assert list(np.isnan(value)) == [False, True, False]


@pytest.mark.parametrize("s", [-0.1, 2.5, np.inf, -np.inf])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_s_out_of_range_is_named(s, dtype):
    with pytest.raises(lobelia.UsageError, match=r"s = .* is out of range; allowed: 0 to 2"):
        lobelia.lobe("cs16").value(np.array([0.5, s], dtype), dtype(8))


@pytest.mark.parametrize("n", [-1, 1e9, np.nan, np.inf])
def test_an_exponent_out_of_range_is_named(n):
    for call in (
        lambda: lobelia.lobe("cs16").value(0.5, n),
        lambda: lobelia.lobe("cs16").value(np.float32(0.5), np.float32(n)),
        lambda: lobelia.lobe("cs16").sample(0.5, n),
        lambda: lobelia.coefficient("phong_rdf", "cosine", n),
        lambda: lobelia.albedo("phong_rdf", "cosine", n),
    ):
        with pytest.raises(lobelia.UsageError, match="exponent .* is out of range; allowed: 0 to"):
            call()


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: lobelia.lobe("cs16").value(np.zeros(3), np.ones(4)), r"\(3\), \(4\) cannot be broadcast"),
        (lambda: lobelia.lobe("cs16").value("text", 8), "s and n are numbers"),
        (lambda: lobelia.lobe("cs16").value([object()], 8), "s and n are numbers"),
        (lambda: lobelia.lobe("cs16").value([1j], 8), "s and n are numbers"),
        (lambda: lobelia.lobe("cosin"), "did you mean 'cosine'"),
        (lambda: lobelia.coefficient("phong_rd", "cosine", 8), "did you mean 'phong_rdf'"),
        (lambda: lobelia.coefficient("phong_rdf", "cosine", 8, "norm"), "allowed: exact, paper"),
        (lambda: lobelia.lobe("cosine").sample(1.0, 8), "u = .* is out of range"),
        (lambda: lobelia.lobe("cosine").sample(-0.1, 8), "u = .* is out of range"),
        (lambda: lobelia.lobe("cosine").sample(np.nan, 8), "u = .* is out of range"),
        (lambda: lobelia.lobe("expression", "1 / ("), "--formula"),
        (lambda: lobelia.lobe("expression"), "needs a --formula"),
        (lambda: lobelia.albedo("phong_rdf", "cosine", 64, math.pi / 2), "incidence"),
    ],
)
def test_a_wrong_argument_is_named(call, sentence):
    with pytest.raises(lobelia.UsageError, match=sentence):
        call()


def test_a_formula_is_a_lobe():
    n, s = 8.0, np.linspace(0, 0.99, 50)
    lobe = lobelia.lobe("expression", "1 / (1 + n * s)")
    assert np.allclose(lobe.value(s, n), 1 / (1 + n * s))
    assert np.allclose(lobe.value(s.astype(np.float32), np.float32(n)), 1 / (1 + n * s), rtol=1e-5)


def test_the_paper_has_no_coefficient_for_other_lobes():
    assert lobelia.coefficient("phong_rdf", "cs16", 64, "paper") > 0
    with pytest.raises(lobelia.InputError, match="the paper gives no coefficient"):
        lobelia.coefficient("phong_rdf", "schlick", 64, "paper")


def test_masked_values_are_refused():
    masked = np.ma.masked_array([0.1, 0.2], mask=[False, True])
    lobe = lobelia.lobe("cosine")
    calls = (lambda: lobe.value(masked, 8.0), lambda: lobe.value(0.1, [masked + 8, masked + 9]),
             lambda: lobe.sample(masked, 8.0), lambda: lobe.density(masked, 8.0),
             lambda: lobelia.coefficient("phong_rdf", "cosine", masked + 8),
             lambda: lobelia.albedo("phong_rdf", "cosine", 8.0, masked),
             lambda: lobelia.radiance("phong_rdf", "cosine", 8.0, 0.5, masked))  # fmt: skip
    for call in calls:
        with pytest.raises(lobelia.InputError, match="masked values"):
            call()
    assert lobe.value(np.ma.masked_array([0.1, 0.2]), 8.0).shape == (2,)


def test_an_rdf_reflects_all_light_at_normal_incidence():
    for name in ("cosine", "cs16"):
        assert lobelia.albedo("phong_rdf", name, 64) == pytest.approx(1, abs=1e-8)
    incidence = np.radians([0, 30, 60])
    both = [lobelia.albedo("modified_phong", "cosine", 16, incidence, of_light=of)
            for of in (False, True)]  # fmt: skip
    assert both[0].shape == (3,)


@pytest.mark.parametrize("model", lobelia.models())
def test_radiance_is_coefficient_lobe_cosine_and_shadowing(model):
    info = next(one for one in catalogue().models if one.name == model)
    s, n, n_dot_l, n_dot_v = np.linspace(0, 1, 7), 16.0, np.array([[-0.5], [0.0], [0.25], [1.0]]), 0.6
    lit = np.where(n_dot_l > 0, n_dot_l, 1.0)
    factor = lit if info.applies_cosine else np.ones_like(lit)
    if info.has_shadowing:
        def twice_lambda(c):
            return np.sqrt(1 + 2 / (n + 2) * (1 / c**2 - 1)) - 1
        factor = factor / (lit * n_dot_v * (1 + twice_lambda(lit) / 2 + twice_lambda(n_dot_v) / 2))
    expected = lobelia.coefficient(model, "cosine", n) * factor * cosine(s, n) * (n_dot_l > 0)
    given = lobelia.radiance(model, "cosine", n, n_dot_l, s, n_dot_v)
    assert np.allclose(given, expected, rtol=1e-10)


def test_the_catalogue_names_every_model_and_lobe():
    assert [one.name for one in catalogue().models] == lobelia.models()
    assert [one.name for one in catalogue().lobes] == lobelia.lobes()
    assert {one.model for one in catalogue().highlights} == set(lobelia.models())
    assert {one.lobe for one in catalogue().highlights} == set(lobelia.lobes())


def test_every_exit_code_has_its_exception():
    kinds = [
        kind for kind in vars(lobelia).values()
        if isinstance(kind, type) and issubclass(kind, lobelia.Error) and kind is not lobelia.Error
    ]  # fmt: skip
    assert {kind.exit_code for kind in kinds} == {2, 3, 4, 5, 70, 71}
    for kind in kinds:
        assert type(error_of(kind.exit_code, ["why"])) is kind
    assert isinstance(error_of(71, ["no threads"]), MemoryError)

"""The models and lobes, written from the formulas and not from Lobelia's source, so that a mistake there makes the pictures
differ. A model or a lobe is one entry here."""

import math
import re
from collections import namedtuple

# is_rdf: the radiance has no factor N.L. part: the lobe's angle as a share of the integration angle x.
# by_cosine: cos x is a weight. factor: a microfacet distribution D reflects D/4. cosine: the coefficient of cos^n in
# closed form, with tail = 2^(-n/2). cs16: the printed coefficient of cs16. misprint: the factor by which the printed
# coefficient of cos^n is wrong. smith: shadowing by Smith, in place of the implicit (N.L)(N.V).
Model = namedtuple("Model", "half_vector is_rdf part by_cosine factor cosine cs16 misprint smith",
                   defaults=(1, False))
MODELS = {
    "phong_rdf": Model(False, True, 1.0, False, 1,
                       lambda n, tail: (n + 1) / (2 * math.pi),
                       lambda n: 1.063 * n / (2 * math.pi)),
    "modified_phong": Model(False, False, 1.0, True, 1,
                            lambda n, tail: (n + 2) / (2 * math.pi),
                            lambda n: (1.063 * n + 1) / (2 * math.pi)),
    "blinn_phong_rdf": Model(True, True, 0.5, False, 1,
                             lambda n, tail: (n + 2) / (4 * math.pi * (2 - tail)),
                             lambda n: (1.068 * n + 0.96) / (8 * math.pi)),
    # The paper prints 4 pi instead of 8 pi, which doubles the energy.
    "modified_blinn_phong": Model(True, False, 0.5, True, 1,
                                  lambda n, tail: (n + 2) * (n + 4) / (8 * math.pi * (tail + n)),
                                  lambda n: (1.027 * n + 4.8) / (8 * math.pi), misprint=2),
    "blinn_phong_ndf": Model(True, False, 1.0, False, 4,
                             lambda n, tail: (n + 1) / (8 * math.pi),
                             lambda n: 1.063 * n / (8 * math.pi)),
    "blinn_phong_heightfield": Model(True, False, 1.0, True, 4,
                                     lambda n, tail: (n + 2) / (8 * math.pi),
                                     lambda n: (1.063 * n + 1) / (8 * math.pi)),
    "microfacet_smith": Model(True, False, 1.0, True, 4,
                              lambda n, tail: (n + 2) / (8 * math.pi),
                              lambda n: (1.063 * n + 1) / (8 * math.pi), smith=True),
}

FLAT = 1e-60  # for the exponent 0, where it divides

# value: at s = 1 - cos(angle) < 1. node: the same as shader nodes. reach: the s where the lobe ends or has fallen to 4e-18.
# k is the order of a family, or a formula as a tree.
Lobe = namedtuple("Lobe", "value node reach")
LOBES = {
    "cosine": Lobe(None, lambda nodes, s, n, k: nodes.cosine_lobe(s, n), None),
    # cos^k for another s.
    "cs": Lobe(lambda s, n, k: max(0.0, 1 - n * s / k) ** k,
               lambda nodes, s, n, k: nodes.cosine_lobe(nodes.math("MULTIPLY", n / k, s), k),
               lambda n, k: k / max(n, FLAT)),
    # cos^k for another s, as 1 - u is the cubic.
    "pk": Lobe(lambda s, n, k: max(0.0, 1 - pk_fall(n, k, n * s)) ** k,
               lambda nodes, s, n, k: nodes.cosine_lobe(pk_fall_node(nodes, n, k, s), k),
               lambda n, k: fallen(lambda s: LOBES["pk"].value(s, n, k))),
    "spherical_gaussian": Lobe(
        lambda s, n, k: math.exp(-n * s),
        lambda nodes, s, n, k: nodes.math("EXPONENT", nodes.math("MULTIPLY", -n, s)),
        lambda n, k: 40 / max(n, FLAT)),
    "gauss": Lobe(
        lambda s, n, k: math.exp(-2 * n * math.asin(math.sqrt(s / 2)) ** 2),
        lambda nodes, s, n, k: nodes.math(
            "EXPONENT", nodes.math("MULTIPLY", -n, nodes.half_square_of_angle(s))),
        lambda n, k: 40 / max(n, FLAT)),
    "schlick": Lobe(lambda s, n, k: (1 - s) / (1 - s + n * s),
                    lambda nodes, s, n, k: schlick_node(nodes, s, n),
                    lambda n, k: 1.0),
    # As printed it is (alpha^2/(c^2 (alpha^2 - 1) + 1))^2, where 1 - c^2 = s (2 - s).
    "ggx": Lobe(lambda s, n, k: (1 + n * s * (2 - s) / 2) ** -2,
                lambda nodes, s, n, k: ggx_node(nodes, s, n),
                lambda n, k: 1.0),
    "expression": Lobe(
        lambda s, n, k: formula_lobe(k, s, n),
        lambda nodes, s, n, k: nodes.math(
            "MAXIMUM", 0.0, nodes.math("MINIMUM", 1.0, formula_node(nodes, k, s, n))),
        lambda n, k: fallen(lambda s: formula_lobe(k, s, n))),
}

# By the order k of pk3: the cubic of t = n s is 1 + q1 t + q2 t^2 + q3 t^3, and each q is a + b v + c v^2, v = 1/max(n, 16).
PK3 = {
    2: ((-0.4870510102, -0.02714573094, 0),
        (0.1006701317, -0.1437461631, 0),
        (-0.008057364014, 0.02973722682, 0)),
    4: ((-0.2489836846, -0.01710772416, 0),
        (0.02922607759, -0.08697986523, 0),
        (-0.001588107903, 0.008609950066, 0)),
    8: ((-0.1249374068, -0.005078414538, 0.05946058577),
        (0.007678866686, -0.05293123069, -0.1160499687),
        (-0.0002564566794, 0.003943782166, 0.001248944705)),
    16: ((-0.06249538915, -0.0006733233308, 0.01116129152),
        (0.001944214873, -0.03015564769, -0.01780493112),
        (-3.675033301e-05, 0.001583516365, -0.01515373696)),
}

# The operations of a formula: a number, a name, or a list of an operation and its operands.
OPERATIONS = {
    "+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b, "/": lambda a, b: a / b,
    "^": lambda a, b: a ** b, "min": min, "max": max, "negate": lambda a: -a, "exp": math.exp,
    "log": math.log, "sqrt": math.sqrt, "abs": abs, "sin": math.sin, "cos": math.cos, "tan": math.tan,
    "asin": math.asin, "acos": math.acos, "atan": math.atan,
}
NODES = {
    "+": "ADD", "-": "SUBTRACT", "*": "MULTIPLY", "/": "DIVIDE", "^": "POWER", "min": "MINIMUM",
    "max": "MAXIMUM", "exp": "EXPONENT", "sqrt": "SQRT", "abs": "ABSOLUTE", "sin": "SINE",
    "cos": "COSINE", "tan": "TANGENT", "asin": "ARCSINE", "acos": "ARCCOSINE", "atan": "ARCTANGENT",
}


def formula_value(tree, names):
    """As in C: infinite or not a number where Python raises an error."""
    if not isinstance(tree, list):
        return names[tree] if isinstance(tree, str) else tree
    operands = [formula_value(operand, names) for operand in tree[1:]]
    try:
        value = OPERATIONS[tree[0]](*operands)
    except OverflowError:
        return math.inf
    except (ValueError, ZeroDivisionError):
        return math.nan
    return math.nan if isinstance(value, complex) else value


def formula_lobe(tree, s, n):
    if s >= 1:
        return 0.0
    value = formula_value(tree, {"s": s, "c": 1 - s, "x": 2 * math.asin(math.sqrt(s / 2)), "n": n})
    return min(1.0, value) if value > 0 else 0.0


def fallen(value):
    """The s where a lobe has fallen to 4e-18, by halving what is left."""
    above, beyond = 0.0, 1.0
    for _ in range(90):
        s = (above + beyond) / 2
        if value(s) > 4e-18:
            above = s
        else:
            beyond = s
    return beyond


def formula_node(nodes, tree, s, n):
    if tree == "c":
        return nodes.math("SUBTRACT", 1.0, s)
    if tree == "x":
        half = nodes.math("ARCSINE", nodes.math("SQRT", nodes.math("MULTIPLY", 0.5, s)))
        return nodes.math("MULTIPLY", 2.0, half)
    if not isinstance(tree, list):
        return {"s": s, "n": n}.get(tree, tree)
    operands = [formula_node(nodes, operand, s, n) for operand in tree[1:]]
    if tree[0] == "negate":
        return nodes.math("SUBTRACT", 0.0, *operands)
    if tree[0] == "log":
        return nodes.math("LOGARITHM", *operands, math.e)
    return nodes.math(NODES[tree[0]], *operands)


def schlick_node(nodes, s, n):
    c = nodes.math("MAXIMUM", nodes.math("SUBTRACT", 1.0, s), 0.0)
    return nodes.math("DIVIDE", c, nodes.math("ADD", c, nodes.math("MULTIPLY", n, s)))


def ggx_node(nodes, s, n):
    square = nodes.math("MULTIPLY", s, nodes.math("SUBTRACT", 2.0, s))
    share = nodes.math("DIVIDE", 1.0, nodes.math("ADD", 1.0, nodes.math("MULTIPLY", n / 2, square)))
    return nodes.math("MULTIPLY", share, share)


def pk_coefficients(n, k):
    v = 1 / max(n, 16)
    return [a + b * v + c * v ** 2 for a, b, c in PK3[k]]


def pk_fall(n, k, t):
    q1, q2, q3 = pk_coefficients(n, k)
    return -(q1 * t + q2 * t ** 2 + q3 * t ** 3)


def pk_fall_node(nodes, n, k, s):
    q1, q2, q3 = pk_coefficients(n, k)
    t = nodes.math("MULTIPLY", n, s)
    sum2 = nodes.math("ADD", q2, nodes.math("MULTIPLY", q3, t))
    sum1 = nodes.math("ADD", q1, nodes.math("MULTIPLY", sum2, t))
    return nodes.math("MULTIPLY", nodes.math("SUBTRACT", 0.0, sum1), t)


def find_lobe(material):
    """The lobe and its order; cs16 is the family cs with k = 16, and pk3.2 the family pk with k = 4. Of a formula, the formula."""
    name = material["lobe"]
    if family := re.fullmatch("cs([0-9]+)", name):
        return LOBES["cs"], int(family[1])
    if family := re.fullmatch("pk3[.]([1-4])", name):
        return LOBES["pk"], 2 ** int(family[1])
    return LOBES[name], material.get("formula")


def integral(f, end):
    """From 0 to end by the rule of Takahasi and Mori. Its points crowd at both ends, which resolves sharp lobes at 0 and
    lobes that drop only at the horizon."""
    step, total = 1 / 64, 0.0
    for i in range(-205, 206):
        u = math.pi / 2 * math.sinh(i * step)
        slope = math.pi / 4 * math.cosh(i * step) / math.cosh(u) ** 2
        total += f(end / (1 + math.exp(-2 * u))) * slope
    return total * end * step


def coefficient(model, material):
    """1 / (2 pi times the integral of the lobe over the angle x = 0..pi/2, with the model's weight)."""
    n = material["exponent"]
    if material["lobe"] == "cosine":
        return model.cosine(n, 2.0 ** (-n / 2))
    lobe, k = find_lobe(material)
    end = min(math.pi / 2,
              2 * math.asin(math.sqrt(min(1.0, lobe.reach(n, k)) / 2)) / model.part)

    def integrand(x):
        s = 2 * math.sin(model.part * x / 2) ** 2
        weight = math.cos(x) if model.by_cosine else 1
        return lobe.value(s, n, k) * math.sin(x) * weight

    return 1 / (2 * math.pi * model.factor * integral(integrand, end))


def coefficient_of(material):
    model, lobe = MODELS[material["model"]], material["lobe"]
    if material["normalisation"] != "paper":
        return coefficient(model, material)
    if lobe == "cs16":
        return model.cs16(material["exponent"])
    if lobe == "cosine":
        return model.misprint * coefficient(model, material)
    raise KeyError(lobe)

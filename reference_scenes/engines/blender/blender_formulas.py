"""The models and lobes, written from the formulas and not from Lobelia's source, so that a mistake there makes the pictures
differ. A model or a lobe is one entry here."""

import math
import re
from collections import namedtuple

# is_rdf: the radiance has no factor N.L. part: the lobe's angle as a share of the integration angle x.
# by_cosine: cos x is a weight. factor: a microfacet distribution D reflects D/4. cosine: the coefficient of cos^n in
# closed form, with tail = 2^(-n/2). cs16: the printed coefficient of cs16. misprint: the factor by which the printed
# coefficient of cos^n is wrong.
Model = namedtuple("Model", "half_vector is_rdf part by_cosine factor cosine cs16 misprint",
                   defaults=(1,))
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
}

# value: at s = 1 - cos(angle) < 1. node: the same as shader nodes. reach: the s where the lobe ends or has fallen to 4e-18.
# k is the order of a family.
Lobe = namedtuple("Lobe", "value node reach")
LOBES = {
    "cosine": Lobe(None, lambda nodes, s, n, k: nodes.cosine_lobe(s, n), None),
    # cos^k for another s.
    "cs": Lobe(lambda s, n, k: max(0.0, 1 - n * s / k) ** k,
               lambda nodes, s, n, k: nodes.cosine_lobe(nodes.math("MULTIPLY", n / k, s), k),
               lambda n, k: k / n),
    "spherical_gaussian": Lobe(
        lambda s, n, k: math.exp(-n * s),
        lambda nodes, s, n, k: nodes.math("EXPONENT", nodes.math("MULTIPLY", -n, s)),
        lambda n, k: 40 / n),
    "gauss": Lobe(
        lambda s, n, k: math.exp(-2 * n * math.asin(math.sqrt(s / 2)) ** 2),
        lambda nodes, s, n, k: nodes.math(
            "EXPONENT", nodes.math("MULTIPLY", -n, nodes.half_square_of_angle(s))),
        lambda n, k: 40 / n),
    "schlick": Lobe(lambda s, n, k: (1 - s) / (1 - s + n * s),
                    lambda nodes, s, n, k: schlick_node(nodes, s, n),
                    lambda n, k: 1.0),
}


def schlick_node(nodes, s, n):
    c = nodes.math("MAXIMUM", nodes.math("SUBTRACT", 1.0, s), 0.0)
    return nodes.math("DIVIDE", c, nodes.math("ADD", c, nodes.math("MULTIPLY", n, s)))


def find_lobe(name):
    """The lobe and its order; cs16 is the family cs with k = 16."""
    family = re.fullmatch("(cs)([0-9]+)", name)
    return (LOBES[family[1]], int(family[2])) if family else (LOBES[name], None)


def integral(f, end):
    """From 0 to end by the rule of Takahasi and Mori. Its points crowd at both ends, which resolves sharp lobes at 0 and
    lobes that drop only at the horizon."""
    step, total = 1 / 64, 0.0
    for i in range(-205, 206):
        u = math.pi / 2 * math.sinh(i * step)
        slope = math.pi / 4 * math.cosh(i * step) / math.cosh(u) ** 2
        total += f(end / (1 + math.exp(-2 * u))) * slope
    return total * end * step


def coefficient(model, lobe_name, n):
    """1 / (2 pi times the integral of the lobe over the angle x = 0..pi/2, with the model's weight)."""
    if lobe_name == "cosine":
        return model.cosine(n, 2.0 ** (-n / 2))
    lobe, k = find_lobe(lobe_name)
    end = min(math.pi / 2,
              2 * math.asin(math.sqrt(min(1.0, lobe.reach(n, k)) / 2)) / model.part)

    def integrand(x):
        s = 2 * math.sin(model.part * x / 2) ** 2
        weight = math.cos(x) if model.by_cosine else 1
        return lobe.value(s, n, k) * math.sin(x) * weight

    return 1 / (2 * math.pi * model.factor * integral(integrand, end))


def coefficient_of(material):
    model, lobe, n = MODELS[material["model"]], material["lobe"], material["exponent"]
    if material["normalisation"] != "paper":
        return coefficient(model, lobe, n)
    if lobe == "cs16":
        return model.cs16(n)
    if lobe == "cosine":
        return model.misprint * coefficient(model, lobe, n)
    raise KeyError(lobe)

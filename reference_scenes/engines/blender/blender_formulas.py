"""The coefficients and lobes, written from their formulas and not from Lobelia's source, so that a mistake there
shows as a difference of pictures."""

import math
import re

REFLECTION_MODELS = ("phong_rdf", "modified_phong")
HALF_VECTOR_MODELS = ("blinn_phong_rdf", "modified_blinn_phong",
                      "blinn_phong_ndf", "blinn_phong_heightfield")
RDF_MODELS = ("phong_rdf", "blinn_phong_rdf")  # their radiance has no factor N.L


def cosine_exact(model, n):
    """1 over the integral, times 2 pi, of cos^n with the weight that the model has; a microfacet
    distribution D (the last two) reflects D/4."""
    tail = 2.0 ** (-n / 2)
    return {
        "phong_rdf": (n + 1) / (2 * math.pi),
        "modified_phong": (n + 2) / (2 * math.pi),
        "blinn_phong_rdf": (n + 2) / (4 * math.pi * (2 - tail)),
        "modified_blinn_phong": (n + 2) * (n + 4) / (8 * math.pi * (tail + n)),
        "blinn_phong_ndf": (n + 1) / (8 * math.pi),
        "blinn_phong_heightfield": (n + 2) / (8 * math.pi),
    }[model]


def cosine_paper(model, n):
    """The paper prints 4 pi instead of 8 pi in one row, and so twice the energy."""
    misprint = 2 if model == "modified_blinn_phong" else 1
    return misprint * cosine_exact(model, n)


def cs16_paper(model, n):
    return {
        "phong_rdf": 1.063 * n / (2 * math.pi),
        "modified_phong": (1.063 * n + 1) / (2 * math.pi),
        "blinn_phong_rdf": (1.068 * n + 0.96) / (8 * math.pi),
        "modified_blinn_phong": (1.027 * n + 4.8) / (8 * math.pi),
        "blinn_phong_ndf": 1.063 * n / (8 * math.pi),
        "blinn_phong_heightfield": (1.063 * n + 1) / (8 * math.pi),
    }[model]


def order_of(lobe):
    """The k of a lobe cs_k, or None."""
    return int(lobe[2:]) if re.fullmatch("cs[0-9]+", lobe) else None


def lobe_value(lobe, s, n):
    """Of s = 1 - cos(angle) below 1."""
    k = order_of(lobe)
    if k:
        return max(0.0, 1 - n * s / k) ** k
    if lobe == "spherical_gaussian":
        return math.exp(-n * s)
    if lobe == "gauss":
        return math.exp(-2 * n * math.asin(math.sqrt(s / 2)) ** 2)
    if lobe == "schlick":
        return (1 - s) / (1 - s + n * s)
    raise KeyError(lobe)


def integral(f, end):
    """From 0 to end by the rule of Takahasi and Mori, whose points crowd at both ends: a lobe of any
    sharpness is resolved at 0, and one that drops only at the horizon is there."""
    step, total = 1 / 64, 0.0
    for i in range(-205, 206):
        u = math.pi / 2 * math.sinh(i * step)
        slope = math.pi / 4 * math.cosh(i * step) / math.cosh(u) ** 2
        total += f(end / (1 + math.exp(-2 * u))) * slope
    return total * end * step


def exact(model, lobe, n):
    """1 over 2 pi times the integral of the lobe over the angle x = 0..pi/2, with the model's weight; a
    microfacet distribution D (the last two) reflects D/4."""
    if lobe == "cosine":
        return cosine_exact(model, n)
    part, cosine, factor = {   # the lobe's angle in terms of x; whether cos x is a weight
        "phong_rdf": (1.0, False, 1),
        "modified_phong": (1.0, True, 1),
        "blinn_phong_rdf": (0.5, False, 1),
        "modified_blinn_phong": (0.5, True, 1),
        "blinn_phong_ndf": (1.0, False, 4),
        "blinn_phong_heightfield": (1.0, True, 4),
    }[model]
    # Where the lobe ends or has fallen to 4e-18, in s; Schlick's reaches to the horizon.
    reach = {"schlick": 1.0}.get(lobe, (order_of(lobe) or 40) / n)
    end = min(math.pi / 2, 2 * math.asin(math.sqrt(min(1.0, reach) / 2)) / part)

    def integrand(x):
        s = 2 * math.sin(part * x / 2) ** 2
        return lobe_value(lobe, s, n) * math.sin(x) * (math.cos(x) if cosine else 1)

    return 1 / (2 * math.pi * factor * integral(integrand, end))


def coefficient_of(material):
    model, lobe, n = material["model"], material["lobe"], material["exponent"]
    if material["normalisation"] == "paper":
        return {"cosine": cosine_paper, "cs16": cs16_paper}[lobe](model, n)
    return exact(model, lobe, n)

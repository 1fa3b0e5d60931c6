#include "studies/shader_check/mistakes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lobelia::shader_check {
namespace {

bool has_cosine(const Highlight& h) { return info(h.model).applies_cosine; }
bool has_shadowing(const Highlight& h) { return info(h.model).has_shadowing; }
bool is_distribution(const Highlight& h) {
  return info(h.model).normalised != NormalisedQuantity::kRadiance;
}
bool is_unshadowed_distribution(const Highlight& h) {
  return is_distribution(h) && !has_shadowing(h);
}
bool has_no_cosine(const Highlight& h) { return !has_cosine(h); }
bool is_mirror(const Highlight& h) { return info(h.model).angle == LobeAngle::kReflection; }
bool is_half(const Highlight& h) { return !is_mirror(h); }

using Mistakes = std::vector<Mistake>;

void add_angles(Mistakes& all) {
  const auto add = [&](const char* id, const char* words, bool (*applies)(const Highlight&),
                       double (*cosine)(const Geometry&)) {
    all.push_back({id, Part::kAngle, words, applies,
                   [cosine](Formula& f, double) { f.lobe_cosine = cosine; }});
  };
  add("half-vector-not-normalised", "H is not normalised: N.(L + V) is used", is_half,
      [](const Geometry& g) { return g.n_dot_h * g.half_length; });
  add("half-vector-halved", "H is (L + V) / 2, which is not normalised", is_half,
      [](const Geometry& g) { return 0.5 * g.n_dot_h * g.half_length; });
  add("half-vector-sign", "H is made of L - V: one of the directions points the wrong way", is_half,
      [](const Geometry& g) { return g.n_dot_difference; });
  add("half-vector-sign", "H is made of V - L: one of the directions points the wrong way", is_half,
      [](const Geometry& g) { return -g.n_dot_difference; });
  all.push_back({"mirror-for-half-vector", Part::kAngle, "R.L is used where N.H is expected",
                 is_half, [](Formula& f, double) { f.angle = LobeAngle::kReflection; }});
  all.push_back({"half-vector-for-mirror", Part::kAngle, "N.H is used where R.L is expected",
                 is_mirror, [](Formula& f, double) { f.angle = LobeAngle::kHalfVector; }});
  add("reflect-sign",
      "reflect has the wrong sign: -R.L is used where R.L is expected (reflect takes a direction "
      "towards the surface)",
      is_mirror, [](const Geometry& g) { return -g.mirror; });
  all.push_back({"abs-mirror", Part::kAngle, "abs(R.L) is used where max(R.L, 0) is expected",
                 is_mirror, [](Formula& f, double) { f.mirrored = true; }});
  add("light-for-half-vector", "N.L is used in the lobe", nullptr,
      [](const Geometry& g) { return g.n_dot_l; });
  add("eye-for-half-vector", "N.V is used in the lobe", nullptr,
      [](const Geometry& g) { return g.n_dot_v; });
  add("eye-and-half-vector", "V.H is used in the lobe", nullptr,
      [](const Geometry& g) { return g.v_dot_h; });
  add("light-and-eye", "L.V is used in the lobe", nullptr,
      [](const Geometry& g) { return g.l_dot_v; });
  add("lobe-missing", "there is no lobe: it does not depend on the eye", nullptr,
      [](const Geometry&) { return 1.0; });
}

void add_directions(Mistakes& all) {
  const auto add = [&](const char* id, const char* words, Reversed which) {
    all.push_back({id, Part::kDirection, words, nullptr,
                   [which](Formula& f, double) { f.reversed = which; }});
  };
  add("light-reversed", "L is reversed: it points to the surface", Reversed::kLight);
  add("normal-reversed", "N is reversed: it points into the surface", Reversed::kNormal);
  add("eye-reversed", "V is reversed: it points to the surface", Reversed::kEye);
  add("two-sided", "it is two-sided: N is turned to the light, so light leaks through from behind",
      Reversed::kToLight);
}

void add_behind(Mistakes& all) {
  using enum Formula::Behind;
  const auto add = [&](const char* id, const char* words, bool (*applies)(const Highlight&),
                       Formula::Behind behind, bool mirrored = false) {
    all.push_back({id, Part::kBehind, words, applies, [behind, mirrored](Formula& f, double) {
                     f.behind = behind;
                     f.mirrored = f.mirrored || mirrored;
                   }});
  };
  add("light-behind", "light leaks through from behind: there is no test of N.L > 0 or the like",
      nullptr, kSigned);
  add("abs-cosine",
      "abs(N.L) is used where max(N.L, 0) is expected, so light leaks through from behind",
      has_cosine, kAbsolute);
  add("two-sided",
      "it is two-sided: abs() is used of N.L and of the lobe's cosine, so light leaks through from "
      "behind",
      nullptr, kAbsolute, true);
  add("test-reversed", "the test of N.L is reversed: it is lit from behind alone", nullptr,
      kReversedAbsolute);
  add("test-reversed",
      "the test of N.L is reversed: it is lit from behind alone, and negative there", has_cosine,
      kReversed);
}

void add_cosines(Mistakes& all) {
  const auto add = [&](const char* id, const char* words, bool (*applies)(const Highlight&),
                       double (*cosine)(double, const Geometry&)) {
    all.push_back(
        {id, Part::kCosine, words, applies, [cosine](Formula& f, double) { f.cosine = cosine; }});
  };
  add("cosine-missing", "the cosine N.L is missing", has_cosine, nullptr);
  add("cosine-twice", "the cosine N.L is applied twice", has_cosine,
      [](double light, const Geometry&) { return light * light; });
  add("cosine-applied", "the cosine N.L is applied, which this model does not have", has_no_cosine,
      [](double light, const Geometry&) { return light; });
  add("eye-cosine", "N.V is used where the cosine N.L is expected", has_cosine,
      [](double, const Geometry& g) { return g.n_dot_v; });
  add("half-vector-cosine", "N.H is used where the cosine N.L is expected", has_cosine,
      [](double, const Geometry& g) { return g.n_dot_h; });
  add("half-vector-cosine", "V.H is used where the cosine N.L is expected", has_cosine,
      [](double, const Geometry& g) { return g.v_dot_h; });
  add("cosine-root", "the square root of N.L is used", nullptr,
      [](double light, const Geometry&) { return std::sqrt(std::max(light, 0.0)); });
  add("cosine-smoothstep", "smoothstep(0, 1, N.L) is used", nullptr,
      [](double light, const Geometry&) {
        const double t = std::clamp(light, 0.0, 1.0);
        return t * t * (3 - 2 * t);
      });
  add("cosine-wrapped", "N.L is wrapped: 0.5 N.L + 0.5 is used", nullptr,
      [](double light, const Geometry&) { return 0.5 * light + 0.5; });
  add("cosine-wrapped", "N.L is wrapped: (0.5 N.L + 0.5)^2 is used", nullptr,
      [](double light, const Geometry&) { return std::pow(0.5 * light + 0.5, 2); });
}

double alpha_of(double exponent) { return std::sqrt(alpha_squared(exponent)); }
double roughness_of(double exponent) { return std::sqrt(alpha_of(exponent)); }

/// The two sides of a separable term of Schlick's form, over (N.L)(N.V).
double schlick(double l, double v, double k) { return 1 / ((l * (1 - k) + k) * (v * (1 - k) + k)); }

void add_geometry_terms(Mistakes& all) {
  using G = const Geometry&;
  const auto add = [&](const char* id, const std::string& words, bool (*applies)(const Highlight&),
                       double (*term)(double, double, G, double)) {
    all.push_back({id, Part::kGeometryTerm, words, applies,
                   [term](Formula& f, double) { f.geometry_term = term; }});
  };
  add("shadowing-missing",
      "the shadowing is missing: the geometry term is (N.L)(N.V), which cancels", has_shadowing,
      nullptr);
  add("over-eye-cosine", "it is divided by N.V", has_cosine,
      [](double, double v, G, double) { return 1 / v; });
  add("no-geometry-term", "it is divided by (N.L)(N.V), as a microfacet model with a geometry term",
      has_cosine, [](double l, double v, G, double) { return 1 / (l * v); });
  const std::string other = "the geometry term is ";
  add("geometry-term", other + "height-correlated Smith", is_unshadowed_distribution, smith_term);
  add("geometry-term", other + "separable Smith", is_distribution,
      [](double l, double v, G, double n) {
        const double a = alpha_squared(n);
        const auto side = [&](double c) { return 2 / (c + std::sqrt(a + (1 - a) * c * c)); };
        return side(l) * side(v);
      });
  add("geometry-term", other + "the linear approximation of Smith", is_distribution,
      [](double l, double v, G, double n) {
        const double a = alpha_of(n);
        return 2 / (2 * l * v * (1 - a) + (l + v) * a);
      });
  add("geometry-term", other + "Smith with roughness for alpha", is_distribution,
      [](double l, double v, G g, double n) { return smith_term(l, v, g, 2 / alpha_of(n) - 2); });
  add("geometry-term", other + "Smith with alpha^2 for alpha", is_distribution,
      [](double l, double v, G g, double n) {
        return smith_term(l, v, g, 2 / std::pow(alpha_squared(n), 2) - 2);
      });
  add("geometry-term", other + "Schlick-GGX with k = (roughness + 1)^2 / 8, of direct light",
      is_distribution, [](double l, double v, G, double n) {
        return schlick(l, v, std::pow(roughness_of(n) + 1, 2) / 8);
      });
  add("geometry-term", other + "Schlick-GGX with k = roughness^2 / 2, of image-based light",
      is_distribution,
      [](double l, double v, G, double n) { return schlick(l, v, alpha_of(n) / 2); });
  add("geometry-term", other + "Schlick-GGX with k = (alpha + 1)^2 / 8: alpha for roughness",
      is_distribution, [](double l, double v, G, double n) {
        return schlick(l, v, std::pow(alpha_of(n) + 1, 2) / 8);
      });
  add("geometry-term", other + "Schlick-GGX with k = alpha^2 / 2: alpha for roughness",
      is_distribution,
      [](double l, double v, G, double n) { return schlick(l, v, alpha_squared(n) / 2); });
  add("geometry-term", other + "Schlick's with k = alpha sqrt(2 / pi)", is_distribution,
      [](double l, double v, G, double n) {
        return schlick(l, v, alpha_of(n) * std::sqrt(2 / std::numbers::pi));
      });
  add("geometry-term", other + "Kelemen's, over (V.H)^2", is_distribution,
      [](double, double, G g, double) { return 1 / (g.v_dot_h * g.v_dot_h); });
  add("geometry-term", other + "Neumann's, over max(N.L, N.V)", is_distribution,
      [](double l, double v, G, double) { return 1 / std::max(l, v); });
  add("geometry-term", other + "Ward's, over sqrt((N.L)(N.V))", is_distribution,
      [](double l, double v, G, double) { return 1 / std::sqrt(l * v); });
  add("geometry-term", other + "Cook and Torrance's", is_distribution,
      [](double l, double v, G g, double) {
        return std::min(1.0, 2 * g.n_dot_h * std::min(l, v) / g.v_dot_h) / (l * v);
      });
}

void add_exponents(Mistakes& all) {
  const auto add = [&](const std::string& used, double (*rule)(double n)) {
    all.push_back({"exponent", Part::kExponent, used + " is used where n is expected", nullptr,
                   [rule](Formula& f, double n) { f.exponent = rule(n); }});
  };
  add("n / 2", [](double n) { return n / 2; });
  add("2 n", [](double n) { return 2 * n; });
  add("n / 4", [](double n) { return n / 4; });
  add("4 n", [](double n) { return 4 * n; });
  add("n + 1", [](double n) { return n + 1; });
  add("n - 1", [](double n) { return n - 1; });
  add("n + 2", [](double n) { return n + 2; });
  add("n^2", [](double n) { return n * n; });
  add("sqrt(n)", [](double n) { return std::sqrt(n); });
  add("128 n", [](double n) { return 128 * n; });
  add("n / 1000", [](double n) { return n / 1000; });
  const auto add_rule = [&](const std::string& used, double (*rule)(double alpha)) {
    all.push_back({"exponent-of-roughness", Part::kExponent,
                   fmt::format("the exponent is {}, where 2 / alpha^2 - 2 is expected", used),
                   nullptr, [rule](Formula& f, double n) { f.exponent = rule(alpha_of(n)); },
                   true});
  };
  add_rule("2 / alpha^2", [](double a) { return 2 / (a * a); });
  add_rule("2 / alpha - 2 (alpha is not squared)", [](double a) { return 2 / a - 2; });
  add_rule("2 / roughness - 2 (roughness is not squared at all)",
           [](double a) { return 2 / std::sqrt(a) - 2; });
  add_rule("2 / alpha^4 - 2 (it is squared once too often)",
           [](double a) { return 2 / std::pow(a, 4) - 2; });
  add_rule("1 / alpha^2", [](double a) { return 1 / (a * a); });
  add_rule("1 / alpha", [](double a) { return 1 / a; });
  add_rule("1 / roughness", [](double a) { return 1 / std::sqrt(a); });
  add_rule("2^(10 (1 - roughness) + 1)",
           [](double a) { return std::exp2(10 * (1 - std::sqrt(a)) + 1); });
  add_rule("128 (1 - roughness)", [](double a) { return 128 * (1 - std::sqrt(a)); });
  add_rule("1000 (1 - roughness)", [](double a) { return 1000 * (1 - std::sqrt(a)); });
}

Mistakes make_mistakes() {
  Mistakes all;
  add_cosines(all);
  add_behind(all);
  add_angles(all);
  add_directions(all);
  add_geometry_terms(all);
  all.push_back({"half-float-s", Part::kRounding, "s is a half float", nullptr,
                 [](Formula& f, double) { f.half = Formula::Half::kS; }});
  all.push_back({"half-float-cosine", Part::kRounding, "the cosine of the lobe is a half float",
                 nullptr, [](Formula& f, double) { f.half = Formula::Half::kCosine; }});
  add_exponents(all);
  for (const LobeId& lobe : all_lobes())
    all.push_back({"lobe", Part::kLobe, fmt::format("its lobe is {}", info(lobe).name), nullptr,
                   [lobe](Formula& f, double) { f.lobe = lobe; }});
  return all;
}

}  // namespace

std::span<const Mistake> mistakes() {
  static const Mistakes all = make_mistakes();
  return all;
}

Formula formula_of(const Highlight& highlight, double n, std::span<const Mistake* const> made) {
  Formula formula = own_formula(highlight, n);
  for (const Mistake* mistake : made) mistake->change(formula, n);
  formula.exponent = std::clamp(formula.exponent, kMinExponent, kMaxExponent);
  return formula;
}

}  // namespace lobelia::shader_check

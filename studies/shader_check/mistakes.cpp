#include "studies/shader_check/mistakes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/pictures/colour.hpp"
#include "base/pictures/half.hpp"
#include "renderer/models/smith.hpp"

namespace lobelia::shader_check {
namespace {

constexpr double kPi = std::numbers::pi;

bool has_cosine(const Highlight& h) { return info(h.model).applies_cosine; }
bool has_shadowing(const Highlight& h) { return info(h.model).has_shadowing; }
bool has_no_cosine(const Highlight& h) { return !has_cosine(h); }
bool is_mirror(const Highlight& h) { return info(h.model).angle == LobeAngle::kReflection; }
bool is_half(const Highlight& h) { return !is_mirror(h); }

std::vector<Mistake> make_mistakes() {
  using enum Part;
  using Behind = Formula::Behind;
  std::vector<Mistake> all{
      {"cosine-missing", kCosine, "the cosine N.L is missing", has_cosine,
       [](Formula& f, double) { f.cosines = 0; }},
      {"cosine-twice", kCosine, "the cosine N.L is applied twice", has_cosine,
       [](Formula& f, double) { f.cosines = 2; }},
      {"cosine-applied", kCosine, "the cosine N.L is applied, which this model does not have",
       has_no_cosine, [](Formula& f, double) { f.cosines = 1; }},
      {"shadowing-missing", kCosine,
       "the shadowing is missing: the geometry term is (N.L)(N.V), which cancels", has_shadowing,
       [](Formula& f, double) { f.has_shadowing = false; }},
      {"light-behind", kBehind,
       "light leaks through from behind: there is no test of N.L > 0 or the like", nullptr,
       [](Formula& f, double) { f.behind = Behind::kSigned; }},
      {"abs-cosine", kBehind,
       "abs(N.L) is used where max(N.L, 0) is expected, so light leaks through from behind",
       nullptr, [](Formula& f, double) { f.behind = Behind::kAbsolute; }},
      {"half-vector-not-normalised", kAngle, "H is not normalised: N.(L + V) is used", is_half,
       [](Formula& f, double) {
         f.lobe_cosine = [](const Geometry& g) { return g.n_dot_h * g.half_length; };
       }},
      {"half-vector-halved", kAngle, "H is (L + V) / 2, which is not normalised", is_half,
       [](Formula& f, double) {
         f.lobe_cosine = [](const Geometry& g) { return 0.5 * g.n_dot_h * g.half_length; };
       }},
      {"half-vector-sign", kAngle, "H is made of L - V: one of the directions points the wrong way",
       is_half,
       [](Formula& f, double) {
         f.lobe_cosine = [](const Geometry& g) { return g.n_dot_difference; };
       }},
      {"half-vector-sign", kAngle, "H is made of V - L: one of the directions points the wrong way",
       is_half,
       [](Formula& f, double) {
         f.lobe_cosine = [](const Geometry& g) { return -g.n_dot_difference; };
       }},
      {"mirror-for-half-vector", kAngle, "R.L is used where N.H is expected", is_half,
       [](Formula& f, double) { f.angle = LobeAngle::kReflection; }},
      {"half-vector-for-mirror", kAngle, "N.H is used where R.L is expected", is_mirror,
       [](Formula& f, double) { f.angle = LobeAngle::kHalfVector; }},
      {"reflect-sign", kAngle,
       "reflect has the wrong sign: -R.L is used where R.L is expected (reflect takes a direction "
       "towards the surface)",
       is_mirror,
       [](Formula& f, double) { f.lobe_cosine = [](const Geometry& g) { return -g.mirror; }; }},
      {"abs-mirror", kAngle, "abs(R.L) is used where max(R.L, 0) is expected", is_mirror,
       [](Formula& f, double) { f.mirrored = true; }},
      {"light-for-half-vector", kAngle, "N.L is used in the lobe", nullptr,
       [](Formula& f, double) { f.lobe_cosine = [](const Geometry& g) { return g.n_dot_l; }; }},
      {"eye-for-half-vector", kAngle, "N.V is used in the lobe", nullptr,
       [](Formula& f, double) { f.lobe_cosine = [](const Geometry& g) { return g.n_dot_v; }; }},
      {"eye-and-half-vector", kAngle, "V.H is used in the lobe", nullptr,
       [](Formula& f, double) { f.lobe_cosine = [](const Geometry& g) { return g.v_dot_h; }; }},
      {"light-and-eye", kAngle, "L.V is used in the lobe", nullptr,
       [](Formula& f, double) { f.lobe_cosine = [](const Geometry& g) { return g.l_dot_v; }; }},
      {"eye-cosine", kCosine, "N.V is used where the cosine N.L is expected", has_cosine,
       [](Formula& f, double) { f.factor = [](const Geometry& g) { return g.n_dot_v; }; }},
      {"half-vector-cosine", kCosine, "N.H is used where the cosine N.L is expected", has_cosine,
       [](Formula& f, double) { f.factor = [](const Geometry& g) { return g.n_dot_h; }; }},
      {"over-eye-cosine", kCosine, "it is divided by N.V", has_cosine,
       [](Formula& f, double) {
         f.factor = [](const Geometry& g) { return g.n_dot_l / g.n_dot_v; };
       }},
      {"no-geometry-term", kCosine,
       "it is divided by (N.L)(N.V), as a microfacet model with a geometry term", has_cosine,
       [](Formula& f, double) { f.factor = [](const Geometry& g) { return 1 / g.n_dot_v; }; }},
      {"fresnel", kCosine, "a Fresnel factor of F0 = 0.04 is in it", has_cosine,
       [](Formula& f, double) {
         f.factor = [](const Geometry& g) {
           return g.n_dot_l * (0.04 + 0.96 * std::pow(1 - g.v_dot_h, 5));
         };
       }},
      {"half-float-s", kRounding, "s is a half float", nullptr,
       [](Formula& f, double) { f.half = Formula::Half::kS; }},
      {"half-float-cosine", kRounding, "the cosine of the lobe is a half float", nullptr,
       [](Formula& f, double) { f.half = Formula::Half::kCosine; }},
  };
  const auto add_exponent = [&](const std::string& used, std::function<double(double n)> rule) {
    all.push_back({"exponent", kExponent, used + " is used where n is expected", nullptr,
                   [rule](Formula& f, double n) { f.exponent = rule(n); }});
  };
  add_exponent("n / 2", [](double n) { return n / 2; });
  add_exponent("2 n", [](double n) { return 2 * n; });
  add_exponent("n / 4", [](double n) { return n / 4; });
  add_exponent("4 n", [](double n) { return 4 * n; });
  add_exponent("n + 1", [](double n) { return n + 1; });
  add_exponent("n - 1", [](double n) { return n - 1; });
  add_exponent("n + 2", [](double n) { return n + 2; });
  add_exponent("n^2", [](double n) { return n * n; });
  add_exponent("sqrt(n)", [](double n) { return std::sqrt(n); });
  const auto add_rule = [&](const std::string& used, std::function<double(double alpha)> rule) {
    all.push_back(
        {"exponent-of-roughness", kExponent,
         fmt::format("the exponent is {}, where 2 / alpha^2 - 2 is expected", used), nullptr,
         [rule](Formula& f, double n) { f.exponent = rule(std::sqrt(2 / (n + 2))); }, true});
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
  for (const LobeId& lobe : all_lobes())
    all.push_back({"lobe", kLobe, fmt::format("its lobe is {}", info(lobe).name), nullptr,
                   [lobe](Formula& f, double) { f.lobe = lobe; }});
  return all;
}

std::vector<CoefficientMistake> make_coefficients() {
  std::vector<CoefficientMistake> all;
  const auto add_factor = [&](const char* id, const std::string& words, double factor) {
    all.push_back(
        {id, words, [factor](const Highlight&, double own, double) { return own * factor; }});
  };
  add_factor("pi-missing", "a division by pi is missing", kPi);
  add_factor("pi-twice", "it is divided by pi once too often", 1 / kPi);
  add_factor("two-missing", "a division by 2 is missing", 2);
  add_factor("two-twice", "it is divided by 2 once too often", 0.5);
  add_factor("four-missing", "a division by 4 is missing", 4);
  add_factor("four-twice", "it is divided by 4 once too often", 0.25);
  add_factor("two-pi-missing", "a division by 2 pi is missing", 2 * kPi);
  add_factor("four-pi-missing", "a division by 4 pi is missing", 4 * kPi);
  add_factor("eight-pi-missing", "a division by 8 pi is missing", 8 * kPi);
  const auto add_constant = [&](const char* id, const std::string& words, double value) {
    all.push_back({id, words, [value](const Highlight&, double, double) { return value; }});
  };
  add_constant("coefficient-missing", "there is no coefficient", 1);
  add_constant("coefficient-constant", "the coefficient is 1 / pi, whatever n", 1 / kPi);
  for (const int added : {1, 2, 8, 0, 4})
    for (const auto& [text, divisor] :
         {std::pair{" / (8 pi)", 8 * kPi}, std::pair{" / (2 pi)", 2 * kPi},
          std::pair{" / (4 pi)", 4 * kPi}, std::pair{" / pi", kPi}, std::pair{" / 8", 8.0},
          std::pair{" / 2", 2.0}, std::pair{" / 4", 4.0}, std::pair{"", 1.0}})
      all.push_back({"coefficient", (added == 0 ? "n" : fmt::format("(n + {})", added)) + text,
                     [added, divisor = divisor](const Highlight&, double, double n) {
                       return (n + added) / divisor;
                     }});
  for (const ModelId model : all_models())
    all.push_back({"coefficient", fmt::format("the coefficient of {}", info(model).name),
                   [model](const Highlight& h, double, double n) {
                     return radiance_coefficient({model, h.lobe, Normalisation::kExact, n});
                   }});
  return all;
}

double clamped_srgb(double v) { return srgb_encoded(std::clamp(v, 0.0, 1.0)); }

constexpr OutputMistake kOutputs[] = {
    {"clamped", "the result is clamped to 1", [](double v) { return std::min(v, 1.0); }},
    {"srgb", "the result is encoded as sRGB, where light is expected", clamped_srgb},
    {"srgb", "the result is encoded as sRGB, where light is expected", srgb_encoded},
    {"srgb-twice", "the result is encoded as sRGB twice",
     [](double v) { return clamped_srgb(clamped_srgb(v)); }},
    {"srgb-twice", "the result is encoded as sRGB twice",
     [](double v) { return srgb_encoded(srgb_encoded(v)); }},
    {"srgb-decoded", "the result is decoded as sRGB, as if it were no light",
     [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }},
    {"gamma", "the result has a gamma of 1 / 2.2",
     [](double v) { return std::pow(std::max(v, 0.0), 1 / 2.2); }},
    {"gamma", "the result has a gamma of 1 / 2.2, and is clamped to 1",
     [](double v) { return std::pow(std::clamp(v, 0.0, 1.0), 1 / 2.2); }},
    {"square-root", "the result is a square root",
     [](double v) { return std::sqrt(std::max(v, 0.0)); }},
    {"tone-mapped", "the result is tone-mapped, v / (1 + v)", [](double v) { return v / (1 + v); }},
    {"tone-mapped", "the result is tone-mapped, 1 - exp(-v)",
     [](double v) { return -std::expm1(-v); }},
};

}  // namespace

std::span<const Mistake> mistakes() {
  static const std::vector<Mistake> all = make_mistakes();
  return all;
}

std::span<const CoefficientMistake> coefficient_mistakes() {
  static const std::vector<CoefficientMistake> all = make_coefficients();
  return all;
}

std::span<const OutputMistake> output_mistakes() { return kOutputs; }

Formula formula_of(const Highlight& highlight, double n, std::span<const Mistake* const> made) {
  Formula formula{.angle = info(highlight.model).angle,
                  .lobe = highlight.lobe,
                  .cosines = info(highlight.model).applies_cosine ? 1 : 0,
                  .has_shadowing = info(highlight.model).has_shadowing,
                  .exponent = n};
  for (const Mistake* mistake : made) mistake->change(formula, n);
  formula.exponent = std::clamp(formula.exponent, kMinExponent, kMaxExponent);
  return formula;
}

double shape_value(const Formula& formula, const Geometry& g) {
  using Behind = Formula::Behind;
  if (formula.behind == Behind::kBlack && g.n_dot_l <= 0) return 0;
  double s = formula.angle == LobeAngle::kReflection ? g.s_mirror : g.s_half;
  if (formula.lobe_cosine) s = 1 - formula.lobe_cosine(g);
  if (formula.mirrored) s = 1 - std::abs(1 - s);
  if (formula.half == Formula::Half::kS) s = rounded_to_half(s);
  if (formula.half == Formula::Half::kCosine) s = 1 - rounded_to_half(1 - s);
  double lobe = 0;
  // A vector that is not normalised may have a cosine over 1.
  if (s < 0)
    lobe = std::pow(1 - s, formula.exponent);
  else if (s < 1)
    lobe = lobe_value(formula.lobe, s, formula.exponent);
  const double light = formula.behind == Behind::kAbsolute ? std::abs(g.n_dot_l) : g.n_dot_l;
  if (formula.has_shadowing)
    lobe *= HWY_NAMESPACE::smith_factor(alpha_squared(formula.exponent), std::abs(g.n_dot_l),
                                        std::abs(g.n_dot_v));
  if (formula.factor) return lobe * formula.factor(g);
  return lobe * std::pow(light, formula.cosines);
}

std::string own_coefficient_text(const Highlight& highlight) {
  if (info(highlight.lobe).name != "cosine") return "the model's own";
  std::string text = formulas(highlight.model).exact_cosine;
  // A distribution's radiance has a quarter of it.
  constexpr std::string_view kTwoPi = "/ (2 pi)";
  if (info(highlight.model).normalised == NormalisedQuantity::kRadiance) return text;
  if (!text.ends_with(kTwoPi)) return text + " / 4";
  return text.substr(0, text.size() - kTwoPi.size()) + "/ (8 pi)";
}

}  // namespace lobelia::shader_check

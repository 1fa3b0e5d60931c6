#include "studies/shader_check/coefficients.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace lobelia::shader_check {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kOfFitted = 1.25, kOfFittedLine = 1.5, kUnknown = 2;
/// A fitted factor is a cause only so many times its tolerance away from 1, and if it does not print as 1.
constexpr double kClear = 3, kLeastExposure = 5e-4, kLeastOfLine = 5e-4;

struct Factor {
  std::string_view id, words;
  double value;
};
constexpr Factor kFactors[] = {
    {"pi-missing", "a division by pi is missing", kPi},
    {"pi-twice", "it is divided by pi once too often", 1 / kPi},
    {"two-missing", "a division by 2 is missing", 2},
    {"two-twice", "it is divided by 2 once too often", 0.5},
    {"four-missing", "a division by 4 is missing", 4},
    {"four-twice", "it is divided by 4 once too often", 0.25},
    {"two-pi-missing", "a division by 2 pi is missing", 2 * kPi},
    {"four-pi-missing", "a division by 4 pi is missing", 4 * kPi},
    {"eight-pi-missing", "a division by 8 pi is missing", 8 * kPi},
};
constexpr Factor kRoundedPi[] = {
    {"", "", 1},
    {"pi-rounded", "pi is 3.14", kPi / 3.14},
    {"pi-rounded", "pi is 22 / 7", kPi / (22.0 / 7)},
    {"pi-rounded", "pi is 3.142", kPi / 3.142},
    {"pi-rounded", "1 / pi is 0.318", 0.318 * kPi},
    {"pi-rounded", "1 / pi is 0.32", 0.32 * kPi},
    {"pi-rounded", "pi is 3.1", kPi / 3.1},
    {"pi-rounded", "pi is 3", kPi / 3},
};
struct Divisor {
  const char* text;
  double value;
};
constexpr Divisor kDivisors[] = {{" / (8 pi)", 8 * kPi},
                                 {" / (2 pi)", 2 * kPi},
                                 {" / (4 pi)", 4 * kPi},
                                 {" / pi", kPi},
                                 {" / 8", 8},
                                 {" / 2", 2},
                                 {" / 4", 4},
                                 {"", 1}};

/// c = slope n + offset with the smallest relative errors.
std::pair<double, double> line_through(std::span<const FittedCoefficient> fitted) {
  double nn = 0, n1 = 0, one = 0, ny = 0, y = 0;
  for (const FittedCoefficient& at : fitted) {
    const double w = 1 / std::pow(at.value * at.tolerance, 2), n = at.exponent;
    nn += w * n * n, n1 += w * n, one += w, ny += w * n * at.value, y += w * at.value;
  }
  const double determinant = nn * one - n1 * n1;
  return {(ny * one - y * n1) / determinant, (nn * y - n1 * ny) / determinant};
}

}  // namespace

double CoefficientNames::exact(ModelId model, const LobeId& lobe, double exponent) {
  const double n = std::clamp(exponent, kMinExponent, kMaxExponent);
  const auto compute = [&] {
    return radiance_coefficient({model, lobe, Normalisation::kExact, n});
  };
  if (lobe != highlight_.lobe) return compute();
  const auto [at, is_new] = exact_.try_emplace({model.index, n}, 0);
  if (is_new) at->second = compute();
  return at->second;
}

double CoefficientNames::own(double exponent) {
  if (highlight_.normalisation == Normalisation::kExact)
    return exact(highlight_.model, highlight_.lobe, exponent);
  Highlight here = highlight_;
  here.exponent = std::clamp(exponent, kMinExponent, kMaxExponent);
  return radiance_coefficient(here);
}

NamedCoefficient CoefficientNames::name(std::span<const FittedCoefficient> fitted,
                                        const LobeId& lobe, bool is_exposed) {
  // Whether a coefficient, times a factor, is the fitted one at all exponents: of the lobe, or those asked for.
  const auto is = [&](const auto& value, double factor = 1) {
    for (const auto exponent : {&FittedCoefficient::exponent, &FittedCoefficient::lobe_exponent})
      if (std::ranges::all_of(fitted, [&](const FittedCoefficient& at) {
            const double expected = factor * value(at.*exponent);
            return std::abs(at.value - expected) <= at.tolerance * std::abs(expected);
          }))
        return true;
    return false;
  };
  const auto owns = [&](double n) { return own(n); };
  const auto of_lobe = [&](double n) { return exact(highlight_.model, lobe, n); };
  NamedCoefficient named;
  const auto made = [&](std::string_view id, const std::string& words, const Factor& rounded) {
    if (!id.empty()) named.ids.push_back(id), named.words = words;
    if (!rounded.id.empty()) {
      named.ids.push_back(rounded.id);
      named.words += (named.words.empty() ? "" : "; ") + std::string(rounded.words);
    }
    named.cost = double(named.ids.size());
    return named;
  };
  const bool has_four = info(highlight_.model).normalised != NormalisedQuantity::kRadiance;
  for (const Factor& rounded : kRoundedPi) {
    if (is(owns, rounded.value)) return made("", "", rounded);
    if (lobe != highlight_.lobe && is(of_lobe, rounded.value)) return made("", "", rounded);
    for (const Factor& factor : kFactors)
      if (is(owns, factor.value * rounded.value))
        return made(factor.id,
                    factor.id == "four-missing" && has_four
                        ? "the 4 of the half-vector is missing (f_r = D / 4)"
                        : std::string(factor.words),
                    rounded);
    const auto in_place = [&](const std::string& text) {
      return fmt::format("the coefficient is {}, where {} is expected", text,
                         own_coefficient_text(highlight_));
    };
    if (rounded.id.empty() && is([](double) { return 1.0; }))
      return made("coefficient-missing", "there is no coefficient", rounded);
    if (is([](double) { return 1 / kPi; }, rounded.value))
      return made("coefficient-constant", "the coefficient is 1 / pi, whatever n", rounded);
    for (const int added : {1, 2, 8, 0, 4, 6})
      for (const Divisor& divisor : kDivisors)
        if (is([&](double n) { return (n + added) / divisor.value; }, rounded.value))
          return made("coefficient",
                      in_place((added == 0 ? "n" : fmt::format("(n + {})", added)) + divisor.text),
                      rounded);
    for (const ModelId model : all_models())
      if (is([&](double n) { return exact(model, highlight_.lobe, n); }, rounded.value))
        return made("coefficient", in_place(fmt::format("the coefficient of {}", info(model).name)),
                    rounded);
  }
  const auto fitted_number = [&](std::string_view id, const std::string& words, double cost) {
    named.ids = {id}, named.words = words, named.cost = cost;
    return named;
  };
  if (fitted.size() > 1) {
    const double factor = fitted[0].value / own(fitted[0].exponent), off = std::abs(factor - 1);
    if (off > kClear * fitted[0].tolerance && is(owns, factor)) {
      if (is_exposed && off > kLeastExposure)
        return fitted_number("exposure", fmt::format("it is exposed by {:.4g} before that", factor),
                             1);
      if (!is_exposed)
        return fitted_number("factor", "by the same factor at every exponent", kOfFitted);
    }
    const double constant = fitted[0].value;
    if (is([&](double) { return constant; }))
      return fitted_number("coefficient-constant",
                           fmt::format("the coefficient is {:.4g}, whatever n", constant),
                           kOfFitted);
  }
  if (fitted.size() > 2) {
    const auto [slope, offset] = line_through(fitted);
    const bool is_clear = std::ranges::any_of(fitted, [&](const FittedCoefficient& at) {
      return std::abs(at.value / own(at.exponent) - 1) > kLeastOfLine;
    });
    if (is_clear && slope > 0 &&
        is([slope = slope, offset = offset](double n) { return slope * n + offset; }))
      return fitted_number(
          "coefficient",
          fmt::format("the coefficient is {:.4g} n {} {:.4g}, where {} is expected", slope,
                      offset < 0 ? "-" : "+", std::abs(offset), own_coefficient_text(highlight_)),
          kOfFittedLine);
  }
  named.is_known = false;
  named.cost = kUnknown;
  return named;
}

std::vector<std::string_view> coefficient_mistake_names() {
  std::vector<std::string_view> names{
      "coefficient", "coefficient-missing", "coefficient-constant", "pi-rounded", "factor",
      "exposure"};
  for (const Factor& factor : kFactors) names.push_back(factor.id);
  return names;
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

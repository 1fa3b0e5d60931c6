#include "studies/shader_check/outputs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/pictures/colour.hpp"

namespace lobelia::shader_check {
namespace {

double itself(double v) { return v; }
double power(double v, double exponent) { return std::pow(std::max(v, 0.0), exponent); }
double clamped(double v) { return std::clamp(v, 0.0, 1.0); }
double gamma_encoded(double v) { return power(v, 1 / 2.2); }
double gamma_decoded(double v) { return power(v, 2.2); }
double squared(double v) { return v * std::abs(v); }
double decoded(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
double decoded_twice(double v) { return decoded(decoded(v)); }

/// Narkowicz's fit of ACES: v (a v + b) / (v (c v + d) + e).
constexpr double kA = 2.51, kB = 0.03, kC = 2.43, kD = 0.59, kE = 0.14;
double aces(double v) {
  v = std::max(v, 0.0);
  return std::min(v * (kA * v + kB) / (v * (kC * v + kD) + kE), 1.0);
}
double inverse_aces(double y) {
  const double a = kA - kC * y, b = kB - kD * y, c = -kE * y;
  return (-b + std::sqrt(std::max(b * b - 4 * a * c, 0.0))) / (2 * a);
}

/// Hejl's filmic curve, which has a gamma in it.
constexpr double kHejlA = 6.2, kHejlB = 0.5, kHejlC = 1.7, kHejlD = 0.06, kHejlBlack = 0.004;
double hejl(double v) {
  const double x = std::max(v - kHejlBlack, 0.0);
  return x * (kHejlA * x + kHejlB) / (x * (kHejlA * x + kHejlC) + kHejlD);
}
double inverse_hejl(double y) {
  const double a = kHejlA * (1 - y), b = kHejlB - kHejlC * y, c = -kHejlD * y;
  return kHejlBlack + (-b + std::sqrt(std::max(b * b - 4 * a * c, 0.0))) / (2 * a);
}

/// Hable's curve of Uncharted 2, with white at 11.2: (x (A x + C B) + D E) / (x (A x + B) + D F) - E / F.
constexpr double kHableA = 0.15, kHableB = 0.5, kHableCB = 0.05, kHableDE = 0.004, kHableDF = 0.06,
                 kHableEF = 0.02 / 0.3;
constexpr double hable_curve(double x) {
  return (x * (kHableA * x + kHableCB) + kHableDE) / (x * (kHableA * x + kHableB) + kHableDF) -
         kHableEF;
}
constexpr double kHableWhite = hable_curve(11.2);
double hable(double v) { return hable_curve(v) / kHableWhite; }
double inverse_hable(double y) {
  const double z = y * kHableWhite + kHableEF, a = kHableA * (1 - z), b = kHableCB - z * kHableB,
               c = kHableDE - z * kHableDF;
  return (-b + std::sqrt(std::max(b * b - 4 * a * c, 0.0))) / (2 * a);
}

constexpr std::string_view kSrgb = "the result is encoded as sRGB, where light is expected",
                           kTwice = "the result is encoded as sRGB twice";
constexpr OutputStep kSteps[] = {
    {"clamped", "the result is clamped to 1", [](double v) { return std::min(v, 1.0); }, itself, 0,
     1},
    {"srgb", kSrgb, [](double v) { return srgb_encoded(clamped(v)); }, decoded, 0, 1},
    {"srgb", kSrgb, srgb_encoded, decoded, -kInfinity, kInfinity},
    {"srgb-twice", kTwice, [](double v) { return srgb_encoded(srgb_encoded(clamped(v))); },
     decoded_twice, 0, 1},
    {"srgb-twice", kTwice, [](double v) { return srgb_encoded(srgb_encoded(v)); }, decoded_twice,
     -kInfinity, kInfinity},
    {"srgb-decoded", "the result is decoded as sRGB, as if it were no light", decoded, srgb_encoded,
     -kInfinity, kInfinity},
    {"gamma", "the result has a gamma of 1 / 2.2", gamma_encoded, gamma_decoded, 0, kInfinity},
    {"gamma", "the result has a gamma of 1 / 2.2, and is clamped to 1",
     [](double v) { return gamma_encoded(clamped(v)); }, gamma_decoded, 0, 1, false, 0, "clamped"},
    {"gamma-decoded", "the result has a gamma of 2.2, as if it were no light", gamma_decoded,
     gamma_encoded, 0, kInfinity},
    {"square-root", "the result is a square root", [](double v) { return power(v, 0.5); }, squared,
     0, kInfinity},
    {"tone-mapped", "the result is tone-mapped, v / (1 + v)", [](double v) { return v / (1 + v); },
     [](double y) { return y / (1 - y); }, -kInfinity, 1, true},
    {"tone-mapped", "the result is tone-mapped, 1 - exp(-v)",
     [](double v) { return -std::expm1(-v); }, [](double y) { return -std::log1p(-y); }, -kInfinity,
     1, true, 2e-7},
    {"tone-mapped", "the result is tone-mapped by Narkowicz's ACES curve", aces, inverse_aces, 0, 1,
     true},
    {"tone-mapped", "the result is tone-mapped by Hejl's filmic curve, with its gamma", hejl,
     inverse_hejl, 0, 1, true, 1e-7},
    {"tone-mapped", "the result is tone-mapped by Hable's curve of Uncharted 2", hable,
     inverse_hable, 0, (1 - kHableEF) / kHableWhite, true, 2e-7},
    {"gamma", "the result has a gamma of 0.4545", [](double v) { return power(v, 0.4545); },
     [](double y) { return power(y, 1 / 0.4545); }, 0, kInfinity},
};

constexpr std::string_view kExposure[] = {
    "that is multiplied by 2 after it", "that is multiplied by 4 after it",
    "that is divided by 2 after it", "that is divided by 4 after it"};
template <int kHalves>
constexpr OutputStep multiplied(std::string_view words) {
  return {"exposure",
          words,
          [](double v) { return v * kHalves / 4; },
          [](double v) { return v * 4 / kHalves; },
          -kInfinity,
          kInfinity};
}
constexpr OutputStep kExposures[] = {multiplied<8>(kExposure[0]), multiplied<16>(kExposure[1]),
                                     multiplied<2>(kExposure[2]), multiplied<1>(kExposure[3])};

double inverse(const OutputStep& step, double value) {
  return step.exponent != 0 ? power(value, 1 / step.exponent) : step.inverse(value);
}

}  // namespace

std::span<const OutputStep> output_steps() { return kSteps; }

OutputStep clamp_to(double most, std::string_view words) {
  return {"clamped", words, nullptr, itself, -kInfinity, most};
}

std::vector<Chain> chains_of_two() {
  std::vector<Chain> all;
  for (const OutputStep& first : kSteps) {
    for (const OutputStep& second : kSteps)
      if (&first != &second && first.words != second.words) all.push_back({&first, &second});
    if (first.is_tone_mapping)
      for (const OutputStep& exposure : kExposures) all.push_back({&first, &exposure});
  }
  return all;
}

OutputStep power_step(double exponent, std::string_view words) {
  const std::string_view id = exponent < 1 ? "gamma" : "gamma-decoded";
  return {id, words, nullptr, nullptr, 0, kInfinity, false, 0, {}, exponent};
}

Origin origin_of(const Chain& chain, double value, double error) {
  double low = value - error, high = value + error;
  bool is_possible = true;
  for (auto step = chain.rbegin(); step != chain.rend(); ++step) {
    const OutputStep& s = **step;
    is_possible = is_possible && low <= s.most && high >= s.least;
    const auto back = [&](double y) {
      return y >= s.most ? kInfinity : y <= s.least ? -kInfinity : inverse(s, y);
    };
    low = low == -kInfinity ? low : back(low - s.rounding);
    high = high == kInfinity ? high : back(high + s.rounding);
    // At the end itself the step is still invertible, but for a tone mapping, which does not reach it.
    value = std::clamp(value, s.least, s.most);
    value = inverse(s, value);
    if (!std::isfinite(value)) value = std::isfinite(low) ? low : std::isfinite(high) ? high : 0;
  }
  if (low == kInfinity) low = value;
  if (high == -kInfinity) high = value;
  return {value, std::max(value - low, 0.0), std::max(high - value, 0.0), is_possible};
}

}  // namespace lobelia::shader_check

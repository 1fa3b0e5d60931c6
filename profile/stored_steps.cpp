#include "profile/stored_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/pictures/colour.hpp"
#include "base/pictures/half.hpp"

namespace lobelia {
namespace {

/// The derivative of the encoding's inverse, at a linear value.
double srgb_slope(double value) {
  const double encoded = srgb_encoded(value);
  return encoded <= 0.04045 ? 1 / 12.92 : 2.4 / 1.055 * std::pow((encoded + 0.055) / 1.055, 1.4);
}

/// The distance to the next larger number with so many binary digits.
double float_step(double value, int digits, double least) {
  if (!(std::abs(value) > least)) return std::ldexp(least, 1 - digits);
  return std::ldexp(1.0, std::ilogb(value) + 1 - digits);
}

}  // namespace

bool StoredSteps::holds(Kind kind, double levels, float value) {
  if (kind == Kind::kHalf) return rounded_to_half(double(value)) == double(value);
  if (!(value >= 0 && value <= 1)) return false;
  // The rounding of a float, and of a decoder.
  constexpr double kExact = 0.02;
  const double stored =
      levels * (kind == Kind::kSrgb ? srgb_encoded(double(value)) : double(value));
  return std::abs(stored - std::round(stored)) < kExact;
}

StoredSteps::StoredSteps(const Image& image) {
  struct Format {
    Kind kind;
    double levels;
  };
  // The coarsest first: of 8 bits are also of 16.
  constexpr Format kFormats[] = {
      {Kind::kLinear, 255}, {Kind::kSrgb, 255},     {Kind::kLinear, 1023},
      {Kind::kSrgb, 1023},  {Kind::kHalf, 0},       {Kind::kLinear, 4095},
      {Kind::kSrgb, 4095},  {Kind::kLinear, 65535}, {Kind::kSrgb, 65535}};
  for (const auto& [kind, levels] : kFormats)
    if (std::ranges::all_of(image.values(), [&, kind = kind, levels = levels](float value) {
          return !std::isfinite(value) || holds(kind, levels, value);
        })) {
      kind_ = kind;
      levels_ = levels;
      return;
    }
}

double StoredSteps::at(double value) const {
  switch (kind_) {
    case Kind::kHalf:
      return float_step(value, 11, kLeastNormalHalf);
    case Kind::kLinear:
      return 1 / levels_;
    case Kind::kSrgb:
      return srgb_slope(value) / levels_;
    case Kind::kFloat:
      break;
  }
  return float_step(value, 24, double(std::numeric_limits<float>::min()));
}

double StoredSteps::rounding(const Image& image, std::size_t pixel) const {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const float value = image.values()[3 * pixel + c];
    if (std::isfinite(value)) sum += at(double(value)) / 3;
  }
  return sum / std::sqrt(12.0);
}

}  // namespace lobelia

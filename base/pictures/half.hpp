// Half floats (IEEE 754 binary16): 11 binary digits, 2^-24 to 65504.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace lobelia {

inline constexpr double kLeastNormalHalf = 0x1p-14, kGreatestHalf = 65504;

/// The nearest half float; infinite from 65520 on.
inline double rounded_to_half(double x) {
  constexpr int kDropped = 52 - 10;
  constexpr double kSubnormalStep = 0x1p-24, kAligned = 0x1.8p52 * kSubnormalStep;
  const double size = std::abs(x);
  if (size < kLeastNormalHalf) return std::copysign((size + kAligned) - kAligned, x);
  if (!(size < kGreatestHalf + 16))
    return std::isnan(x) ? x : std::copysign(std::numeric_limits<double>::infinity(), x);
  const auto bits = std::bit_cast<std::uint64_t>(x);
  constexpr std::uint64_t kRest = (std::uint64_t{1} << kDropped) - 1;
  return std::bit_cast<double>((bits + kRest / 2 + (bits >> kDropped & 1)) & ~kRest);
}

}  // namespace lobelia

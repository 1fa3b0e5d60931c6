// Properties of a picture's values.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "base/pictures/image.hpp"
#include "base/system/scratch_memory.hpp"

namespace lobelia {

/// Whether no value is NaN or infinite. Without a jump, so that it is as fast as the memory.
inline bool is_finite(std::span<const float> values) {
  constexpr std::uint32_t kExponent = 0x7f800000;
  std::uint32_t broken = 0;
  for (const float value : values)
    broken |= std::uint32_t((std::bit_cast<std::uint32_t>(value) & kExponent) == kExponent);
  return broken == 0;
}
inline bool is_finite(const Image& image) {
  bool finite = true;
  in_parts(image.values().size(), sizeof(float), [&](std::size_t begin, std::size_t end) {
    finite = finite && is_finite(image.values().subspan(begin, end - begin));
  });
  return finite;
}

/// Whether they have one size and every value equals the other's; NaN equals nothing.
inline bool have_equal_values(const Image& a, const Image& b) {
  if (a.width() != b.width() || a.height() != b.height()) return false;
  bool equal = true;
  in_parts(a.values().size(), 2 * sizeof(float), [&](std::size_t begin, std::size_t end) {
    const auto part = [&](const Image& of) { return of.values().subspan(begin, end - begin); };
    equal = equal && std::ranges::equal(part(a), part(b));
  });
  return equal;
}

/// The brightest R, G or B value; 0 without a positive value.
inline double peak_value(const Image& image) {
  // Several at once: each would wait for the one before.
  std::array<float, 16> peaks{};
  in_parts(image.values().size(), sizeof(float), [&](std::size_t begin, std::size_t end) {
    const float* const values = image.values().data();
    auto of_part = peaks;  // in registers
    for (; begin + of_part.size() <= end; begin += of_part.size())
      for (std::size_t i = 0; i < of_part.size(); ++i)
        of_part[i] = std::max(of_part[i], values[begin + i]);
    for (; begin < end; ++begin) of_part[0] = std::max(of_part[0], values[begin]);
    peaks = of_part;
  });
  return double(std::ranges::max(peaks));
}

/// The largest finite |value|; 0 if there is none.
inline double largest_magnitude(std::span<const float> values) {
  float largest = 0;
  in_parts(values.size(), sizeof(float), [&](std::size_t begin, std::size_t end) {
    for (const float value : values.subspan(begin, end - begin))
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  });
  return largest;
}

}  // namespace lobelia

#include "gallery/packed/packed_numbers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace lobelia::gallery {
namespace {

constexpr std::int32_t kNan = 1 << 27, kInfinity = kNan + 1;
constexpr int kLeastExponent = -330;  // below that of every double

}  // namespace

std::int32_t decimal_code(double value, int digits) {
  if (std::isnan(value)) return kNan;
  if (std::isinf(value)) return value > 0 ? kInfinity : -kInfinity;
  if (value == 0) return 0;
  const std::string text = fmt::format("{:.{}e}", std::abs(value), digits - 1);  // "1.2345e-02"
  const std::size_t e = text.find('e');
  const int exponent = std::atoi(text.c_str() + e + 1);
  std::int32_t mantissa = 0, least = 1;
  for (const char c : text.substr(0, e))
    if (c != '.') mantissa = 10 * mantissa + (c - '0');
  for (int i = 1; i < digits; ++i) least *= 10;
  const std::int32_t code = 1 + (exponent - kLeastExponent) * 9 * least + (mantissa - least);
  return value < 0 ? -code : code;
}

void PackedNumbers::add(std::span<const double> values, int digits, bool is_smooth) {
  std::int32_t before = 0;
  for (const double value : values) {
    const std::int32_t code = decimal_code(value, digits), rest = is_smooth ? code - before : code;
    codes_.push_back(static_cast<std::uint32_t>(rest) << 1 ^
                     static_cast<std::uint32_t>(rest >> 31));
    before = code;
  }
}

std::string PackedNumbers::bytes() const {
  std::string bytes;
  for (int shift = 0; shift < 32; shift += 8)
    for (const std::uint32_t code : codes_) bytes += static_cast<char>(code >> shift & 0xff);
  return bytes;
}

}  // namespace lobelia::gallery

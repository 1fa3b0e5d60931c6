// Numbers as text for people.
#pragma once

#include <cstdint>
#include <string>

namespace lobelia {

/// With `digits` significant digits: "0.0123", "1234", "4.9 × 10⁻⁴"; "–" for NaN.
std::string number_text(double value, int digits = 3);
/// "10⁻³"
std::string power_of_ten_text(int exponent);
/// For a shader: the digits of float32, and a point, because "4" would be an integer there.
std::string float32_text(double value);
/// A share in per cent with two significant digits: 4.9e-4 is "0.049 %", 1e-8 is "1 × 10⁻⁶ %". Columns of measured values
/// keep zeros at the end: "0.040 %".
enum class TrailingZeros { kDrop, kKeep };
std::string percent_text(double share, TrailingZeros zeros = TrailingZeros::kDrop);
/// "0.8 ms", "12.3 s", "3 min 20 s".
std::string seconds_text(double seconds);
/// "12.5°"
std::string degrees_text(double degrees);
/// "−1.44 stops"
std::string stops_text(double stops);
/// An integer with thin spaces: "65 536"; any other value as number_text().
std::string count_text(double count);
/// "1.5 GiB"
std::string size_text(std::uint64_t bytes);

}  // namespace lobelia

// Numbers as people read them. Nothing here changes a value beyond rounding it for print.
#pragma once

#include <cstdint>
#include <string>

namespace lobelia {

/// Significant digits: "0.0123", "1234", "4.9 × 10⁻⁴"; "–" where it is not a number.
std::string number_text(double value, int digits = 3);
/// "10⁻³"
std::string power_of_ten_text(int exponent);
/// A share as per cent, two significant digits: 4.9e-4 is "0.049 %", 1e-8 is "1 × 10⁻⁶ %".
/// In a column of measured values the zeros at the end are kept: "0.040 %".
enum class TrailingZeros { kDrop, kKeep };
std::string percent_text(double share, TrailingZeros zeros = TrailingZeros::kDrop);
/// "0.8 ms", "12.3 s", "3 min 20 s".
std::string seconds_text(double seconds);
/// "12.5°"
std::string degrees_text(double degrees);
/// "−1.44 stops"
std::string stops_text(double stops);
/// An integer with thin spaces: "65 536". Values that are not integers as number_text.
std::string count_text(double count);
/// "1.5 GiB"
std::string size_text(std::uint64_t bytes);

}  // namespace lobelia

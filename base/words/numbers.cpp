#include "base/words/numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

namespace lobelia {
namespace {

// A typographic minus: the hyphen is too short to be seen in front of a small exponent.
std::string with_minus(std::string text) {
  if (!text.empty() && text.front() == '-') text.replace(0, 1, "−");
  return text;
}

std::string trimmed(std::string text) {
  if (text.find('.') == std::string::npos) return text;
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string superscript(int exponent) {
  static constexpr std::array<std::string_view, 10> kDigits = {"⁰", "¹", "²", "³", "⁴",
                                                               "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) text += kDigits[digit - '0'];
  return text;
}

std::string non_finite(double value) {
  if (std::isnan(value)) return "–";
  return value > 0 ? "infinite" : "minus infinite";
}

/// `digits` significant digits without an exponent.
std::string all_significant(double value, int digits) {
  const double magnitude = std::floor(std::log10(std::abs(value)));
  const int decimals = std::max(0, digits - 1 - static_cast<int>(magnitude));
  return fmt::format("{:.{}f}", value, decimals);
}

std::string significant(double value, int digits) {
  return trimmed(all_significant(value, digits));
}

}  // namespace

std::string number_text(double value, int digits) {
  if (!std::isfinite(value)) return non_finite(value);
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size >= 1e-3 && size < 1e5) return with_minus(significant(value, digits));
  const std::string scientific = fmt::format("{:.{}e}", value, digits - 1);
  const auto e = scientific.find('e');
  return with_minus(trimmed(scientific.substr(0, e))) + " × " +
         power_of_ten_text(std::stoi(scientific.substr(e + 1)));
}

std::string float32_text(double value) {
  std::string text = fmt::format("{:.9g}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string power_of_ten_text(int exponent) { return "10" + superscript(exponent); }

std::string percent_text(double share, TrailingZeros zeros) {
  if (!std::isfinite(share)) return non_finite(share);
  if (share == 0) return "0 %";
  if (std::abs(share) < 1e-6) return number_text(100 * share, 2) + " %";
  if (std::abs(share) >= 1e4) return number_text(100 * share) + " %";
  const std::string digits = all_significant(100 * share, 2);
  return with_minus(zeros == TrailingZeros::kKeep ? digits : trimmed(digits)) + " %";
}

std::string seconds_text(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0) return number_text(seconds) + " s";
  if (seconds == 0) return "0 s";
  if (seconds < 0.1) return significant(1000 * seconds, 2) + " ms";
  if (seconds < 60) return significant(seconds, 3) + " s";
  if (seconds >= 1e9) return number_text(seconds) + " s";
  const auto whole = static_cast<long long>(std::lround(seconds));
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string degrees_text(double degrees) { return number_text(degrees) + "°"; }

std::string stops_text(double stops) { return number_text(stops) + " stops"; }

std::string count_text(double count) {
  if (!std::isfinite(count) || count != std::floor(count) || std::abs(count) >= 1e15) {
    return number_text(count);
  }
  std::string digits = fmt::format("{:.0f}", std::abs(count));
  static constexpr std::string_view kThinSpace = "\u202f";
  for (auto at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(at, kThinSpace);
  return (count < 0 ? "−" : "") + digits;
}

std::string size_text(std::uint64_t bytes) {
  constexpr const char* kUnits[] = {"B", "KiB", "MiB", "GiB", "TiB"};
  double value = double(bytes);
  std::size_t unit = 0;
  for (; value >= 1024 && unit + 1 < std::size(kUnits); ++unit) value /= 1024;
  return fmt::format("{:.{}f} {}", value, unit == 0 ? 0 : 1, kUnits[unit]);
}

}  // namespace lobelia

// Curves as whole numbers: decimal digits and exponent in one, which grows with the value, so that neighbours differ by
// little. gallery/web/src/lib/packed_numbers.ts reads them back.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lobelia::gallery {

/// Significant digits that a chart of a few hundred pixels can show.
inline constexpr int kDigits = 5, kDigitsOfDifference = 3;

class PackedNumbers {
 public:
  /// Rounded to `digits`. A smooth curve is kept as the steps from value to value.
  void add(std::span<const double> values, int digits, bool is_smooth);
  /// Four bytes a number: the low bytes of all, then the next.
  std::string bytes() const;

 private:
  std::vector<std::uint32_t> codes_;
};

/// The code of a value rounded to `digits`. Zero is 0; NaN and the infinities have codes of their own.
std::int32_t decimal_code(double value, int digits);

}  // namespace lobelia::gallery

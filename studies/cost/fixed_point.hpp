// Lobes as a circuit of whole numbers computes them: fractions of f bits, and after each product f bits again.
// Emulated exactly.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace lobelia::cost {

enum class FixedRounding { kTruncate, kNearest };
std::string_view name(FixedRounding rounding);  ///< "truncated", "rounded"

/// A number of f fractional bits is a whole number of 2^-f.
struct FixedPoint {
  int bits;  ///< f, 1 to 32
  FixedRounding rounding;

  std::uint64_t one() const { return std::uint64_t(1) << bits; }
  double value(std::uint64_t x) const { return double(x) / double(one()); }
  /// What is left of a b, both at most 1.
  std::uint64_t product(std::uint64_t a, std::uint64_t b) const;
  /// s in [0, 1] as it comes from a dot product of f bits: 1 less the rounded cosine.
  std::uint64_t one_minus_cos(double s) const;
};

/// The paper's circuit: max(0, 1 - n s / k), a multiply-add rounded once, then log2 k squarings. k is a power
/// of 2, n below 2^24.
std::uint64_t fixed_cs(FixedPoint f, unsigned n, int k, std::uint64_t s);

/// cos^n itself by binary powering of 1 - s, n >= 1.
std::uint64_t fixed_power(FixedPoint f, unsigned n, std::uint64_t s);

/// cos^n from a table over the highlight, linearly in between; 0 beyond.
class FixedTable {
 public:
  /// 2^address_bits intervals over s from 0 to the least power of 2 that is no smaller than
  /// highlight_end(n).
  FixedTable(FixedPoint f, unsigned n, int address_bits);
  std::uint64_t value(std::uint64_t s) const;
  /// Whether f bits have anything to tell within an interval; below this they would not fill its address.
  static bool fits(FixedPoint f, unsigned n, int address_bits);
  int bits_within() const { return bits_within_; }  ///< of s between two entries

 private:
  FixedPoint f_;
  int bits_within_;
  std::vector<std::uint64_t> entries_;
};

/// One-bit operations: a product of a and b bits takes a b of them, a sum or a comparison as many as it has
/// bits, reading one of N entries as many as N entries have. Rounding to nearest is a carry that a product
/// takes in, and free.
double fixed_cs_operations(FixedPoint f, unsigned n, int k);
double fixed_power_operations(FixedPoint f, unsigned n);
double fixed_table_operations(FixedPoint f, const FixedTable& table, int address_bits);

}  // namespace lobelia::cost

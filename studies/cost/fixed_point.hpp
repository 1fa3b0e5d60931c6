// Lobes computed by a circuit in fixed point, emulated exactly: their error by the number of bits, and the number of
// one-bit operations.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "studies/cost/table.hpp"

namespace lobelia::cost {

enum class FixedRounding { kTruncate, kNearest };
std::string_view name(FixedRounding rounding);  ///< "truncated", "rounded"

/// A number of f fractional bits is a whole number of 2^-f.
struct FixedPoint {
  int bits;  ///< f, 1 to 32
  FixedRounding rounding;

  std::uint64_t one() const { return std::uint64_t(1) << bits; }
  double value(std::uint64_t x) const { return double(x) / double(one()); }
  /// a b rounded to f bits, both at most 1.
  std::uint64_t product(std::uint64_t a, std::uint64_t b) const;
  /// s in [0, 1] from a dot product of f bits: 1 - the rounded cosine.
  std::uint64_t one_minus_cos(double s) const;
};

/// The paper's circuit: max(0, 1 - n s / k), a multiply-add rounded once, then log2 k squarings. k is a power
/// of 2, n below 2^24.
std::uint64_t fixed_cs(FixedPoint f, unsigned n, int k, std::uint64_t s);

/// pk3.m: t = n s exactly, then three multiply-adds of t and a coefficient, each rounded once, the cut and m squarings.
/// The coefficients are rounded to f bits and made for one n, below 2^24.
class FixedPk {
 public:
  FixedPk(FixedPoint f, unsigned n, int k);
  std::uint64_t value(std::uint64_t s) const;
  double operations() const;

 private:
  FixedPoint f_;
  unsigned n_;
  int k_;
  int range_;            ///< the lobe ends below t = 2^range
  std::int64_t q_[3]{};  ///< of t / 2^range
};

/// cos^n itself by binary powering of 1 - s, n >= 1.
std::uint64_t fixed_power(FixedPoint f, unsigned n, std::uint64_t s);

/// cos^n from a table over the highlight with linear interpolation; 0 beyond.
class FixedTable {
 public:
  /// 2^address_bits intervals over s from 0 to the least power of 2 >= highlight_end(n).
  FixedTable(FixedPoint f, unsigned n, int address_bits);
  std::uint64_t value(std::uint64_t s) const;
  /// Whether f bits are more than the address of an interval.
  static bool fits(FixedPoint f, unsigned n, int address_bits);
  int bits_within() const { return bits_within_; }  ///< of s between two entries

 private:
  FixedPoint f_;
  int bits_within_;
  std::vector<std::uint64_t> entries_;
};

/// One-bit operations: a b for a product of a and b bits, one per bit for a sum or a comparison, and all bits of N
/// entries to read one of them. Rounding to nearest is a carry into a product, and free.
double fixed_cs_operations(FixedPoint f, unsigned n, int k);
double fixed_power_operations(FixedPoint f, unsigned n);
double fixed_table_operations(FixedPoint f, const FixedTable& table, int address_bits);

/// A circuit and its function without rounding.
struct Circuit {
  std::string what;  ///< "cs16"
  FixedPoint f;
  double operations;
  double most_rounding;  ///< a bound of the sum of its roundings, that of s included
  std::function<std::uint64_t(std::uint64_t s)> value;
  std::function<double(double s)> ideal;
};
Circuit cs_circuit(FixedPoint f, unsigned n, int k);
Circuit pk_circuit(FixedPoint f, unsigned n, int k);
Circuit power_circuit(FixedPoint f, unsigned n);

/// If a circuit has more steps than this in the highlight, two from each of kCells equal parts are measured.
inline constexpr std::uint64_t kMostSteps = 1 << 17, kCells = 1 << 15;

/// Errors relative to the peak, over s from 0 to highlight_end: `shape` of the ideal against cos^n, `rounding` of the
/// circuit against its ideal, and `quantisation`, a part of it, of the ideal at the quantised s.
struct CircuitErrors : records::CircuitErrors {
  double max = 0;     ///< of the circuit against cos^n
  double rms = 0;     ///< the same, root mean square
  double energy = 0;  ///< the same of the integral, relative
  /// Where not all steps are measured: a bound of `max`, and standard errors of the two sums. Else `max`, and 0.
  double max_at_most = 0, rms_spread = 0, energy_spread = 0;
};
CircuitErrors circuit_errors(const Circuit& circuit, unsigned n);

Table fixed_point_table(unsigned n, const std::vector<int>& bits);

}  // namespace lobelia::cost

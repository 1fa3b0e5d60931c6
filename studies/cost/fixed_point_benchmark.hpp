// What a lobe costs as a circuit in fixed point: its error over the number of bits, and how many one-bit
// operations those are. Nothing is timed.
#pragma once

#include <functional>
#include <string>

#include "studies/cost/benchmarks.hpp"
#include "studies/cost/fixed_point.hpp"

namespace lobelia::cost {

/// A circuit, and the function that it would be without rounding.
struct Circuit {
  std::string what;  ///< "cs16"
  FixedPoint f;
  double operations;
  double most_rounding;  ///< a bound of what its roundings add up to, those of s with them
  std::function<std::uint64_t(std::uint64_t s)> value;
  std::function<double(double s)> ideal;
};
Circuit cs_circuit(FixedPoint f, unsigned n, int k);
Circuit power_circuit(FixedPoint f, unsigned n);

/// If a circuit has more steps than this in the highlight, two from each of kCells equal parts are looked at.
inline constexpr std::uint64_t kMostSteps = 1 << 17, kCells = 1 << 15;

/// Errors relative to the peak, over s from 0 to highlight_end: `shape` of the ideal against cos^n, `rounding` of the
/// circuit against its ideal, and `quantisation`, a part of it, of the ideal at the quantised s.
struct CircuitErrors : records::CircuitErrors {
  double max = 0;     ///< of the circuit against cos^n
  double rms = 0;     ///< the same, root mean square
  double energy = 0;  ///< the same of the integral, relative
  /// Where not all steps are looked at: a bound of `max`, and standard errors of the two sums. Else `max`, and 0.
  double max_at_most = 0, rms_spread = 0, energy_spread = 0;
};
CircuitErrors circuit_errors(const Circuit& circuit, unsigned n);

/// One table per exponent, "fixed-point-n64".
std::vector<Table> measure_fixed_point(const Options& options);
Table fixed_point_table(unsigned n, const std::vector<int>& bits);

}  // namespace lobelia::cost

// What a lobe costs as a circuit in fixed point: its error over the number of bits, and how many one-bit
// operations those are. Nothing is timed.
#pragma once

#include <functional>
#include <string>

#include "cost/fixed_point.hpp"
#include "cost/levels.hpp"

namespace lobelia::cost {

/// A circuit, and the function that it would be without rounding.
struct Circuit {
  std::string what;  ///< "cs16"
  FixedPoint f;
  double operations;
  std::function<std::uint64_t(std::uint64_t s)> value;
  std::function<double(double s)> ideal;
};
Circuit cs_circuit(FixedPoint f, unsigned n, int k);
Circuit power_circuit(FixedPoint f, unsigned n);

/// Largest errors relative to the peak, over s from 0 to highlight_end.
struct CircuitErrors {
  double max = 0;       ///< of the circuit against cos^n
  double rms = 0;       ///< the same, root mean square
  double energy = 0;    ///< the same of the integral, relative
  double shape = 0;     ///< of the ideal against cos^n
  double rounding = 0;  ///< of the circuit against its ideal
  double quantisation =
      0;  ///< of the ideal at the quantised s against the ideal: a part of rounding
};
CircuitErrors circuit_errors(const Circuit& circuit, unsigned n);

/// One table per exponent, "fixed-point-n64".
std::vector<Table> measure_fixed_point(const Options& options);
Table fixed_point_table(unsigned n, const std::vector<int>& bits);

}  // namespace lobelia::cost

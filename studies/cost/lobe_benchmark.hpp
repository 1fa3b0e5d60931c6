// What a lobe costs: every lobe and every way of computing it, at one exponent after the other.
#pragma once

#include "studies/cost/benchmarks.hpp"

namespace lobelia::cost {

/// One table per exponent, "lobe-n64".
std::vector<Table> measure_lobes(const Options& options);

/// That of one exponent: its errors, and times as the medians of so many rounds. A quick one looks for the largest
/// error of a way at 2^20 numbers, and may then have a bracket of it alone.
Table lobe_table(double exponent, int rounds, bool quick);

}  // namespace lobelia::cost

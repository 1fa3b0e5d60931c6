// What a lobe costs: every lobe and every way of computing it, at one exponent after the other.
#pragma once

#include "cost/levels.hpp"

namespace lobelia::cost {

/// One table per exponent, "lobe-n64".
std::vector<Table> measure_lobes(const Options& options);

/// That of one exponent: its errors, and times as the medians of so many rounds.
Table lobe_table(double exponent, int rounds);

}  // namespace lobelia::cost

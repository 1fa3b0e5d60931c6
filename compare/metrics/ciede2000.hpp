// The colour difference CIEDE2000 of two colours.
#pragma once

#include "compare/metrics/cie_lab.hpp"
#include "core/vec.hpp"

namespace lobelia {

/// With the parametric factors k_L = k_C = k_H = 1.
double ciede2000(Lab a, Lab b);

/// Linear light of an sRGB display, each in [0, 1], to Lab under its white (D65).
Lab lab_from_display(Rgb shown);

}  // namespace lobelia

// One highlight along a line across it: the truth, the textbook in float32, and ours.
#pragma once

#include <string>
#include <vector>

namespace lobelia::stability {

struct ErrorCurve {
  double exponent = 0;
  std::string model, lobe;
  std::vector<double> degrees;             ///< between L and the mirror direction
  std::vector<double> truth, naive, ours;  ///< of the peak, N.L included; naive may be no number
};

/// Modified Phong's cos^n, from the middle to where a thousandth is left, for n = 16 to 1e8. Ours is in the
/// precision that a plan would choose.
std::vector<ErrorCurve> error_curves();

}  // namespace lobelia::stability

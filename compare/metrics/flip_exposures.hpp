// The exposures that HDR-FLIP looks at, where nobody says which.
#pragma once

#include "compare/metrics/metric.hpp"
#include "core/image.hpp"

namespace lobelia {

/// The range of Andersson et al. 2021, section 3, as NVIDIA's tool 1.6 takes it for ACES: from where the
/// reference's largest luminance is 0.85 after the tone curve to where its median luminance is, in as
/// many exposures as stops, rounded up, and at least 2. A range of its own for each reference: figures of
/// two pairs are comparable only if both had the same.
/// Throws Error(kInput) where it is infinite, as for a sphere over black, or has over kMaxHdrExposures.
HdrExposures automatic_exposures(const Image& reference);

}  // namespace lobelia

// How far the figures of a highlight may be off although nothing differs.
//
// Formula:      kSlack standard errors of each figure. The error of a pixel is the known noise, or what the reference's own
//               roughness tells: fourth differences around the highlight, and where its core has pixels enough, within,
//               which smooth light hardly has. Two pictures may be as rough.
//               Rounding of stored values is added; it may be the same in all pixels.
#pragma once

#include "compare/highlights/find.hpp"

namespace lobelia {

/// Standard errors. More than the chance of one highlight asks for: a picture may have a hundred, and the errors themselves
/// are estimates.
inline constexpr double kSlack = 5;

/// Whether the highlight stands out: its height is six errors of a pixel, and its energy is known to a seventh. Else the
/// maximum of noise may have chosen its pixels. `peak`: the reference's brightest radiance.
bool add_slack(const Image& reference, const HighlightNoise& noise, double peak,
               LocalHighlight& highlight);

}  // namespace lobelia

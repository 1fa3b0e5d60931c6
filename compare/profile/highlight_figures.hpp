// The highlight of one picture in figures.
#pragma once

#include "compare/profile/profile.hpp"

namespace lobelia {

/// `geometry.width` is not 0, and the picture has as many pixels as the geometry.
HighlightFigures measure_highlight(const ProfileGeometry& geometry, const Image& image);

}  // namespace lobelia

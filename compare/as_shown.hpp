// A picture as the viewing condition has it.
#pragma once

#include "compare/metrics/metric.hpp"

namespace lobelia {

/// At the exposure, and on the display, of `viewing`; finite values only. As DisplayLight: of a plain display it is
/// a view, which the picture must outlive.
inline DisplayLight as_shown(const Image& image, const Viewing& viewing) {
  return DisplayLight::of(image, viewing.exposure_stops, viewing.display.get());
}

}  // namespace lobelia

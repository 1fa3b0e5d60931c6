// From scene-linear light to a display, by OpenColorIO, and back.
#pragma once

#include "core/image.hpp"

namespace lobelia {

/// The picture on an sRGB display: values times 2^exposure_stops, clipped to [0, 1], encoded
/// by the sRGB display of core/lobelia.ocio, rounded to 8 bits. Non-finite pixels become magenta.
DisplayImage to_display(const Image& image, double exposure_stops);

/// An sRGB-encoded value (IEC 61966-2-1) as linear light.
float srgb_decoded(float value);
/// The same for every value, in place.
void decode_srgb(Image& image);

/// The exposure, in stops, that brings `peak` to display white; 0 if peak is not a positive number.
double exposure_for_peak(double peak);

}  // namespace lobelia

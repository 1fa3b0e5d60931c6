// The code values of an 8-bit sRGB file: what tools see that compare PNGs.
#pragma once

#include <vector>

#include "compare/display_light.hpp"

namespace lobelia {

/// Three values a pixel, from 0 to 255: the shown light, encoded by the curve of IEC 61966-2-1 and rounded. An 8-bit sRGB
/// file that is shown at exposure 0 gives its own values.
std::vector<std::uint8_t> code_values(const DisplayLight& shown);
/// Those of row y, 3 * width.
std::vector<std::uint8_t> code_values(const DisplayLight& shown, int y);

/// One difference a pixel: the largest of the three channels, in code values.
std::vector<float> code_differences(const DisplayLight& a, const DisplayLight& b);

/// One difference a pixel from 0 to 1, by the distance in YIQ of pixelmatch (to version 7), odiff and reg-cli. Source:
/// Y. Kotsarenko, F. Ramos, "Measuring perceived color difference using YIQ NTSC transmission color space in mobile
/// applications", 2010. The root of pixelmatch's colorDelta over its largest value, 35215, for opaque pixels; so it is
/// over a threshold where pixelmatch's is.
std::vector<float> yiq_differences(const DisplayLight& a, const DisplayLight& b);

}  // namespace lobelia

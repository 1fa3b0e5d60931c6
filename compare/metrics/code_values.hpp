// The code values of an 8-bit sRGB file: what tools see that compare PNGs.
#pragma once

#include <vector>

#include "compare/metrics/metric.hpp"

namespace lobelia {

/// Three values a pixel, from 0 to 255.
using CodeValues = std::vector<std::uint8_t, ZeroedMemory<std::uint8_t>>;

/// The shown light, encoded by the curve of IEC 61966-2-1 and rounded. An 8-bit sRGB file that is shown at exposure 0 gives
/// its own values.
CodeValues code_values(const DisplayLight& shown);

struct CodePair {
  CodeValues a, b;
};
/// Shared by all metrics of code values.
std::shared_ptr<const CodePair> code_pair(const MetricInput& input);
/// The work of these metrics.
inline constexpr std::string_view kCodeWork = "code values";

/// One difference a pixel: the largest of the three channels, in code values.
PixelValues code_differences(const CodePair& codes);

/// One difference a pixel from 0 to 1, by the distance in YIQ of pixelmatch (to version 7), odiff and reg-cli. Source:
/// Y. Kotsarenko, F. Ramos, "Measuring perceived color difference using YIQ NTSC transmission color space in mobile
/// applications", 2010. The root of pixelmatch's colorDelta over its largest value, 35215, for opaque pixels; so it is
/// over a threshold where pixelmatch's is.
PixelValues yiq_differences(const CodePair& codes);

}  // namespace lobelia

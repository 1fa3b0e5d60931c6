#include "core/colour.hpp"

#include <OpenColorIO/OpenColorIO.h>

#include <cmath>
#include <sstream>
#include <string_view>

namespace lobelia {
namespace ocio = OCIO_NAMESPACE;
namespace embedded {
extern const std::string_view lobelia_ocio;
}
namespace {

constexpr std::uint8_t kMagenta[3] = {255, 0, 255};

/// From scene-linear to the display of the embedded configuration.
ocio::ConstCPUProcessorRcPtr display_processor() {
  std::istringstream text{std::string(embedded::lobelia_ocio)};
  const auto config = ocio::Config::CreateFromStream(text);
  return config->getProcessor("linear", "sRGB")->getDefaultCPUProcessor();
}

}  // namespace

DisplayImage to_display(const Image& image, double exposure_stops) {
  static const auto to_srgb = display_processor();
  DisplayImage result{image.width(), image.height(), {}};
  result.rgb.resize(image.values().size());
  const float gain = float(std::exp2(exposure_stops));
  std::vector<float> row(std::size_t{3} * image.width());
  for (int y = 0; y < image.height(); ++y) {
    const auto source = image.values().subspan(row.size() * y, row.size());
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = source[i] * gain;
    ocio::PackedImageDesc description(row.data(), image.width(), 1, 3);
    to_srgb->apply(description);
    for (int x = 0; x < image.width(); ++x) {
      const std::size_t p = std::size_t{3} * x;
      const bool finite =
          std::isfinite(source[p]) && std::isfinite(source[p + 1]) && std::isfinite(source[p + 2]);
      for (std::size_t c = 0; c < 3; ++c)
        result.rgb[row.size() * y + p + c] =
            finite ? std::uint8_t(std::lround(255 * std::clamp(row[p + c], 0.0f, 1.0f)))
                   : kMagenta[c];
    }
  }
  return result;
}

float srgb_decoded(float value) {
  // In float32, and not by OpenColorIO, whose approximate power differs in the last bit: FLIP takes a
  // root of such differences, and would leave its published values by 4e-5.
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

void decode_srgb(Image& image) {
  for (float& value : image.values()) value = srgb_decoded(value);
}

double exposure_for_peak(double peak) {
  return std::isfinite(peak) && peak > 0 ? -std::log2(peak) : 0;
}

}  // namespace lobelia

#include "core/colour.hpp"

#include <OpenColorIO/OpenColorIO.h>

#include <cmath>
#include <sstream>
#include <string_view>

#include "core/error.hpp"

namespace lobelia {
namespace ocio = OCIO_NAMESPACE;
namespace embedded {
extern const std::string_view lobelia_ocio;
}
namespace {

constexpr std::uint8_t kMagenta[3] = {255, 0, 255};

/// The processor from one space of the embedded configuration to another.
ocio::ConstCPUProcessorRcPtr processor(const char* from, const char* to) {
  static const ocio::ConstConfigRcPtr config = [] {
    std::istringstream text{std::string(embedded::lobelia_ocio)};
    return ocio::Config::CreateFromStream(text);
  }();
  // The default optimisation replaces powers by a fast approximation; 8 bits would hide it, a
  // decoded reference picture would not.
  return config->getProcessor(from, to)->getOptimizedCPUProcessor(ocio::OPTIMIZATION_LOSSLESS);
}

}  // namespace

DisplayImage to_display(const Image& image, double exposure_stops) {
  static const auto to_srgb = processor("linear", "sRGB");
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
      const bool finite = std::isfinite(source[p]) && std::isfinite(source[p + 1]) &&
                          std::isfinite(source[p + 2]);
      for (std::size_t c = 0; c < 3; ++c)
        result.rgb[row.size() * y + p + c] =
            finite ? std::uint8_t(std::lround(255 * std::clamp(row[p + c], 0.0f, 1.0f)))
                   : kMagenta[c];
    }
  }
  return result;
}

void decode_srgb(Image& image) {
  static const auto to_linear = processor("sRGB", "linear");
  ocio::PackedImageDesc description(image.values().data(), image.width(), image.height(), 3);
  to_linear->apply(description);
}

double exposure_for_peak(double peak) {
  return std::isfinite(peak) && peak > 0 ? -std::log2(peak) : 0;
}

}  // namespace lobelia

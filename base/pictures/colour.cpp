// The loader of the colour module: OpenColorIO and what it needs would cost every start 1.3 ms.
#include "base/pictures/colour.hpp"

#include <cmath>
#include <cstdlib>

#include "base/pictures/colour_module.hpp"
#include "base/system/module.hpp"

namespace lobelia {
namespace {

const ColourModule& loaded_colour_module() {
  static const auto* const table =
      static_cast<const ColourModule*>(colour_module.find(kColourModuleSymbol));
  return *table;
}

}  // namespace

DisplayImage to_display(const Image& image, double exposure_stops) {
  return to_display(image.values(), image.width(), exposure_stops);
}

DisplayImage to_display(std::span<const float> rows, int width, double exposure_stops) {
  return loaded_colour_module().to_display(rows, width, exposure_stops);
}

double exposure_for_peak(double peak) {
  return std::isfinite(peak) && peak > 0 ? -std::log2(peak) : 0;
}

std::shared_ptr<const DisplayView> DisplayView::open(const DisplayViewChoice& asked) {
  DisplayViewChoice choice = asked;
  const char* environment = std::getenv("OCIO");
  const bool by_environment = choice.config.empty() && environment && *environment;
  if (choice.config.empty()) choice.config = by_environment ? environment : kOwnConfig;
  if (choice == DisplayViewChoice{kOwnConfig, {}, {}, {}}) return nullptr;
  return loaded_colour_module().open_view(choice, by_environment);
}

}  // namespace lobelia

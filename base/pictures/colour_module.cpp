// The only file that uses OpenColorIO. It is loaded when it is first needed: base/system/module.hpp.
#include "base/pictures/colour_module.hpp"

#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

#include "base/system/error.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace ocio = OCIO_NAMESPACE;
namespace embedded {
extern const std::string_view lobelia_ocio;
}

namespace {

constexpr std::uint8_t kMagenta[3] = {255, 0, 255};

/// Names of linear light with Rec. 709 primaries in OpenColorIO's own configurations, ACES' older ones, Blender's, and
/// ours.
constexpr const char* kLinearRec709[] = {"lin_rec709_scene",
                                         "lin_rec709",
                                         "Linear Rec.709 (sRGB)",
                                         "Utility - Linear - sRGB",
                                         "Utility - Linear - Rec.709",
                                         "lin_srgb",
                                         "Linear Rec.709",
                                         "Linear",
                                         "linear"};

constexpr char kXyzRole[] = "cie_xyz_d65_interchange";

// IEC 61966-2-1, 5.2: XYZ (D65, Y of white is 1) to linear sRGB.
constexpr float kRgbFromXyz[3][3] = {
    {3.2406f, -1.5372f, -0.4986f}, {-0.9689f, 1.8758f, 0.0415f}, {0.0557f, -0.2040f, 1.0570f}};

ocio::ConstConfigRcPtr own_config() {
  std::istringstream text{std::string(embedded::lobelia_ocio)};
  return ocio::Config::CreateFromStream(text);
}

void require_name(std::string_view what, const std::string& config, const std::string& wanted,
                  const std::vector<std::string_view>& names) {
  if (std::ranges::count(names, wanted) > 0) return;
  throw Error(ExitCode::kUsage, "{} has no {} '{}'{}; it has {}", config, what, printable(wanted),
              did_you_mean(wanted, names), printable(join(names), 400));
}

std::string chosen_display(const ocio::Config& config, const DisplayViewChoice& choice) {
  if (choice.display.empty()) return config.getDefaultDisplay();
  std::vector<std::string_view> names;
  for (int i = 0; i < config.getNumDisplays(); ++i) names.emplace_back(config.getDisplay(i));
  require_name("display", choice.config, choice.display, names);
  return choice.display;
}

std::string chosen_view(const ocio::Config& config, const DisplayViewChoice& choice,
                        const std::string& display) {
  if (choice.view.empty()) return config.getDefaultView(display.c_str());
  std::vector<std::string_view> names;
  for (int i = 0; i < config.getNumViews(display.c_str()); ++i)
    names.emplace_back(config.getView(display.c_str(), i));
  require_name(fmt::format("display '{}' with a view", display), choice.config, choice.view, names);
  return choice.view;
}

std::string chosen_input(const ocio::Config& config, const DisplayViewChoice& choice) {
  if (!choice.input_space.empty()) {
    if (const auto space = config.getColorSpace(choice.input_space.c_str()))
      return space->getName();
    std::vector<std::string_view> names;
    for (int i = 0; i < config.getNumColorSpaces(); ++i)
      names.emplace_back(config.getColorSpaceNameByIndex(i));
    require_name("colour space", choice.config, choice.input_space, names);
  }
  for (const char* name : kLinearRec709)
    if (const auto space = config.getColorSpace(name)) return space->getName();
  if (const auto space = config.getColorSpace(ocio::ROLE_SCENE_LINEAR)) return space->getName();
  throw Error(ExitCode::kInput,
              "{} has neither a linear Rec. 709 space nor the role scene_linear; name the "
              "space of the pictures",
              choice.config);
}

/// OpenColorIO's default is a faster, approximate power. Its differences would show in FLIP, which takes a root of them.
ocio::ConstCPUProcessorRcPtr exact(const ocio::ConstProcessorRcPtr& processor) {
  return processor->getOptimizedCPUProcessor(ocio::OPTIMIZATION_LOSSLESS);
}

float clipped(float value) { return std::isnan(value) ? 0.0f : std::clamp(value, 0.0f, 1.0f); }

void decode_xyz(float* xyz) {
  const float x = xyz[0], y = xyz[1], z = xyz[2];
  for (int c = 0; c < 3; ++c)
    xyz[c] = clipped(kRgbFromXyz[c][0] * x + kRgbFromXyz[c][1] * y + kRgbFromXyz[c][2] * z);
}

DisplayImage in_srgb(std::span<const float> rows, int width, double exposure_stops) {
  static const auto to_srgb =
      own_config()->getProcessor("linear", "sRGB")->getDefaultCPUProcessor();
  std::vector<float> row(std::size_t{3} * width);
  DisplayImage result{width, width == 0 ? 0 : int(rows.size() / row.size()), {}};
  result.rgb.resize(rows.size());
  const float gain = float(std::exp2(exposure_stops));
  for (int y = 0; y < result.height; ++y) {
    const auto source = rows.subspan(row.size() * y, row.size());
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = source[i] * gain;
    ocio::PackedImageDesc description(row.data(), width, 1, 3);
    to_srgb->apply(description);
    for (int x = 0; x < width; ++x) {
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

class OcioView : public DisplayView {
 public:
  static std::shared_ptr<const DisplayView> open(const DisplayViewChoice& asked,
                                                 bool by_environment);
  Image shown(const Image& scene_linear, double exposure_stops) const override;

 private:
  ocio::ConstCPUProcessorRcPtr to_display_, to_xyz_;  ///< to_xyz_ is null where values are sRGB's
};

std::shared_ptr<const DisplayView> OcioView::open(const DisplayViewChoice& asked,
                                                  bool by_environment) {
  DisplayViewChoice choice = asked;
  try {
    const auto config = choice.config == kOwnConfig
                            ? own_config()
                            : ocio::Config::CreateFromFile(choice.config.c_str());
    config->validate();
    const auto made = std::make_shared<OcioView>();
    choice.display = chosen_display(*config, choice);
    choice.view = chosen_view(*config, choice, choice.display);
    choice.input_space = chosen_input(*config, choice);
    const auto view = ocio::DisplayViewTransform::Create();
    view->setSrc(choice.input_space.c_str());
    view->setDisplay(choice.display.c_str());
    view->setView(choice.view.c_str());
    made->to_display_ = exact(config->getProcessor(view));
    const std::string space_name =
        config->getDisplayViewColorSpaceName(choice.display.c_str(), choice.view.c_str());
    const auto space = config->getColorSpace(
        space_name == "<USE_DISPLAY_NAME>" ? choice.display.c_str() : space_name.c_str());
    // In older configurations the view's space is one of the scene, and decoding it would undo the view.
    const bool knows_light = space &&
                             space->getReferenceSpaceType() == ocio::REFERENCE_SPACE_DISPLAY &&
                             config->hasRole(kXyzRole);
    if (knows_light) made->to_xyz_ = exact(config->getProcessor(space->getName(), kXyzRole));
    made->decoded_by_ = knows_light ? "XYZ" : "sRGB";
    made->config_id_ = config->getCacheID();
    made->choice_ = choice;
    return made;
  } catch (const ocio::Exception& error) {
    throw Error(ExitCode::kInput, "OpenColorIO configuration {}{}: {}", choice.config,
                by_environment ? " ($OCIO)" : "", printable(error.what(), 300));
  }
}

Image OcioView::shown(const Image& scene_linear, double exposure_stops) const {
  Image result = scene_linear;
  const float gain = float(std::exp2(exposure_stops));
  const std::size_t row_values = std::size_t{3} * std::size_t(result.width());
  const auto apply = [&](const ocio::ConstCPUProcessorRcPtr& processor, float* row) {
    ocio::PackedImageDesc description(row, result.width(), 1, 3);
    processor->apply(description);
  };
  const auto show_row = [&](float* row) {
    for (std::size_t i = 0; i < row_values; ++i) row[i] *= gain;
    apply(to_display_, row);
    if (!to_xyz_) {
      for (std::size_t i = 0; i < row_values; ++i) row[i] = srgb_decoded(clipped(row[i]));
      return;
    }
    apply(to_xyz_, row);
    for (std::size_t i = 0; i < row_values; i += 3) decode_xyz(row + i);
  };
  oneapi::tbb::parallel_for(0, result.height(), [&](int y) {
    show_row(result.values().data() + row_values * std::size_t(y));
  });
  return result;
}

}  // namespace
}  // namespace lobelia

extern "C" __attribute__((visibility("default"))) const lobelia::ColourModule lobelia_colour_module;
const lobelia::ColourModule lobelia_colour_module = {lobelia::in_srgb, lobelia::OcioView::open};

#include "farm/make_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/metrics/metric.hpp"
#include "core/colour.hpp"
#include "core/image_io.hpp"
#include "core/image_values.hpp"
#include "farm/our_name.hpp"

namespace lobelia {

std::string picture_file(const std::string& engine) { return engine + ".exr"; }
std::string error_file(const std::string& engine) { return engine + "-error.exr"; }
std::string comparison_name(const std::string& engine) { return std::string(kOurs) + "-" + engine; }

Image read_whole_picture(const std::filesystem::path& file, const Scene& scene) {
  const std::string name = file.filename().string();
  if (std::error_code unknown; !std::filesystem::exists(file, unknown))
    throw Error(ExitCode::kOutput,
                fmt::format("{}: somebody took it away while it was needed", file.string()));
  Image image;
  try {
    // Written by ourselves: what an engine wrote was read where it could do no harm, and encoded anew.
    image = read_trusted_image(file);
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    throw ResultFailure(FailureClass::kBadOutput, error.what());
  }
  if (image.width() != scene.film.width || image.height() != scene.film.height)
    throw ResultFailure(
        FailureClass::kWrongSize,
        fmt::format("{} is {} x {}; the scene's film is {} x {}", name, image.width(),
                    image.height(), scene.film.width, scene.film.height));
  if (!is_finite(image))
    throw ResultFailure(FailureClass::kNonFinite,
                        fmt::format("{} has values that are not finite", name));
  return image;
}

double cell_exposure(const Image& ours) {
  return std::clamp(exposure_for_peak(peak_value(ours)), -kMaxExposureStops, kMaxExposureStops);
}

}  // namespace lobelia

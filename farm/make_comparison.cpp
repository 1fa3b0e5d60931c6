#include "compare/compare.hpp"
#include "core/colour.hpp"
#include "core/image_io.hpp"
#include "core/image_values.hpp"
#include "farm/make_result.hpp"
#include "records/record.hpp"
#include "reference_scenes/engine.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "renderer/render.hpp"

namespace lobelia {
namespace {

/// Whether the errors of a picture that is an average lie beside it.
bool has_error(const MadePicture& picture) {
  std::error_code ignored;
  return std::filesystem::exists(picture.directory / error_file(picture.engine), ignored);
}

/// Ours are of samples that each pixel has for itself, an engine's of points that all pixels share.
NoiseOptions noise_of(const MadePicture& ours, const MadePicture& theirs) {
  const auto noise = [](const MadePicture& picture, int freedom, bool shared) {
    return noise_of_standard_errors(
        read_trusted_image(picture.directory / error_file(picture.engine)), freedom, shared);
  };
  return {.a = noise(ours, kErrorFreedom, false), .b = noise(theirs, kReplicates - 1, true)};
}

}  // namespace

Tolerance tolerance_of(std::string_view engine, std::vector<std::uint8_t> edges) {
  constexpr std::int64_t kAllowedOutliers = 3;
  const EngineTolerance tolerance = engine_info(engine).tolerance;
  return {tolerance.of_value, tolerance.of_peak, kAllowedOutliers, std::move(edges)};
}

void make_comparison(const Scene& scene, const MadePicture& ours, const MadePicture& theirs,
                     ResultDraft& draft, records::Result& record) {
  const std::string& engine = theirs.engine;
  const Image a = read_whole_picture(ours.directory / picture_file(kOurs), scene);
  const Image b = read_whole_picture(theirs.directory / picture_file(engine), scene);
  const double exposure = cell_exposure(a);
  write_png(draft.file(engine + ".png"), to_display(b, exposure));

  // A tolerance for each pixel is one of pictures without noise. Where there is noise, the tolerance is what
  // rounding may do, and the usual limits say how fine the answer has to be.
  const bool exact = truth::why_not_evaluated(scene).empty();
  if (!exact && !(has_error(ours) && has_error(theirs))) {
    record.not_comparable =
        "its picture may have noise that is not known, and no tolerance of single pixels judges that";
    return;
  }
  ComparisonOptions options;
  options.viewing.exposure_stops = exposure;
  options.tolerance =
      tolerance_of(engine, exact ? truth::edge_ring(scene) : std::vector<std::uint8_t>());
  if (!exact) {
    options.limits.assign(default_limits().begin(), default_limits().end());
    options.noise = noise_of(ours, theirs);
  }
  const Comparison comparison = compare(a, b, options);

  const std::string name = comparison_name(engine);
  // White is what the tolerance allows at the brightest place, and a tenth of the peak where there is noise.
  const double relative = exact ? options.tolerance->relative + options.tolerance->of_peak : 0.1;
  const double white_at = relative * peak_value(b);
  write_png(draft.file(name + ".png"), difference_picture(a, b, white_at));
  records::write_record(draft.file(name + ".json"),
                        comparison_record(comparison, picture_file(kOurs), picture_file(engine)));
  record.verdict = verdict_name(comparison.verdict);
  record.entry =
      records::CellComparison{kOurs, engine, name + ".json", name + ".png", {white_at, relative}};
}

}  // namespace lobelia

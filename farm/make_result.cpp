#include "farm/make_result.hpp"

#include <fmt/format.h>

#include "base/pictures/colour.hpp"
#include "base/pictures/image_io.hpp"
#include "base/pictures/image_values.hpp"
#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "base/words/numbers.hpp"
#include "compare/set/job.hpp"
#include "farm/profile_scene.hpp"
#include "reference_scenes/engine.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "reference_scenes/replicates.hpp"
#include "renderer/render.hpp"
#include "renderer/render_record.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace {

/// Reads a picture of a result again. Throws ResultFailure unless it has the scene's size and finite values.
Image read_whole_picture(const std::filesystem::path& file, const Scene& scene) {
  const std::string name = file.filename().string();
  if (std::error_code unknown; !std::filesystem::exists(file, unknown))
    throw Error(ExitCode::kOutput, "{}: somebody took it away while it was needed", file.string());
  Image image;
  try {
    // Safe to trust: an engine's file was read in a separate process and encoded anew.
    image = read_trusted_image(file);
  } catch (const Error& error) {
    // After a fault of the disk nothing is known of the picture.
    if (error.code() != ExitCode::kInput || error.is_fault()) throw;
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

/// The exposure at which a cell is shown: the brightest value of our picture becomes white.
double cell_exposure(const Image& ours) {
  return std::clamp(exposure_for_peak(peak_value(ours)), -kMaxExposureStops, kMaxExposureStops);
}

/// Bytes for the picture and its copy read back; for an average also its error and the sums for it.
std::uint64_t memory_to_make(const Scene& scene) {
  constexpr std::uint64_t kOfPicture = 3 * sizeof(float), kOfSums = 2 * 3 * sizeof(double);
  return std::uint64_t(scene.film.width) * std::uint64_t(scene.film.height) *
         (2 * kOfPicture + (needs_replicates(scene) ? kOfPicture + kOfSums : 0));
}

/// Only an average has a file of standard errors.
bool has_error(const MadePicture& picture) {
  std::error_code ignored;
  return std::filesystem::exists(picture.directory / error_file(picture.engine), ignored);
}

/// Our pixels have samples of their own; an engine's pixels share one set of points.
NoiseOptions noise_of(const MadePicture& ours, const MadePicture& theirs) {
  const auto noise = [](const MadePicture& picture, int freedom, bool shared) {
    return noise_of_standard_errors(
        read_trusted_image(picture.directory / error_file(picture.engine)), freedom, shared);
  };
  // It is not known which values err together, so each figure is measured six times: of many cells, by fewer pairs.
  return {.a = noise(ours, kErrorFreedom, false),
          .b = noise(theirs, kReplicates - 1, true),
          .bootstraps = 12};
}

}  // namespace

std::string picture_file(const std::string& engine) { return engine + ".exr"; }
std::string error_file(const std::string& engine) { return engine + "-error.exr"; }
std::string comparison_name(const std::string& a, const std::string& b) { return a + "-" + b; }

void make_render(const Scene& scene, ResultDraft& draft, std::chrono::duration<double> time_limit,
                 std::uint64_t memory_limit, records::Result& made) {
  if (const std::uint64_t needed = memory_to_make(scene); memory_limit > 0 && needed > memory_limit)
    throw ResultFailure(
        FailureClass::kOutOfMemory,
        fmt::format("its picture of {} x {} needs {} of memory; allowed: {}", scene.film.width,
                    scene.film.height, size_text(needed), size_text(memory_limit)));
  using Clock = std::chrono::steady_clock;
  RenderOptions options;
  options.threads = 1;  // other cells keep the other processors busy
  options.on_progress = [begun = Clock::now(), time_limit](double) {
    if (Clock::now() - begun > time_limit)
      throw ResultFailure(
          FailureClass::kTimedOut,
          fmt::format("stopped after {:.6g} s, the time limit of a picture", time_limit.count()));
  };
  const std::string file = picture_file(kOurs);
  const ImageMetadata metadata = render_metadata(scene);
  const RenderResult result = render(scene, options);
  records::Render record =
      render_record(scene, result, {"lobelia", "render", "scene.xml", "-o", file}, file);
  write_exr(draft.file(file), result.image, metadata);
  // A comparison with an engine's average needs the noise of both.
  if (needs_replicates(scene)) {
    record.standard_error = error_file(kOurs);
    write_exr(draft.file(error_file(kOurs)), standard_error_of_render(scene, options), metadata);
  }
  const Image image = read_whole_picture(draft.file(file), scene);
  const double exposure = cell_exposure(image);
  write_png(draft.file(std::string(kOurs) + ".png"), to_display(image, exposure));
  records::write_record(draft.file(std::string(kOurs) + ".json"), record);
  write_file(draft.file("scene.xml"), scene_to_xml(scene));

  made.command = record.command;
  made.exposure_stops = exposure;
  if (!scene.spheres.empty())
    made.highlight =
        highlight_record(scene.materials.at(std::size_t(scene.spheres.front().material)).highlight);
  auto& warnings = made.warnings.emplace();
  for (const Material& material : scene.materials)
    if (std::string text = warning(material.highlight); !text.empty())
      warnings.push_back(std::move(text));
}

void make_reference(const Scene& scene, const FarmEngine& engine, const std::string& program,
                    ReferenceResult result, ResultDraft& draft, records::Result& made) {
  records::Reference& record = result.record;
  const std::string file = picture_file(engine.name);
  record.command = {"lobelia", "reference", "scene.xml", "--engine", engine.name, "-o", file};
  if (!program.empty()) record.command.insert(record.command.end(), {"--" + engine.name, program});
  if (engine.engine->outside()) record.command = engine.engine->outside()->command;
  record.image = {file, result.image.width(), result.image.height()};
  const ImageMetadata metadata = reference_metadata(scene, record);
  write_exr(draft.file(file), result.image, metadata);
  if (result.standard_error.pixel_count() > 0) {
    record.standard_error = error_file(engine.name);
    write_exr(draft.file(error_file(engine.name)), result.standard_error, metadata);
  }
  read_whole_picture(draft.file(file), scene);
  records::write_record(draft.file(engine.name + ".json"), record);
  if (!result.log.empty()) write_file(draft.file(engine.name + ".log"), result.log);
  made.command = record.command;
  made.engine_commands = record.engine_commands;
  made.shading = record.shading;
}

Tolerance tolerance_of(const Scene& scene, const std::vector<EngineFloor>& floors) {
  constexpr std::int64_t kAllowedOutliers = 3;
  Tolerance tolerance{.allowed_outliers = kAllowedOutliers};
  double least_cosine = 0;
  for (const EngineFloor& floor : floors) {
    tolerance.relative += floor.of_value;
    tolerance.of_peak += floor.of_peak_in(scene);
    least_cosine = std::max(least_cosine, floor.least_cosine);
  }
  if (!truth::why_not_evaluated(scene).empty()) return tolerance;
  tolerance.edges = truth::edge_ring(scene);
  tolerance.allowed_outliers += truth::mark_grazing(scene, least_cosine, tolerance.edges);
  return tolerance;
}

Comparison judge_cell(const Image& a, const Image& b, double exposure_stops, Tolerance tolerance,
                      std::optional<NoiseOptions> noise) {
  ComparisonOptions options = judging_options(plain_choice(exposure_stops));
  options.default_limits = false;
  if (noise) options.limits.assign(default_limits().begin(), default_limits().end());
  // Profiles measure the highlight of every cell. Nor is each highlight judged by itself: a cell is held pixel by pixel to
  // what the arithmetic of engines and the known noise allow, which is far below the 3 % of those limits.
  options.highlight = false;
  options.tolerance = std::move(tolerance);
  options.noise = std::move(noise);
  return compare(a, b, options);
}

PicturesOfCell read_pictures(const Scene& scene, const MadePicture& a, const MadePicture& b,
                             const MadePicture& ours) {
  const auto read = [&](const MadePicture& one) {
    return read_whole_picture(one.directory / picture_file(one.engine), scene);
  };
  PicturesOfCell pictures{read(a), read(b)};
  pictures.exposure_stops = cell_exposure(ours.engine == a.engine ? pictures.a : read(ours));
  if (!truth::why_not_evaluated(scene).empty() && has_error(a) && has_error(b))
    pictures.noise = noise_of(a, b);
  return pictures;
}

void make_comparison(const Scene& scene, const ComparisonTask& task, PicturesOfCell pictures,
                     const std::vector<EngineFloor>& floors, ResultDraft& draft,
                     records::Result& record) {
  const auto& [a, b, exposure, noise] = pictures;
  write_png(draft.file((task.shows_a ? task.a : task.b) + ".png"),
            to_display(task.shows_a ? a : b, exposure));

  // Without noise, each pixel has a tolerance. With noise it covers rounding alone, and the default limits decide.
  const bool exact = truth::why_not_evaluated(scene).empty();
  if (!exact && !noise) {
    record.not_comparable =
        "its picture may have noise that is not known, and no tolerance of single pixels judges that";
    return;
  }
  const Tolerance tolerance = tolerance_of(scene, floors);
  const Comparison comparison = judge_cell(a, b, exposure, tolerance, std::move(pictures.noise));

  const std::string name = comparison_name(task.a, task.b);
  // White in the difference picture: the tolerance at the peak, or with noise a tenth of the peak.
  const double relative = exact ? tolerance.relative + tolerance.of_peak : 0.1;
  const double white_at = relative * peak_value(b);
  write_png(draft.file(name + ".png"), difference_picture(a, b, white_at));
  records::write_record(draft.file(name + ".json"),
                        comparison_record(comparison, picture_file(task.a), picture_file(task.b)));
  record.verdict = verdict_name(comparison.verdict);
  record.entry =
      records::CellComparison{task.a, task.b, name + ".json", name + ".png", {white_at, relative}};
}

void make_profile(const Scene& scene, const std::vector<MadePicture>& pictures,
                  ResultDraft& draft) {
  std::vector<Image> images;
  images.reserve(pictures.size());
  NamedImages named;
  for (const auto& picture : pictures) {
    // The profile adds the formula's curve itself.
    if (picture.engine == records::kAnalytic) continue;
    images.push_back(read_whole_picture(picture.directory / picture_file(picture.engine), scene));
    named.emplace_back(picture.engine, &images.back());
  }
  records::write_record(draft.file("profile.json"), profile_scene(scene, 0, 0, named));
}

}  // namespace lobelia

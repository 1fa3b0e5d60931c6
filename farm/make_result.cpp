#include "farm/make_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/metrics/metric.hpp"
#include "core/colour.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/image_values.hpp"
#include "farm/profile_scene.hpp"
#include "records/record.hpp"

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

void make_reference(const Scene& scene, const FarmEngine& engine, const std::string& program,
                    ReferenceResult result, ResultDraft& draft, records::Result& made) {
  records::Reference& record = result.record;
  const std::string file = picture_file(engine.name);
  record.command = {"lobelia", "reference", "scene.xml", "--engine", engine.name, "-o", file};
  if (!program.empty()) record.command.insert(record.command.end(), {"--" + engine.name, program});
  record.image = {file, result.image.width(), result.image.height()};
  const ImageMetadata metadata = reference_metadata(scene, record);
  write_exr(draft.file(file), result.image, metadata);
  if (result.standard_error.pixel_count() > 0) {
    record.standard_error = error_file(engine.name);
    write_exr(draft.file(error_file(engine.name)), result.standard_error, metadata);
  }
  read_whole_picture(draft.file(file), scene);
  records::write_record(draft.file(engine.name + ".json"), record);
  // An engine may have had nothing to say.
  if (!result.log.empty()) write_file(draft.file(engine.name + ".log"), result.log);
  made.command = record.command;
  made.engine_commands = record.engine_commands;
  made.witness = record.witness;
}

void make_profile(const Scene& scene, const std::vector<MadePicture>& pictures,
                  ResultDraft& draft) {
  std::vector<Image> images;
  images.reserve(pictures.size());
  NamedImages named;
  for (const auto& picture : pictures) {
    // The profile draws the formula under that name already.
    if (picture.engine == records::kAnalytic) continue;
    images.push_back(read_whole_picture(picture.directory / picture_file(picture.engine), scene));
    named.emplace_back(picture.engine, &images.back());
  }
  records::write_record(draft.file("profile.json"), profile_scene(scene, 0, 0, named));
}

double cell_exposure(const Image& ours) {
  return std::clamp(exposure_for_peak(peak_value(ours)), -kMaxExposureStops, kMaxExposureStops);
}

}  // namespace lobelia

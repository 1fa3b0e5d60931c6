#include <system_error>

#include "core/files.hpp"
#include "core/image_io.hpp"
#include "farm/make_result.hpp"
#include "reference_scenes/reference_metadata.hpp"

namespace lobelia {
namespace {
constexpr std::uint64_t kMaxEngineLogBytes = 1 << 30;  // each pass and sample of a scene adds to it
}

Json make_reference(const Scene& scene, const FarmEngine& engine, const std::string& program,
                    ReferenceResult result, const std::filesystem::path& log, ResultDraft& draft) {
  const std::string file = picture_file(engine.name);
  Json command{"lobelia", "reference", "scene.xml", "--engine", engine.name, "-o", file};
  if (!program.empty()) command.insert(command.end(), {"--" + engine.name, program});
  result.record["command"] = command;
  result.record["image"] = {
      {"file", file}, {"width", result.image.width()}, {"height", result.image.height()}};
  const ImageMetadata metadata = reference_metadata(scene, result.record);
  write_exr(draft.file(file), result.image, metadata);
  if (result.standard_error.pixel_count() > 0) {
    result.record["standardError"] = error_file(engine.name);
    write_exr(draft.file(error_file(engine.name)), result.standard_error, metadata);
  }
  read_whole_picture(draft.file(file), scene);
  write_record(draft.file(engine.name + ".json"), result.record);
  // An engine may have had nothing to say.
  if (std::error_code none; !log.empty() && std::filesystem::exists(log, none))
    write_file(draft.file(engine.name + ".log"), read_file(log, kMaxEngineLogBytes));

  Json made{{"command", std::move(command)}};
  for (const char* key : {"engineCommands", "witness"})
    if (result.record.contains(key)) made[key] = result.record[key];
  return made;
}

}  // namespace lobelia

#include <system_error>

#include "core/image_io.hpp"
#include "farm/make_result.hpp"
#include "reference_scenes/reference_metadata.hpp"

namespace lobelia {

Json make_reference(const Scene& scene, const FarmEngine& engine, const std::string& program,
                    ReferenceResult result, const std::filesystem::path& log,
                    const ResultDraft& draft) {
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
  std::error_code none;  // an engine may have had nothing to say
  if (!log.empty()) std::filesystem::copy_file(log, draft.file(engine.name + ".log"), none);

  Json made{{"command", std::move(command)}};
  for (const char* key : {"engineCommands", "witness"})
    if (result.record.contains(key)) made[key] = result.record[key];
  return made;
}

}  // namespace lobelia

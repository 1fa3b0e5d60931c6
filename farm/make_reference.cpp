#include "core/files.hpp"
#include "core/image_io.hpp"
#include "farm/make_result.hpp"
#include "records/record.hpp"
#include "reference_scenes/reference_metadata.hpp"

namespace lobelia {
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

}  // namespace lobelia

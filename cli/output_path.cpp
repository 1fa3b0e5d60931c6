#include "cli/output_path.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"

namespace lobelia::cli {

std::filesystem::path checked_record_path(const std::filesystem::path& image) {
  if (image.extension() != ".exr")
    throw Error(ExitCode::kUsage,
                fmt::format("-o {}: pictures are linear float32; the name must end in .exr",
                            image.string()));
  const auto record = std::filesystem::path(image).replace_extension(".json");
  require_writable(image);
  require_writable(record);
  return record;
}

}  // namespace lobelia::cli

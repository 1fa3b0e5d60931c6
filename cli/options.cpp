#include "cli/options.hpp"

#include "core/contained_reader.hpp"
#include "core/files.hpp"
#include "core/picture_file.hpp"

namespace lobelia::cli {

CLI::Validator between(double min, double max) {
  return {[=](std::string& text) {
            double value = 0;
            if (parse_number(text, value) && value >= min && value <= max) return std::string();
            return fmt::format("'{}' is out of range; allowed: {:g} to {:g}", printable(text), min,
                               max);
          },
          fmt::format("{:g} to {:g}", min, max)};
}

void add_any_format(CLI::App& command) {
  command.add_flag_callback(
      "--any-format", [] { read_any_picture_format(); },
      fmt::format("Read every format that OpenImageIO knows, not only {}", kPictureFormats));
}

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

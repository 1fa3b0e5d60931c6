// Replaces core's reading of pictures, which needs a process of its own: no picture can be read.
#include "core/error.hpp"
#include "core/image_io.hpp"
#include "core/picture_file.hpp"

namespace lobelia {

Picture read_picture(const std::filesystem::path& path, const std::string&, const PictureLimit&) {
  throw Error(ExitCode::kInput, path.string() + ": not a readable picture");
}

Picture read_picture(const PictureFile& file, const std::string& layer, const PictureLimit& limit) {
  return read_picture(file.path(), layer, limit);
}

Image read_image(const std::filesystem::path& path) { return read_picture(path, "", {}).image; }

}  // namespace lobelia

// Replaces core's reading of pictures, which needs a process of its own: no picture can be read.
#include "base/pictures/image_io.hpp"
#include "base/pictures/picture_file.hpp"
#include "base/system/error.hpp"

namespace lobelia {

Picture read_picture(const std::filesystem::path& path, const std::string&, const PictureLimit&) {
  throw Error(ExitCode::kInput, path.string() + ": not a readable picture");
}

Picture read_picture(const PictureFile& file, const std::string& layer, const PictureLimit& limit) {
  return read_picture(file.path(), layer, limit);
}

Image read_image(const std::filesystem::path& path) { return read_picture(path, "", {}).image; }

}  // namespace lobelia

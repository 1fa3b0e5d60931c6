// Replaces core's functions that read files in the fuzzed program: a scene from memory must not call them.
#include <cstdlib>

#include "base/pictures/contained_reader.hpp"
#include "base/pictures/picture_file.hpp"
#include "base/system/files.hpp"

namespace lobelia {

Picture read_picture(const std::filesystem::path&, const std::string&, const PictureLimit&) {
  std::abort();
}
Picture read_picture(const PictureFile&, const std::string&, const PictureLimit&) { std::abort(); }
PictureFile::PictureFile(InputFile) { std::abort(); }

InputFile::InputFile(const std::filesystem::path&) { std::abort(); }
std::filesystem::path InputFile::real_path() const { std::abort(); }
bool is_below(const std::filesystem::path&, const std::filesystem::path&) { std::abort(); }
std::string read_file(const std::filesystem::path&, std::uint64_t) { std::abort(); }
void read_pieces(const InputFile&, std::uint64_t, const std::function<void(std::string_view)>&) {
  std::abort();
}

}  // namespace lobelia

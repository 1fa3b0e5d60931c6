// In place of core's functions that read files, in the fuzzed program alone: a scene from memory that
// reaches one is a find.
#include <cstdlib>

#include "core/files.hpp"
#include "core/image_io.hpp"

namespace lobelia {

Image read_image(const std::filesystem::path&) { std::abort(); }
std::string read_file(const std::filesystem::path&, std::uint64_t) { std::abort(); }

}  // namespace lobelia

// The loader of the image module: see image_io.hpp for why there is one.
#include "core/image_io.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/contained_reader.hpp"
#include "core/error.hpp"
#include "core/exr_writer.hpp"
#include "core/files.hpp"
#include "core/image_io_module.hpp"
#include "core/picture_file.hpp"

namespace lobelia {
namespace fs = std::filesystem;

fs::path companion_file(const char* name) {
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
  for (const fs::path& directory : {here, here.parent_path() / "lib" / "lobelia"})
    if (fs::exists(directory / name)) return directory / name;
  throw Error(ExitCode::kInternal,
              fmt::format("{} is neither beside the program in {} nor in ../lib/lobelia", name,
                          here.string()));
}

const ImageIoTable& image_io_table() {
  static const ImageIoTable& table = []() -> const ImageIoTable& {
    void* handle = ::dlopen(companion_file(kImageIoModuleFile).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle) throw Error(ExitCode::kInternal, fmt::format("image module: {}", ::dlerror()));
    const void* symbol = ::dlsym(handle, kImageIoTableSymbol);
    if (!symbol) throw Error(ExitCode::kInternal, fmt::format("image module: {}", ::dlerror()));
    return *static_cast<const ImageIoTable*>(symbol);
  }();
  return table;
}

Picture read_picture(const fs::path& path, const std::string& layer) {
  return read_contained(path, layer);
}

Image read_image(const fs::path& path) { return read_picture(path, "").image; }

Image read_trusted_image(const fs::path& path) {
  const PictureFile file(path);
  const std::string bytes = file.read_all();
  return image_io_table().read_picture({path, bytes, file.known_format()}, "").image;
}

std::vector<std::string> layer_names(const fs::path& path) { return layer_names_contained(path); }

void write_exr(const fs::path& path, const Image& image, const ImageMetadata& metadata) {
  ExrWriter writer(path, image.width(), image.height(), metadata);
  writer.write_rows(0, image.height(), image.values().data());
  writer.finish();
}

void write_png(const fs::path& path, const DisplayImage& image, const ImageMetadata& metadata) {
  write_file(path, image_io_table().encode_png(image, metadata));
}

void code_pictures_on_calling_threads() {
  ExrWriter::set_pool(0);
  decode_contained_on_one_thread();
  image_io_table().decode_on_calling_threads();
}

ColourTable colour_table(std::string_view name) { return image_io_table().colour_table(name); }

}  // namespace lobelia

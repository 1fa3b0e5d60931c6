// The loader of the image module: see image_io.hpp for why there is one.
#include "core/image_io.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/error.hpp"
#include "core/exr_writer.hpp"
#include "core/files.hpp"
#include "core/image_io_module.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

const ImageIoTable& module() {
  static const ImageIoTable& table = []() -> const ImageIoTable& {
    // Beside the program in a build tree, in ../lib/lobelia once installed.
    const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
    for (const fs::path& directory : {here, here.parent_path() / "lib" / "lobelia"}) {
      const fs::path file = directory / kImageIoModuleFile;
      if (!fs::exists(file)) continue;
      void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
      if (!handle) throw Error(ExitCode::kInternal, fmt::format("image module: {}", ::dlerror()));
      const void* symbol = ::dlsym(handle, kImageIoTableSymbol);
      if (!symbol) throw Error(ExitCode::kInternal, fmt::format("image module: {}", ::dlerror()));
      return *static_cast<const ImageIoTable*>(symbol);
    }
    throw Error(ExitCode::kInternal,
                fmt::format("{} is neither beside the program in {} nor in ../lib/lobelia",
                            kImageIoModuleFile, here.string()));
  }();
  return table;
}

}  // namespace

Picture read_picture(const fs::path& path, const std::string& layer) {
  return module().read_picture(path, layer);
}

Image read_image(const fs::path& path) { return read_picture(path, "").image; }

std::vector<std::string> layer_names(const fs::path& path) { return module().layer_names(path); }

void write_exr(const fs::path& path, const Image& image, const ImageMetadata& metadata) {
  ExrWriter writer(path, image.width(), image.height(), metadata);
  writer.write_rows(0, image.height(), image.values().data());
  writer.finish();
}

void write_png(const fs::path& path, const DisplayImage& image, const ImageMetadata& metadata) {
  write_file(path, module().encode_png(image, metadata));
}

void code_pictures_on_calling_threads() {
  ExrWriter::set_pool(0);
  module().decode_on_calling_threads();
}

ColourTable colour_table(std::string_view name) { return module().colour_table(name); }

}  // namespace lobelia

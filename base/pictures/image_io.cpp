// The loader of the image module: see image_io.hpp for why there is one.
#include "base/pictures/image_io.hpp"

#include <sys/mman.h>

#include <atomic>
#include <cerrno>
#include <utility>
#include <vector>

#include "base/pictures/exr_writer.hpp"
#include "base/pictures/image_io_module.hpp"
#include "base/pictures/picture_file.hpp"
#include "base/pictures/plain_picture.hpp"
#include "base/pictures/png_module.hpp"
#include "base/pictures/png_writer.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/no_resources.hpp"
#include "base/system/threads.hpp"

namespace lobelia {
namespace fs = std::filesystem;

namespace {

/// The module loads some 260 libraries. On Debian 12 they map 340 MB of code, use 101 MB of memory for data and start
/// 4 threads; each is rounded up here.
constexpr std::size_t kModuleCode = std::size_t{400} << 20, kModuleData = std::size_t{128} << 20;
constexpr int kModuleThreads = 8;

bool is_free(std::size_t size, int access) {
  void* const place =
      ::mmap(nullptr, size, access, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  return place != MAP_FAILED && ::munmap(place, size) == 0;
}

std::atomic<bool> g_on_calling_threads{false};

/// Checked beforehand, because one of those libraries (log4cplus) hangs if it gets two of its four threads.
void require_room_for_module() {
  const int error = startable_threads(kModuleThreads) < kModuleThreads ? EAGAIN
                    : !is_free(kModuleCode + kModuleData, PROT_NONE) ||
                            !is_free(kModuleData, PROT_READ | PROT_WRITE)
                        ? ENOMEM
                        : 0;
  if (error != 0) throw failure_of("image module", error, ExitCode::kInternal);
}

/// OpenImageIO, with as many threads as was asked.
const ImageIoTable& other_formats() {
  const ImageIoTable& table = image_io_table();
  if (g_on_calling_threads) table.decode_on_calling_threads();
  return table;
}

}  // namespace

constinit Module image_io_module{"lobelia_image_io.so", "image module", require_room_for_module};

const ImageIoTable& image_io_table() {
  static const auto* const table =
      static_cast<const ImageIoTable*>(image_io_module.find(kImageIoTableSymbol));
  return *table;
}

Image read_image(const fs::path& path) { return read_picture(path, "").image; }

const PngTable& png_table() {
  static const auto* const table = static_cast<const PngTable*>(png_module.find(kPngTableSymbol));
  return *table;
}

Image read_trusted_image(const fs::path& path) {
  const PictureFile file(path);
  const std::string bytes = file.read_all();
  PictureBytes picture{path, bytes, file.known_format()};
  picture.on_one_thread = g_on_calling_threads;
  if (auto plain = read_plain_picture(picture, "")) return std::move(plain->image);
  return other_formats().read_picture(picture, "").image;
}

void write_exr(const fs::path& path, const Image& image, const ImageMetadata& metadata) {
  ExrWriter writer(path, image.width(), image.height(), metadata);
  writer.write_rows(0, image.height(), image.values().data());
  writer.finish();
}

void write_png(const fs::path& path, const DisplayImage& image, const ImageMetadata& metadata) {
  PngWriter writer(path, image.width, image.height, metadata);
  writer.write_rows(image);
  writer.finish();
}

std::string png_bytes(const DisplayImage& image, const ImageMetadata& metadata) {
  const auto encoder = png_table().start(image.width, image.height, metadata);
  std::string file;
  for (const auto& bytes : {encoder->encode(image), encoder->finish()})
    file.append(bytes.begin(), bytes.end());
  return file;
}

void code_pictures_on_calling_threads() {
  ExrWriter::pack_on_calling_threads();
  decode_contained_on_one_thread();
  g_on_calling_threads = true;
}

ColourTable colour_table(std::string_view name) { return image_io_table().colour_table(name); }

}  // namespace lobelia

// The only file that knows OpenImageIO; built as a module of its own, see image_io.hpp.
#include "core/image_io_module.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/colour.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace lobelia {
namespace {

[[noreturn]] void unreadable(const std::filesystem::path& path, std::string_view why) {
  throw Error(ExitCode::kInput,
              fmt::format("{}: not a readable picture: {}", path.string(), printable(why, 300)));
}

void check_size(const std::filesystem::path& path, const OIIO::ImageSpec& spec) {
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1)
    unreadable(path, "it has no pixels");
  if (spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width ||
      spec.height != spec.full_height)
    unreadable(path, "it is a crop: its data window differs from its display window");
  if (spec.width > kMaxImageSide || spec.height > kMaxImageSide ||
      std::int64_t{spec.width} * spec.height > kMaxImagePixels || spec.nchannels > 1024)
    unreadable(
        path, fmt::format("{} x {} pixels, {} channels; at most {} a side and {} in all are read",
                          spec.width, spec.height, spec.nchannels, kMaxImageSide, kMaxImagePixels));
}

/// Whether the values are display-encoded: what the file says, or else integers are and floats are
/// not. A PNG that says "gamma 1/2.2" means sRGB: that is how its writers approximate it.
bool is_srgb(const std::filesystem::path& path, const OIIO::ImageSpec& spec) {
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  if (space.empty()) return !spec.format.is_floating_point();
  if (space == "sRGB") return true;
  if (space == "Linear" || space == "linear" || space == "scene_linear") return false;
  const float gamma = spec.get_float_attribute("oiio:Gamma", 1);
  if (std::abs(gamma - 2.2f) < 0.05f) return true;
  if (std::abs(gamma - 1.0f) < 0.01f) return false;
  unreadable(path, fmt::format("its colour space is '{}'; sRGB and linear are read", space));
}

Image read(const std::filesystem::path& path) {
  std::error_code status;
  if (!std::filesystem::exists(path, status)) unreadable(path, "no such file");
  if (!std::filesystem::is_regular_file(path, status)) unreadable(path, "not a regular file");
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) unreadable(path, OIIO::geterror());
  const OIIO::ImageSpec spec = input->spec();
  check_size(path, spec);
  Image image(spec.width, spec.height);
  const int channels = spec.nchannels >= 3 ? 3 : 1;
  std::vector<float> grey;
  float* target = image.values().data();
  if (channels == 1) {
    grey.resize(image.pixel_count());
    target = grey.data();
  }
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, target))
    unreadable(path, input->geterror());
  for (std::size_t i = 0; i < grey.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) image.values()[3 * i + c] = grey[i];
  if (is_srgb(path, spec)) decode_srgb(image);
  return image;
}

std::vector<std::uint8_t> encode(const char* extension, OIIO::ImageSpec spec, OIIO::TypeDesc type,
                                 const void* pixels) {
  std::vector<std::uint8_t> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(extension);
  if (!output)
    throw Error(ExitCode::kInternal,
                fmt::format("no writer for {}: {}", extension, OIIO::geterror()));
  if (!output->set_ioproxy(&memory) || !output->open(std::string("memory.") + extension, spec) ||
      !output->write_image(type, pixels) || !output->close())
    throw Error(ExitCode::kOutput,
                fmt::format("cannot encode {}: {}", extension, output->geterror()));
  return bytes;
}

std::vector<std::uint8_t> encode_png(const DisplayImage& image, const ImageMetadata& metadata) {
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  for (const auto& [name, value] : metadata) spec.attribute(name, value);
  return encode("png", spec, OIIO::TypeDesc::UINT8, image.rgb.data());
}

ColourTable table_of_colours(std::string_view name) {
  OIIO::ImageBuf ramp(OIIO::ImageSpec(kColourTableSize, 1, 1, OIIO::TypeDesc::FLOAT));
  for (int i = 0; i < kColourTableSize; ++i) {
    const float value = float(i) / (kColourTableSize - 1);
    ramp.setpixel(i, 0, &value, 1);
  }
  const OIIO::ImageBuf colours =
      OIIO::ImageBufAlgo::color_map(ramp, 0, OIIO::string_view(name.data(), name.size()));
  if (colours.has_error() || colours.nchannels() != 3)
    throw Error(ExitCode::kInternal, fmt::format("colour map: {}", colours.geterror()));
  // Its maps are linear light, whatever they were published as.
  Image linear(kColourTableSize, 1);
  for (int i = 0; i < kColourTableSize; ++i) colours.getpixel(i, 0, linear.pixel(i, 0).data(), 3);
  const DisplayImage shown = to_display(linear, 0);
  ColourTable table;
  for (std::size_t i = 0; i < table.size(); ++i)
    std::copy_n(shown.rgb.begin() + std::ptrdiff_t(3 * i), 3, table[i].begin());
  return table;
}

}  // namespace
}  // namespace lobelia

extern "C" __attribute__((visibility("default")))
const lobelia::ImageIoTable lobelia_image_io_table;
const lobelia::ImageIoTable lobelia_image_io_table = {lobelia::read, lobelia::encode_png,
                                                      lobelia::table_of_colours};

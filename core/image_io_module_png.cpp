#include "core/image_io_module_png.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"

namespace lobelia {
namespace {

class Png : public PngEncoder {
 public:
  Png(int width, int height, const ImageMetadata& metadata)
      : output_(OIIO::ImageOutput::create("png")), width_(width), height_(height) {
    if (!output_)
      throw Error(ExitCode::kInternal, fmt::format("no writer for png: {}", OIIO::geterror()));
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    for (const auto& [name, value] : metadata) spec.attribute(name, value);
    check(output_->set_ioproxy(&memory_) && output_->open("memory.png", spec));
  }
  ~Png() override {
    // libpng prints an error of its own if it is closed before it has put out any packed rows.
    constexpr int kEnoughBytes = 16 << 20;  // even of black ones
    const int rows = std::min(height_ - next_row_, kEnoughBytes / (3 * width_) + 1);
    if (rows <= 0) return;
    const std::vector<std::uint8_t> black(std::size_t(3) * std::size_t(width_));
    for (int y = next_row_; y < next_row_ + rows; ++y)
      if (!output_->write_scanline(y, 0, OIIO::TypeDesc::UINT8, black.data())) return;
  }
  std::vector<std::uint8_t> encode(const DisplayImage& rows) override {
    const int end = next_row_ + rows.height;
    check(output_->write_scanlines(next_row_, end, 0, OIIO::TypeDesc::UINT8, rows.rgb.data()));
    next_row_ = end;
    return taken();
  }
  std::vector<std::uint8_t> finish() override {
    check(output_->close());
    return taken();
  }

 private:
  void check(bool succeeded) const {
    if (!succeeded)
      throw Error(ExitCode::kOutput, fmt::format("cannot encode png: {}", output_->geterror()));
  }
  std::vector<std::uint8_t> taken() {
    memory_.seek(0);
    return std::exchange(bytes_, {});
  }

  std::vector<std::uint8_t> bytes_;
  OIIO::Filesystem::IOVecOutput memory_{bytes_};
  std::unique_ptr<OIIO::ImageOutput> output_;  // closed before the memory goes
  int width_, height_, next_row_ = 0;
};

}  // namespace

std::unique_ptr<PngEncoder> start_png(int width, int height, const ImageMetadata& metadata) {
  return std::make_unique<Png>(width, height, metadata);
}

}  // namespace lobelia

// Writes a PNG row by row, with memory for a few rows.
#pragma once

#include "base/pictures/png_module.hpp"
#include "base/system/files.hpp"

namespace lobelia {

/// Writes the file of write_png() (base/pictures/image_io.hpp). Throws Error(kOutput); without finish() nothing is left
/// behind.
class PngWriter {
 public:
  PngWriter(const std::filesystem::path& path, int width, int height,
            const ImageMetadata& metadata = {})
      : encoder_(png_table().start(width, height, metadata)), file_(path) {}

  /// The next rows.
  void write_rows(const DisplayImage& rows) { file_.append(encoder_->encode(rows)); }

  /// After the last row.
  void finish() {
    file_.append(encoder_->finish());
    file_.finish();
  }

 private:
  std::unique_ptr<PngEncoder> encoder_;
  PartFile file_;
};

}  // namespace lobelia

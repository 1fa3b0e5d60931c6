// Writes a PNG row by row, with memory for a few rows.
#pragma once

#include <filesystem>
#include <memory>

#include "core/image.hpp"

namespace lobelia {

/// Writes the file of write_png() (core/image_io.hpp). Throws Error(kOutput); without finish() nothing is left behind.
class PngWriter {
 public:
  PngWriter(const std::filesystem::path& path, int width, int height,
            const ImageMetadata& metadata = {});
  ~PngWriter();

  /// The next rows.
  void write_rows(const DisplayImage& rows);

  /// After the last row.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lobelia

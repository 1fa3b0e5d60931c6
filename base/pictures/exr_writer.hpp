// Writes an OpenEXR picture row by row, as it is rendered, with memory for a few rows.
//
// By the core of the OpenEXR library and ISA-L: loading OpenImageIO takes longer than rendering most pictures
// (docs/decisions/0009).
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "base/pictures/image.hpp"

namespace lobelia {

/// Packs by ZIP, 16 rows at a time, on the threads of the caller's arena. The bytes depend on pixels and metadata only,
/// not on the number of threads or of rows at a time. Throws Error(kOutput); without finish() nothing is left behind.
class ExrWriter {
 public:
  /// Scene-linear float32, Rec. 709. The metadata become string attributes.
  ExrWriter(const std::filesystem::path& path, int width, int height,
            const ImageMetadata& metadata);
  ~ExrWriter();

  /// `count` rows of 3 * width floats, from row y0 on. Rows come in order, each once.
  void write_rows(int y0, int count, const float* rgb);

  /// After the last row.
  void finish();

  /// From now on all writers of this process pack on the threads that write.
  static void pack_on_calling_threads();

 private:
  struct State;
  int width_, height_, next_row_ = 0;
  std::unique_ptr<State> state_;
};

}  // namespace lobelia

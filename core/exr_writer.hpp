// Writes an OpenEXR picture row by row, as it is rendered, with memory for a few rows.
//
// By the OpenEXR library itself: loading OpenImageIO takes longer than rendering most pictures (docs/decisions/0005).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "core/image.hpp"

namespace lobelia {

enum class ExrCompression : std::uint8_t {
  kNone,
  kZips,  ///< each row by itself
  kZip,   ///< 16 rows at a time
  kPiz,   ///< wavelets, 32 rows at a time
};

struct ExrOptions {
  ExrCompression compression = ExrCompression::kZip;
  int zip_level = 1;  ///< 1..9; docs/decisions/0005 says why 1
};

/// The bytes depend on pixels, metadata and options only, not on the number of threads or of rows at a time. Throws
/// Error(kOutput); without finish() nothing is left behind.
class ExrWriter {
 public:
  /// Scene-linear float32, Rec. 709. The metadata become string attributes.
  ExrWriter(const std::filesystem::path& path, int width, int height, const ImageMetadata& metadata,
            ExrOptions options = {});
  ~ExrWriter();

  /// `count` rows of 3 * width floats, from row y0 on. Rows come in order, each once.
  void write_rows(int y0, int count, const float* rgb);

  /// After the last row.
  void finish();

  /// Sets how many threads compress, for all writers of this process; 0: the threads that write. Only before the first
  /// writer; the default is one for each processor.
  static void set_pool(int threads);

 private:
  struct State;
  int width_, height_, next_row_ = 0;
  std::unique_ptr<State> state_;
};

}  // namespace lobelia

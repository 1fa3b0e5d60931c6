#include "core/png_writer.hpp"

#include "core/files.hpp"
#include "core/png_module.hpp"

namespace lobelia {

struct PngWriter::State {
  std::unique_ptr<PngEncoder> encoder;
  PartFile file;
};

PngWriter::PngWriter(const std::filesystem::path& path, int width, int height,
                     const ImageMetadata& metadata)
    : state_(new State{png_table().start(width, height, metadata), PartFile(path)}) {}

PngWriter::~PngWriter() = default;

void PngWriter::write_rows(const DisplayImage& rows) {
  state_->file.append(state_->encoder->encode(rows));
}

void PngWriter::finish() {
  state_->file.append(state_->encoder->finish());
  state_->file.finish();
}

}  // namespace lobelia

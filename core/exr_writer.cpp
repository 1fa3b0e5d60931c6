#include "core/exr_writer.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <mutex>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/no_resources.hpp"
#include "core/threads.hpp"

namespace lobelia {
namespace {

/// In the order of ExrCompression.
constexpr Imf::Compression kCompressions[] = {Imf::NO_COMPRESSION, Imf::ZIPS_COMPRESSION,
                                              Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION};

Imf::Header header(int width, int height, const ImageMetadata& metadata, ExrOptions options) {
  Imf::Header result(width, height);
  result.compression() = kCompressions[std::size_t(options.compression)];
  result.zipCompressionLevel() = options.zip_level;
  for (const char* name : {"R", "G", "B"}) result.channels().insert(name, Imf::Channel(Imf::FLOAT));
  for (const auto& [name, value] : metadata) {
    constexpr std::size_t kLongestName = 255;  // of the format; OpenEXR would cut it
    if (name.size() > kLongestName)
      throw Error(ExitCode::kInternal, "EXR: an attribute's name is too long");
    result.insert(name, Imf::StringAttribute(value));
  }
  return result;
}

/// Sends OpenEXR's output to a PartFile. OpenEXR swallows exceptions while it writes its table of offsets on closing, so
/// the first one is kept for finish().
class Stream : public Imf::OStream {
 public:
  explicit Stream(const std::filesystem::path& path) : OStream(path.c_str()), file_(path) {}

  void write(const char bytes[], int count) override {
    const std::span data(reinterpret_cast<const std::uint8_t*>(bytes), std::size_t(count));
    try {
      // OpenEXR appends everything but the table.
      if (position_ == file_.size())
        file_.append(data);
      else
        file_.write_at(position_, data);
    } catch (...) {
      if (!failure_) failure_ = std::current_exception();
      throw;
    }
    position_ += data.size();
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }
  void finish() {
    rethrow();
    file_.finish();
  }

 private:
  PartFile file_;
  std::uint64_t position_ = 0;
  std::exception_ptr failure_;
};

int pool_threads = 0;  // as set_pool() has set it

}  // namespace

void ExrWriter::set_pool(int threads) {
  // The process has one pool, which must not change while another writer uses it.
  static std::once_flag once;
  std::call_once(once, [&] {
    Imf::setGlobalThreadCount(threads);
    pool_threads = threads;
  });
}

struct ExrWriter::State {
  Stream stream;
  std::unique_ptr<Imf::OutputFile> output;  // closed before the stream

  /// OpenEXR wraps what a stream throws in errors of its own.
  template <class F>
  void guarded(const F& f) {
    try {
      f();
    } catch (const Error&) {
      throw;
    } catch (const std::exception& error) {
      stream.rethrow();
      throw failure_of("EXR", error, ExitCode::kInternal);
    }
  }
};

ExrWriter::ExrWriter(const std::filesystem::path& path, int width, int height,
                     const ImageMetadata& metadata, ExrOptions options)
    : width_(width), height_(height), state_(new State{Stream(path), nullptr}) {
  set_pool(usual_threads() == 1 ? 0 : usual_threads());
  const int threads = std::min(pool_threads, oneapi::tbb::this_task_arena::max_concurrency());
  state_->guarded([&] {
    state_->output = std::make_unique<Imf::OutputFile>(
        state_->stream, header(width, height, metadata, options), threads);
  });
}

ExrWriter::~ExrWriter() = default;

void ExrWriter::write_rows(int y0, int count, const float* rgb) {
  if (y0 != next_row_ || count < 0 || count > height_ - y0)
    throw Error(ExitCode::kInternal, fmt::format("EXR: rows {} to {} of {} after {}", y0,
                                                 y0 + count, height_, next_row_));
  if (count == 0) return;
  next_row_ += count;
  const std::size_t pixel = 3 * sizeof(float), row = pixel * std::size_t(width_);
  Imf::FrameBuffer rows;
  const char* names[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    // The address that row 0 would have.
    const auto first = reinterpret_cast<std::intptr_t>(rgb + c) - std::intptr_t(row) * y0;
    rows.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(first), pixel, row));
  }
  state_->guarded([&] {
    state_->output->setFrameBuffer(rows);
    state_->output->writePixels(count);
  });
}

void ExrWriter::finish() {
  if (next_row_ != height_)
    throw Error(ExitCode::kInternal, fmt::format("EXR: {} of {} rows", next_row_, height_));
  state_->output.reset();
  state_->stream.finish();
}

}  // namespace lobelia

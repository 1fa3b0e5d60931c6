#include "base/pictures/exr_writer.hpp"

#include <fmt/format.h>
#include <isa-l/igzip_lib.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <openexr.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <exception>
#include <span>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/threads.hpp"

namespace lobelia {
namespace {

constexpr int kBlockRows = 16;  // of the format's ZIP
/// Packed before the first of them is written; bounds the memory for them.
constexpr int kBlocksTogether = 64;

std::atomic<bool> packs_on_calling_threads{false};

using Bytes = std::vector<std::uint8_t>;

/// Memory that a thread uses again for each block: fresh memory takes longer than packing.
struct Workspace {
  Bytes block, apart, steps, packed;
  std::vector<isal_zstream, ZeroedMemory<isal_zstream>> stream{
      1};  // 80 KiB, whose pages come at once
  std::unique_ptr<std::uint8_t[]> deflate{new std::uint8_t[ISAL_DEF_LVL1_DEFAULT]};
};

/// The rows of a block as the format has them: in each row all of B, then G, then R.
void take_block(const float* rgb, int width, int rows, Bytes& block) {
  block.resize(std::size_t(rows) * std::size_t(width) * 3 * sizeof(float));
  std::uint8_t* to = block.data();
  for (int y = 0; y < rows; ++y, rgb += 3 * std::ptrdiff_t(width))
    for (int channel = 2; channel >= 0; --channel)
      for (int x = 0; x < width; ++x, to += sizeof(float))
        std::memcpy(to, &rgb[3 * x + channel], sizeof(float));
}

/// Even bytes, then odd ones, each less the one before it, as zlib's format: what ZIP is in an EXR. The bytes themselves
/// if that is no shorter.
Bytes zipped(const float* rgb, int width, int rows) {
  thread_local Workspace space;
  take_block(rgb, width, rows, space.block);
  const std::size_t count = space.block.size(), half = count / 2;  // even, because floats are
  space.apart.resize(count), space.steps.resize(count), space.packed.resize(count);
  const std::uint8_t* const block = space.block.data();
  std::uint8_t *const apart = space.apart.data(), *const steps = space.steps.data();
  for (std::size_t i = 0; i < half; ++i) {
    apart[i] = block[2 * i];
    apart[half + i] = block[2 * i + 1];
  }
  steps[0] = apart[0];
  for (std::size_t i = 1; i < count; ++i) steps[i] = std::uint8_t(apart[i] - apart[i - 1] + 128);

  isal_zstream& stream = space.stream[0];
  // All zero: a few bytes of a packed block depend on what isal_deflate_init() leaves as it was.
  std::memset(&stream, 0, sizeof stream);
  isal_deflate_init(&stream);
  stream.level = 1;
  stream.level_buf = space.deflate.get();
  stream.level_buf_size = ISAL_DEF_LVL1_DEFAULT;
  stream.gzip_flag = IGZIP_ZLIB;
  stream.next_out = space.packed.data();
  stream.avail_out = std::uint32_t(count);
  stream.next_in = space.steps.data();
  // The first bytes by themselves: if more come at first, ISA-L 2.30 to 2.32 hashes the address of the stream, and 15 of
  // 26 000 small blocks differ by it; 244 do by isal_deflate_stateless(). libdeflate takes 3 to 4.6 times as long.
  stream.avail_in = std::uint32_t(std::min<std::size_t>(count, 16));
  stream.flush = SYNC_FLUSH;
  isal_deflate(&stream);
  stream.avail_in = std::uint32_t(count) - stream.total_in;
  stream.flush = NO_FLUSH;
  stream.end_of_stream = 1;
  isal_deflate(&stream);
  if (stream.avail_out == 0) return space.block;
  return {space.packed.data(), space.packed.data() + stream.total_out};
}

}  // namespace

struct ExrWriter::State {
  explicit State(const std::filesystem::path& path) : file(path) {}
  ~State() {
    if (context) ::exr_finish(&context);
  }

  PartFile file;
  exr_context_t context = nullptr;
  std::vector<float> rows;  ///< of a block that is not complete
  std::exception_ptr failure;
  std::string message;

  static void take_message(exr_const_context_t context, exr_result_t, const char* message) {
    void* state = nullptr;
    ::exr_get_user_data(context, &state);
    if (state) static_cast<State*>(state)->message = message;
  }
  static std::int64_t write(exr_const_context_t, void* self, const void* bytes, std::uint64_t count,
                            std::uint64_t offset, exr_stream_error_func_ptr_t) {
    State& state = *static_cast<State*>(self);
    const std::span data(static_cast<const std::uint8_t*>(bytes), count);
    try {
      // OpenEXR appends everything but the table of offsets.
      if (offset == state.file.size())
        state.file.append(data);
      else
        state.file.write_at(offset, data);
      return std::int64_t(count);
    } catch (...) {
      state.failure = std::current_exception();
      return -1;
    }
  }

  void check(exr_result_t result) {
    if (failure) std::rethrow_exception(failure);
    if (result != EXR_ERR_SUCCESS)
      throw Error(ExitCode::kInternal, "EXR: {}",
                  message.empty() ? ::exr_get_error_code_as_string(result) : message.c_str());
  }

  /// Blocks from row y on; the last may have fewer rows.
  void write_blocks(int y, int count, int width, const float* rgb) {
    const std::size_t row = 3 * std::size_t(width);
    const int blocks = (count + kBlockRows - 1) / kBlockRows;
    const bool is_small = std::size_t(count) * std::size_t(width) <= kPixelsOfOneThread;
    std::vector<Bytes> packed;
    for (int first = 0; first < blocks; first += kBlocksTogether) {
      packed.resize(std::size_t(std::min(kBlocksTogether, blocks - first)));
      const auto pack = [&](std::size_t i) {
        const int begin = (first + int(i)) * kBlockRows;
        packed[i] =
            zipped(rgb + row * std::size_t(begin), width, std::min(kBlockRows, count - begin));
      };
      if (packs_on_calling_threads || is_small) {
        for (std::size_t i = 0; i < packed.size(); ++i) pack(i);
      } else {
        // Isolated, because another task could wait for what the caller holds.
        oneapi::tbb::this_task_arena::isolate(
            [&] { oneapi::tbb::parallel_for(std::size_t{0}, packed.size(), pack); });
      }
      for (std::size_t i = 0; i < packed.size(); ++i)
        check(::exr_write_scanline_chunk(context, 0, y + (first + int(i)) * kBlockRows,
                                         packed[i].data(), packed[i].size()));
    }
  }
};

ExrWriter::ExrWriter(const std::filesystem::path& path, int width, int height,
                     const ImageMetadata& metadata)
    : width_(width), height_(height), state_(new State(path)) {
  State& state = *state_;
  exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
  how.error_handler_fn = &State::take_message;
  how.user_data = &state;
  how.write_fn = &State::write;
  state.check(::exr_start_write(&state.context, path.c_str(), EXR_WRITE_FILE_DIRECTLY, &how));
  const exr_context_t context = state.context;
  int part = 0;
  state.check(::exr_add_part(context, "", EXR_STORAGE_SCANLINE, &part));
  state.check(
      ::exr_initialize_required_attr_simple(context, part, width, height, EXR_COMPRESSION_ZIP));
  for (const char* name : {"B", "G", "R"})
    state.check(::exr_add_channel(context, part, name, EXR_PIXEL_FLOAT,
                                  EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
  constexpr std::size_t kShortName = 31, kLongestName = 255;  // of the format
  const auto length = [](const auto& one) { return one.first.size(); };
  if (std::ranges::any_of(metadata, [&](const auto& one) { return length(one) > kLongestName; }))
    throw Error(ExitCode::kInternal, "EXR: an attribute's name is too long");
  const bool has_long =
      std::ranges::any_of(metadata, [&](const auto& one) { return length(one) > kShortName; });
  state.check(::exr_set_longname_support(context, has_long));
  for (const auto& [name, value] : metadata)
    state.check(::exr_attr_set_string(context, part, name.c_str(), value.c_str()));
  state.check(::exr_write_header(context));
}

ExrWriter::~ExrWriter() = default;

void ExrWriter::pack_on_calling_threads() { packs_on_calling_threads = true; }

void ExrWriter::write_rows(int y0, int count, const float* rgb) {
  if (y0 != next_row_ || count < 0 || count > height_ - y0)
    throw Error(ExitCode::kInternal, "EXR: rows {} to {} of {} after {}", y0, y0 + count, height_,
                next_row_);
  const std::size_t row = 3 * std::size_t(width_);
  std::vector<float>& kept = state_->rows;
  const auto keep = [&](int rows) {
    kept.insert(kept.end(), rgb, rgb + row * std::size_t(rows));
    rgb += row * std::size_t(rows);
    next_row_ += rows;
  };
  const int end = y0 + count;
  if (!kept.empty()) {
    keep(std::min(count, kBlockRows - next_row_ % kBlockRows));
    if (next_row_ % kBlockRows != 0 && next_row_ != height_) return;
    const int rows = int(kept.size() / row);
    state_->write_blocks(next_row_ - rows, rows, width_, kept.data());
    kept.clear();
  }
  const int whole = end == height_ ? end : end / kBlockRows * kBlockRows;
  if (whole > next_row_) {
    state_->write_blocks(next_row_, whole - next_row_, width_, rgb);
    rgb += row * std::size_t(whole - next_row_);
    next_row_ = whole;
  }
  keep(end - next_row_);
}

void ExrWriter::finish() {
  if (next_row_ != height_)
    throw Error(ExitCode::kInternal, "EXR: {} of {} rows", next_row_, height_);
  state_->check(::exr_finish(&state_->context));
  state_->file.finish();
}

}  // namespace lobelia

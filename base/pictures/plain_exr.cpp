// Plain EXRs, by OpenEXR's core; ISA-L unpacks ZIP in half of zlib's time.
#include <isa-l/igzip_lib.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <openexr.h>

#include <atomic>
#include <cstring>
#include <utility>

#include "base/pictures/plain_picture.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace {

/// In OpenImageIO's order. An EXR has them by their names' alphabet.
const std::vector<std::string> kPlainChannels[] = {
    {"R", "G", "B"}, {"R", "G", "B", "A"}, {"Y"}, {"Y", "A"}};

/// Attributes by which OpenImageIO would find other layers, or another window.
constexpr std::string_view kNotPlain[] = {"view", "multiview", "envmap", "textureformat",
                                          "oiio:subimagename"};

std::int64_t read_bytes(exr_const_context_t context, void* bytes, void* to, std::uint64_t count,
                        std::uint64_t offset, exr_stream_error_func_ptr_t) {
  static_cast<void>(context);
  const auto& all = *static_cast<const std::string_view*>(bytes);
  if (offset >= all.size()) return 0;
  const std::uint64_t n = std::min<std::uint64_t>(count, all.size() - offset);
  std::memcpy(to, all.data() + offset, n);
  return std::int64_t(n);
}

using Decompress = decltype(exr_decode_pipeline_t::decompress_fn);

struct Unzip {
  std::vector<std::uint8_t> steps;  ///< memory that is used again
  Decompress by_zlib = nullptr;
};

/// Unpacks a ZIP block, the inverse of zipped() in exr_writer.cpp. Falls back to zlib if ISA-L fails.
exr_result_t unzip(exr_decode_pipeline_t* pipeline) try {
  const exr_chunk_info_t& chunk = pipeline->chunk;
  const std::size_t size = chunk.unpacked_size;
  if (chunk.packed_size == size) return EXR_ERR_SUCCESS;  // stored
  auto& [steps, by_zlib] = *static_cast<Unzip*>(pipeline->decoding_user_data);
  steps.resize(size);
  inflate_state state;
  isal_inflate_init(&state);
  state.crc_flag = ISAL_ZLIB;
  state.next_in = static_cast<std::uint8_t*>(pipeline->packed_buffer);
  state.avail_in = std::uint32_t(chunk.packed_size);
  state.next_out = steps.data();
  state.avail_out = std::uint32_t(size);
  if (isal_inflate_stateless(&state) != ISAL_DECOMP_OK || state.total_out != size)
    return by_zlib(pipeline);
  // Each byte is the sum of the steps up to it, less 128 each but the first. Even bytes are in the first half.
  const std::size_t half = (size + 1) / 2;
  std::uint8_t even = 128, odd = even;
  for (std::size_t i = 0; i < half; ++i) odd = std::uint8_t(odd + steps[i] - 128);
  const std::uint8_t *first = steps.data(), *second = first + half;
  auto* to = static_cast<std::uint8_t*>(pipeline->unpacked_buffer);
  for (std::size_t i = 0; i < size / 2; ++i, to += 2) {
    to[0] = even = std::uint8_t(even + first[i] - 128);
    to[1] = odd = std::uint8_t(odd + second[i] - 128);
  }
  if (size % 2 == 1) *to = std::uint8_t(even + first[half - 1] - 128);
  return EXR_ERR_SUCCESS;
} catch (const std::bad_alloc&) {
  return EXR_ERR_OUT_OF_MEMORY;
}

/// Finds the block of row y. False unless it is complete, and its row and its length before it are right: OpenEXR's core
/// 3.1 does not look.
bool find_block(exr_const_context_t context, std::string_view file, int y,
                exr_chunk_info_t& chunk) {
  return ::exr_read_scanline_chunk_info(context, 0, y, &chunk) == EXR_ERR_SUCCESS &&
         chunk.data_offset >= 8 && chunk.data_offset <= file.size() &&
         chunk.packed_size <= file.size() - chunk.data_offset &&
         std::int32_t(number_at(file, chunk.data_offset - 8, true)) == y &&
         number_at(file, chunk.data_offset - 4, true) == chunk.packed_size &&
         chunk.packed_size <= chunk.unpacked_size &&
         (chunk.compression != EXR_COMPRESSION_NONE || chunk.packed_size == chunk.unpacked_size);
}

/// Decodes one block of rows after another, in the same memory.
class BlockDecoder {
 public:
  BlockDecoder() = default;
  BlockDecoder(const BlockDecoder&) = delete;
  BlockDecoder& operator=(const BlockDecoder&) = delete;
  ~BlockDecoder() {
    if (context_) ::exr_decoding_destroy(context_, &pipeline_);
  }

  /// Row y is the file's; channels[c] of the file goes to to[c], of pixels of 12 bytes.
  bool decode(exr_const_context_t context, std::string_view file, bool is_zip, int y,
              std::span<const std::pair<std::string, float*>> channels, int width) {
    exr_chunk_info_t chunk;
    if (!find_block(context, file, y, chunk)) return false;
    if ((context_ ? ::exr_decoding_update(context, 0, &chunk, &pipeline_)
                  : ::exr_decoding_initialize(context, 0, &chunk, &pipeline_)) != EXR_ERR_SUCCESS)
      return false;
    const bool is_first = !context_;
    context_ = context;
    for (int c = 0; c < pipeline_.channel_count; ++c) {
      exr_coding_channel_info_t& channel = pipeline_.channels[c];
      channel.decode_to_ptr = nullptr;
      channel.user_bytes_per_element = sizeof(float);
      channel.user_data_type = EXR_PIXEL_FLOAT;
      channel.user_pixel_stride = 3 * sizeof(float);
      channel.user_line_stride = 3 * int(sizeof(float)) * width;
      for (const auto& [name, to] : channels)
        if (channel.channel_name == name)
          channel.decode_to_ptr = reinterpret_cast<std::uint8_t*>(to);
    }
    if (is_first) {
      if (::exr_decoding_choose_default_routines(context, 0, &pipeline_) != EXR_ERR_SUCCESS)
        return false;
      if (is_zip) unzip_.by_zlib = std::exchange(pipeline_.decompress_fn, unzip);
      pipeline_.decoding_user_data = &unzip_;
    }
    return ::exr_decoding_run(context, 0, &pipeline_) == EXR_ERR_SUCCESS;
  }

 private:
  exr_decode_pipeline_t pipeline_ = EXR_DECODE_PIPELINE_INITIALIZER;
  exr_const_context_t context_ = nullptr;
  Unzip unzip_;
};

class PlainExr : public PlainFile {
 public:
  explicit PlainExr(const PictureBytes& file)
      : bytes_(file.bytes), on_one_thread_(file.on_one_thread) {}
  ~PlainExr() override {
    if (context_) ::exr_finish(&context_);
  }

  bool open() {
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    how.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
    how.user_data = &bytes_;
    how.read_fn = read_bytes;
    how.size_fn = [](exr_const_context_t, void* bytes) {
      return std::int64_t(static_cast<const std::string_view*>(bytes)->size());
    };
    how.flags = EXR_CONTEXT_FLAG_STRICT_HEADER | EXR_CONTEXT_FLAG_SILENT_HEADER_PARSE |
                EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    how.max_image_width = how.max_image_height = kMaxImageSide;
    int parts = 0;
    exr_storage_t storage;
    exr_lineorder_t order;
    return ::exr_start_read(&context_, "picture", &how) == EXR_ERR_SUCCESS &&
           ::exr_get_count(context_, &parts) == EXR_ERR_SUCCESS && parts == 1 &&
           ::exr_get_storage(context_, 0, &storage) == EXR_ERR_SUCCESS &&
           storage == EXR_STORAGE_SCANLINE &&
           ::exr_get_lineorder(context_, 0, &order) == EXR_ERR_SUCCESS &&
           order != EXR_LINEORDER_RANDOM_Y && take_packing() && take_windows() && take_channels() &&
           take_attributes() && has_all_blocks();
  }

  ColourMeaning meaning(const std::filesystem::path&) const override {
    ColourMeaning result;
    result.primaries = primaries_;
    return result;
  }

  bool read(int y, const std::vector<std::size_t>& channels, Image& rows) override {
    float* const values = rows.values().data();
    const int count = rows.height(), blocks = (count + band_rows - 1) / band_rows;
    oneapi::tbb::enumerable_thread_specific<BlockDecoder> decoders;
    std::atomic<bool> succeeds{true};
    const auto decode = [&](int block) {
      if (!succeeds) return;
      const int first = block * band_rows;
      std::vector<std::pair<std::string, float*>> to;
      for (std::size_t c = 0; c < channels.size(); ++c)
        to.emplace_back(
            part.channels[channels[c]],
            values + std::size_t(3) * std::size_t(window.width) * std::size_t(first) + c);
      if (!decoders.local().decode(context_, bytes_, is_zip_, window.y + y + first, to,
                                   window.width))
        succeeds = false;
    };
    if (on_one_thread_)
      for (int block = 0; block < blocks; ++block) decode(block);
    else
      oneapi::tbb::parallel_for(0, blocks, decode);
    if (channels.size() == 1)
      for (std::size_t i = 0; i < rows.values().size(); i += 3)
        values[i + 1] = values[i + 2] = values[i];
    return succeeds;
  }

 private:
  /// Accepts lossless packing only: all decoders then give the same values.
  bool take_packing() {
    exr_compression_t packing;
    std::int32_t rows = 0;
    if (::exr_get_compression(context_, 0, &packing) != EXR_ERR_SUCCESS ||
        ::exr_get_scanlines_per_chunk(context_, 0, &rows) != EXR_ERR_SUCCESS || rows < 1)
      return false;
    band_rows = rows;
    is_zip_ = packing == EXR_COMPRESSION_ZIP || packing == EXR_COMPRESSION_ZIPS;
    return is_zip_ || packing == EXR_COMPRESSION_NONE || packing == EXR_COMPRESSION_RLE ||
           packing == EXR_COMPRESSION_PIZ;
  }
  /// Looked at first, because a band that was handed on cannot be left to OpenImageIO any more.
  bool has_all_blocks() const {
    exr_chunk_info_t chunk;
    for (int y = 0; y < window.height; y += band_rows)
      if (!find_block(context_, bytes_, window.y + y, chunk)) return false;
    return true;
  }
  bool take_windows() {
    exr_attr_box2i_t data, display;
    if (::exr_get_data_window(context_, 0, &data) != EXR_ERR_SUCCESS ||
        ::exr_get_display_window(context_, 0, &display) != EXR_ERR_SUCCESS ||
        std::memcmp(&data, &display, sizeof data) != 0)
      return false;
    const auto length = [](std::int32_t first, std::int32_t last) {
      const std::int64_t n = std::int64_t{last} - first + 1;
      return n >= 1 && n <= kMaxImageSide ? int(n) : 0;  // window_problem() refuses 0
    };
    window = {data.min.x, data.min.y, length(data.min.x, data.max.x),
              length(data.min.y, data.max.y)};
    return true;
  }
  bool take_channels() {
    const exr_attr_chlist_t* list = nullptr;
    if (::exr_get_channels(context_, 0, &list) != EXR_ERR_SUCCESS || list->num_channels < 1)
      return false;
    std::vector<std::string> names;
    const exr_pixel_type_t type = list->entries[0].pixel_type;
    for (int c = 0; c < list->num_channels; ++c) {
      const exr_attr_chlist_entry_t& entry = list->entries[c];
      if (entry.x_sampling != 1 || entry.y_sampling != 1 || entry.pixel_type != type) return false;
      names.emplace_back(entry.name.str, std::size_t(entry.name.length));
    }
    if (type != EXR_PIXEL_HALF && type != EXR_PIXEL_FLOAT) return false;
    value_type = type == EXR_PIXEL_HALF ? "half" : "float";
    value_bytes = type == EXR_PIXEL_HALF ? 2 : 4;
    std::ranges::sort(names);
    for (const std::vector<std::string>& plain : kPlainChannels) {
      std::vector<std::string> sorted = plain;
      std::ranges::sort(sorted);
      if (sorted != names) continue;
      part.channels = plain;
      return true;
    }
    return false;
  }
  bool take_attributes() {
    std::int32_t count = 0;
    if (::exr_get_attribute_count(context_, 0, &count) != EXR_ERR_SUCCESS) return false;
    for (std::int32_t i = 0; i < count; ++i) {
      const exr_attribute_t* found = nullptr;
      if (::exr_get_attribute_by_index(context_, 0, EXR_ATTR_LIST_FILE_ORDER, i, &found) !=
          EXR_ERR_SUCCESS)
        return false;
      const std::string_view name = found->name;
      // OpenImageIO finds them in any case of letters.
      if (std::ranges::count(kNotPlain, lower_case(name)) > 0) return false;
      const bool is_text = found->type == EXR_ATTR_STRING;
      const std::string text =
          is_text ? std::string(found->string->str, std::size_t(found->string->length)) : "";
      if (name == "name" && is_text) part.name = text;
      if (name == "chromaticities" && found->type == EXR_ATTR_CHROMATICITIES) {
        const exr_attr_chromaticities_t& c = *found->chromaticities;
        primaries_ = {c.red_x,  c.red_y,  c.green_x, c.green_y,
                      c.blue_x, c.blue_y, c.white_x, c.white_y};
      }
      if (!may_state_samples(name)) continue;
      if (found->type == EXR_ATTR_INT)
        attributes.emplace_back(name, std::to_string(found->i));
      else if (is_text)
        attributes.emplace_back(name, text);
      else
        return false;
    }
    return true;
  }

  std::string_view bytes_;
  bool on_one_thread_, is_zip_ = false;
  exr_context_t context_ = nullptr;
  std::optional<Chromaticities> primaries_;
};

}  // namespace

std::unique_ptr<PlainFile> open_plain_exr(const PictureBytes& file) {
  if (is_exr_that_claims_too_much(file.bytes)) return nullptr;
  auto exr = std::make_unique<PlainExr>(file);
  if (!exr->open()) return nullptr;
  return exr;
}

}  // namespace lobelia

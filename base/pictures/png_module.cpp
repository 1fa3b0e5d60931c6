#include "base/pictures/png_module.hpp"

#include <fmt/format.h>
#include <spng.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/pictures/orientation.hpp"
#include "base/system/error.hpp"

namespace lobelia {
namespace {

struct FreePng {
  void operator()(spng_ctx* png) const { ::spng_ctx_free(png); }
};
using PngContext = std::unique_ptr<spng_ctx, FreePng>;

/// Whether each chunk's type is four letters. libpng refuses others, libspng does not look.
bool has_types_of_letters(std::string_view bytes) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  for (std::size_t at = 8; at + 8 <= bytes.size(); at += 12 + number_at(bytes, at, false))
    if (!std::ranges::all_of(bytes.substr(at + 4, 4), is_letter)) return false;
  return true;
}

class PlainPng : public PlainFile {
 public:
  explicit PlainPng(std::string_view bytes, int most_side = kMaxImageSide)
      : context_(::spng_ctx_new(0)),
        colour_(png_colour(bytes)),
        types_are_right_(has_types_of_letters(bytes)) {
    if (!context_) throw std::bad_alloc();
    // Texts are unpacked, and a few bytes can unpack to gigabytes.
    constexpr std::size_t kMostText = std::size_t{1} << 20, kMostOfAll = std::size_t{16} << 20;
    ::spng_set_chunk_limits(context_.get(), kMostText, kMostOfAll);
    ::spng_set_image_limits(context_.get(), std::uint32_t(most_side), std::uint32_t(most_side));
    ::spng_set_png_buffer(context_.get(), bytes.data(), bytes.size());
  }

  bool open() {
    spng_ihdr header;
    spng_plte palette;
    spng_trns transparent;
    spng_offs position;
    spng_ctx* const png = context_.get();
    if (!types_are_right_ || ::spng_get_ihdr(png, &header) != 0 || header.bit_depth < 8 ||
        colour_.has_icc_profile || header.color_type == SPNG_COLOR_TYPE_INDEXED ||
        ::spng_decode_chunks(png) != 0 || has(::spng_get_plte(png, &palette)) ||
        has(::spng_get_trns(png, &transparent)) || has(::spng_get_offs(png, &position)))
      return false;
    const bool has_alpha = (header.color_type & 4) != 0, is_colour = (header.color_type & 2) != 0;
    part.channels =
        is_colour ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"};
    if (has_alpha) part.channels.emplace_back("A");
    is_unassociated = has_alpha;
    window = {0, 0, int(header.width), int(header.height)};
    value_bytes = header.bit_depth / 8;
    value_type = value_bytes == 1 ? "uint8" : "uint16";
    std::uint32_t count = 0;
    if (::spng_get_text(png, nullptr, &count) != 0) return true;  // there are none
    std::vector<spng_text> texts(count);
    if (::spng_get_text(png, texts.data(), &count) != 0) return false;
    for (const spng_text& text : texts)
      if (may_state_samples(text.keyword))
        attributes.emplace_back(text.keyword, std::string(text.text, text.length));
    return true;
  }

  ColourMeaning meaning(const std::filesystem::path& path) const override {
    return png_meaning(path, colour_);
  }

  bool read(int, const std::vector<std::size_t>& channels, Image& rows) override {
    if (!decode()) return false;
    if (value_bytes == 1)
      convert<std::uint8_t>(channels, rows);
    else
      convert<std::uint16_t>(channels, rows);
    return true;
  }

  std::optional<DisplayImage> codes() {
    const bool is_srgb = colour_.is_srgb || (!colour_.gamma && !colour_.chromaticities);
    if (colour_.cicp || !is_srgb || value_bytes != 1 || part.channels.size() != 3 || !decode())
      return std::nullopt;
    return DisplayImage{window.width, window.height, std::move(values_)};
  }

 private:
  /// All values, as the file has them.
  bool decode() {
    if (!values_.empty()) return true;
    std::size_t size = 0;
    if (::spng_decoded_image_size(context_.get(), SPNG_FMT_PNG, &size) != 0) return false;
    values_.resize(size);
    // The chunks behind the pixels are read for the checksum of the last with pixels.
    return ::spng_decode_image(context_.get(), values_.data(), size, SPNG_FMT_PNG, 0) == 0 &&
           ::spng_decode_chunks(context_.get()) == 0;
  }
  /// Whether there is such a chunk; a damaged one counts too.
  static bool has(int result) { return result != SPNG_ECHUNKAVAIL; }

  /// The largest integer becomes 1, by a product as in OpenImageIO.
  template <class Integer>
  void convert(const std::vector<std::size_t>& channels, Image& rows) const {
    constexpr float kScale = 1.0f / std::numeric_limits<Integer>::max();
    const std::size_t stride = part.channels.size() * sizeof(Integer);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint8_t* from =
          values_.data() + channels[std::min(c, channels.size() - 1)] * sizeof(Integer);
      for (std::size_t i = c; i < rows.values().size(); i += 3, from += stride) {
        Integer value;
        std::memcpy(&value, from, sizeof value);
        rows.values()[i] = float(value) * kScale;
      }
    }
  }

  PngContext context_;
  PngColour colour_;
  bool types_are_right_;
  std::vector<std::uint8_t> values_;
};

bool is_ascii(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

class SpngEncoder : public PngEncoder {
 public:
  SpngEncoder(int width, int height, const ImageMetadata& metadata)
      : context_(::spng_ctx_new(SPNG_CTX_ENCODER)),
        row_bytes_(std::size_t(3) * std::size_t(width)) {
    if (!context_) throw std::bad_alloc();
    spng_ctx* const png = context_.get();
    spng_ihdr header{};
    header.width = std::uint32_t(width);
    header.height = std::uint32_t(height);
    header.bit_depth = 8;
    header.color_type = SPNG_COLOR_TYPE_TRUECOLOR;
    check(::spng_set_png_stream(png, &SpngEncoder::take, this));
    check(::spng_set_ihdr(png, &header));
    check(::spng_set_srgb(png, 0));  // perceptual
    std::vector<spng_text> texts;
    for (const auto& [name, value] : metadata) {
      if (value.empty()) continue;  // libspng refuses it
      spng_text& text = texts.emplace_back();
      name.copy(text.keyword, sizeof text.keyword - 1);
      text.type = is_ascii(value) ? SPNG_TEXT : SPNG_ITXT;  // Latin-1, UTF-8
      text.length = value.size();
      text.text = const_cast<char*>(value.c_str());
      text.language_tag = text.translated_keyword = const_cast<char*>("");
    }
    if (!texts.empty()) check(::spng_set_text(png, texts.data(), std::uint32_t(texts.size())));
    check(::spng_encode_image(png, nullptr, 0, SPNG_FMT_PNG,
                              SPNG_ENCODE_PROGRESSIVE | SPNG_ENCODE_FINALIZE));
  }
  std::vector<std::uint8_t> encode(const DisplayImage& rows) override {
    for (int y = 0; y < rows.height; ++y) {
      const int result = ::spng_encode_row(
          context_.get(), rows.rgb.data() + row_bytes_ * std::size_t(y), row_bytes_);
      is_complete_ = result == SPNG_EOI;  // the last row ends the file
      if (!is_complete_) check(result);
    }
    return std::exchange(bytes_, {});
  }
  std::vector<std::uint8_t> finish() override {
    if (!is_complete_) throw Error(ExitCode::kInternal, "PNG: rows are missing");
    return std::exchange(bytes_, {});
  }

 private:
  static int take(spng_ctx*, void* self, void* bytes, std::size_t size) try {
    auto& taken = static_cast<SpngEncoder*>(self)->bytes_;
    const auto* const begin = static_cast<const std::uint8_t*>(bytes);
    taken.insert(taken.end(), begin, begin + size);
    return 0;
  } catch (const std::bad_alloc&) {
    return SPNG_EMEM;
  }
  static void check(int result) {
    if (result == SPNG_EMEM || result == SPNG_EZLIB_INIT) throw std::bad_alloc();
    if (result != 0)
      throw Error(ExitCode::kOutput, "cannot encode png: {}", ::spng_strerror(result));
  }

  std::vector<std::uint8_t> bytes_;
  PngContext context_;
  std::size_t row_bytes_;
  bool is_complete_ = false;
};

std::unique_ptr<PlainFile> open_plain_png(const PictureBytes& file) {
  auto png = std::make_unique<PlainPng>(file.bytes);
  if (!png->open()) return nullptr;
  return png;
}

std::optional<DisplayImage> read_codes(std::string_view bytes, int most_side) {
  if (stated_orientation(bytes, "png") != kUpright) return std::nullopt;
  PlainPng png(bytes, most_side);
  return png.open() ? png.codes() : std::nullopt;
}

std::unique_ptr<PngEncoder> start_png(int width, int height, const ImageMetadata& metadata) {
  return std::make_unique<SpngEncoder>(width, height, metadata);
}

}  // namespace
}  // namespace lobelia

extern "C" __attribute__((visibility("default"))) const lobelia::PngTable lobelia_png_table;
const lobelia::PngTable lobelia_png_table = {lobelia::open_plain_png, lobelia::read_codes,
                                             lobelia::start_png};

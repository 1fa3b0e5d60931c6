// The only file that knows OpenImageIO; built as a module of its own, see image_io.hpp.
#include "base/pictures/image_io_module.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <optional>

#include "base/pictures/colour.hpp"
#include "base/pictures/icc_profile.hpp"
#include "base/pictures/orientation.hpp"
#include "base/pictures/picture.hpp"
#include "base/pictures/picture_file.hpp"
#include "base/pictures/picture_layers.hpp"
#include "base/pictures/picture_light.hpp"
#include "base/pictures/subsampled_exr.hpp"
#include "base/system/error.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace {

[[noreturn]] void unreadable(const std::filesystem::path& path, std::string_view why) {
  const std::vector<std::string> lines =
      split(why, "\n");  // the library writes one for each problem
  if (lines.empty()) unreadable_picture(path, "its values cannot be decoded");
  unreadable_picture(path, fmt::format("{}", fmt::join(lines, "; ")));
}

/// A file with more parts is a film, or its directory is damaged.
constexpr int kMaxParts = 1024;
constexpr int kMaxChannels = 1024;

/// With a format, its plug-in reads from memory. With --any-format each plug-in opens the file by itself.
std::shared_ptr<OIIO::ImageInput> open(const PictureBytes& file) {
  if (is_exr_that_claims_too_much(file.bytes))
    unreadable(file.path, "its header claims more than the file has");
  if (is_tiff_without_bits(file.bytes))
    unreadable(file.path,
               "it has no BitsPerSample: that is a TIFF of 1 bit, which is read wrongly; "
               "write it with the tag");
  OIIO::ImageSpec wishes;
  // Otherwise a PNG's colours are multiplied by alpha while they are still encoded.
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  if (file.format.empty()) {
    const std::string ending = file.path.extension().string();
    auto input = OIIO::ImageInput::create(ending.empty() ? "none" : ending.substr(1));
    OIIO::ImageSpec spec;
    if (!input || !input->open(file.reopen.string(), spec, wishes))
      input = OIIO::ImageInput::open(file.reopen.string(), &wishes);
    if (!input) unreadable(file.path, OIIO::geterror());
    return input;
  }
  const auto memory = std::make_shared<OIIO::Filesystem::IOMemReader>(
      const_cast<char*>(file.bytes.data()), file.bytes.size());
  auto created = OIIO::ImageInput::create(std::string(file.format));
  if (!created)
    throw Error(ExitCode::kInternal, "no reader for {}: {}", file.format, OIIO::geterror());
  // The memory must live as long as the input.
  const std::shared_ptr<OIIO::ImageInput> input(created.release(),
                                                [memory](OIIO::ImageInput* last) { delete last; });
  // Given with the wishes, because some plug-ins keep those and open the file again to go back to an earlier row.
  OIIO::Filesystem::IOProxy* proxy = memory.get();
  wishes.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  OIIO::ImageSpec spec;
  if (!input->open("memory", spec, wishes)) unreadable(file.path, input->geterror());
  return input;
}

int count_mip_levels(OIIO::ImageInput& input, int part) {
  constexpr int kMostLevels = 32;  // of a side of 2^31
  const std::string_view format = input.format_name();
  // Other formats have none, and some of their readers cannot go back.
  if (format != "openexr" && format != "tiff" && format != "dds") return 1;
  int levels = 1;
  while (levels < kMostLevels && input.seek_subimage(part, levels)) ++levels;
  return levels;
}

/// The texts of an attribute that is a list of them.
std::vector<std::string> texts(const OIIO::ImageSpec& spec, const char* name) {
  const OIIO::ParamValue* list = spec.find_attribute(name);
  if (!list || list->type().basetype != OIIO::TypeDesc::STRING) return {};
  std::vector<std::string> result;
  for (int i = 0; i < int(list->type().numelements()) * list->nvalues(); ++i)
    result.emplace_back(list->get_string_indexed(i));
  return result;
}

/// Afterwards `input` may be of no use: some readers fail for good once they are asked for a part that does not exist.
std::vector<PicturePart> parts_of(const PictureBytes& file, OIIO::ImageInput& input) {
  std::vector<PicturePart> parts;
  for (int i = 0; input.seek_subimage(i, 0); ++i) {
    if (i == kMaxParts) unreadable(file.path, fmt::format("it has more than {} parts", kMaxParts));
    const OIIO::ImageSpec spec = input.spec(i);
    if (spec.nchannels < 1 || spec.nchannels > kMaxChannels)
      unreadable(file.path,
                 fmt::format("it has {} channels; 1 to {} are read", spec.nchannels, kMaxChannels));
    PicturePart part{std::string(spec.get_string_attribute("oiio:subimagename")), {}};
    for (std::size_t c = 0; c < std::min(std::size_t(spec.nchannels), spec.channelnames.size());
         ++c)
      part.channels.push_back(spec.channelnames[c]);
    part.mip_levels = count_mip_levels(input, i);
    part.view = spec.get_string_attribute("view");
    part.views = texts(spec, "multiView");
    parts.push_back(std::move(part));
  }
  return parts;
}

PixelWindow data_window(const OIIO::ImageSpec& spec) {
  return {spec.x, spec.y, spec.width, spec.height};
}

/// In other formats than EXR a data window that leaves the display window is a position on a page. For a cube map
/// OpenImageIO gives the first of six faces.
PixelWindow display_window(const OIIO::ImageSpec& spec, std::string_view format) {
  const PixelWindow data = data_window(spec);
  const PixelWindow display{spec.full_x, spec.full_y, spec.full_width, spec.full_height};
  const std::string kind = spec.get_string_attribute("textureformat");
  if (kind.starts_with("CubeFace")) return data;
  return is_inside(data, display) || format == "openexr" ? display : data;
}

void check(const std::filesystem::path& path, const OIIO::ImageSpec& spec, std::string_view format,
           const std::string& part_name) {
  if (spec.deep)
    unreadable(path, fmt::format("{} is deep: a pixel has any number of samples; flatten it first "
                                 "(oiiotool DEEP.exr --flatten -o FLAT.exr)",
                                 part_name.empty() ? "it" : "its part '" + part_name + "'"));
  if (spec.depth > 1) unreadable(path, fmt::format("it is a volume, {} pictures deep", spec.depth));
  if (const std::string problem = windows_problem(data_window(spec), display_window(spec, format));
      !problem.empty())
    unreadable(path, problem);
  // In these formats the attributes below are any text in the file.
  if (format == "png" || format == "openexr") return;
  // OpenImageIO would convert such colours to RGB without their profile.
  for (const char* attribute : {"tiff:ColorSpace", "jpeg:ColorSpace", "oiio:ColorSpace"}) {
    const std::string space = spec.get_string_attribute(attribute);
    for (const char* other : {"CMYK", "YCbCrK", "color separated", "CIELAB", "ICCLAB", "ITULAB"})
      if (space == other)
        unreadable(path, fmt::format("its colours are {}; RGB and grey are read", space));
  }
}

/// A part of a file, opened for its values.
struct Reader {
  const std::filesystem::path& path;
  OIIO::ImageInput& input;
  int part;
  const OIIO::ImageSpec& spec;
  bool as_stored = false;
  int first_row = 0, rows = spec.height;

  /// Channels [first, first + count) into every `stride`-th float of `values`.
  void read(int first, int count, float* values, std::size_t stride) const {
    if (is_number(first)) {
      for (int c = 0; c < count; ++c) read_numbers(first + c, values + c, stride);
      return;
    }
    read_as(OIIO::TypeDesc::FLOAT, first, count, values, OIIO::stride_t(stride * sizeof(float)));
  }

 private:
  /// Whether it holds IDs, which OpenImageIO would divide by 4294967295: always in an EXR.
  bool is_number(int channel) const {
    const OIIO::TypeDesc type = spec.channelformat(channel);
    if (as_stored) return type == OIIO::TypeDesc::UINT32 || type == OIIO::TypeDesc::INT32;
    return type == OIIO::TypeDesc::UINT32 && std::string_view(input.format_name()) == "openexr";
  }
  void read_numbers(int channel, float* values, std::size_t stride) const {
    std::vector<std::uint32_t> numbers(std::size_t(spec.width) * rows);
    read_as(spec.channelformat(channel), channel, 1, numbers.data(), OIIO::AutoStride);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      values[i * stride] = as_stored ? std::bit_cast<float>(numbers[i]) : float(numbers[i]);
  }
  void read_as(OIIO::TypeDesc type, int first, int count, void* values,
               OIIO::stride_t stride) const {
    const int top = spec.y + first_row;
    const bool read = rows == spec.height
                          ? input.read_image(part, 0, first, first + count, type, values, stride)
                          : input.read_scanlines(part, 0, top, top + rows, 0, first, first + count,
                                                 type, values, stride);
    // Some readers succeed although a part of the file is missing.
    if (!read || input.has_error()) unreadable(path, input.geterror());
  }
};

Image read_channels(const Reader& reader, const std::vector<std::size_t>& where) {
  Image image(reader.spec.width, reader.rows);
  float* values = image.values().data();
  const bool in_order = where.size() == 3 && where[1] == where[0] + 1 && where[2] == where[0] + 2;
  if (in_order) {
    reader.read(int(where[0]), 3, values, 3);
    return image;
  }
  // With two channels, a vector, the third value stays 0.
  for (std::size_t c = 0; c < where.size(); ++c) reader.read(int(where[c]), 1, values + c, 3);
  if (where.size() == 1)
    for (std::size_t i = 0; i < image.values().size(); i += 3)
      values[i + 1] = values[i + 2] = values[i];
  return image;
}

void multiply_by_alpha(const Reader& reader, Image& image) {
  std::vector<float> alpha(image.pixel_count());
  reader.read(reader.spec.alpha_channel, 1, alpha.data(), 1);
  for (std::size_t i = 0; i < alpha.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) image.values()[3 * i + c] *= alpha[i];
}

/// Whether the file's colours are not multiplied by its alpha. PNG and EXR define it, whatever an attribute says.
bool is_unassociated(const OIIO::ImageSpec& spec, std::string_view format) {
  if (spec.alpha_channel < 0 || format == "openexr") return false;
  return format == "png" || spec.get_int_attribute("oiio:UnassociatedAlpha", 0) == 1;
}

/// With an ICC profile, which replaces the curve and the primaries.
struct ProfiledMeaning : ColourMeaning {
  std::optional<IccProfile> profile = {};
};

/// The bytes of the ICC profile, where the format has a field for it; else empty.
std::string_view icc_bytes(const PictureBytes& file, const OIIO::ImageSpec& spec,
                           std::string_view format) {
  if (format == "openexr") return {};
  if (const OIIO::ParamValue* profile = spec.find_attribute("ICCProfile");
      profile && profile->type().basetype == OIIO::TypeDesc::UINT8)
    return {static_cast<const char*>(profile->data()), std::size_t(profile->datasize())};
  if (format == "png" && png_colour(file.bytes).has_icc_profile)
    unreadable(file.path,
               "libpng refuses its ICC profile: it is damaged, or not for the picture's colours");
  return {};
}

/// A profile counts for integers, and for floats that it calls linear: other floats are light already. The chunk cICP of a
/// PNG precedes it.
void add_profile(const PictureBytes& file, const OIIO::ImageSpec& spec, std::string_view format,
                 const PictureLayer& layer, PictureSource& source, ProfiledMeaning& meaning) {
  if (!layer.is_colour || (format == "png" && png_colour(file.bytes).cicp)) return;
  const std::string_view bytes = icc_bytes(file, spec, format);
  if (bytes.empty()) return;
  IccProfile profile(file.path, bytes, layer.where.size() == 1);
  source.icc_profile =
      spec.get_string_attribute("ICCProfile:profile_description", "without a name");
  source.icc_is_srgb = profile.is_srgb();
  const bool is_light = spec.channelformat(int(layer.where[0])).is_floating_point();
  if (!profile.is_srgb() && (!is_light || profile.is_linear()))
    meaning.profile = std::move(profile);
}

ColourMeaning colour_meaning(const PictureBytes& file, const OIIO::ImageSpec& spec,
                             std::string_view format, OIIO::TypeDesc type) {
  if (format == "png") return png_meaning(file.path, png_colour(file.bytes));
  ColourMeaning meaning;
  if (format == "openexr") {
    if (type == OIIO::TypeDesc::UINT32) return meaning;
    const OIIO::TypeDesc eight(OIIO::TypeDesc::FLOAT, 8);
    std::array<float, 8> xy;
    if (spec.getattribute("chromaticities", eight, xy.data()))
      std::copy(xy.begin(), xy.end(), meaning.primaries.emplace().begin());
    return meaning;
  }
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  meaning.curve = transfer_curve(
      file.path.string(),
      {format, space, spec.get_float_attribute("oiio:Gamma", 1), type.is_floating_point()});
  return meaning;
}

/// Makes the picture's colours light.
void to_light(const std::filesystem::path& path, const ProfiledMeaning& meaning, Picture& picture) {
  if (!meaning.profile) return decode_colours(path, meaning, picture);
  meaning.profile->to_light(picture.image);
  picture.source.transfer = kByProfile;
}

double samples_of(const OIIO::ImageSpec& spec, const std::string& channel) {
  std::vector<std::pair<std::string, std::string>> texts;
  for (const OIIO::ParamValue& attribute : spec.extra_attribs)
    if (may_state_samples(attribute.name().string()))
      texts.emplace_back(attribute.name().string(), attribute.get_string());
  return samples_stated(texts, channel);
}

/// The Cryptomattes that the parts announce, with their manifests where the values are wanted as they are stored: keys
/// cryptomatte/ID/name and cryptomatte/ID/manifest.
void find_cryptomattes(OIIO::ImageInput& input, std::size_t parts, PictureSource& source) {
  constexpr std::string_view kBegin = "cryptomatte/", kName = "/name", kManifest = "/manifest";
  constexpr std::size_t kMost = 64, kLongestName = 1024, kLongestManifest = 8 << 20;
  std::map<std::string, std::array<std::string, 2>> found;  // by ID
  for (std::size_t part = 0; part < parts; ++part)
    for (const OIIO::ParamValue& attribute : input.spec(int(part)).extra_attribs) {
      const std::string key = attribute.name().string();
      const bool is_name = key.ends_with(kName);
      const std::size_t id_end = key.rfind('/');
      if (!key.starts_with(kBegin) || (!is_name && !key.ends_with(kManifest)) ||
          id_end <= kBegin.size() || attribute.type() != OIIO::TypeDesc::STRING)
        continue;
      const std::string id = key.substr(kBegin.size(), id_end - kBegin.size());
      std::string text = attribute.get_string();
      if (found.size() == kMost && !found.contains(id)) continue;
      if (text.size() <= (is_name ? kLongestName : kLongestManifest))
        found[id][is_name ? 0 : 1] = std::move(text);
    }
  for (auto& [id, texts] : found) {
    if (texts[0].empty() || std::ranges::count(source.cryptomattes, texts[0]) > 0) continue;
    source.cryptomattes.push_back(texts[0]);
    if (source.as_stored) source.manifests.push_back(std::move(texts[1]));
  }
}

PictureClaim claim_of(const OIIO::ImageSpec& spec, std::string_view format) {
  const PixelWindow display = display_window(spec, format);
  return {std::uint64_t(spec.width) * spec.height + std::uint64_t(display.width) * display.height,
          spec.image_bytes(true)};
}

Image read_colours(const Reader& reader, const PictureLayer& layer,
                   const ProfiledMeaning& meaning) {
  Image image = read_channels(reader, layer.where);
  if (layer.has_chroma) mix_luminance_chroma(reader.path, meaning.primaries, image);
  return image;
}

/// Whether the file's rows are those of the picture, and each needs no other.
bool has_plain_rows(const OIIO::ImageSpec& spec, const PictureSource& source) {
  return source.format == "openexr" && spec.tile_width == 0 && source.data == source.display;
}

void read_in_bands(const Reader& whole, const PictureLayer& layer, const ProfiledMeaning& meaning,
                   const PictureBytes& file, const PictureSource& source) {
  constexpr int kBlock = 32;  // rows that an EXR may pack together
  const int height = whole.spec.height, rows = rows_of_band(whole.spec.width, kBlock);
  for (int y = 0; y < height; y += rows) {
    Reader reader = whole;
    reader.first_row = y;
    reader.rows = std::min(rows, height - y);
    Picture band{read_colours(reader, layer, meaning), {}, source};
    to_light(file.path, meaning, band);
    file.on_rows(band, y);
  }
}

void undo_orientation(const PictureBytes& file, std::size_t part, Picture& picture) {
  const std::string& format = picture.source.format;
  const int stated = stated_orientation(file.bytes, format, part);
  turn_upright(picture,
               format == "tiff" ? orientation_left_by_libtiff(file.bytes, stated, part) : stated);
  picture.source.orientation = stated;
}

Picture read(const PictureBytes& file, const std::string& layer_name) {
  const std::filesystem::path& path = file.path;
  if (has_subsampled_channels(file.bytes)) return read_subsampled_exr(file, layer_name);
  auto input = open(file);
  const std::vector<PicturePart> parts = parts_of(file, *input);
  if (input->format_name() != std::string_view("openexr")) input = open(file);
  const PictureLayer layer = find_layer(path.string(), parts, layer_name);
  const int part = int(layer.part);
  const OIIO::ImageSpec spec = input->spec(part);
  const std::string format = input->format_name();
  if (is_cut_off(file.bytes, format)) unreadable(path, "it is cut off");
  if (format == "dpx" && is_dpx_in_columns(file.bytes))
    unreadable(path, "its lines are columns of the picture; write it in rows");
  if (format == "heif" && is_heif_of_hdr(file.bytes))
    unreadable(
        path,
        "it is a HEIF or AVIF with PQ or HLG, of which OpenImageIO gives 8 bits alone; convert "
        "it to a PNG of 16 bits with a cICP chunk");
  check(path, spec, format, parts[layer.part].name);
  if (file.on_header) file.on_header(claim_of(spec, format));

  Picture picture;
  PictureSource& source = picture.source;
  const OIIO::TypeDesc type = spec.channelformat(int(layer.where[0]));
  source = picture_source(format, parts, layer);
  source.value_type = type.c_str();
  source.samples = samples_of(spec, source.channels[0]);
  source.data = data_window(spec);
  source.display = display_window(spec, format);

  source.as_stored = file.as_stored;
  if (format == "openexr") find_cryptomattes(*input, parts.size(), source);

  ProfiledMeaning meaning;
  const bool is_decoded = layer.is_colour && !file.as_stored;
  if (is_decoded) meaning = {colour_meaning(file, spec, format, type)};
  if (is_decoded) add_profile(file, spec, format, layer, source, meaning);
  const Reader reader{path, *input, part, spec, file.as_stored};
  if (file.on_rows && has_plain_rows(spec, source)) {
    read_in_bands(reader, layer, meaning, file, source);
    return picture;
  }
  picture.image = read_colours(reader, layer, meaning);
  to_light(path, meaning, picture);
  source.has_gain_map =
      format == "jpeg" && layer_name.empty() && !file.as_stored && has_gain_map(file.bytes);
  source.multiplied_by_alpha = is_decoded && is_unassociated(spec, format);
  if (source.multiplied_by_alpha) multiply_by_alpha(reader, picture.image);
  place_on_display(picture);
  if (picture.overscan.pixel_count() == 0) undo_orientation(file, layer.part, picture);
  return picture;
}

std::vector<std::string> list_layers(const PictureBytes& file) {
  if (has_subsampled_channels(file.bytes)) return subsampled_exr_layers(file);
  return picture_layer_names(parts_of(file, *open(file)));
}

ColourTable table_of_colours(std::string_view name) {
  OIIO::ImageBuf ramp(OIIO::ImageSpec(kColourTableSize, 1, 1, OIIO::TypeDesc::FLOAT));
  for (int i = 0; i < kColourTableSize; ++i) {
    const float value = float(i) / (kColourTableSize - 1);
    ramp.setpixel(i, 0, &value, 1);
  }
  const OIIO::ImageBuf colours =
      OIIO::ImageBufAlgo::color_map(ramp, 0, OIIO::string_view(name.data(), name.size()));
  if (colours.has_error() || colours.nchannels() != 3)
    throw Error(ExitCode::kInternal, "colour map: {}", colours.geterror());
  // OpenImageIO's maps are linear light.
  Image linear(kColourTableSize, 1);
  for (int i = 0; i < kColourTableSize; ++i) colours.getpixel(i, 0, linear.pixel(i, 0).data(), 3);
  const DisplayImage shown = to_display(linear, 0);
  ColourTable table;
  for (std::size_t i = 0; i < table.size(); ++i)
    std::copy_n(shown.rgb.begin() + std::ptrdiff_t(3 * i), 3, table[i].begin());
  return table;
}

}  // namespace
}  // namespace lobelia

extern "C" __attribute__((visibility("default")))
const lobelia::ImageIoTable lobelia_image_io_table;
const lobelia::ImageIoTable lobelia_image_io_table = {
    lobelia::read, lobelia::list_layers, lobelia::table_of_colours,
    [] { OIIO::attribute("exr_threads", -1); }, [] { OIIO::ImageInput::create("openexr"); }};

#include "base/pictures/picture_light.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/words/text.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

/// To Rec. 709, for three channels.
void convert_primaries(const fs::path& path, const Chromaticities& from, Picture& picture) {
  if (are_equal(from, kRec709Chromaticities)) return;
  const auto matrix = to_rec709(from);
  if (!matrix)
    unreadable_picture(path,
                       fmt::format("its chromaticities {:g} are no red, green, blue and white",
                                   fmt::join(from, " ")));
  apply(*matrix, picture.image);
  picture.source.chromaticities.assign(from.begin(), from.end());
}

constexpr std::string_view kPbrtSamples = "samplesPerPixel";
/// "cycles.ViewLayer.samples", of the layer's first part.
constexpr std::string_view kCyclesBegin = "cycles.", kCyclesEnd = ".samples";

}  // namespace

ColourMeaning png_meaning(const fs::path& path, const PngColour& colour) {
  ColourMeaning meaning{transfer_curve(path.string(), colour)};
  if (colour.cicp) {
    if (colour.cicp->matrix != 0 || !colour.cicp->full_range)
      unreadable_picture(path, "its cICP chunk says no RGB of the full range");
    meaning.primaries = chromaticities_of_code_point(colour.cicp->primaries);
    if (!meaning.primaries)
      unreadable_picture(path,
                         fmt::format("its cICP chunk says colour primaries {}, which are not known",
                                     colour.cicp->primaries));
  } else if (!colour.has_icc_profile && !colour.is_srgb) {
    meaning.primaries = colour.chromaticities;
  }
  return meaning;
}

void mix_luminance_chroma(const fs::path& path, const std::optional<Chromaticities>& primaries,
                          Image& image) {
  const auto weights = luminance_weights(primaries.value_or(kRec709Chromaticities));
  constexpr double kLeastWeight = 1e-3;
  if (!(weights[1] >= kLeastWeight))
    unreadable_picture(path,
                       "green has no luminance by its chromaticities, so that luminance and "
                       "chroma (Y, RY, BY) are no colour");
  const std::span<float> values = image.values();
  for (std::size_t i = 0; i < values.size(); i += 3) {
    const double y = double(values[i]);
    const double red = (double(values[i + 1]) + 1) * y, blue = (double(values[i + 2]) + 1) * y;
    values[i] = float(red);
    values[i + 1] = float((y - weights[0] * red - weights[2] * blue) / weights[1]);
    values[i + 2] = float(blue);
  }
}

void decode_colours(const fs::path& path, const ColourMeaning& meaning, Picture& picture) {
  const bool is_grey = picture.source.channels.size() == 1;
  decode(meaning.curve, picture.image,
         luminance_weights(meaning.primaries.value_or(kRec709Chromaticities)));
  picture.source.transfer = meaning.curve.name;
  if (meaning.primaries && !is_grey) convert_primaries(path, *meaning.primaries, picture);
}

PictureSource picture_source(std::string_view format, std::span<const PicturePart> parts,
                             const PictureLayer& layer) {
  PictureSource source;
  source.format = format;
  source.layer = layer.name;
  for (const std::size_t c : layer.where) source.channels.push_back(parts[layer.part].channels[c]);
  source.alpha = layer.alpha;
  source.mip_levels = parts[layer.part].mip_levels;
  source.layers = picture_layer_names(parts);
  return source;
}

int rows_of_band(int width, int block) {
  constexpr int kBandPixels = 2 << 20;
  return std::max(block, kBandPixels / width / block * block);
}

bool may_state_samples(std::string_view name) {
  return name == kPbrtSamples || (name.starts_with(kCyclesBegin) && name.ends_with(kCyclesEnd) &&
                                  name.size() > kCyclesBegin.size() + kCyclesEnd.size());
}

double samples_stated(std::span<const std::pair<std::string, std::string>> attributes,
                      const std::string& channel) {
  double samples = 0, of_layer = 0;
  for (const auto& [name, text] : attributes) {
    if (name == kPbrtSamples) parse_number(text, samples);
    if (name == kPbrtSamples || !may_state_samples(name)) continue;
    const std::string layer =
        name.substr(kCyclesBegin.size(), name.size() - kCyclesBegin.size() - kCyclesEnd.size());
    double number = 0;
    if ((channel + ".").starts_with(layer + ".") && parse_number(text, number)) of_layer = number;
  }
  if (of_layer != 0) samples = of_layer;
  constexpr double kMostSamples = 1e12;
  return samples >= 1 && samples <= kMostSamples ? samples : 0;
}

}  // namespace lobelia

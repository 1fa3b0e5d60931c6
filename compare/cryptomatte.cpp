#include "compare/cryptomatte.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/pictures/contained_reader.hpp"
#include "base/records/manifest.hpp"
#include "base/words/text.hpp"
#include "compare/mask.hpp"
#include "compare/overscan.hpp"
#include "profile/require_same_size.hpp"

namespace lobelia {
namespace {

/// An object that covers less of a pixel may be missing there: coverage is rounded by half as much in half floats.
constexpr float kLeastCoverage = 1e-3f;

/// Whether both are names of one Cryptomatte, of which one may have a part's name before it.
bool is_same_cryptomatte(const std::string& one, const std::string& other) {
  return one == other || one.ends_with("." + other) || other.ends_with("." + one);
}

/// The rank that a layer of that name has; `is_alpha`: by the name of its alpha.
std::optional<int> rank_of_name(const std::string& layer, const PictureSource& source,
                                const CryptomatteRank& of, bool is_alpha) {
  std::string name = layer;
  if (is_alpha) {
    const std::size_t dot = name.rfind('.');
    if (dot == name.npos) return std::nullopt;
    const std::string channel = lower_case(name.substr(dot + 1));
    if (channel != "a" && channel != "alpha") return std::nullopt;
    name.resize(dot);
  }
  std::vector<std::string> announced = source.cryptomattes;
  announced.push_back(of.name);
  const auto rank = cryptomatte_rank(name, announced);
  if (!rank || !is_same_cryptomatte(rank->name, of.name)) return std::nullopt;
  return rank->rank;
}

struct Covering {
  std::uint32_t id;
  float share;
};

/// The objects in a pixel, by ascending identifier, each once.
void objects_in(const CoveredPixels& picture, std::size_t pixel, std::vector<Covering>& objects) {
  objects.clear();
  for (const CoveredPixels::Pair& pair : picture.pairs)
    if (pair.coverage[pixel] != 0) objects.push_back({pair.ids[pixel], pair.coverage[pixel]});
  std::ranges::sort(objects, {}, &Covering::id);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (kept > 0 && objects[kept - 1].id == objects[i].id)
      objects[kept - 1].share += objects[i].share;
    else
      objects[kept++] = objects[i];
  objects.resize(kept);
}

struct PixelDifference {
  bool differs = false;  ///< an object is in one alone
  float coverage = 0;    ///< largest difference
};

PixelDifference difference(std::span<const Covering> a, std::span<const Covering> b) {
  PixelDifference result;
  const auto add = [&](float in_a, float in_b, bool in_both) {
    result.differs = result.differs || (!in_both && std::abs(in_a - in_b) > kLeastCoverage);
    result.coverage = std::max(result.coverage, std::abs(in_a - in_b));
  };
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    if (j == b.size() || (i < a.size() && a[i].id < b[j].id)) {
      add(a[i++].share, 0, false);
    } else if (i == a.size() || b[j].id < a[i].id) {
      add(0, b[j++].share, false);
    } else {
      add(a[i].share, b[j].share, true);
      ++i;
      ++j;
    }
  }
  return result;
}

/// The object that covers most of a pixel.
std::uint32_t main_object(std::span<const Covering> objects) {
  return objects.empty() ? 0 : std::ranges::max_element(objects, {}, &Covering::share)->id;
}

std::string object_text(std::uint64_t id, const CoveredPixels& first, const CoveredPixels& other) {
  for (const CoveredPixels* picture : {&first, &other})
    if (const auto found = picture->names.find(std::uint32_t(id)); found != picture->names.end())
      return fmt::format("'{}'", printable(found->second));
  return id == 0 ? "nothing" : fmt::format("object {:08x}", id);
}

}  // namespace

std::optional<CryptomatteRank> cryptomatte_of(const PictureSource& a, const PictureSource& b,
                                              const ComparisonOptions& options) {
  constexpr std::size_t kChannels = 3;
  if (a.channels.size() != kChannels || b.channels.size() != kChannels ||
      type_of_layers(a, b, options) != LayerType::kIdentifier)
    return std::nullopt;
  const auto rank = cryptomatte_rank(b);
  return rank ? rank : cryptomatte_rank(a);
}

std::vector<std::string> cryptomatte_layers(const PictureSource& source,
                                            const CryptomatteRank& rank) {
  std::vector<std::string> layers{source.layer};
  if (!source.alpha.empty()) layers.push_back(source.alpha);
  for (const std::string& layer : source.layers)
    if (rank_of_name(layer, source, rank, false) || rank_of_name(layer, source, rank, true))
      layers.push_back(layer);
  return layers;
}

CoveredPixels read_cryptomatte(const std::filesystem::path& file, const PictureSource& source,
                               const CryptomatteRank& rank, const ComparisonOptions& options,
                               const std::optional<PixelWindow>& window) {
  const auto part_of = [&](Picture picture) {
    if (window) return all_data(picture, *window);
    return options.crop ? cut(std::move(picture.image), *options.crop) : std::move(picture.image);
  };
  std::map<int, std::string> layers{{rank.rank, source.layer}};
  for (const std::string& layer : source.layers)
    if (const auto one = rank_of_name(layer, source, rank, false)) layers.try_emplace(*one, layer);
  CoveredPixels result;
  Image first;
  for (const auto& [number, name] : layers) {
    Picture colours = read_stored_picture(file, name), alpha;
    if (!colours.source.alpha.empty()) alpha = read_stored_picture(file, colours.source.alpha);
    if (first.pixel_count() == 0) first = Image(colours.image.width(), colours.image.height());
    require_same_size(first, colours.image, file.string() + ", its first rank",
                      "layer " + printable(name));
    const PictureSource& read = colours.source;
    for (std::size_t i = 0; i < read.manifests.size() && result.names.empty(); ++i)
      if (is_same_cryptomatte(read.cryptomattes[i], rank.name))
        result.names = records::object_names(read.manifests[i]);
    const Image pairs = part_of(std::move(colours));
    const Image shares = alpha.image.pixel_count() > 0 ? part_of(std::move(alpha)) : Image();
    result.width = pairs.width();
    result.height = pairs.height();
    const bool has_second = shares.pixel_count() == pairs.pixel_count();
    for (const bool is_second : {false, true}) {
      if (is_second && !has_second) continue;
      CoveredPixels::Pair& pair = result.pairs.emplace_back();
      pair.ids.resize(pairs.pixel_count());
      pair.coverage.resize(pairs.pixel_count());
      for (std::size_t pixel = 0; pixel < pairs.pixel_count(); ++pixel) {
        const float* const rgb = &pairs.values()[3 * pixel];
        pair.ids[pixel] = std::bit_cast<std::uint32_t>(rgb[is_second ? 2 : 0]);
        pair.coverage[pixel] = is_second ? shares.values()[3 * pixel] : rgb[1];
      }
    }
  }
  return result;
}

Comparison compare_cryptomattes(const CoveredPixels& a, const CoveredPixels& b,
                                const ComparisonOptions& options) {
  Image in_a(a.width, a.height), in_b(b.width, b.height);
  require_same_size(in_a, in_b);
  const std::size_t count = in_a.pixel_count();
  LayerInput layer{
      .type = LayerType::kIdentifier, .differs = PixelFlags(count), .coverage = PixelValues(count)};
  ExchangedIdentifiers exchanged;
  std::vector<Covering> objects_a, objects_b;
  for (std::size_t pixel = 0; pixel < count; ++pixel) {
    if (!options.ignored.empty() && options.ignored[pixel] != 0) continue;
    objects_in(a, pixel, objects_a);
    objects_in(b, pixel, objects_b);
    const PixelDifference found = difference(objects_a, objects_b);
    layer.differs[pixel] = found.differs;
    layer.coverage[pixel] = found.coverage;
    const std::uint32_t main_a = main_object(objects_a), main_b = main_object(objects_b);
    if (found.differs && main_a != main_b) exchanged.add(main_a, main_b);
    // compare() counts and names them.
    for (const auto& [picture, image] : {std::pair(&a, &in_a), {&b, &in_b}})
      for (const CoveredPixels::Pair& pair : picture->pairs)
        if (!std::isfinite(pair.coverage[pixel])) image->values()[3 * pixel] = pair.coverage[pixel];
  }
  ComparisonOptions own = options_of_type(LayerType::kIdentifier, options, true);
  own.layer = &layer;
  Comparison comparison = compare(in_a, in_b, own);
  comparison.type = LayerType::kIdentifier;
  if (const auto most = exchanged.most())
    comparison.finding =
        exchange_text(object_text(most->in_a, a, b), object_text(most->in_b, b, a), most->pixels);
  return comparison;
}

}  // namespace lobelia

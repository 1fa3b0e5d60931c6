#include "compare/layer_sensitivity.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "base/pictures/colour.hpp"
#include "base/pictures/contained_reader.hpp"
#include "base/pictures/half.hpp"
#include "base/pictures/image_values.hpp"
#include "base/system/error.hpp"
#include "base/words/constants.hpp"
#include "compare/cryptomatte.hpp"

namespace lobelia {
namespace {

/// Compares copies of a layer's values with it.
class ChangedCopies {
 public:
  ChangedCopies(const Picture& layer, LayerType type, const ComparisonOptions& options)
      : layer_(layer), type_(type), options_(options) {}

  void add(std::string name, Expected expected, const std::function<void(Image&)>& change) {
    Image a = layer_.image, b = layer_.image;
    change(a);
    changes.push_back(
        change_of(std::move(name), expected,
                  compare_values(a, b, layer_.source, layer_.source, type_, options_)));
  }
  void add_each(std::string name, Expected expected, const std::function<float(float)>& change) {
    add(std::move(name), expected, [&](Image& image) {
      for (float& value : image.values()) value = change(value);
    });
  }
  void add_half_floats() {
    const std::span<const float> values = layer_.image.values();
    // A layer that the format cannot hold is not rounded by it but spoilt.
    if (std::ranges::all_of(values, [](float v) {
          return v == 0 || !std::isfinite(v) ||
                 (std::abs(v) >= kLeastNormalHalf && std::abs(v) <= kGreatestHalf);
        }))
      add_each("rounded to half floats", Expected::kNotFound,
               [](float v) { return std::isfinite(v) ? float(rounded_to_half(double(v))) : v; });
  }
  const Image& image() const { return layer_.image; }

  std::vector<Change> changes;

 private:
  const Picture& layer_;
  LayerType type_;
  const ComparisonOptions& options_;
};

[[noreturn]] void nothing_to_change(const std::string& file, const char* what) {
  throw Error(ExitCode::kInput, file + ": for --sensitivity its layer needs " + what);
}

void change_alpha(ChangedCopies& copies) {
  const auto [least, most] = std::ranges::minmax(copies.image().values());
  constexpr float kSeen = 0.05f;
  copies.add_each("opaque", least < 1 - kSeen ? Expected::kFound : Expected::kEither,
                  [](float) { return 1.0f; });
  copies.add_each("transparent", most > kSeen ? Expected::kFound : Expected::kEither,
                  [](float) { return 0.0f; });
  copies.add_each("2 % lower", most > 0 ? Expected::kFound : Expected::kEither,
                  [](float v) { return v * 0.98f; });
  if (most <= 1 && least >= 0)
    copies.add_each("rounded to 8 bits", Expected::kNotFound,
                    [](float v) { return std::round(v * 255) / 255; });
  copies.add_half_floats();
}

void change_depth(ChangedCopies& copies, const std::string& file) {
  const std::span<const float> values = copies.image().values();
  const auto is_surface = [](float v) { return std::abs(v) < kBackgroundDepth; };
  const auto first = std::ranges::find_if(values, is_surface);
  if (first == values.end()) nothing_to_change(file, "a surface");
  const auto pixel = std::size_t(first - values.begin()) / 3;
  const auto any_depth =
      std::ranges::any_of(values, [&](float v) { return is_surface(v) && v != 0; });
  const Expected if_any = any_depth ? Expected::kFound : Expected::kEither;
  copies.add("without its surfaces", Expected::kFound,
             [](Image& image) { std::ranges::fill(image.values(), float(kInfinity)); });
  copies.add("without the surface in one pixel", Expected::kFound, [&](Image& image) {
    std::ranges::fill(image.values().subspan(3 * pixel, 3), float(kInfinity));
  });
  const auto nearer = [&](double by) {
    return [=](float v) { return is_surface(v) ? float(double(v) * (1 - by)) : v; };
  };
  copies.add_each("0.1 % nearer", Expected::kEither, nearer(0.001));
  copies.add_each("2 % nearer", if_any, nearer(0.02));
  copies.add_each("rounded in the seventh digit", Expected::kNotFound, nearer(1e-7));
  copies.add_half_floats();
  copies.add_each("background written as infinity", Expected::kNotFound, [&](float v) {
    return is_surface(v) || std::isnan(v) ? v : std::copysign(float(kInfinity), v);
  });
}

/// Turned about (1, 1, 1), or in its plane if there are two components.
void turn(std::span<float> v, double degrees, bool in_plane) {
  const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  const double x = v[0], y = v[1], z = v[2];
  if (in_plane) {
    v[0] = float(c * x - s * y);
    v[1] = float(s * x + c * y);
    return;
  }
  const double along = (x + y + z) / 3 * (1 - c), t = s / std::sqrt(3.0);
  v[0] = float(c * x + t * (z - y) + along);
  v[1] = float(c * y + t * (x - z) + along);
  v[2] = float(c * z + t * (y - x) + along);
}

void change_vectors(ChangedCopies& copies, bool in_plane, const std::string& file) {
  const Image& image = copies.image();
  std::size_t longest = 0;
  double length = 0;
  for (std::size_t i = 0; i < image.values().size(); i += 3) {
    const float* const v = &image.values()[i];
    // The part that turning about (1, 1, 1) moves.
    const double mean = in_plane ? 0 : (double(v[0]) + v[1] + v[2]) / 3;
    const double one = std::hypot(v[0] - mean, v[1] - mean, in_plane ? 0 : v[2] - mean);
    if (!(one > length)) continue;
    length = one;
    longest = i;
  }
  if (!(length > 0) || !std::isfinite(length)) nothing_to_change(file, "a vector");
  const auto turn_all = [&](double degrees) {
    return [=](Image& turned) {
      for (std::size_t i = 0; i < turned.values().size(); i += 3)
        turn(turned.values().subspan(i, 3), degrees, in_plane);
    };
  };
  copies.add("turned by 1 degree", Expected::kEither, turn_all(1));
  copies.add("turned by 5 degrees", Expected::kFound, turn_all(5));
  copies.add("one vector turned by 5 degrees", Expected::kFound,
             [&](Image& turned) { turn(turned.values().subspan(longest, 3), 5, in_plane); });
  copies.add_each("2 % longer", Expected::kFound, [](float v) { return v * 1.02f; });
  copies.add_each("opposite", Expected::kFound, [](float v) { return -v; });
  copies.add_each("rounded in the seventh digit", Expected::kNotFound,
                  [](float v) { return float(double(v) * (1 + 1e-7)); });
  copies.add_half_floats();
}

void change_identifiers(ChangedCopies& copies) {
  const auto bits = [](float v) { return std::bit_cast<std::uint32_t>(v); };
  const std::span<const float> values = copies.image().values();
  const std::uint32_t first = bits(values.front());
  copies.add("one bit in one pixel", Expected::kFound, [&](Image& image) {
    for (float& value : image.values().first(3)) value = std::bit_cast<float>(bits(value) ^ 1u);
  });
  const auto other = std::ranges::find_if(values, [&](float v) { return bits(v) != first; });
  if (other != values.end())
    copies.add_each("two identifiers exchanged", Expected::kFound,
                    [&, second = bits(*other)](float v) {
                      return bits(v) == first    ? std::bit_cast<float>(second)
                             : bits(v) == second ? std::bit_cast<float>(first)
                                                 : v;
                    });
  copies.add("the same", Expected::kNotFound, [](Image&) {});
}

std::vector<Change> change_cryptomatte(const CoveredPixels& objects,
                                       const ComparisonOptions& options, const std::string& file) {
  std::vector<Change> changes;
  const auto add = [&](std::string name, Expected expected, const auto& change) {
    CoveredPixels copy = objects;
    change(copy);
    changes.push_back(
        change_of(std::move(name), expected, compare_cryptomattes(copy, objects, options)));
  };
  constexpr float kSeen = 0.05f;
  std::set<std::uint32_t> ids;
  for (const CoveredPixels::Pair& pair : objects.pairs)
    for (std::size_t pixel = 0; pixel < pair.ids.size() && ids.size() < 2; ++pixel)
      if (pair.coverage[pixel] > kSeen) ids.insert(pair.ids[pixel]);
  if (ids.empty()) nothing_to_change(file, "an object");
  const std::uint32_t first = *ids.begin(), second = *ids.rbegin();
  const auto replace = [&](std::uint32_t one, std::uint32_t by, bool exchange) {
    return [=](CoveredPixels& copy) {
      for (CoveredPixels::Pair& pair : copy.pairs)
        for (std::uint32_t& id : pair.ids)
          if (id == one)
            id = by;
          else if (exchange && id == by)
            id = one;
    };
  };
  add("an object with another name", Expected::kFound, replace(first, ~first, false));
  if (ids.size() > 1) add("two objects exchanged", Expected::kFound, replace(first, second, true));
  const auto each_share = [](const std::function<float(float)>& change) {
    return [=](CoveredPixels& copy) {
      for (CoveredPixels::Pair& pair : copy.pairs)
        for (float& share : pair.coverage) share = change(share);
    };
  };
  add("coverage 10 % lower", Expected::kEither, each_share([](float v) { return v * 0.9f; }));
  add("coverage rounded to half floats", Expected::kNotFound,
      each_share([](float v) { return float(rounded_to_half(double(v))); }));
  add("objects of a pixel in another order", Expected::kNotFound,
      [](CoveredPixels& copy) { std::ranges::reverse(copy.pairs); });
  return changes;
}

}  // namespace

std::vector<Change> layer_sensitivity(const Picture& layer, const std::string& file,
                                      const ComparisonOptions& options) {
  const PictureSource& source = layer.source;
  const LayerType type = type_of_layers(source, source, options);
  if (type == LayerType::kColour)
    return sensitivity(layer.image, options_of_type(LayerType::kColour, options));
  if (const auto rank = cryptomatte_of(source, source, options))
    return change_cryptomatte(read_cryptomatte(file, source, *rank, options), options, file);
  Picture read = layer;
  if (type == LayerType::kIdentifier) {
    read = read_stored_picture(file, source.layer);
    Image same = read.image;
    take_part(read.image, same, options);
  } else if (type != LayerType::kDepth && !is_finite(layer.image)) {
    nothing_to_change(file, "finite values");
  }
  ChangedCopies copies(read, type, options);
  switch (type) {
    case LayerType::kAlpha:
      change_alpha(copies);
      break;
    case LayerType::kDepth:
      change_depth(copies, file);
      break;
    case LayerType::kVector:
      change_vectors(copies, source.channels.size() == 2, file);
      break;
    default:
      change_identifiers(copies);
  }
  return std::move(copies.changes);
}

}  // namespace lobelia

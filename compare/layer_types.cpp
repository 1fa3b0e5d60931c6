#include "compare/layer_types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/pictures/image_values.hpp"
#include "base/words/text.hpp"
#include "compare/highlight_region.hpp"
#include "compare/layers.hpp"
#include "compare/metrics/catalogue.hpp"
#include "profile/require_same_size.hpp"

namespace lobelia {
namespace {

bool is_measured_of(LayerType type, const Metric& metric, bool has_coverage) {
  if (metric.needs == Needs::kCoverage && !has_coverage) return false;
  if (metric.layer) return *metric.layer == type;
  if (type == LayerType::kColour) return true;
  const bool of_highlight = metric.region == Region::kHighlight ||
                            metric.needs == Needs::kHighlight || metric.needs == Needs::kHighlights;
  return type != LayerType::kIdentifier && metric.family == Family::kRadiance && !of_highlight;
}

bool is_background(float depth) { return std::abs(depth) >= kBackgroundDepth; }

/// As LayerInput::background.
PixelFlags find_background(const Image& a, const Image& b) {
  PixelFlags flags(a.pixel_count());
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    const float in_a = a.values()[i], in_b = b.values()[i];
    const bool far_a = is_background(in_a), far_b = is_background(in_b);
    if (!far_a && !far_b) continue;
    const bool is_same = far_a && far_b && std::signbit(in_a) == std::signbit(in_b);
    flags[i / 3] = std::max(flags[i / 3], std::uint8_t(is_same ? 1 : 2));
  }
  return flags;
}

void clear_background(Image& image) {
  for (float& value : image.values())
    if (is_background(value)) value = 0;
}

/// The same number for the same identifier. Of two types of values numbers are compared, else bits.
std::uint64_t identifier(float stored, const PictureSource& source, bool by_number) {
  const auto bits = std::bit_cast<std::uint32_t>(stored);
  if (!by_number) return bits;
  return std::bit_cast<std::uint64_t>(source.value_type == "uint" ? double(bits) : double(stored));
}

std::string identifier_text(std::uint64_t id, const PictureSource& source, bool by_number) {
  if (by_number) return fmt::format("{:.17g}", std::bit_cast<double>(id));
  if (source.value_type == "uint") return fmt::format("{}", id);
  return fmt::format("{:.9g}", std::bit_cast<float>(std::uint32_t(id)));
}

Comparison compare_identifiers(const Image& a, const Image& b, const PictureSource& source_a,
                               const PictureSource& source_b, ComparisonOptions options) {
  const bool by_number = source_a.value_type != source_b.value_type;
  LayerInput layer{.type = LayerType::kIdentifier, .differs = PixelFlags(a.pixel_count())};
  ExchangedIdentifiers exchanged;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    const std::uint64_t in_a = identifier(a.values()[i], source_a, by_number),
                        in_b = identifier(b.values()[i], source_b, by_number);
    if (in_a == in_b) continue;
    layer.differs[i / 3] = 1;
    if (i % 3 == 0) exchanged.add(in_a, in_b);
  }
  options.layer = &layer;
  const Image black(a.width(), a.height());
  Comparison comparison = compare(black, black, options);
  const auto most = exchanged.most();
  if (most && source_a.channels.size() == 1)
    comparison.finding =
        exchange_text(identifier_text(most->in_a, source_a, by_number),
                      identifier_text(most->in_b, source_b, by_number), most->pixels);
  return comparison;
}

/// The default limits of layers of the type; of colours none, see default_limits(). Those on the coverage of objects are for
/// Cryptomattes.
std::span<const MetricLimit> limits_of_type(LayerType type) {
  // Alpha is a share: the first is for single pixels, the second for all, and allows the rounding to 8 bits.
  static const std::array<MetricLimit, 2> alpha{{{"max_rel_peak", 0.01}, {"mae", 0.002}}};
  // Half floats are off by 0.05 % at most.
  static const std::array<MetricLimit, 3> depth{
      {{"depth.relative.p95", 0.001}, {"depth.relative.max", 0.01}, {"depth.background", 0}}};
  // Half floats turn a normal by 0.02 degrees at most.
  static const std::array<MetricLimit, 3> vector{
      {{"vector.angle.p95", 0.1}, {"vector.angle.max", 1}, {"vector.length.max", 0.01}}};
  // A number is the same or another. Half floats hold a share of a pixel within 0.05 %.
  static const std::array<MetricLimit, 2> identifier{
      {{"identifier.pixels", 0}, {"coverage.max", 0.01}}};
  switch (type) {
    case LayerType::kColour:
      break;
    case LayerType::kAlpha:
      return alpha;
    case LayerType::kDepth:
      return depth;
    case LayerType::kVector:
      return vector;
    case LayerType::kIdentifier:
      return identifier;
  }
  return {};
}

}  // namespace

LayerTypeChoice parse_layer_type(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  const auto type = equals == text.npos
                        ? std::nullopt
                        : find_id<LayerType>(records::kLayerTypes, text.substr(equals + 1));
  if (!type)
    throw Error(ExitCode::kUsage, "--layer-type {}: expected NAME=TYPE, where TYPE is one of {}",
                printable(text), join(records::kLayerTypes));
  return {text.substr(0, equals), *type};
}

LayerType type_of_layers(const PictureSource& a, const PictureSource& b,
                         const ComparisonOptions& options) {
  if (options.noise) return LayerType::kColour;
  for (auto choice = options.layer_types.rbegin(); choice != options.layer_types.rend(); ++choice)
    if (is_layer_called(a, choice->layer) || is_layer_called(b, choice->layer)) return choice->type;
  return layer_type(a) == LayerType::kIdentifier ? LayerType::kIdentifier : layer_type(b);
}

bool can_judge(LayerType type, std::string_view metric, bool has_coverage) {
  const Metric* found = find_metric(metric);
  return !found || is_measured_of(type, *found, has_coverage);
}

ComparisonOptions options_of_type(LayerType type, const ComparisonOptions& options,
                                  bool has_coverage) {
  ComparisonOptions own = options;
  const auto is_of_others = [&](const MetricLimit& limit) {
    return !can_judge(type, limit.metric, has_coverage);
  };
  std::erase_if(own.limits, is_of_others);
  std::erase_if(own.warnings, is_of_others);
  if (type == LayerType::kColour) return own;
  own.highlight = false;
  own.default_limits = false;
  own.viewing = Viewing{.pixels_per_degree = options.viewing.pixels_per_degree};
  if (type == LayerType::kIdentifier) own.tolerance.reset();
  if (options.default_limits || (own.limits.empty() && !own.tolerance)) {
    const std::vector<MetricLimit> given = own.limits;
    for (const MetricLimit& limit : limits_of_type(type))
      if (!is_of_others(limit) &&
          std::ranges::count(given, limit.metric, &MetricLimit::metric) == 0)
        own.limits.push_back(limit);
  }
  if (type == LayerType::kIdentifier || own.metrics.empty()) {
    const std::vector<std::string_view> names =
        type == LayerType::kIdentifier ? std::vector<std::string_view>{"identifier", "coverage"}
                                       : std::vector<std::string_view>{"radiance"};
    own.metrics.clear();
    for (const std::string_view name : names)
      for (const std::string_view region : {"", ".mask", ".outside"})
        own.metrics.push_back(fmt::format("{}{}", name, region));
  }
  return own;
}

Comparison compare_values(Image& a, Image& b, const PictureSource& source_a,
                          const PictureSource& source_b, LayerType type,
                          const ComparisonOptions& options) {
  require_same_size(a, b);
  ComparisonOptions own = options_of_type(type, options);
  Comparison comparison;
  if (type == LayerType::kIdentifier) {
    comparison = compare_identifiers(a, b, source_a, source_b, std::move(own));
    comparison.type = type;
    return comparison;
  }
  LayerInput layer{.type = type};
  if (type == LayerType::kDepth) layer.background = find_background(a, b);
  std::optional<std::int64_t> equal;
  if (type == LayerType::kDepth || allows_equal_nonfinite(options, source_b))
    equal = clear_equal_nonfinite(a, b);
  if (type == LayerType::kDepth) {
    clear_background(a);
    clear_background(b);
  }
  if (type == LayerType::kDepth || type == LayerType::kVector) {
    // For pictures of the report: no metric of the type looks at them as they are shown.
    const bool is_automatic = options.viewing.automatic && is_finite(a) && is_finite(b);
    own.viewing = is_automatic ? with_exposures(options.viewing, a, b) : options.viewing;
    own.viewing.automatic = false;
    own.viewing.tail_stops.reset();
    own.viewing.further_stops.clear();
  }
  if (type != LayerType::kColour) own.layer = &layer;
  comparison = compare(a, b, own);
  comparison.nonfinite.equal_allowed = equal;
  comparison.type = type;
  return comparison;
}

void ExchangedIdentifiers::add(std::uint64_t in_a, std::uint64_t in_b) {
  constexpr std::size_t kMost = 1 << 16;  // a hostile file has another pair in each pixel
  const std::pair pair(in_a, in_b);
  if (pixels_.size() < kMost || pixels_.contains(pair)) ++pixels_[pair];
}

std::optional<ExchangedIdentifiers::Most> ExchangedIdentifiers::most() const {
  const auto most =
      std::ranges::max_element(pixels_, {}, [](const auto& one) { return one.second; });
  if (most == pixels_.end()) return std::nullopt;
  return Most{most->first.first, most->first.second, most->second};
}

std::string exchange_text(const std::string& in_a, const std::string& in_b, std::int64_t pixels) {
  return fmt::format("a has {} where b has {}, in {} pixel{}", in_a, in_b, pixels,
                     pixels == 1 ? "" : "s");
}

}  // namespace lobelia

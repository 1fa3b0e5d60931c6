#include "compare/metrics/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "compare/highlight_region.hpp"

// One line per metric. A file of that name in this directory defines `const Metric <name>_metric`.
#define LOBELIA_METRICS(METRIC) \
  METRIC(highlight)             \
  METRIC(mae)                   \
  METRIC(mse)                   \
  METRIC(rmse)                  \
  METRIC(psnr)                  \
  METRIC(drift)                 \
  METRIC(relmse)                \
  METRIC(max_abs)               \
  METRIC(max_rel_peak)          \
  METRIC(ciede2000)             \
  METRIC(delta_e_itp)           \
  METRIC(ssim)                  \
  METRIC(ms_ssim)               \
  METRIC(flip_ldr)              \
  METRIC(flip_hdr)              \
  METRIC(outliers)              \
  METRIC(z)

namespace lobelia {

#define LOBELIA_DECLARE(name) extern const Metric name##_metric;
LOBELIA_METRICS(LOBELIA_DECLARE)
#undef LOBELIA_DECLARE

namespace {

std::string region_id(std::string_view first, std::string_view id, Region region) {
  const bool has_place =
      id.starts_with(first) && id.size() > first.size() && id[first.size()] == '.';
  const std::string_view figure = has_place ? first : id;
  return fmt::format("{}.{}{}", figure, region_name(region), id.substr(figure.size()));
}

/// The whole catalogue: the metrics of the highlight first, then those of the picture, of the mask and outside of it.
class Catalogue {
 public:
  Catalogue() {
#define LOBELIA_ADDRESS(name) &name##_metric,
    static constexpr const Metric* kMetrics[] = {LOBELIA_METRICS(LOBELIA_ADDRESS)};
#undef LOBELIA_ADDRESS
    const auto add_regions = [&](Region region) {
      for (const Metric* metric : kMetrics)
        if (metric->in_regions) add(*metric, region);
    };
    list_.push_back(kMetrics[0]);
    add_regions(Region::kHighlight);
    list_.insert(list_.end(), std::begin(kMetrics) + 1, std::end(kMetrics));
    add_regions(Region::kMask);
    add_regions(Region::kOutside);
  }
  std::span<const Metric* const> list() const { return list_; }

 private:
  void add(const Metric& whole, Region region) {
    constexpr std::string_view kWhere[] = {"", "in the highlight", "inside the mask",
                                           "outside the mask"};
    const std::string_view where = kWhere[std::size_t(region)];
    auto& outputs = outputs_.emplace_back(whole.outputs.begin(), whole.outputs.end());
    for (MetricOutput& output : outputs) {
      const auto keep = [&](std::string text) -> std::string_view {
        return texts_.emplace_back(std::move(text));
      };
      output.id = keep(region_id(whole.outputs.front().id, output.id, region));
      if (!output.title.empty()) output.title = keep(fmt::format("{}, {}", output.title, where));
      output.meaning = keep(fmt::format("{}, {}", output.meaning, where));
    }
    Metric& metric = metrics_.emplace_back(whole);
    metric.outputs = outputs;
    metric.region = region;
    list_.push_back(&metric);
  }

  std::deque<std::string> texts_;
  std::deque<std::vector<MetricOutput>> outputs_;
  std::deque<Metric> metrics_;
  std::vector<const Metric*> list_;
};

/// Whether the input's pixels hold at least one of the region.
bool has_pixels(Region region, const MetricInput& input) {
  const auto is_inside = [](auto inside) { return inside != 0; };
  switch (region) {
    case Region::kWhole:
      return true;
    case Region::kHighlight:
      return std::ranges::any_of(input.highlight, is_inside);
    case Region::kMask:
      return std::ranges::any_of(input.mask, is_inside);
    case Region::kOutside:
      return !std::ranges::all_of(input.mask, is_inside);
  }
  return false;
}

std::vector<std::uint8_t> pixels_of(const Metric& metric, const MetricInput& input) {
  if (metric.region == Region::kHighlight)
    return grown(input.highlight, input.a.width(), metric.footprint ? metric.footprint(input) : 0);
  std::vector<std::uint8_t> pixels(input.mask.begin(), input.mask.end());
  if (metric.region == Region::kOutside)
    for (std::uint8_t& pixel : pixels) pixel = pixel == 0;
  return pixels;
}

/// SSIM has no window whose middle is nearer to the border than half of one.
bool has_window(const Metric& metric, const MetricInput& input) {
  if (metric.region == Region::kWhole) return true;
  const std::vector<std::uint8_t> pixels = pixels_of(metric, input);
  constexpr int kMargin = kSsimSide / 2;
  const auto width = std::size_t(input.a.width());
  for (int y = kMargin; y < input.a.height() - kMargin; ++y) {
    const auto row = pixels.begin() + std::ptrdiff_t(std::size_t(y) * width);
    if (std::any_of(row + kMargin, row + std::ptrdiff_t(width) - kMargin,
                    [](auto inside) { return inside != 0; }))
      return true;
  }
  return false;
}

/// Worse of two values of an output that takes a limit; of a fact the first.
double worse(const MetricOutput& output, double one, double other) {
  if (output.better == Better::kNeither || std::isnan(one)) return one;
  if (output.better == Better::kHigher) return std::isnan(other) ? other : std::min(one, other);
  return std::isnan(other) || std::abs(other) > std::abs(one) ? other : one;
}

}  // namespace

std::span<const Metric* const> metrics() {
  static const Catalogue catalogue;
  return catalogue.list();
}

void measure_metric(const Metric& metric, const MetricInput& input, std::span<double> values) {
  MetricInput part = input;
  std::vector<std::uint8_t> pixels;
  if (metric.region != Region::kWhole) part.region = pixels = pixels_of(metric, input);
  metric.measure(part, values);
  const bool is_shown = metric.family != Family::kRadiance && metric.needs != Needs::kHdrExposures;
  if (!is_shown || !input.shown_tail) return;
  part.shown_a = input.shown_tail->a;
  part.shown_b = input.shown_tail->b;
  std::vector<double> tail(values.size());
  metric.measure(part, tail);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = worse(metric.outputs[i], values[i], tail[i]);
}

std::string id_in_region(const Metric& metric, const MetricOutput& output, Region region) {
  if (region == Region::kWhole) return std::string(output.id);
  return region_id(metric.outputs.front().id, output.id, region);
}

const Metric* find_metric(std::string_view id) {
  for (const Metric* metric : metrics())
    if (std::ranges::count(metric->outputs, id, &MetricOutput::id) > 0) return metric;
  return nullptr;
}

const MetricOutput* find_metric_output(std::string_view id) {
  const Metric* metric = find_metric(id);
  return metric ? &*std::ranges::find(metric->outputs, id, &MetricOutput::id) : nullptr;
}

bool is_measurable(const Metric& metric, const MetricInput& input) {
  const int side = std::min(input.a.width(), input.a.height());
  if (!has_pixels(metric.region, input)) return false;
  switch (metric.needs) {
    case Needs::kNothing:
      return true;
    case Needs::kTolerance:
      return input.tolerance != nullptr;
    case Needs::kHighlight:
      return has_pixels(Region::kHighlight, input);
    case Needs::kHdrExposures:
      return input.hdr_exposures != nullptr && input.hdr_exposures->problem.empty();
    case Needs::kOneWindow:
      return side >= kSsimSide && has_window(metric, input);
    case Needs::kFiveScales:
      return side >= kMsSsimSide;
    case Needs::kNoise:
      return input.noise != nullptr;
  }
  return false;
}

std::string why_not_measured(const Metric& metric, const MetricInput& input) {
  if (is_measurable(metric, input)) return "";
  const bool of_highlight =
      metric.region == Region::kHighlight || metric.needs == Needs::kHighlight;
  const bool by_mask = metric.region == Region::kMask || metric.region == Region::kOutside;
  if ((of_highlight && input.highlight.empty()) || (by_mask && input.mask.empty())) return "";
  if (of_highlight && !has_pixels(Region::kHighlight, input))
    return "no value is positive, so there is no highlight";
  if (!has_pixels(metric.region, input))
    return fmt::format("no pixel lies {} the mask",
                       metric.region == Region::kMask ? "inside" : "outside");
  if (metric.needs == Needs::kHdrExposures && input.hdr_exposures)
    return input.hdr_exposures->problem;
  const bool one_window = metric.needs == Needs::kOneWindow;
  if (!one_window && metric.needs != Needs::kFiveScales) return "";
  const int side = std::min(input.a.width(), input.a.height());
  if (one_window && side >= kSsimSide) return "no window lies around a pixel of the region";
  return fmt::format("it needs {} pixels a side, the pictures have {} x {}",
                     one_window ? kSsimSide : kMsSsimSide, input.a.width(), input.a.height());
}

bool is_within(const MetricOutput& output, double value, double limit) {
  switch (output.better) {
    case Better::kLower:
      return value <= limit;
    case Better::kNearZero:
      return std::abs(value) <= limit;
    case Better::kHigher:
      return value >= limit;
    case Better::kNeither:
      break;
  }
  return false;
}

std::vector<std::string_view> limit_names(bool with_regions) {
  std::vector<std::string_view> names;
  for (const Metric* metric : metrics()) {
    if (metric->region != Region::kWhole && !with_regions) continue;
    for (const MetricOutput& output : metric->outputs)
      if (output.better != Better::kNeither) names.push_back(output.id);
  }
  return names;
}

}  // namespace lobelia

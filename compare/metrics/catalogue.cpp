#include "compare/metrics/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>

#include "base/words/text.hpp"

// One line per metric. A file of that name in this directory defines `const Metric <name>_metric`; pixels_over.cpp
// defines those that end in _over.
#define LOBELIA_METRICS(METRIC) \
  METRIC(highlight)             \
  METRIC(highlights)            \
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
  METRIC(z)                     \
  METRIC(code)                  \
  METRIC(abs_over)              \
  METRIC(code_over)             \
  METRIC(yiq_over)              \
  METRIC(ciede2000_over)        \
  METRIC(delta_e_itp_over)      \
  METRIC(flip_ldr_over)         \
  METRIC(depth)                 \
  METRIC(vector)                \
  METRIC(identifier)            \
  METRIC(coverage)

namespace lobelia {

#define LOBELIA_DECLARE(name) extern const Metric name##_metric;
LOBELIA_METRICS(LOBELIA_DECLARE)
#undef LOBELIA_DECLARE

namespace {

/// The region of this name; kWhole if there is none.
Region region_of(std::string_view name) {
  for (const Region region : {Region::kHighlight, Region::kMask, Region::kOutside})
    if (region_name(region) == name) return region;
  return Region::kWhole;
}

std::string region_id(std::string_view first, std::string_view id, Region region) {
  const bool has_place =
      id.starts_with(first) && id.size() > first.size() && id[first.size()] == '.';
  const std::string_view figure = has_place ? first : id;
  return fmt::format("{}.{}{}", figure, region_name(region), id.substr(figure.size()));
}

/// The ending of an id that stands for any threshold.
constexpr std::string_view kAnyThreshold = "=0";

/// The whole catalogue: the metrics of the highlight first, then those of the picture, of the mask and outside of it.
class Catalogue {
 public:
  Catalogue() {
    list_.reserve(kMost);  // a span of it stays valid
#define LOBELIA_ADDRESS(name) &name##_metric,
    static constexpr const Metric* kMetrics[] = {LOBELIA_METRICS(LOBELIA_ADDRESS)};
#undef LOBELIA_ADDRESS
    const auto add_regions = [&](Region region) {
      for (const Metric* metric : kMetrics)
        if (metric->in_regions && !(metric->layer && region == Region::kHighlight))
          add(*metric, region);
    };
    list_.push_back(kMetrics[0]);
    add_regions(Region::kHighlight);
    list_.insert(list_.end(), std::begin(kMetrics) + 1, std::end(kMetrics));
    add_regions(Region::kMask);
    add_regions(Region::kOutside);
  }
  std::span<const Metric* const> list() const {
    const std::lock_guard lock(mutex_);
    return list_;
  }

  const Metric* find(std::string_view id) {
    const std::lock_guard lock(mutex_);
    if (const Metric* metric = find_in_list(id)) return metric;
    // "share_over.abs=0.004.mask": stem, threshold, region
    const std::size_t equals = id.find('=');
    if (equals == id.npos) return nullptr;
    const std::size_t dot = id.rfind('.');
    const bool in_region = dot > equals && region_of(id.substr(dot + 1)) != Region::kWhole;
    const std::size_t end = in_region ? dot : id.size();
    double threshold = 0;
    if (!parse_number(id.substr(equals + 1, end - equals - 1), threshold) || threshold < 0)
      return nullptr;
    const auto with = [&](std::string_view ending) {
      return fmt::format("{}{}{}", id.substr(0, equals), ending, id.substr(end));
    };
    const Metric* any = find_in_list(with(kAnyThreshold));
    if (!any || !any->on_request || threshold == 0) return any;
    const std::string ending = fmt::format("={}", threshold);
    if (const Metric* metric = find_in_list(with(ending))) return metric;
    return list_.size() == kMost ? nullptr : add_threshold(*any, threshold, ending);
  }

 private:
  static constexpr std::size_t kMost = 2048;

  const Metric* find_in_list(std::string_view id) const {
    for (const Metric* metric : list_)
      if (std::ranges::count(metric->outputs, id, &MetricOutput::id) > 0) return metric;
    return nullptr;
  }

  const Metric* add_threshold(const Metric& any, double threshold, const std::string& ending) {
    auto& outputs = outputs_.emplace_back(any.outputs.begin(), any.outputs.end());
    for (MetricOutput& output : outputs) {
      std::string id(output.id);
      id.replace(id.find(kAnyThreshold), kAnyThreshold.size(), ending);
      output.id = texts_.emplace_back(std::move(id));
    }
    Metric& metric = metrics_.emplace_back(any);
    metric.outputs = outputs;
    metric.threshold = threshold;
    return list_.emplace_back(&metric);
  }

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
  mutable std::mutex mutex_;
};

Catalogue& catalogue() {
  static Catalogue catalogue;
  return catalogue;
}

/// Whether the input's pixels hold at least one of the region.
bool has_pixels(Region region, const MetricInput& input) {
  const auto is_inside = [](auto inside) { return inside != 0; };
  // In pieces without a jump: the first pixel may be far into the picture.
  const auto any_inside = [](std::span<const std::uint8_t> pixels) {
    constexpr std::size_t kPiece = 4096;
    for (std::size_t i = 0; i < pixels.size(); i += kPiece) {
      unsigned any = 0;
      for (const std::uint8_t pixel : pixels.subspan(i, std::min(kPiece, pixels.size() - i)))
        any |= pixel;
      if (any != 0) return true;
    }
    return false;
  };
  switch (region) {
    case Region::kWhole:
      return true;
    case Region::kHighlight:
      return any_inside(input.highlight);
    case Region::kMask:
      return any_inside(input.mask);
    case Region::kOutside:
      return !std::ranges::all_of(input.mask, is_inside);
  }
  return false;
}

/// SSIM has no window whose middle is nearer to the border than half of one.
bool has_window(const Metric& metric, const MetricInput& input) {
  // A highlight is grown by half a window, so that a window's middle is in it wherever it lies.
  if (metric.region == Region::kWhole || metric.region == Region::kHighlight) return true;
  const bool inside = metric.region == Region::kMask;
  constexpr int kMargin = kSsimSide / 2;
  const auto width = std::size_t(input.a.width());
  for (int y = kMargin; y < input.a.height() - kMargin; ++y) {
    const auto row = input.mask.begin() + std::ptrdiff_t(std::size_t(y) * width);
    if (std::any_of(row + kMargin, row + std::ptrdiff_t(width) - kMargin,
                    [inside](auto pixel) { return (pixel != 0) == inside; }))
      return true;
  }
  return false;
}

}  // namespace

std::span<const Metric* const> metrics() { return catalogue().list(); }

std::string id_in_region(const Metric& metric, const MetricOutput& output, Region region) {
  if (region == Region::kWhole) return std::string(output.id);
  return region_id(metric.outputs.front().id, output.id, region);
}

const Metric* find_metric(std::string_view id) { return catalogue().find(id); }

const MetricOutput* find_metric_output(std::string_view id) {
  const Metric* metric = find_metric(id);
  if (!metric) return nullptr;
  const auto has = [&](auto is_it) { return std::ranges::find_if(metric->outputs, is_it); };
  const auto found = has([&](const MetricOutput& output) { return output.id == id; });
  if (found != metric->outputs.end()) return &*found;
  // Its threshold was not in the shortest form.
  return &*has([&](const MetricOutput& output) {
    return output.id.substr(0, output.id.find('=')) == id.substr(0, id.find('='));
  });
}

bool is_named(const Metric& metric, std::string_view name) {
  // The list has the thresholds of other comparisons, too.
  if (metric.threshold > 0) return find_metric(name) == &metric;
  if (name == "all") return true;
  if (metric.region != Region::kWhole && region_name(metric.region) == name)
    return !metric.on_request;
  if ((metric.needs == Needs::kHighlight || metric.needs == Needs::kHighlights) &&
      name == region_name(Region::kHighlight))
    return true;
  std::string_view stem = name;
  Region region = Region::kWhole;
  if (const std::size_t dot = name.rfind('.'); dot != name.npos)
    region = region_of(name.substr(dot + 1));
  if (region != Region::kWhole) stem = name.substr(0, name.rfind('.'));
  if (metric.region == region && stem == family_name(metric.family)) return !metric.on_request;
  return std::ranges::any_of(metric.outputs, [&](const MetricOutput& output) {
    if (output.id == name) return true;
    const bool begins = output.id.size() > stem.size() && output.id.starts_with(stem);
    return begins && metric.region == region &&
           (output.id[stem.size()] == '.' || output.id[stem.size()] == '=');
  });
}

bool is_measurable(const Metric& metric, const MetricInput& input) {
  const int side = std::min(input.a.width(), input.a.height());
  if (metric.layer && (!input.layer || input.layer->type != *metric.layer)) return false;
  if (!has_pixels(metric.region, input)) return false;
  switch (metric.needs) {
    case Needs::kNothing:
      return true;
    case Needs::kTolerance:
      return input.tolerance != nullptr;
    case Needs::kHighlight:
      return has_pixels(Region::kHighlight, input);
    case Needs::kHighlights:
      return !input.highlights.empty();
    case Needs::kHdrExposures:
      return input.hdr_exposures != nullptr && input.hdr_exposures->problem.empty();
    case Needs::kOneWindow:
      return side >= kSsimSide && has_window(metric, input);
    case Needs::kFiveScales:
      return side >= kMsSsimSide;
    case Needs::kNoise:
      return input.noise != nullptr;
    case Needs::kCoverage:
      return input.layer && !input.layer->coverage.empty();
  }
  return false;
}

namespace {

/// Why the metric cannot be measured although no option is missing; otherwise empty.
std::string obstacle(const Metric& metric, const MetricInput& input) {
  if (is_measurable(metric, input)) return "";
  const bool of_highlight = metric.region == Region::kHighlight ||
                            metric.needs == Needs::kHighlight || metric.needs == Needs::kHighlights;
  const bool by_mask = metric.region == Region::kMask || metric.region == Region::kOutside;
  if ((of_highlight && input.highlight.empty()) || (by_mask && input.mask.empty())) return "";
  if (of_highlight && !has_pixels(Region::kHighlight, input))
    return "no value is positive, so there is no highlight";
  if (metric.needs == Needs::kHighlights)
    return "nothing in the reference stands out from its surroundings";
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

}  // namespace

bool is_best_by_equality(const Metric& metric, const MetricInput& input) {
  // A mask without pixels is a mistake of whoever made it.
  const bool by_mask = metric.region == Region::kMask || metric.region == Region::kOutside;
  return input.equal && !(by_mask && !has_pixels(metric.region, input)) &&
         !obstacle(metric, input).empty();
}

std::string why_not_measured(const Metric& metric, const MetricInput& input) {
  return is_best_by_equality(metric, input) ? "" : obstacle(metric, input);
}

std::string limit_problem(const MetricOutput& output, double limit) {
  const auto& [least_value, most] = output.range;
  const double least = output.better == Better::kHigher ? least_value : 0;
  if (limit >= least && limit <= most && std::isfinite(limit)) return "";
  if (output.better == Better::kNearZero)
    return fmt::format("a limit on {} is on its size, a finite number of at least 0, not {}",
                       output.id, limit);
  const std::string_view kind = output.unit == Unit::kShare ? "share" : "number";
  const std::string range = std::isfinite(most)
                                ? fmt::format("a {} from {} to {}", kind, least, most)
                            : std::isfinite(least) ? fmt::format("a {} of at least {}", kind, least)
                                                   : fmt::format("a finite {}", kind);
  std::string problem = fmt::format("{} is {}, so {} is no limit on it", output.id, range, limit);
  constexpr double kPercent = 100;
  if (most == 1 && limit > most && limit <= kPercent)
    problem += fmt::format("; for {0:g} % write {1:g}", limit, limit / kPercent);
  return problem;
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

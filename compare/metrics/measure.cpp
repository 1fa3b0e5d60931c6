// Measures metrics of the same two pictures.
#include <algorithm>
#include <cmath>
#include <map>

#include "compare/highlight_region.hpp"
#include "compare/metrics/catalogue.hpp"
#include "compare/metrics/shared_work.hpp"

namespace lobelia {
namespace {

using Pixels = std::span<const std::uint8_t>;

/// The pixels of each metric's region, each made once.
class RegionPixels {
 public:
  explicit RegionPixels(const MetricInput& input) : input_(input) {}

  /// Empty for the whole picture. Valid as long as this.
  Pixels of(const Metric& metric) {
    if (metric.region == Region::kWhole) return {};
    if (metric.region == Region::kMask) return input_.mask;
    const bool of_highlight = metric.region == Region::kHighlight;
    const int radius = of_highlight && metric.footprint ? metric.footprint(input_) : 0;
    if (of_highlight && radius == 0) return input_.highlight;
    const auto [made, is_new] = made_.try_emplace({metric.region, radius});
    if (!is_new) return made->second;
    if (of_highlight) return made->second = grown(input_.highlight, input_.a.width(), radius);
    made->second.assign(input_.mask.begin(), input_.mask.end());
    for (std::uint8_t& pixel : made->second) pixel = pixel == 0;
    return made->second;
  }

 private:
  const MetricInput& input_;
  std::map<std::pair<Region, int>, PixelFlags> made_;
};

/// Worse of two values of an output that takes a limit; of a fact the first.
double worse(const MetricOutput& output, double one, double other) {
  if (output.better == Better::kNeither || std::isnan(one)) return one;
  if (output.better == Better::kHigher) return std::isnan(other) ? other : std::min(one, other);
  return std::isnan(other) || std::abs(other) > std::abs(one) ? other : one;
}

bool is_shown(const Metric& metric) {
  return metric.family != Family::kRadiance && metric.needs != Needs::kHdrExposures;
}

/// Measures metrics of one work at one exposure, and calls keep(i, values) for each.
template <class Keep>
void measure_work(std::span<const Metric* const> list, MetricInput input, RegionPixels& pixels,
                  Keep keep) {
  std::vector<Pixels> regions;
  for (const Metric* metric : list) {
    const Pixels region = pixels.of(*metric);
    if (std::ranges::count(regions, region.data(), &Pixels::data) == 0) regions.push_back(region);
  }
  SharedWork shared;
  input.regions = regions;
  input.shared = &shared;
  for (std::size_t i = 0; i < list.size(); ++i) {
    input.region = pixels.of(*list[i]);
    input.threshold = list[i]->threshold;
    std::vector<double> values(list[i]->outputs.size());
    list[i]->measure(input, values);
    keep(i, values);
  }
}

}  // namespace

std::vector<std::vector<double>> measure_metrics(std::span<const Metric* const> list,
                                                 const MetricInput& input) {
  std::vector<std::vector<double>> all(list.size());
  std::vector<bool> is_measured(list.size());
  for (std::size_t first = 0; first < list.size(); ++first) {
    if (is_measured[first]) continue;
    MetricList of_work;
    std::vector<std::size_t> places;
    for (std::size_t i = first; i < list.size(); ++i) {
      const bool is_same = !list[i]->work.empty() && list[i]->work == list[first]->work;
      if (i != first && !is_same) continue;
      of_work.push_back(list[i]);
      places.push_back(i);
      is_measured[i] = true;
    }
    RegionPixels pixels(input);
    measure_work(of_work, input, pixels, [&](std::size_t i, const std::vector<double>& values) {
      all[places[i]] = values;
    });
    // Metrics of one work are all shown, or none is.
    if (!is_shown(*list[first])) continue;
    for (const ShownPair& shown : input.shown_further) {
      MetricInput further = input;
      further.shown_a = shown.a;
      further.shown_b = shown.b;
      measure_work(of_work, further, pixels, [&](std::size_t i, const std::vector<double>& values) {
        std::vector<double>& worst = all[places[i]];
        for (std::size_t k = 0; k < values.size(); ++k)
          worst[k] = worse(of_work[i]->outputs[k], worst[k], values[k]);
      });
    }
  }
  return all;
}

void measure_metric(const Metric& metric, const MetricInput& input, std::span<double> values) {
  const Metric* const one = &metric;
  std::ranges::copy(measure_metrics({&one, 1}, input)[0], values.begin());
}

}  // namespace lobelia

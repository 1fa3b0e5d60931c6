#include "compare/uncertainty/error_bars.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <map>

#include "base/words/constants.hpp"
#include "compare/highlight_region.hpp"
#include "compare/metrics/catalogue.hpp"
#include "profile/critical.hpp"

namespace lobelia {
namespace {

/// Running mean and spread (Welford 1962).
class Spread {
 public:
  void add(double value) {
    ++count_;
    // Without noise a value may be infinite, and the same each time.
    all_equal_ = all_equal_ && (count_ == 1 || value == first_);
    if (count_ == 1) first_ = value;
    const double step = value - mean_;
    mean_ += step / count_;
    squares_ += step * (value - mean_);
  }
  double mean() const { return all_equal_ ? first_ : mean_; }
  double deviation() const { return all_equal_ ? 0 : std::sqrt(squares_ / (count_ - 1)); }

 private:
  int count_ = 0;
  bool all_equal_ = true;
  double first_ = 0, mean_ = 0, squares_ = 0;
};

struct Spreads {
  Spread value;             ///< of noisier pictures, as in the record
  Spread noisier, nothing;  ///< distances of noisier pictures, and of noise alone
};

/// The reliability of a region's noise, estimated from the noise itself.
struct RegionNoise {
  double freedom = kInfinity;    ///< Satterthwaite's, of the sum over its pixels
  double floor_uncertainty = 0;  ///< variance of a noise floor, in units of the figure's
};

struct Figure {
  const Metric* metric;
  const MetricOutput* output;
  double distance;               ///< of the pictures without additional noise
  std::vector<Spreads> spreads;  ///< by what_may_err_together()
};

template <class Visit>
void measure_each(std::span<const Metric* const> list, const MetricInput& input, Visit visit) {
  MetricList measurable;
  std::ranges::copy_if(list, std::back_inserter(measurable), [&](const Metric* metric) {
    return metric->needs != Needs::kNoise && is_measurable(*metric, input);
  });
  const auto values = measure_metrics(measurable, input);
  for (std::size_t m = 0; m < values.size(); ++m)
    for (std::size_t i = 0; i < values[m].size(); ++i)
      if (const MetricOutput& output = measurable[m]->outputs[i]; output.better != Better::kNeither)
        visit(*measurable[m], output, values[m][i]);
}

bool is_in_region(Region region, const MetricInput& input, std::size_t pixel) {
  switch (region) {
    case Region::kHighlight:
      return input.highlight[pixel] != 0;
    case Region::kMask:
      return input.mask[pixel] != 0;
    case Region::kOutside:
      return input.mask[pixel] == 0;
    case Region::kWhole:
      break;
  }
  return true;
}

/// The square of an estimated variance is on average too large by the factor 1 + 2 / freedom.
RegionNoise noise_in(Region region, const MetricInput& input) {
  RegionNoise result;
  double all = 0, squares = 0, floor = 0;
  for (const PictureNoise* one : {input.noise->a, input.noise->b}) {
    if (!one) continue;
    double sum = 0;
    for (std::size_t pixel = 0; pixel < input.a.pixel_count(); ++pixel) {
      if (!is_in_region(region, input, pixel)) continue;
      double variance = 0;
      for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) variance += one->own_variance(i);
      sum += variance;
      squares += variance * variance / (one->freedom + 2);
    }
    all += sum;
    floor += sum * sum / one->freedom;
    if (one->shared && sum > 0) result.freedom = std::min(result.freedom, one->freedom);
  }
  if (!(all > 0)) return result;
  result.freedom = std::min(result.freedom, std::max(1.0, all * all / squares));
  result.floor_uncertainty = floor / (all * all);
  return result;
}

/// The largest of |a - b| over the values of a region, and what is surely left of it without noise: each value's chance to
/// be further off is such that together they have `beyond`.
std::pair<double, double> largest_without_noise(Region region, const MetricInput& input,
                                                double beyond) {
  double count = 0, largest = 0, left = 0;
  for (std::size_t pixel = 0; pixel < input.a.pixel_count(); ++pixel)
    count += 3 * is_in_region(region, input, pixel);
  const CriticalT critical(sidak(beyond, std::max(1.0, count)));
  const std::span<const float> a = input.a.values(), b = input.b.values();
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!is_in_region(region, input, i / 3)) continue;
    const double apart = std::abs(double(a[i]) - double(b[i]));
    largest = std::max(largest, apart);
    if (apart <= left) continue;
    const ValueError error = error_of_difference(*input.noise, i);
    const double noise = error.size > 0 ? critical(error.freedom) * error.size : 0;
    left = std::max(left, apart - noise);
  }
  return {largest, left};
}

}  // namespace

struct NoisyFigures::Figures {
  explicit Figures(const MetricInput& measured) : input(measured) {}

  /// The bound of other draws that so many exceed, in deviations from the mean.
  double factor(const RegionNoise& noise, double beyond, bool of_floor) const {
    const double freedom = 1 / (1 / noise.freedom + 1.0 / (count - 1));
    return boost::math::quantile(
               boost::math::complement(boost::math::students_t(freedom), beyond)) *
           std::sqrt(1 + 1.0 / count + (of_floor ? noise.floor_uncertainty : 0));
  }

  ErrorBar bar_of(const Figure& figure, double near, double far) const {
    const MetricOutput& output = *figure.output;
    const RegionNoise& noise = regions.at(figure.metric->region);
    const auto worst = [&](auto number) {
      double result = number(figure.spreads.front());
      // A figure that a draw does not have is not known.
      for (const Spreads& spreads : figure.spreads)
        if (const double one = number(spreads); !(one <= result)) result = one;
      return result;
    };
    ErrorBar bar;
    bar.standard_error = worst([](const Spreads& s) { return s.value.deviation(); });
    const double floor = worst([](const Spreads& s) { return s.nothing.mean(); });
    bar.noise_floor = from_distance(output, floor);
    const auto floor_most = [&](double beyond) {
      const double times = factor(noise, beyond, true);
      return worst(
          [&](const Spreads& s) { return s.nothing.mean() + times * s.nothing.deviation(); });
    };
    bar.noise_floor_most = from_distance(output, floor_most(kBeyondOneEnd));
    double low = figure.distance, high = figure.distance;
    if (output.better == Better::kNearZero && std::isfinite(figure.distance)) {
      const double spread = worst(
          [](const Spreads& s) { return std::max(s.noisier.deviation(), s.nothing.deviation()); });
      const double unbiased = figure.distance - floor;
      const bool above = unbiased >= 0;
      low = unbiased - factor(noise, above ? near : far, false) * spread;
      high = unbiased + factor(noise, above ? far : near, false) * spread;
    } else if (std::isfinite(figure.distance)) {
      high +=
          factor(noise, far, false) * worst([](const Spreads& s) { return s.noisier.deviation(); });
      low = has_heavy_tails ? 0 : std::max(0.0, low - floor_most(near) - kFloorBias * floor);
      if (output.is_largest_difference) {
        const auto [largest, left] = largest_without_noise(figure.metric->region, input, near);
        low = largest > 0 ? std::max(0.0, left / largest) * figure.distance : 0;
      }
    }
    const double ends[] = {from_distance(output, low), from_distance(output, high)};
    bar.low = std::min(ends[0], ends[1]);
    bar.high = std::max(ends[0], ends[1]);
    return bar;
  }

  MetricInput input;
  std::vector<Figure> list;
  std::map<Region, RegionNoise> regions;
  int count = 0;
  bool has_heavy_tails = false;
};

NoisyFigures::NoisyFigures(std::span<const Metric* const> list, const MetricInput& input,
                           const Viewing& viewing, const DrawOptions& options)
    : figures_(std::make_unique<Figures>(input)) {
  const NoiseOfPair& noise = *input.noise;
  const std::vector<Together> possibilities = what_may_err_together(noise);
  std::map<std::string_view, std::size_t> places;
  std::vector<Figure>& figures = figures_->list;
  figures_->count = options.count;
  for (const PictureNoise* one : {noise.a, noise.b})
    figures_->has_heavy_tails = figures_->has_heavy_tails || (one && one->has_heavy_tails());
  measure_each(list, input, [&](const Metric& metric, const MetricOutput& output, double value) {
    places[output.id] = figures.size();
    figures.push_back(
        {&metric, &output, as_distance(output, value), std::vector<Spreads>(possibilities.size())});
    if (!figures_->regions.contains(metric.region))
      figures_->regions[metric.region] = noise_in(metric.region, input);
  });
  const auto measure_noisy = [&](const Image& a, const Image& b, std::uint64_t stream,
                                 Together together, auto keep) {
    const Image noisy_a = with_noise(a, noise.a, mix(options.seed) + 2 * stream, together);
    const Image noisy_b = with_noise(b, noise.b, mix(options.seed) + 2 * stream + 1, together);
    // The noise also chooses the pixels of the highlight.
    const PixelFlags highlight = input.highlight.empty()
                                     ? PixelFlags()
                                     : highlight_region(noisy_a, noisy_b, options.surfaces);
    const std::vector<JudgedHighlight> highlights = judge_again(noisy_a, noisy_b, input.highlights);
    MetricInput noisy{noisy_a,
                      noisy_b,
                      as_shown(noisy_a, viewing),
                      as_shown(noisy_b, viewing),
                      input.pixels_per_degree,
                      input.tolerance,
                      input.hdr_exposures,
                      input.mask,
                      nullptr,
                      highlight,
                      highlights,
                      further_as_shown(noisy_a, noisy_b, viewing)};
    std::vector<std::pair<double, double>> found(figures.size(), {kNaN, kNaN});
    measure_each(list, noisy, [&](const Metric&, const MetricOutput& output, double value) {
      if (const auto place = places.find(output.id); place != places.end())
        found[place->second] = {value, as_distance(output, value)};
    });
    for (std::size_t i = 0; i < figures.size(); ++i)
      keep(figures[i], found[i].first, found[i].second);
  };
  const Image expected = common_expectation(input.a, input.b, noise);
  for (std::size_t p = 0; p < possibilities.size(); ++p)
    for (int k = 0; k < options.count; ++k) {
      const auto stream = 2 * (p * std::size_t(options.count) + std::size_t(k));
      measure_noisy(input.a, input.b, stream, possibilities[p],
                    [&](Figure& figure, double value, double distance) {
                      figure.spreads[p].value.add(value);
                      figure.spreads[p].noisier.add(distance);
                    });
      measure_noisy(expected, expected, stream + 1, possibilities[p],
                    [&](Figure& figure, double, double distance) {
                      figure.spreads[p].nothing.add(distance);
                    });
    }
}

NoisyFigures::~NoisyFigures() = default;

ErrorBars NoisyFigures::bars() const {
  ErrorBars bars;
  for (const Figure& figure : figures_->list)
    bars.emplace_back(figure.output->id, figures_->bar_of(figure, kBeyondOneEnd, kBeyondOneEnd));
  return bars;
}

ErrorBars NoisyFigures::bars_of_limits(double significance) const {
  ErrorBars bars;
  for (const Figure& figure : figures_->list) {
    const double sides = figure.output->better == Better::kNearZero ? 2 : 1;
    bars.emplace_back(figure.output->id,
                      figures_->bar_of(figure, significance / sides, kBeyondOneEnd));
  }
  return bars;
}

double as_distance(const MetricOutput& output, double value) {
  if (std::isinf(output.best)) return std::pow(10, -value / 20);
  if (output.better == Better::kNearZero) return value;
  const double apart = std::abs(value - output.best);
  return output.square ? std::sqrt(apart) : apart;
}

double from_distance(const MetricOutput& output, double distance) {
  if (std::isinf(output.best)) return -20 * std::log10(distance);
  if (output.better == Better::kNearZero) return distance;
  const double apart = output.square ? distance * distance : distance;
  return output.better == Better::kHigher ? output.best - apart : output.best + apart;
}

}  // namespace lobelia

#include "compare/uncertainty/error_bars.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/students_t.hpp>

#include "compare/metrics/catalogue.hpp"
#include "compare/uncertainty/z_test.hpp"

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

struct Figure {
  const MetricOutput* output;
  double distance;  ///< of the pictures without additional noise
  struct Spreads {
    Spread value;             ///< of noisier pictures, as in the record
    Spread noisier, nothing;  ///< distances of noisier pictures, and of noise alone
  };
  std::array<Spreads, 2>
      spreads;  ///< if values err independently, and if all values of a picture err together
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
        visit(output, values[m][i]);
}

/// With `together`, all values of a picture with shared noise get the same multiple of their errors.
Image with_noise(const Image& image, const PictureNoise* noise, std::uint64_t stream,
                 bool together) {
  Image result = image;
  if (!noise) return result;
  constexpr std::size_t kValuesPerTask = 1 << 14;
  const double one = gaussian(stream, ~std::uint64_t{0});
  together = together && noise->shared;
  oneapi::tbb::parallel_for(
      oneapi::tbb::blocked_range<std::size_t>(0, result.values().size(), kValuesPerTask),
      [&](const oneapi::tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const double error = noise->standard_error.values()[i];
          if (error > 0)
            result.values()[i] += float(error * (together ? one : gaussian(stream, i)));
        }
      });
  return result;
}

/// The bound of 97.5 % of other draws, in deviations from the mean.
double draw_factor(const NoiseOfPair& noise, int count) {
  double freedom = count - 1;
  for (const PictureNoise* one : {noise.a, noise.b})
    if (one && one->shared) freedom = std::min(freedom, one->freedom);
  return boost::math::quantile(boost::math::students_t(freedom), 0.975) *
         std::sqrt(1 + 1.0 / count);
}

/// How pixels err together is not known: the worse of the two spreads counts.
ErrorBar bar_of(const Figure& figure, double factor) {
  const MetricOutput& output = *figure.output;
  const auto worse = [&](auto number) {
    return std::max(number(figure.spreads[0]), number(figure.spreads[1]));
  };
  using Spreads = Figure::Spreads;
  ErrorBar bar;
  bar.standard_error = worse([](const Spreads& s) { return s.value.deviation(); });
  bar.noise_floor = from_distance(output, worse([](const Spreads& s) { return s.nothing.mean(); }));
  const double spread = factor * worse([](const Spreads& s) { return s.noisier.deviation(); });
  const double floor =
      worse([&](const Spreads& s) { return s.nothing.mean() + factor * s.nothing.deviation(); });
  bar.noise_floor_most = from_distance(output, floor);
  double near = figure.distance, far = figure.distance;
  if (std::isfinite(figure.distance)) {
    far += spread;
    near = output.better == Better::kNearZero ? near - spread : std::max(0.0, near - floor);
  }
  const double ends[] = {from_distance(output, near), from_distance(output, far)};
  bar.low = std::min(ends[0], ends[1]);
  bar.high = std::max(ends[0], ends[1]);
  return bar;
}

}  // namespace

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

ErrorBars error_bars(std::span<const Metric* const> list, const MetricInput& input,
                     const Viewing& viewing, int count, std::uint64_t seed) {
  const NoiseOfPair& noise = *input.noise;
  std::vector<Figure> figures;
  measure_each(list, input, [&](const MetricOutput& output, double value) {
    figures.push_back({&output, as_distance(output, value), {}});
  });
  const auto measure_noisy = [&](const Image& a, std::uint64_t stream, bool together, auto keep) {
    const Image noisy_a = with_noise(a, noise.a, mix(seed) + 2 * stream, together);
    const Image noisy_b = with_noise(input.b, noise.b, mix(seed) + 2 * stream + 1, together);
    MetricInput noisy{noisy_a,
                      noisy_b,
                      as_shown(noisy_a, viewing),
                      as_shown(noisy_b, viewing),
                      input.pixels_per_degree,
                      input.tolerance,
                      input.hdr_exposures,
                      input.mask,
                      nullptr,
                      input.highlight,
                      tail_as_shown(noisy_a, noisy_b, viewing)};
    std::size_t next = 0;
    measure_each(list, noisy, [&](const MetricOutput& output, double value) {
      keep(figures[next++], as_distance(output, value), value);
    });
  };
  const bool any_shared = (noise.a && noise.a->shared) || (noise.b && noise.b->shared);
  for (int k = 0; k < (any_shared ? 2 : 1) * count; ++k) {
    const bool together = k >= count;
    const auto stream = 2 * std::uint64_t(k);
    measure_noisy(input.a, stream, together, [&](Figure& figure, double distance, double value) {
      figure.spreads[together].value.add(value);
      figure.spreads[together].noisier.add(distance);
    });
    measure_noisy(input.b, stream + 1, together, [&](Figure& figure, double distance, double) {
      figure.spreads[together].nothing.add(distance);
    });
  }
  if (!any_shared)
    for (Figure& figure : figures) figure.spreads[1] = figure.spreads[0];
  ErrorBars bars;
  const double factor = draw_factor(noise, count);
  for (const Figure& figure : figures) bars.emplace_back(figure.output->id, bar_of(figure, factor));
  return bars;
}

}  // namespace lobelia

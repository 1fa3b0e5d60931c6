#include "compare/maps/flip_histogram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/words/svg_chart.hpp"

namespace lobelia {
namespace {

constexpr double kMegapixel = 1024 * 1024;

}  // namespace

FlipHistogram flip_histogram(std::span<const float> errors) {
  FlipHistogram histogram;
  if (errors.empty()) return histogram;
  std::vector<float> sorted(errors.begin(), errors.end());
  std::ranges::sort(sorted);
  double sum = 0;
  for (const float error : sorted) {
    sum += double(error);
    // In float32, as the tool has it.
    const auto bucket = std::size_t(double(error) / double(1.0f / kFlipBuckets));
    ++histogram.pixels[std::min(bucket, histogram.pixels.size() - 1)];
  }
  for (std::size_t i = 0; i < histogram.pixels.size(); ++i)
    histogram.weighted[i] = double(histogram.pixels[i]) * ((double(i) + 0.5) / kFlipBuckets) /
                            (double(errors.size()) / kMegapixel);
  histogram.mean = sum / double(errors.size());
  histogram.least = double(sorted.front());
  histogram.largest = double(sorted.back());
  const auto quantile = [&](double share) {
    double running = 0;
    for (const float error : sorted)
      if ((running += double(error)) > share * sum) return double(error);
    return 0.0;
  };
  histogram.first_quartile = quantile(0.25);
  histogram.median = quantile(0.5);
  histogram.third_quartile = quantile(0.75);
  return histogram;
}

std::string histogram_csv(const FlipHistogram& histogram) {
  std::string text = "from,to,pixels,weighted_per_megapixel\r\n";
  for (std::size_t i = 0; i < histogram.pixels.size(); ++i)
    text += fmt::format("{:.2f},{:.2f},{},{}\r\n", double(i) / kFlipBuckets,
                        double(i + 1) / kFlipBuckets, histogram.pixels[i], histogram.weighted[i]);
  return text;
}

std::string histogram_svg(const FlipHistogram& histogram, const std::string& title) {
  Chart chart;
  chart.id = "flip-histogram";
  chart.title = "Weighted histogram of " + title;
  chart.description = fmt::format(
      "mean {:.4g}, weighted median {:.4g}, weighted quartiles {:.4g} and {:.4g}, from {:.4g} to {:.4g}",
      histogram.mean, histogram.median, histogram.first_quartile, histogram.third_quartile,
      histogram.least, histogram.largest);
  chart.x = {title + " error", 0, 1, false, {}};
  const double top = round_up(std::ranges::max(histogram.weighted));
  chart.y = {"weighted sum per megapixel", 0, top, false, {}};
  ChartSeries& outline = chart.series.emplace_back();
  outline.label = "pixels, weighted by their error";
  outline.style = 1;
  for (std::size_t i = 0; i < histogram.weighted.size(); ++i)
    for (const std::size_t edge : {i, i + 1}) {
      outline.x.push_back(double(edge) / kFlipBuckets);
      outline.y.push_back(histogram.weighted[i]);
    }
  const auto add_line = [&](std::string label, double at, int style) {
    ChartSeries& line = chart.series.emplace_back();
    line.label = fmt::format("{} {:.4f}", label, at);
    line.x = {at, at};
    line.y = {0, top};
    line.style = style;
  };
  add_line("mean", histogram.mean, 2);
  add_line("weighted quartile", histogram.first_quartile, 4);
  add_line("weighted median", histogram.median, 3);
  add_line("weighted quartile", histogram.third_quartile, 4);
  return draw_chart_file(chart);
}

}  // namespace lobelia

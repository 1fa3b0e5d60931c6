// LDR-FLIP: the difference that a person sees when two pictures are shown in turn, 0 to 1.
//
// Source:       P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem,
//               M. D. Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proceedings
//               of the ACM on Computer Graphics and Interactive Techniques 3 (2), 2020.
// Formula:      per pixel colour^(1 - feature). colour: distance of the Hunt-adjusted Lab colours
//               after the eye's contrast filter, remapped to [0, 1]; feature: the difference in
//               edges or points of the luminance. mean and max over all pixels.
// Input:        DisplayLight (linear, clipped). The tool takes sRGB and decodes it first.
// Agrees with:  NVIDIA's tool, version 1.6, built without fused multiply-add, its mean taken in
//               double: in all nine digits of mean and maximum on the pictures of the test.
// Differs:      the mean is summed in double; the tool's float32 sum is wrong by percents on a
//               large picture.
//
// Why the error map is float32, unlike every other metric: in a flat area the feature difference is
// the square root of rounding noise, some 1e-4 in the tool, and moves the error by up to 5e-5. More
// precision removes the noise but also the agreement.
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "compare/metrics/flip_filters.hpp"
#include "compare/metrics/metric.hpp"

namespace lobelia {
namespace {

// Section 4.1.4: the share of the largest colour distance, and the error that it is mapped to,
// above which distances are compressed.
constexpr float kKnee = 0.4f, kErrorAtKnee = 0.95f;
// Section 4.2.2: exponent of the feature difference, and 1/sqrt(2), which brings it to [0, 1].
constexpr float kFeatureExponent = 0.5f;
const float kFeatureScale = 1.0f / std::sqrt(2.0f);

// Rows filtered at once: enough that the filter's radius around them costs little, few enough that
// their planes stay in the cache and every processor has some.
constexpr int kRowsPerTask = 32;

constexpr MetricOutput kOutputs[] = {
    {"flip.ldr.mean", Better::kLower, true, "LDR-FLIP, mean"},
    {"flip.ldr.max", Better::kLower, true, "LDR-FLIP, the largest of all pixels"}};

float colour_error(float distance, float largest) {
  const float knee = kKnee * largest;
  if (distance < knee) return distance * (kErrorAtKnee / knee);
  return kErrorAtKnee + ((distance - knee) / (largest - knee)) * (1.0f - kErrorAtKnee);
}

float feature_difference(const FlipRows& a, const FlipRows& b, std::size_t i) {
  const float edge = std::abs(a.edge[i] - b.edge[i]);
  const float point = std::abs(a.point[i] - b.point[i]);
  return std::pow(kFeatureScale * std::max(edge, point), kFeatureExponent);
}

void measure(const MetricInput& input, std::span<double> values) {
  const FlipFilters filters(float(input.pixels_per_degree));
  const float largest_distance = flip_largest_distance();
  const int width = input.shown_a.width(), height = input.shown_a.height();
  std::vector<double> row_sum(std::size_t(height), 0.0), row_max(row_sum);
  const int tasks = (height + kRowsPerTask - 1) / kRowsPerTask;
  oneapi::tbb::parallel_for(0, tasks, [&](int task) {
    const int first = task * kRowsPerTask, last = std::min(height, first + kRowsPerTask);
    const FlipRows a = flip_filter_rows(input.shown_a, filters, first, last);
    const FlipRows b = flip_filter_rows(input.shown_b, filters, first, last);
    for (int row = first; row < last; ++row) {
      double sum = 0, largest = 0;
      for (int x = 0; x < width; ++x) {
        const std::size_t i = std::size_t(row - first) * std::size_t(width) + std::size_t(x);
        const float colour =
            colour_error(flip_distance(a.colour[i], b.colour[i]), largest_distance);
        const double error = std::pow(colour, 1.0f - feature_difference(a, b, i));
        sum += error;
        largest = std::max(largest, error);
      }
      row_sum[std::size_t(row)] = sum;
      row_max[std::size_t(row)] = largest;
    }
  });
  // In order of the rows: the sum must not depend on the number of threads.
  double sum = 0, largest = 0;
  for (const double row : row_sum) sum += row;
  for (const double row : row_max) largest = std::max(largest, row);
  values[0] = sum / double(std::max<std::size_t>(input.shown_a.pixel_count(), 1));
  values[1] = largest;
}

}  // namespace

extern const Metric flip_ldr_metric;
constinit const Metric flip_ldr_metric{kOutputs, Family::kVisibility, Needs::kNothing,
                                       "Andersson et al. 2020; FLIP 1.6", measure};

}  // namespace lobelia

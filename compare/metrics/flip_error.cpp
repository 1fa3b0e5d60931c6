#include "compare/metrics/flip_error.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

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
constexpr int kRowsPerTask = 64;

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

}  // namespace

std::vector<float> flip_error_rows(const DisplayLight& a, const DisplayLight& b,
                                   const FlipFilters& filters, int first_row, int last_row) {
  const float largest_distance = flip_largest_distance();
  const FlipRows rows_a = flip_filter_rows(a, filters, first_row, last_row);
  const FlipRows rows_b = flip_filter_rows(b, filters, first_row, last_row);
  std::vector<float> errors(rows_a.colour.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const float colour =
        colour_error(flip_distance(rows_a.colour[i], rows_b.colour[i]), largest_distance);
    errors[i] = std::pow(colour, 1.0f - feature_difference(rows_a, rows_b, i));
  }
  return errors;
}

FlipPooled flip_pooled(int width, int height,
                       const std::function<std::vector<float>(int first, int last)>& error_rows) {
  std::vector<double> row_sum(std::size_t(height), 0.0), row_max(row_sum);
  const int tasks = (height + kRowsPerTask - 1) / kRowsPerTask;
  oneapi::tbb::parallel_for(0, tasks, [&](int task) {
    const int first = task * kRowsPerTask, last = std::min(height, first + kRowsPerTask);
    const std::vector<float> errors = error_rows(first, last);
    const float* error = errors.data();
    for (int row = first; row < last; ++row)
      for (int x = 0; x < width; ++x, ++error) {
        row_sum[std::size_t(row)] += double(*error);
        row_max[std::size_t(row)] = std::max(row_max[std::size_t(row)], double(*error));
      }
  });
  // In order of the rows: the sum must not depend on the number of threads.
  double sum = 0, largest = 0;
  for (const double row : row_sum) sum += row;
  for (const double row : row_max) largest = std::max(largest, row);
  return {sum / std::max(double(width) * double(height), 1.0), largest};
}

}  // namespace lobelia

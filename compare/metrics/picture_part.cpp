#include "compare/metrics/picture_part.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <cmath>

#include "base/pictures/image_values.hpp"
#include "compare/metrics/shared_work.hpp"

namespace lobelia {
namespace {

ValueErrors errors_of_row(const MetricInput& input, std::size_t row) {
  const std::span<const float> a = input.a.values(), b = input.b.values();
  const auto width = std::size_t(input.a.width());
  ValueErrors errors;
  for (std::size_t pixel = row * width; pixel < (row + 1) * width; ++pixel) {
    if (!input.in_region(pixel)) continue;
    errors.count += 3;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
      const double reference = b[i], difference = double(a[i]) - reference,
                   size = std::abs(difference), square = difference * difference;
      errors.sizes += size;
      errors.squares += square;
      errors.differences += difference;
      errors.relative += square / (reference * reference + kRelmseEpsilon);
      if (size > errors.largest) {
        errors.largest = size;
        errors.where = pixel;
      }
    }
  }
  looked_at(6 * sizeof(float) * width);
  return errors;
}

}  // namespace

std::shared_ptr<const ValueErrors> value_errors(const MetricInput& input) {
  return shared(
      input, kValueErrors,
      [&] {
        std::vector<ValueErrors> rows(std::size_t(input.a.height()));
        oneapi::tbb::parallel_for(std::size_t{0}, rows.size(),
                                  [&](std::size_t y) { rows[y] = errors_of_row(input, y); });
        ValueErrors all;
        for (const ValueErrors& row : rows) {
          all.count += row.count;
          all.sizes += row.sizes;
          all.squares += row.squares;
          all.differences += row.differences;
          all.relative += row.relative;
          if (row.largest > all.largest) {
            all.largest = row.largest;
            all.where = row.where;
          }
        }
        return all;
      },
      true);
}

double reference_peak(const MetricInput& input) {
  return *shared(input, "peak", [&] { return peak_value(input.b); });
}

}  // namespace lobelia

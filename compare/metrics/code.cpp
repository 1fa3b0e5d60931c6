// The difference of two pictures as 8-bit files would have it.
//
// Source:       ours; what `compare -metric PAE` and pixel diffs of PNGs count.
// Formula:      code values by code_values(). max: the largest |a - b| of any R, G or B value, and the first such pixel
//               in reading order, from 0; mean: over all of them.
// Input:        DisplayLight (linear, clipped).
// On request:   one step of 8 bits is the rounding of the file, so it says little of a float picture.
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "base/system/scratch_memory.hpp"
#include "compare/metrics/code_values.hpp"

namespace lobelia {
namespace {

constexpr ValueRange kCodeRange{0, 255};

constexpr MetricOutput kCodeOutputs[] = {
    {"code.max", "Largest difference in code values", Unit::kPlain, Better::kLower, true,
     "largest difference of 8-bit sRGB code values", "In steps of an 8-bit picture.", 0, false,
     kCodeRange},
    {"code.max.x", "", Unit::kPlain, Better::kNeither, true, "its column"},
    {"code.max.y", "", Unit::kPlain, Better::kNeither, true, "its row, from the top"},
    {"code.mean", "Mean difference in code values", Unit::kPlain, Better::kLower, true,
     "mean difference of 8-bit sRGB code values", "In steps of an 8-bit picture.", 0, false,
     kCodeRange}};

void measure_code(const MetricInput& input, std::span<double> values) {
  struct Row {
    int largest = 0;
    std::size_t where = 0;
    std::int64_t sum = 0, count = 0;
  };
  const auto codes = code_pair(input);
  const auto width = std::size_t(input.a.width());
  std::vector<Row> rows(std::size_t(input.a.height()));
  oneapi::tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t y) {
    Row& row = rows[y];
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t pixel = width * y + x;
      if (!input.in_region(pixel)) continue;
      for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
        const int difference = std::abs(int(codes->a[i]) - int(codes->b[i]));
        if (difference > row.largest) row.where = x;
        row.largest = std::max(row.largest, difference);
        row.sum += difference;
      }
      row.count += 3;
    }
    looked_at(6 * width);
  });
  values[0] = values[1] = values[2] = 0;
  std::int64_t sum = 0, count = 0;
  for (std::size_t y = 0; y < rows.size(); ++y) {
    if (rows[y].largest > values[0]) {
      values[0] = rows[y].largest;
      values[1] = double(rows[y].where);
      values[2] = double(y);
    }
    sum += rows[y].sum;
    count += rows[y].count;
  }
  values[3] = double(sum) / double(std::max<std::int64_t>(count, 1));
}

}  // namespace

extern constinit const Metric code_metric{.outputs = kCodeOutputs,
                                          .family = Family::kColour,
                                          .needs = Needs::kNothing,
                                          .source = "ours: 8-bit sRGB",
                                          .measure = measure_code,
                                          .work = kCodeWork,
                                          .on_request = true};

}  // namespace lobelia

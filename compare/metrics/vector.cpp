// How far vectors are turned and how much longer or shorter they are: normals, positions, motion.
//
// Source:       ours; the angle between unit normals is the usual measure of normal maps.
// Formula:      angle: atan2(|a x b|, a.b) in degrees, of pixels where both are longer than 1e-3 of the reference's longest,
//               0 of the others. length: | |a| - |b| | / the reference's longest, or a's if all of the reference's are 0.
//               Mean, 95th percentile (nearest rank) and maximum over all pixels.
// Input:        two or three components as stored; a third that is missing is 0.
// Deviations:   short vectors have no angle, because rounding alone turns them; where one alone is short, the lengths differ.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compare/metrics/pixel_differences.hpp"

namespace lobelia {
namespace {

/// The least length that has a direction, as a share of the longest.
constexpr double kLeastVector = 1e-3;

constexpr ValueRange kAngleRange{0, 180};

constexpr MetricOutput kVectorOutputs[] = {
    {"vector.angle.mean", "Angle, mean", Unit::kPlain, Better::kLower, false,
     "angle between vectors in degrees, mean", "", 0, false, kAngleRange},
    {"vector.angle.p95", "Angle, 95th percentile", Unit::kPlain, Better::kLower, false,
     "angle between vectors in degrees, 95th percentile", "", 0, false, kAngleRange},
    {"vector.angle.max", "Angle, largest", Unit::kPlain, Better::kLower, false,
     "angle between vectors in degrees, largest", "", 0, false, kAngleRange},
    {"vector.length.mean", "Length, mean", Unit::kShare, Better::kLower, false,
     "difference of lengths divided by the reference's longest, mean"},
    {"vector.length.p95", "Length, 95th percentile", Unit::kShare, Better::kLower, false,
     "difference of lengths divided by the reference's longest, 95th percentile"},
    {"vector.length.max", "Length, largest", Unit::kShare, Better::kLower, false,
     "difference of lengths divided by the reference's longest, largest"}};

double vector_length(const float* v) {
  return std::hypot(double(v[0]), double(v[1]), double(v[2]));
}

double longest_vector(const Image& image) {
  double result = 0;
  for (std::size_t i = 0; i < image.values().size(); i += 3)
    result = std::max(result, vector_length(&image.values()[i]));
  return result;
}

double angle_between(const float* p, const float* q) {
  const double x[] = {p[0], p[1], p[2]}, y[] = {q[0], q[1], q[2]};
  const double across =
      std::hypot(x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]);
  return std::atan2(across, x[0] * y[0] + x[1] * y[1] + x[2] * y[2]) * 180 / std::numbers::pi;
}

void measure_vector(const MetricInput& input, std::span<double> values) {
  const std::size_t count = input.a.pixel_count();
  double scale = longest_vector(input.b);
  if (scale == 0) scale = longest_vector(input.a);
  PixelValues angles(count), lengths(count);
  for (std::size_t pixel = 0; pixel < count && scale > 0; ++pixel) {
    const float *const in_a = &input.a.values()[3 * pixel], *const in_b =
                                                                &input.b.values()[3 * pixel];
    const double of_a = vector_length(in_a), of_b = vector_length(in_b);
    lengths[pixel] = float(std::abs(of_a - of_b) / scale);
    if (std::min(of_a, of_b) > kLeastVector * scale)
      angles[pixel] = float(angle_between(in_a, in_b));
  }
  write_figures(angles, input, {0.95}, values.first(3));
  write_figures(lengths, input, {0.95}, values.subspan(3));
}

}  // namespace

extern constinit const Metric vector_metric{.outputs = kVectorOutputs,
                                            .family = Family::kRadiance,
                                            .needs = Needs::kNothing,
                                            .source = "ours",
                                            .measure = measure_vector,
                                            .layer = LayerType::kVector};

}  // namespace lobelia

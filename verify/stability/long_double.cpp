#include "verify/stability/long_double.hpp"

#include <cmath>

#include "reference_scenes/engines/analytic/formulas/definition.hpp"

namespace lobelia::stability {
namespace {

struct Long3 {
  long double x, y, z;
  friend Long3 operator+(Long3 a, Long3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Long3 operator-(Long3 a, Long3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Long3 operator*(long double k, Long3 a) { return {k * a.x, k * a.y, k * a.z}; }
};
long double dot(Long3 a, Long3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Long3 unit(Long3 a) { return 1 / std::sqrt(dot(a, a)) * a; }
Long3 unit(Vec3 a) { return unit(Long3{a.x, a.y, a.z}); }
Vec3 rounded(Long3 a) { return {double(a.x), double(a.y), double(a.z)}; }

}  // namespace

ScreenedVectors screen(LobeAngle angle, const Triple& directions) {
  const Long3 n = unit(directions.normal), v = unit(directions.to_eye),
              l = unit(directions.to_light);
  const Long3 sum = l + v;
  const Long3 difference =
      angle == LobeAngle::kReflection ? 2 * dot(n, v) * n - v - l : n - unit(sum);
  return {rounded(n), rounded(v),
          rounded(l), dot(difference, difference) / 2,
          dot(n, l),  double(std::sqrt(dot(sum, sum)))};
}

long double screened_lobe(LobeId lobe, long double s, double exponent) {
  return s < 1 ? lobe_definition(lobe, 1 - s, exponent) : 0;
}

}  // namespace lobelia::stability

// Test vectors of highlights: at random, in long double, and in the kernels' layout.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "base/words/vec.hpp"
#include "renderer/highlight.hpp"
#include "renderer/kernels/kernels.hpp"

namespace lobelia::stability {

/// Exact directions, not of unit length.
struct Triple {
  Vec3 normal, to_eye, to_light;
};

/// Random vectors about a highlight: its middle, its flank and its foot, oblique and grazing.
class RandomVectors {
 public:
  RandomVectors(LobeAngle angle, double exponent, std::uint64_t seed)
      : angle_(angle), width_(1 / std::sqrt(exponent)), random_(seed) {}

  Triple next();
  /// Close to `there`: the same place of the lobe, other roundings.
  Triple beside(const Triple& there);

 private:
  double uniform() { return uniform_(random_); }
  Vec3 direction();
  double grazing_cosine();

  LobeAngle angle_;
  double width_;  ///< of the lobe, radians
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> uniform_{0, 1};
  std::normal_distribution<double> normal_;
};

/// A highlight's vectors in long double (64 binary digits on x86), to find the worst of many cases, which is then judged
/// by reference_scenes/engines/analytic/formulas/.
struct ScreenedVectors {
  Vec3 normal, to_eye, to_light;    ///< unit, correctly rounded to double
  long double s, n_dot_l, n_dot_v;  ///< of the unrounded vectors
  double half_length;               ///< |L + V|
};
ScreenedVectors screen(LobeAngle angle, const Triple& directions);
long double screened_lobe(LobeId lobe, long double s, double exponent);

/// geometry_factor() of a model, and its error if each cosine is off by four roundings of `unit`. The error is 0 without
/// shadowing. With shadowing it is as large as the factor where light and eye are within a rounding of the horizon.
struct Factor {
  long double value;
  double error;
  /// Errors are relative to this. Shadowing makes a highlight higher than its lobe at grazing angles.
  double peak() const { return std::max(1.0, double(value)); }
  /// A bound of the lobe's error, as one of the whole, relative to peak().
  double bound(double of_lobe, double lobe) const {
    return of_lobe + std::min(1.0, lobe + of_lobe) * error / peak();
  }
};
Factor factor(const Highlight& h, long double n_dot_l, long double n_dot_v, double unit = 0x1p-53);

inline constexpr int kHalvings = 64;  ///< |L + V| is above 2^-kHalvings

inline void put(Vec3Chunk& to, std::size_t i, Vec3 a) {
  to.x[i] = a.x, to.y[i] = a.y, to.z[i] = a.z;
}

/// Vectors in the kernels' layout.
struct Chunk {
  Triple directions[kChunk];
  Vec3Chunk normal{}, to_eye{}, to_light{};
  long double s[kChunk], n_dot_l[kChunk], n_dot_v[kChunk];
  int halvings[kChunk];

  template <class Draw>
  void fill(LobeAngle angle, Draw draw) {
    for (std::size_t i = 0; i < kChunk; ++i) {
      directions[i] = draw();
      const ScreenedVectors v = screen(angle, directions[i]);
      put(normal, i, v.normal), put(to_eye, i, v.to_eye), put(to_light, i, v.to_light);
      s[i] = v.s, n_dot_l[i] = v.n_dot_l, n_dot_v[i] = v.n_dot_v;
      halvings[i] = std::clamp(-std::ilogb(v.half_length), 0, kHalvings - 1);
    }
  }
};

/// Lobe times geometry_factor() by the renderer's kernel, in the precision that the plan would choose. Sets `bound` to that
/// precision's bound.
double by_kernel(const Highlight& h, const ScreenedVectors& v, double& bound);

}  // namespace lobelia::stability

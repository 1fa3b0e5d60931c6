// The angle that a model's lobe sees, from the three unit vectors.
//
//   reflection: between L and R = 2 (N.V) N - V        half vector: between N and H = (L + V)/|L + V|
//
// Computed from the difference of the two vectors, because its square is 2 s. The cosine of a small angle would
// leave no digits in 1 - cos.
#include <hwy/highway.h>

#include "renderer/highlight.hpp"

#if defined(LOBELIA_RENDERER_MODELS_LOBE_ANGLE_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LOBELIA_RENDERER_MODELS_LOBE_ANGLE_HPP
#undef LOBELIA_RENDERER_MODELS_LOBE_ANGLE_HPP
#else
#define LOBELIA_RENDERER_MODELS_LOBE_ANGLE_HPP
#endif

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

/// s = 1 - cos of the lobe's angle. Real and Vector have the same precision.
template <LobeAngle angle, class Real, class Vector>
Real one_minus_cos(Vector normal, Vector to_eye, Vector to_light) {
  Vector difference;
  if constexpr (angle == LobeAngle::kReflection) {
    difference = Real(2.0) * dot(normal, to_eye) * normal - to_eye - to_light;
  } else {
    const Vector sum = to_light + to_eye;
    difference = normal - Real(1.0) / sqrt(dot(sum, sum)) * sum;
  }
  return Real(0.5) * dot(difference, difference);
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target guard

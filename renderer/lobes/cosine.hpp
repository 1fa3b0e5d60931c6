// The cosine lobe, cos^n: Phong 1975 (of the mirror angle), Blinn 1977 (of the half-vector angle).
//
//   value(s, n) = (1 - s)^n where s < 1, else 0
//
// The standard that the cheap lobes stand in for.
#include "renderer/lobes/lobe.hpp"

#if defined(LOBELIA_RENDERER_LOBES_COSINE_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LOBELIA_RENDERER_LOBES_COSINE_HPP
#undef LOBELIA_RENDERER_LOBES_COSINE_HPP
#else
#define LOBELIA_RENDERER_LOBES_COSINE_HPP
#endif

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

struct CosineLobe {
  static constexpr LobeInfo kInfo{"cosine", "cosine", "(1 - s)^n", "Phong 1975; Blinn 1977"};
  static constexpr PaperColumn kPaperColumn = PaperColumn::kCosine;

  template <class Real>
  static Real value(Real s, Real n) {
    return power_of_one_minus(s, n);
  }

  static double moment(int j, double n, double s_max) { return power_moment(n, 1 - s_max, j); }
};
static_assert(Lobe<CosineLobe>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target guard

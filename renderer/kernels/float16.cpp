// The shading of Precision::kFloat16.
#include "base/pictures/half.hpp"
#include "renderer/kernels/kernels.hpp"
#include "renderer/lobes/catalogue.hpp"
#include "renderer/models/catalogue.hpp"
#include "renderer/models/lobe_angle.hpp"

namespace lobelia {
namespace {

using HWY_NAMESPACE::LobesById;
using HWY_NAMESPACE::Models;

template <class M, class L>
void shade_in_half_floats(const Highlight& highlight, std::size_t count, const Vec3Chunk& normal,
                          const Vec3Chunk& to_eye, const Vec3Chunk& to_light, double* specular) {
  const L lobe(LobeParameters{highlight});
  const auto at = [](const Vec3Chunk& from, std::size_t i) {
    return Vec3{from.x[i], from.y[i], from.z[i]};
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 n = at(normal, i), v = at(to_eye, i), l = at(to_light, i);
    const double n_dot_l = dot(n, l);
    specular[i] = 0;
    if (!(n_dot_l > 0)) continue;
    const Half s = HWY_NAMESPACE::one_minus_cos<M::kInfo.angle, Half>(Half3(n), Half3(v), Half3(l));
    specular[i] = double(lobe.value(s)) *
                  geometry_factor(highlight.model, highlight.exponent, n_dot_l, dot(n, v));
  }
}

template <class M>
constexpr auto half_float_row() {
  return map_types<KernelTable::Shade>(LobesById{},
                                       []<class L>() { return &shade_in_half_floats<M, L>; });
}

}  // namespace

KernelTable::Shade float16_shade(const Highlight& highlight) {
  using Row = std::array<KernelTable::Shade, LobesById::kSize>;
  static constexpr auto kTable =
      map_types<Row>(Models{}, []<class M>() { return half_float_row<M>(); });
  return kTable.at(highlight.model.index).at(highlight.lobe.index);
}

}  // namespace lobelia

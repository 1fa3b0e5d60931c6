#include "renderer/kernels/kernels.hpp"

// Without optimisation Highway's functions are not inlined, and GCC 12 hands wide registers through
// memory that it aligns to 16 bytes only: a debug build keeps to the baseline.
#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/kernels/kernels.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "renderer/kernels/chunk-inl.hpp"
#include "renderer/kernels/geometry-inl.hpp"
#include "renderer/lobes/catalogue.hpp"
#include "renderer/models/catalogue.hpp"
#include "renderer/models/lobe_angle.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace {

void visibility(const std::vector<Sphere>& spheres, const std::vector<int>& occluders,
                std::size_t count, const Vec3Chunk& point, const Vec3Chunk& to_light,
                const double* distance, double* visible) {
  const hn::ScalableTag<double> d;
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes3 p = load(point, i), l = load(to_light, i);
    const Lanes far = Lanes::load(distance + i);
    auto blocked = hn::Lt(far.v, hn::Zero(d));  // nowhere
    for (const int k : occluders) {
      const Lanes3 to_center = broadcast(spheres[k].center) - p;
      const Lanes along = dot(to_center, l);
      const Lanes3 off_axis = to_center - along * l;
      const Lanes half_chord_squared =
          Lanes(spheres[k].radius * spheres[k].radius) - dot(off_axis, off_axis);
      const Lanes half_chord = sqrt(positive_part(half_chord_squared));
      // Not by the far end of the chord: where the point lies on this sphere too, that is at 0, and
      // rounding would put it on either side.
      const double depth = inner_radius(spheres[k]);
      const auto towards = hn::Or(hn::Gt(along.v, hn::Zero(d)),
                                  hn::Lt(dot(to_center, to_center).v, hn::Set(d, depth * depth)));
      const auto meets = hn::And(hn::Gt(half_chord_squared.v, hn::Zero(d)),
                                 hn::And(towards, hn::Lt((along - half_chord).v, far.v)));
      blocked = hn::Or(blocked, meets);
    }
    Lanes(hn::IfThenElse(blocked, hn::Zero(d), hn::Set(d, 1.0))).store(visible + i);
  }
}

/// Two registers' worth of vectors, as the precisions narrower than float64 take them.
struct Pair {
  Lanes3 low, high;
  HWY_INLINE Pair(const Vec3Chunk& from, std::size_t i)
      : low(load(from, i)), high(load(from, i + Lanes::count())) {}
  HWY_INLINE Lanes3Of<float> rounded() const {
    return {narrow(low.x, high.x), narrow(low.y, high.y), narrow(low.z, high.z)};
  }
};

template <class M, class L>
struct Shader {
  static void float64(const Highlight& highlight, std::size_t count, const Vec3Chunk& normal,
                      const Vec3Chunk& to_eye, const Vec3Chunk& to_light, double* specular) {
    const L lobe({highlight.exponent, highlight.lobe.order});
    for (std::size_t i = 0; i < count; i += Lanes::count()) {
      const Lanes3 n = load(normal, i), v = load(to_eye, i), l = load(to_light, i);
      const Lanes s = one_minus_cos<M::kInfo.angle, Lanes>(n, v, l);
      store_lit(dot(n, l), lobe.value(s), specular + i);
    }
  }

  /// N.L stays float64, so that every precision has the same terminator and no product of two small
  /// float32 is too small for a normal one.
  template <bool mixed>
  static void narrow_lobe(const Highlight& highlight, std::size_t count, const Vec3Chunk& normal,
                          const Vec3Chunk& to_eye, const Vec3Chunk& to_light, double* specular) {
    const L lobe({highlight.exponent, highlight.lobe.order});
    for (std::size_t i = 0; i < count; i += Lanes32::count()) {
      const Pair n(normal, i), v(to_eye, i), l(to_light, i);
      Lanes32 s;
      if constexpr (mixed)
        s = narrow(one_minus_cos<M::kInfo.angle, Lanes>(n.low, v.low, l.low),
                   one_minus_cos<M::kInfo.angle, Lanes>(n.high, v.high, l.high));
      else
        s = one_minus_cos<M::kInfo.angle, Lanes32>(n.rounded(), v.rounded(), l.rounded());
      Lanes low, high;
      widen(lobe.value(s), low, high);
      store_lit(dot(n.low, l.low), low, specular + i);
      store_lit(dot(n.high, l.high), high, specular + i + Lanes::count());
    }
  }

 private:
  static HWY_INLINE void store_lit(Lanes n_dot_l, Lanes value, double* specular) {
    // Also where there is no half vector (L = -V): N.L and N.V are never both positive there.
    where_less(Lanes(0.0), n_dot_l, value * M::foreshortening(n_dot_l)).store(specular);
  }
};

template <class L>
void lobe32(const Highlight& highlight, std::size_t count, const float* s, float* value) {
  const L lobe({highlight.exponent, highlight.lobe.order});
  for (std::size_t i = 0; i < count; i += Lanes32::count())
    lobe.value(Lanes32::load(s + i)).store(value + i);
}

void fresnel(std::size_t count, const Vec3Chunk& to_eye, const Vec3Chunk& to_light,
             double* weight) {
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    schlick_weight(load(to_eye, i), load(to_light, i)).store(weight + i);
  }
}

void cosine(std::size_t count, const Vec3Chunk& normal, const Vec3Chunk& to_light,
            double* n_dot_l) {
  for (std::size_t i = 0; i < count; i += Lanes::count())
    positive_part(dot(load(normal, i), load(to_light, i))).store(n_dot_l + i);
}

using ShadeRow = std::array<KernelTable::Shade, 3>;  // by precision

template <class M>
constexpr auto shade_table() {
  return map_types<ShadeRow>(Lobes{}, []<class L>() -> ShadeRow {
    using S = Shader<M, L>;
    return {&S::template narrow_lobe<false>, &S::template narrow_lobe<true>, &S::float64};
  });
}

KernelTable::Shade find_shade(const Highlight& highlight, Precision precision) {
  using Row = std::array<ShadeRow, Lobes::kSize>;
  static constexpr auto kTable =
      map_types<Row>(Models{}, []<class M>() { return shade_table<M>(); });
  return kTable.at(highlight.model.index).at(highlight.lobe.index).at(std::size_t(precision));
}

KernelTable::LobeValue find_lobe32(LobeId lobe) {
  static constexpr auto kTable =
      map_types<KernelTable::LobeValue>(Lobes{}, []<class L>() { return &lobe32<L>; });
  return kTable.at(lobe.index);
}

}  // namespace

const KernelTable& kernel_table() {
  static const KernelTable table{visibility, find_shade, find_lobe32,
                                 fresnel,    cosine,     hwy::TargetName(HWY_TARGET)};
  return table;
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {

HWY_EXPORT(kernel_table);

const KernelTable& kernels() {
  static const KernelTable& table = HWY_DYNAMIC_DISPATCH(kernel_table)();
  return table;
}

}  // namespace lobelia
#endif

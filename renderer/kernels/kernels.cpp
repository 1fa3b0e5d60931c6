#include "renderer/kernels/kernels.hpp"

#include "renderer/sobol.hpp"

// Without optimisation Highway's functions are not inlined, and GCC 12 passes wide registers in memory that is
// aligned to 16 bytes only. So a debug build has only the baseline.
#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/kernels/kernels.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "renderer/kernels/geometry-inl.hpp"
#include "renderer/lobes/catalogue.hpp"
#include "renderer/models/catalogue.hpp"
#include "renderer/models/lobe_angle.hpp"
#include "renderer/models/smith.hpp"

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
      // Does not test the far end of the chord: for a point on this sphere it is at 0, and rounding would decide.
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

/// Two registers of vectors, for the precisions narrower than float64.
struct Pair {
  Lanes3 low, high;
  HWY_INLINE Pair(const Vec3Chunk& from, std::size_t i)
      : low(load(from, i)), high(load(from, i + Lanes::count())) {}
  HWY_INLINE Lanes3Of<float> rounded() const { return narrow(low, high); }
};

template <class M, class L>
struct Shader {
  static void float64(const Highlight& highlight, std::size_t count, const Vec3Chunk& normal,
                      const Vec3Chunk& to_eye, const Vec3Chunk& to_light, double* specular) {
    const L lobe(LobeParameters{highlight});
    const double alpha2 = alpha_squared(highlight.exponent);
    for (std::size_t i = 0; i < count; i += Lanes::count()) {
      const Lanes3 n = load(normal, i), v = load(to_eye, i), l = load(to_light, i);
      const Lanes s = one_minus_cos<M::kInfo.angle, Lanes>(n, v, l);
      store_lit(alpha2, n, v, l, lobe.value(s), specular + i);
    }
  }

  /// N.L and shadowing stay float64, so that every precision has the same terminator and no product of two small float32 is
  /// subnormal.
  template <bool mixed>
  static void narrow_lobe(const Highlight& highlight, std::size_t count, const Vec3Chunk& normal,
                          const Vec3Chunk& to_eye, const Vec3Chunk& to_light, double* specular) {
    const L lobe(LobeParameters{highlight});
    const double alpha2 = alpha_squared(highlight.exponent);
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
      store_lit(alpha2, n.low, v.low, l.low, low, specular + i);
      store_lit(alpha2, n.high, v.high, l.high, high, specular + i + Lanes::count());
    }
  }

 private:
  static HWY_INLINE void store_lit(double alpha2, Lanes3 n, Lanes3 v, Lanes3 l, Lanes value,
                                   double* specular) {
    const Lanes n_dot_l = dot(n, l);
    if constexpr (M::kInfo.has_shadowing) value = value * smith_factor(alpha2, n_dot_l, dot(n, v));
    // Also 0 where there is no half vector (L = -V): N.L and N.V are never both positive there.
    if constexpr (M::kInfo.applies_cosine) value = value * n_dot_l;
    where_less(Lanes(0.0), n_dot_l, value).store(specular);
  }
};

template <class L>
void lobe32(const Highlight& highlight, std::size_t count, const float* s, float* value) {
  const L lobe(LobeParameters{highlight});
  for (std::size_t i = 0; i < count; i += Lanes32::count())
    lobe.value(Lanes32::load(s + i)).store(value + i);
}

void fresnel(std::size_t count, const Vec3Chunk& to_eye, const Vec3Chunk& to_light,
             double* weight) {
  for (std::size_t i = 0; i < count; i += Lanes::count())
    schlick_weight(load(to_eye, i), load(to_light, i)).store(weight + i);
}

void cosine(std::size_t count, const Vec3Chunk& normal, const Vec3Chunk& to_light,
            double* n_dot_l) {
  for (std::size_t i = 0; i < count; i += Lanes::count())
    positive_part(dot(load(normal, i), load(to_light, i))).store(n_dot_l + i);
}

void camera_rays(const CameraFrame& camera, std::size_t count, const double* u, const double* v,
                 const double* lens_u, const double* lens_v, Vec3Chunk& to_eye) {
  const Lanes3 forward = broadcast(camera.forward);
  const Lanes3 right = broadcast(camera.right), up = broadcast(camera.up);
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes x = Lanes::load(u + i) - Lanes::load(lens_u + i);
    const Lanes y = Lanes::load(v + i) - Lanes::load(lens_v + i);
    store(to_eye_of_ray(forward, x, right, y * up), to_eye, i);
  }
}

void nearest_sphere(const std::vector<Sphere>& spheres, std::size_t count, const Vec3Chunk& origin,
                    const Vec3Chunk& to_eye, const double* leaves, double* index,
                    double* distance) {
  const hn::ScalableTag<double> d;
  // For each sphere, the most that the squared distance to the centre exceeds the squared radius at points on it.
  std::vector<double> on_it;
  for (const Sphere& sphere : spheres)
    on_it.push_back((outer_radius(sphere) - sphere.radius) *
                    (outer_radius(sphere) + sphere.radius));
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes3 o = load(origin, i), eye = load(to_eye, i);
    const auto left = hn::LoadU(d, leaves + i);
    auto nearest = hn::Set(d, std::numeric_limits<double>::infinity()), found = hn::Set(d, -1.0);
    for (std::size_t k = 0; k < spheres.size(); ++k) {
      Lanes3 off_axis;
      Lanes half, t;
      const Mask ahead =
          chord(broadcast(spheres[k].center) - o, Lanes(spheres[k].radius), eye, off_axis, half, t);
      // The same excess at the origin: by the secant theorem, the product of the distances to both ends of the chord.
      const Mask outside = hn::Gt((t * (t + half + half)).v, hn::Set(d, on_it[k]));
      const auto here = hn::Set(d, double(k));
      const Mask hit =
          hn::AndNot(hn::Eq(here, left), hn::And(hn::And(ahead, outside), hn::Lt(t.v, nearest)));
      nearest = hn::IfThenElse(hit, t.v, nearest);
      found = hn::IfThenElse(hit, here, found);
    }
    hn::StoreU(found, d, index + i);
    hn::StoreU(nearest, d, distance + i);
  }
}

void surface(std::size_t count, const Vec3Chunk& origin, const Vec3Chunk& to_eye,
             const Vec3Chunk& center, const double* radius, Vec3Chunk& point, Vec3Chunk& normal) {
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes3 c = load(center, i), eye = load(to_eye, i);
    const Lanes r = Lanes::load(radius + i);
    Lanes3 off_axis;
    Lanes half, t;
    chord(c - load(origin, i), r, eye, off_axis, half, t);
    const Lanes3 n = normal_of_chord(Lanes(-1.0) / r, eye, off_axis, half);
    store(n, normal, i);
    store(add_scaled(r, n, c), point, i);
  }
}

/// Rays that meet a plane beyond this distance run along it, to its horizon.
constexpr double kFarthest = 1e15;

void nearest_plane(const Plane& plane, double plane_index, std::size_t count,
                   const Vec3Chunk& origin, const Vec3Chunk& to_eye, const double* leaves,
                   double* index, double* distance) {
  const hn::ScalableTag<double> d;
  const Lanes3 normal = broadcast(plane.normal), on_plane = broadcast(plane.point);
  const auto here = hn::Set(d, plane_index);
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes t = dot(load(origin, i) - on_plane, normal) / dot(load(to_eye, i), normal);
    const auto before = hn::LoadU(d, distance + i);
    const Mask ahead = hn::And(hn::Gt(t.v, hn::Zero(d)), hn::Lt(t.v, hn::Set(d, kFarthest)));
    const Mask hit =
        hn::AndNot(hn::Eq(here, hn::LoadU(d, leaves + i)), hn::And(ahead, hn::Lt(t.v, before)));
    hn::StoreU(hn::IfThenElse(hit, t.v, before), d, distance + i);
    hn::StoreU(hn::IfThenElse(hit, here, hn::LoadU(d, index + i)), d, index + i);
  }
}

void plane_surface(const Plane& plane, double plane_index, std::size_t count,
                   const Vec3Chunk& origin, const Vec3Chunk& to_eye, const double* index,
                   const double* distance, Vec3Chunk& point, Vec3Chunk& normal) {
  const hn::ScalableTag<double> d;
  const Lanes3 up = broadcast(plane.normal), on_plane = broadcast(plane.point);
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Mask here = hn::Eq(hn::Set(d, plane_index), hn::LoadU(d, index + i));
    const Lanes3 eye = load(to_eye, i);
    const Lanes3 at = subtract_scaled(Lanes::load(distance + i), eye, load(origin, i));
    // Moves the point back onto the plane, which a distant ray's rounding has left.
    const Lanes3 p = subtract_scaled(dot(at - on_plane, up), up, at);
    const Mask from_above = hn::Gt(dot(eye, up).v, hn::Zero(d));
    const auto put = [&](const Lanes& now, double* to)
                         HWY_ATTR { hn::BlendedStore(now.v, here, d, to + i); };
    put(p.x, point.x), put(p.y, point.y), put(p.z, point.z);
    const auto facing = [&](Lanes n) HWY_ATTR {
      return Lanes(hn::IfThenElse(from_above, n.v, hn::Neg(n.v)));
    };
    put(facing(up.x), normal.x), put(facing(up.y), normal.y), put(facing(up.z), normal.z);
  }
}

void plane_hides(const Plane& plane, std::size_t count, const Vec3Chunk& point,
                 const Vec3Chunk& to_light, const double* distance, double* visible) {
  const hn::ScalableTag<double> d;
  const Lanes3 normal = broadcast(plane.normal), on_plane = broadcast(plane.point);
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes t = dot(on_plane - load(point, i), normal) / dot(load(to_light, i), normal);
    const Mask between = hn::And(hn::Gt(t.v, hn::Zero(d)), hn::Lt(t.v, hn::LoadU(d, distance + i)));
    hn::StoreU(hn::IfThenZeroElse(between, hn::LoadU(d, visible + i)), d, visible + i);
  }
}

void scatter_evenly(std::size_t count, const Vec3Chunk& normal, const double* u, const double* v,
                    Vec3Chunk& to_light) {
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    // Malley's method: lifts a point of the disc. N.L = sqrt(1 - u).
    const Lanes square = Lanes::load(u + i);
    const Lanes3 l = about(load(normal, i), sqrt(square), sqrt(Lanes(1.0) - square),
                           Lanes(2 * std::numbers::pi) * Lanes::load(v + i));
    store(l, to_light, i);
  }
}

void random(std::size_t count, const std::uint32_t* pixel, const std::uint32_t* index,
            std::uint32_t dimension, double* u, double* v) {
  // Plain integers: the compiler vectorises them for each instruction set.
  for (std::size_t i = 0; i < count; ++i) {
    const sobol::Pair p = sobol::pair(pixel[i], index[i], dimension);
    u[i] = p.u;
    v[i] = p.v;
  }
}

using ShadeRow = std::array<KernelTable::Shade, 3>;  // by precision, but for float16

template <class M>
constexpr auto shade_table() {
  return map_types<ShadeRow>(LobesById{}, []<class L>() -> ShadeRow {
    using S = Shader<M, L>;
    return {&S::template narrow_lobe<false>, &S::template narrow_lobe<true>, &S::float64};
  });
}

KernelTable::Shade find_shade(const Highlight& highlight, Precision precision) {
  if (precision == Precision::kFloat16) return float16_shade(highlight);
  using Row = std::array<ShadeRow, LobesById::kSize>;
  static constexpr auto kTable =
      map_types<Row>(Models{}, []<class M>() { return shade_table<M>(); });
  return kTable.at(highlight.model.index).at(highlight.lobe.index).at(std::size_t(precision));
}

KernelTable::LobeValue find_lobe32(LobeId lobe) {
  static constexpr auto kTable =
      map_types<KernelTable::LobeValue>(LobesById{}, []<class L>() { return &lobe32<L>; });
  return kTable.at(lobe.index);
}

}  // namespace

const KernelTable& kernel_table() {
  static const KernelTable table{visibility,     find_shade,
                                 find_lobe32,    fresnel,
                                 cosine,         camera_rays,
                                 nearest_sphere, surface,
                                 nearest_plane,  plane_surface,
                                 plane_hides,    scatter_evenly,
                                 random,         hwy::TargetName(HWY_TARGET)};
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

// The fused kernel. It does the same operations as the kernels of kernels.cpp one after the other, so its pictures
// are the same bit for bit. The constants of a row or a picture are computed once. Compiled once for each
// instruction set.
#include "renderer/kernels/fused.hpp"
#include "renderer/kernels/geometry-inl.hpp"
#include "renderer/lobes/catalogue.hpp"
#include "renderer/models/catalogue.hpp"
#include "renderer/models/lobe_angle.hpp"

#if defined(LOBELIA_RENDERER_KERNELS_FUSED_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LOBELIA_RENDERER_KERNELS_FUSED_INL_HPP
#undef LOBELIA_RENDERER_KERNELS_FUSED_INL_HPP
#else
#define LOBELIA_RENDERER_KERNELS_FUSED_INL_HPP
#endif

/// For a lambda that is inlined into its caller's loop, with the caller's instructions.
#ifndef LOBELIA_INLINE
#define LOBELIA_INLINE HWY_ATTR __attribute__((always_inline))
#endif

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace fused {

/// Pixels that go through one loop after the other. A single loop from ray to colour would wait for its own roots
/// and divisions, because a processor looks only about a hundred instructions ahead, less than one round of it. The
/// values between the loops fit in the first-level cache.
constexpr int kStretch = 128;

/// A value for each pixel of a stretch. One cache line longer, so that no two start at the same place in a page.
struct Values {
  HWY_ALIGN double at[kStretch + 8];
  HWY_INLINE Lanes load(int i) const { return Lanes::load(at + i); }
  HWY_INLINE void store(int i, Lanes a) { a.store(at + i); }
};
struct Vectors {
  Values x, y, z;
  HWY_INLINE Lanes3 load(int i) const { return {x.load(i), y.load(i), z.load(i)}; }
  HWY_INLINE void store(int i, Lanes3 a) {
    x.store(i, a.x);
    y.store(i, a.y);
    z.store(i, a.z);
  }
};
struct Stretch {
  Vectors to_eye;
  Vectors normal;  ///< 0 where the sphere is not seen, so that no light is reflected
  Values s, n_dot_l;
  HWY_ALIGN float s32[kStretch + 16];
  Vectors to_light;  ///< of a point light
  Values falloff;    ///< of a point light
  Values fresnel;
  Vectors sum;  ///< red, green, blue, where there are several lights
};

/// to_eye_of_ray (geometry-inl.hpp) in two loops, up to the division and after it.
inline void trace_rays(const FusedRow& row, int begin, int count, Stretch& stretch) {
  const Lanes3 forward = broadcast(row.forward), right = broadcast(row.right);
  const Lanes3 v_up = broadcast(row.v_up);
  const double* columns = row.columns + begin;
  const Starts floats;
  for (int i = 0; i < count; i += int(Lanes::count())) {
    const Lanes3 along = add_scaled(Lanes::load(columns + i), right, forward) + v_up;
    const Lanes squared = dot(along, along);
    stretch.s.store(i, squared);
    hn::StoreU(start_of_inverse_sqrt(squared), floats, stretch.s32 + i);
  }
  for (int i = 0; i < count; i += int(Lanes::count())) {
    const Lanes3 along = add_scaled(Lanes::load(columns + i), right, forward) + v_up;
    const Lanes scale = refine_inverse_sqrt(stretch.s.load(i), hn::LoadU(floats, stretch.s32 + i));
    stretch.to_eye.store(i, -scale * along);
  }
}

template <bool kRivals>
void meet_sphere(const FusedSphere& sphere, std::span<const FusedRival> rivals, int count,
                 Stretch& stretch) {
  const Lanes3 to_center = broadcast(sphere.center - sphere.eye);
  const Lanes radius(sphere.radius), minus_inverse_radius(-1 / sphere.radius);
  for (int i = 0; i < count; i += int(Lanes::count())) {
    const Lanes3 to_eye = stretch.to_eye.load(i);
    Lanes3 off_axis;
    Lanes half, distance;
    Mask hit = chord(to_center, radius, to_eye, off_axis, half, distance);
    if constexpr (kRivals) {
      for (const FusedRival& rival : rivals) {
        Lanes3 other_off_axis;
        Lanes other_half, other_distance;
        const Mask other = chord(broadcast(rival.center - sphere.eye), Lanes(rival.radius), to_eye,
                                 other_off_axis, other_half, other_distance);
        const Mask nearer = rival.wins_ties ? hn::Le(other_distance.v, distance.v)
                                            : hn::Lt(other_distance.v, distance.v);
        hit = hn::AndNot(hn::And(other, nearer), hit);
      }
    }
    const Lanes3 normal = normal_of_chord(minus_inverse_radius, to_eye, off_axis, half);
    stretch.normal.store(
        i, {Lanes(hn::IfThenElseZero(hit, normal.x.v)), Lanes(hn::IfThenElseZero(hit, normal.y.v)),
            Lanes(hn::IfThenElseZero(hit, normal.z.v))});
  }
}

inline void reach_point_light(const FusedSphere& sphere, const FusedLight& light, int count,
                              Stretch& stretch) {
  const Lanes3 center = broadcast(sphere.center), position = broadcast(light.vector);
  const Lanes radius(sphere.radius);
  for (int i = 0; i < count; i += int(Lanes::count())) {
    Lanes3 to_light;
    Lanes falloff, distance;
    to_point_light(position, add_scaled(radius, stretch.normal.load(i), center), to_light, falloff,
                   distance);
    stretch.to_light.store(i, to_light);
    stretch.falloff.store(i, falloff);
  }
}

/// Computes s and N.L for one light.
template <LobeAngle kAngle, Precision kPrecision, bool kDirectional>
void find_angles(const FusedLight& light, int count, Stretch& stretch) {
  Lanes3 l_low = broadcast(light.vector), l_high = l_low;
  const int lanes = int(Lanes::count());
  for (int i = 0; i < count; i += 2 * lanes) {
    const int j = i + lanes;
    const Lanes3 n_low = stretch.normal.load(i), n_high = stretch.normal.load(j);
    const Lanes3 v_low = stretch.to_eye.load(i), v_high = stretch.to_eye.load(j);
    if constexpr (!kDirectional) {
      l_low = stretch.to_light.load(i);
      l_high = stretch.to_light.load(j);
    }
    stretch.n_dot_l.store(i, dot(n_low, l_low));
    stretch.n_dot_l.store(j, dot(n_high, l_high));
    if constexpr (kPrecision == Precision::kFloat32) {
      one_minus_cos<kAngle, Lanes32>(narrow(n_low, n_high), narrow(v_low, v_high),
                                     narrow(l_low, l_high))
          .store(stretch.s32 + i);
    } else {
      const Lanes low = one_minus_cos<kAngle, Lanes>(n_low, v_low, l_low);
      const Lanes high = one_minus_cos<kAngle, Lanes>(n_high, v_high, l_high);
      if constexpr (kPrecision == Precision::kMixed) {
        narrow(low, high).store(stretch.s32 + i);
      } else {
        stretch.s.store(i, low);
        stretch.s.store(j, high);
      }
    }
  }
}

inline void find_fresnel(const FusedLight& light, int count, Stretch& stretch) {
  for (int i = 0; i < count; i += int(Lanes::count())) {
    const Lanes3 to_light =
        light.is_directional ? broadcast(light.vector) : stretch.to_light.load(i);
    stretch.fresnel.store(i, schlick_weight(stretch.to_eye.load(i), to_light));
  }
}

struct Rgb3 {
  Lanes r, g, b;
  // Not left to the compiler, which would not compile it for this instruction set.
  HWY_INLINE Rgb3() {}
  HWY_INLINE void set(Lanes weight, Rgb colour) {
    r = weight * Lanes(colour.r);
    g = weight * Lanes(colour.g);
    b = weight * Lanes(colour.b);
  }
  HWY_INLINE void add(Lanes weight, Rgb colour) {
    r = r + weight * Lanes(colour.r);
    g = g + weight * Lanes(colour.g);
    b = b + weight * Lanes(colour.b);
  }
  HWY_INLINE void load(const Vectors& from, int i) {
    r = from.x.load(i);
    g = from.y.load(i);
    b = from.z.load(i);
  }
  HWY_INLINE void store(Vectors& to, int i) const {
    to.x.store(i, r);
    to.y.store(i, g);
    to.z.store(i, b);
  }
};

/// Writes two registers of pixels to the picture.
HWY_INLINE void write(const Rgb3& low, const Rgb3& high, bool adds, float* rgb) {
  const hn::ScalableTag<float> d;
  using Floats = hn::Vec<hn::ScalableTag<float>>;
  Floats r = narrow(low.r, high.r).v, g = narrow(low.g, high.g).v, b = narrow(low.b, high.b).v;
  if (adds) {
    // Each pixel shows one sphere; the others add 0.
    Floats r0, g0, b0;
    hn::LoadInterleaved3(d, rgb, r0, g0, b0);
    r = hn::Add(r0, r), g = hn::Add(g0, g), b = hn::Add(b0, b);
  }
  hn::StoreInterleaved3(r, g, b, d, rgb);
}

/// The same where red, green and blue are one number.
HWY_INLINE void write_grey(Lanes low, Lanes high, double colour, float* rgb) {
  const auto grey = narrow(low * Lanes(colour), high * Lanes(colour)).v;
  hn::StoreInterleaved3(grey, grey, grey, hn::ScalableTag<float>(), rgb);
}

using FindAngles = void (*)(const FusedLight&, int, Stretch&);

/// By precision, then by whether the light is directional.
template <LobeAngle kAngle>
constexpr FindAngles kFindAngles[3][2] = {
    {&find_angles<kAngle, Precision::kFloat32, false>,
     &find_angles<kAngle, Precision::kFloat32, true>},
    {&find_angles<kAngle, Precision::kMixed, false>, &find_angles<kAngle, Precision::kMixed, true>},
    {&find_angles<kAngle, Precision::kFloat64, false>,
     &find_angles<kAngle, Precision::kFloat64, true>}};

/// `kOrder` is the k of a family of lobes if it is compiled in, otherwise 0; `Real` is the type of the lobe's
/// arithmetic.
template <class L, int kOrder, class Real, bool kForeshortened, bool kDiffuse, bool kFresnel>
class Kernel final : public FusedKernel {
 public:
  explicit Kernel(const FusedSphere& sphere)
      : sphere_(sphere), lobe_({sphere.highlight.exponent, sphere.highlight.lobe.order}) {
    const auto& table = info(sphere.highlight.model).angle == LobeAngle::kReflection
                            ? kFindAngles<LobeAngle::kReflection>
                            : kFindAngles<LobeAngle::kHalfVector>;
    for (const FusedLight& light : sphere.lights)
      find_angles_.push_back(table[std::size_t(sphere.precision)][light.is_directional]);
  }

  void render(const FusedRow& row, int begin, int end,
              std::span<const FusedRival> rivals) const override {
    Stretch stretch;
    for (int first = begin; first < end; first += kStretch) {
      const int count = std::min(kStretch, end - first);
      trace_rays(row, first, count, stretch);
      if (rivals.empty())
        meet_sphere<false>(sphere_, rivals, count, stretch);
      else
        meet_sphere<true>(sphere_, rivals, count, stretch);
      shade(count, !rivals.empty(), row.rgb + 3 * first, stretch);
    }
  }

 private:
  void shade(int count, bool adds, float* rgb, Stretch& stretch) const {
    const std::size_t lights = sphere_.lights.size();
    const int whole = (count + kFusedBlock - 1) / kFusedBlock * kFusedBlock;
    for (std::size_t l = 0; l < lights; ++l) {
      const FusedLight& light = sphere_.lights[l];
      if (!light.is_directional) reach_point_light(sphere_, light, whole, stretch);
      find_angles_[l](light, whole, stretch);
      if constexpr (kFresnel) find_fresnel(light, whole, stretch);
      const bool first = l == 0, last = l + 1 == lights;
      if (first && last) return colour<true>(light, count, true, adds, rgb, stretch);
      colour<false>(light, whole, first, false, nullptr, stretch);
    }
    in_blocks(count, rgb, [&](int i, float* to) LOBELIA_INLINE {
      Rgb3 low, high;
      if (lights > 0) {
        low.load(stretch.sum, i);
        high.load(stretch.sum, i + int(Lanes::count()));
      } else {
        low.set(Lanes(0.0), {});
        high.set(Lanes(0.0), {});
      }
      write(low, high, adds, to);
    });
  }

  /// block(i, target of pixel i's floats) for whole registers; the rest of a row goes through a buffer.
  template <class Block>
  static HWY_INLINE void in_blocks(int count, float* rgb, Block block) {
    const int pixels = int(Lanes32::count());
    const int whole = count / pixels * pixels, over = 3 * (count - whole);
    HWY_ALIGN float rest[3 * kFusedBlock];
    if (over > 0) std::copy_n(rgb + 3 * whole, over, rest);
    for (int i = 0; i < count; i += pixels) block(i, i < whole ? rgb + 3 * i : rest);
    if (over > 0) std::copy_n(rest, over, rgb + 3 * whole);
  }

  /// Adds the light of one lamp, to the picture if it is the only one, otherwise to the sums.
  template <bool kOnly>
  void colour(const FusedLight& light, int count, bool first, bool adds, float* rgb,
              Stretch& stretch) const {
    // Copies, so that their numbers stay in registers while the picture is written.
    L lobe = lobe_;
    if constexpr (kOrder != 0) lobe.k = kOrder;
    const Rgb specular = light.specular, grazing = light.grazing, diffuse = light.diffuse;
    const bool falls_off = !light.is_directional;
    const bool is_grey = kOnly && !kFresnel && !kDiffuse && !adds && specular.r == specular.g &&
                         specular.g == specular.b;
    const int lanes = int(Lanes::count());
    const auto block = [&](int i, float* to) LOBELIA_INLINE {
      Rgb3 low, high;
      if (!kOnly && !first) {
        low.load(stretch.sum, i);
        high.load(stretch.sum, i + lanes);
      }
      Lanes value_low, value_high;
      if constexpr (std::is_same_v<Real, float>) {
        widen(lobe.value(Lanes32::load(stretch.s32 + i)), value_low, value_high);
      } else {
        value_low = lobe.value(stretch.s.load(i));
        value_high = lobe.value(stretch.s.load(i + lanes));
      }
      const auto lit = [&](int at, Lanes value) LOBELIA_INLINE {
        const Lanes n_dot_l = stretch.n_dot_l.load(at);
        if constexpr (kForeshortened) value = value * n_dot_l;
        value = where_less(Lanes(0.0), n_dot_l, value);
        if (falls_off) value = stretch.falloff.load(at) * value;
        return value.v;
      };
      value_low = Lanes(lit(i, value_low));
      value_high = Lanes(lit(i + lanes, value_high));
      if (is_grey) return write_grey(value_low, value_high, specular.r, to);
      const auto add = [&](int at, Lanes value, Rgb3& sum) LOBELIA_INLINE {
        if (kOnly || first)
          sum.set(value, specular);
        else
          sum.add(value, specular);
        if constexpr (kFresnel) sum.add(value * stretch.fresnel.load(at), grazing);
        if constexpr (kDiffuse) {
          Lanes cosine = positive_part(stretch.n_dot_l.load(at));
          if (falls_off) cosine = stretch.falloff.load(at) * cosine;
          sum.add(cosine, diffuse);
        }
      };
      add(i, value_low, low);
      add(i + lanes, value_high, high);
      if constexpr (kOnly) {
        write(low, high, adds, to);
      } else {
        low.store(stretch.sum, i);
        high.store(stretch.sum, i + lanes);
      }
    };
    if constexpr (kOnly) {
      in_blocks(count, rgb, block);
    } else {
      for (int i = 0; i < count; i += 2 * lanes) block(i, nullptr);
    }
  }

  FusedSphere sphere_;
  std::vector<FindAngles> find_angles_;
  L lobe_;
};

using KernelPointer = std::unique_ptr<const FusedKernel>;

template <class L, int kOrder, class Real, bool kDiffuse, bool kFresnel>
KernelPointer make_of_model(const FusedSphere& sphere) {
  if (info(sphere.highlight.model).applies_cosine)
    return std::make_unique<Kernel<L, kOrder, Real, true, kDiffuse, kFresnel>>(sphere);
  return std::make_unique<Kernel<L, kOrder, Real, false, kDiffuse, kFresnel>>(sphere);
}

/// The order that is compiled in, for speed: the paper's.
template <class L>
inline constexpr int kUsualOrder = std::size(L::kOrders) > 0 ? 16 : 0;

template <class L, bool kDiffuse, bool kFresnel>
KernelPointer make_of_lobe(const FusedSphere& sphere) {
  if (constexpr int kOrder = kUsualOrder<L>; kOrder != 0 && sphere.highlight.lobe.order == kOrder &&
                                             sphere.precision != Precision::kFloat64)
    return make_of_model<L, kOrder, float, kDiffuse, kFresnel>(sphere);
  if (sphere.precision == Precision::kFloat64)
    return make_of_model<L, 0, double, kDiffuse, kFresnel>(sphere);
  return make_of_model<L, 0, float, kDiffuse, kFresnel>(sphere);
}

template <bool kDiffuse, bool kFresnel>
KernelPointer make(const FusedSphere& sphere) {
  using Make = KernelPointer (*)(const FusedSphere&);
  static constexpr auto kTable = map_types<Make>(
      Lobes{}, []<class L>() -> Make { return &make_of_lobe<L, kDiffuse, kFresnel>; });
  return kTable.at(sphere.highlight.lobe.index)(sphere);
}

}  // namespace fused
}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target guard

// The fused kernel. It does the same operations as the kernels of kernels.cpp one after the other, so its pictures
// are the same bit for bit. The constants of a row or a picture are computed once.
#include "renderer/kernels/fused.hpp"

#include <functional>

// As in kernels.cpp: a debug build keeps to the baseline.
#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/kernels/fused.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "renderer/kernels/geometry-inl.hpp"
#include "renderer/lobes/catalogue.hpp"
#include "renderer/models/catalogue.hpp"
#include "renderer/models/lobe_angle.hpp"
#include "renderer/models/smith.hpp"

/// For a lambda that is inlined into its caller's loop, with the caller's instructions.
#ifndef LOBELIA_INLINE
#define LOBELIA_INLINE HWY_ATTR __attribute__((always_inline))
#endif

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace {

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
  Values value;  ///< of the lobe, times shadowing
  HWY_ALIGN float s32[kStretch + 16];
  Vectors to_light;  ///< of a point light
  Values falloff;    ///< of a point light
  Values fresnel;
  Vectors sum;  ///< red, green, blue, where there are several lights
};

/// to_eye_of_ray (geometry-inl.hpp) in two loops, up to the division and after it.
void trace_rays(const FusedRow& row, int begin, int count, Stretch& stretch) {
  const Lanes3 forward = broadcast(row.forward), right = broadcast(row.right);
  const Lanes3 v_up = broadcast(row.v_up);
  const double* columns = row.columns + begin;
  const int lanes = int(Lanes::count());
  const auto squared_at = [&](int i) LOBELIA_INLINE {
    const Lanes3 along = add_scaled(Lanes::load(columns + i), right, forward) + v_up;
    return dot(along, along).v;
  };
  // Two registers of doubles make one of floats, of which a root takes no longer than of half of it.
  for (int i = 0; i < count; i += 2 * lanes) {
    const Lanes low(squared_at(i)), high(squared_at(i + lanes));
    stretch.s.store(i, low);
    stretch.s.store(i + lanes, high);
    starts_of_inverse_sqrt(low, high).store(stretch.s32 + i);
  }
  const Starts floats;
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

void reach_point_light(const FusedSphere& sphere, const FusedLight& light, int count,
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

void apply_shadowing(double alpha_squared, int count, Stretch& stretch) {
  for (int i = 0; i < count; i += int(Lanes::count())) {
    const Lanes n_dot_v = dot(stretch.normal.load(i), stretch.to_eye.load(i));
    stretch.value.store(
        i, stretch.value.load(i) * smith_factor(alpha_squared, stretch.n_dot_l.load(i), n_dot_v));
  }
}

void find_fresnel(const FusedLight& light, int count, Stretch& stretch) {
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

/// Writes the value of the lobe at each s.
using EvaluateLobe = std::function<void(int count, Stretch&)>;

/// `kOrder` is the k of a family of lobes if it is compiled in, otherwise 0; `Real` is the type of the lobe's
/// arithmetic.
template <class L, int kOrder, class Real>
EvaluateLobe evaluate_lobe(const Highlight& highlight) {
  const L made(LobeParameters{highlight});
  return [made](int count, Stretch& stretch) HWY_ATTR {
    // A copy, so that its numbers stay in registers while values are written.
    L lobe = made;
    if constexpr (kOrder != 0) lobe.k = kOrder;
    const int lanes = int(Lanes::count());
    for (int i = 0; i < count; i += 2 * lanes) {
      Lanes low, high;
      if constexpr (std::is_same_v<Real, float>) {
        widen(lobe.value(Lanes32::load(stretch.s32 + i)), low, high);
      } else {
        low = lobe.value(stretch.s.load(i));
        high = lobe.value(stretch.s.load(i + lanes));
      }
      stretch.value.store(i, low);
      stretch.value.store(i + lanes, high);
    }
  };
}

template <class L>
EvaluateLobe evaluate_at(const Highlight& highlight, Precision precision) {
  constexpr int kUsualOrder = [] {
    if constexpr (LobeFamily<L>) return L::kUsualOrder;
    return 0;
  }();
  if (precision == Precision::kFloat64) return evaluate_lobe<L, 0, double>(highlight);
  if (highlight.lobe.order == kUsualOrder) return evaluate_lobe<L, kUsualOrder, float>(highlight);
  return evaluate_lobe<L, 0, float>(highlight);
}

/// block(i, target of pixel i's floats) for whole registers; the rest of a row goes through a buffer.
template <class Block>
HWY_INLINE void in_blocks(int count, float* rgb, Block block) {
  const int pixels = int(Lanes32::count());
  const int whole = count / pixels * pixels, over = 3 * (count - whole);
  HWY_ALIGN float rest[3 * kFusedBlock];
  if (over > 0) std::copy_n(rgb + 3 * whole, over, rest);
  for (int i = 0; i < count; i += pixels) block(i, i < whole ? rgb + 3 * i : rest);
  if (over > 0) std::copy_n(rest, over, rgb + 3 * whole);
}

/// Where a light's colour goes.
struct Target {
  bool first;  ///< it is the first light: the sums are not to be read
  bool adds;   ///< to the picture's pixels
  float* rgb;  ///< the picture
};

/// Adds the light of one lamp, to the picture if it is the only one, otherwise to the sums.
template <bool kOnly, bool kForeshortened, bool kDiffuse, bool kFresnel>
void colour(const FusedLight& light, int count, const Target& target, Stretch& stretch) {
  // Copies, so that their numbers stay in registers while the picture is written.
  const Rgb specular = light.specular, grazing = light.grazing, diffuse = light.diffuse;
  const bool falls_off = !light.is_directional, first = target.first, adds = target.adds;
  const bool is_grey = kOnly && !kFresnel && !kDiffuse && !adds && specular.r == specular.g &&
                       specular.g == specular.b;
  const int lanes = int(Lanes::count());
  const auto block = [&](int i, float* to) LOBELIA_INLINE {
    Rgb3 low, high;
    if (!kOnly && !first) {
      low.load(stretch.sum, i);
      high.load(stretch.sum, i + lanes);
    }
    const auto lit = [&](int at) LOBELIA_INLINE {
      const Lanes n_dot_l = stretch.n_dot_l.load(at);
      Lanes value = stretch.value.load(at);
      if constexpr (kForeshortened) value = value * n_dot_l;
      value = where_less(Lanes(0.0), n_dot_l, value);
      if (falls_off) value = stretch.falloff.load(at) * value;
      return value.v;
    };
    const Lanes value_low(lit(i)), value_high(lit(i + lanes));
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
    in_blocks(count, target.rgb, block);
  } else {
    for (int i = 0; i < count; i += 2 * lanes) block(i, nullptr);
  }
}

using Colour = void (*)(const FusedLight&, int count, const Target&, Stretch&);

/// By whether the model is foreshortened, and whether there is a diffuse base and a Fresnel factor.
template <bool kOnly>
constexpr Colour kColours[2][2][2] = {
    {{&colour<kOnly, false, false, false>, &colour<kOnly, false, false, true>},
     {&colour<kOnly, false, true, false>, &colour<kOnly, false, true, true>}},
    {{&colour<kOnly, true, false, false>, &colour<kOnly, true, false, true>},
     {&colour<kOnly, true, true, false>, &colour<kOnly, true, true, true>}}};

class Kernel final : public FusedKernel {
 public:
  explicit Kernel(const FusedSphere& sphere) : sphere_(sphere) {
    using Evaluate = EvaluateLobe (*)(const Highlight&, Precision);
    static constexpr auto kLobes =
        map_types<Evaluate>(LobesById{}, []<class L>() -> Evaluate { return &evaluate_at<L>; });
    evaluate_lobe_ = kLobes.at(sphere.highlight.lobe.index)(sphere.highlight, sphere.precision);
    const ModelInfo& model = info(sphere.highlight.model);
    const auto& angles = model.angle == LobeAngle::kReflection
                             ? kFindAngles<LobeAngle::kReflection>
                             : kFindAngles<LobeAngle::kHalfVector>;
    for (const FusedLight& light : sphere.lights)
      find_angles_.push_back(angles[std::size_t(sphere.precision)][light.is_directional]);
    const auto& colours = sphere.lights.size() == 1 ? kColours<true> : kColours<false>;
    has_shadowing_ = model.has_shadowing;
    colour_ = colours[model.applies_cosine][sphere.diffuse][sphere.fresnel];
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
      evaluate_lobe_(whole, stretch);
      if (has_shadowing_)
        apply_shadowing(alpha_squared(sphere_.highlight.exponent), whole, stretch);
      if (sphere_.fresnel) find_fresnel(light, whole, stretch);
      colour_(light, lights == 1 ? count : whole, {l == 0, adds, rgb}, stretch);
    }
    if (lights == 1) return;
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

  FusedSphere sphere_;
  std::vector<FindAngles> find_angles_;
  EvaluateLobe evaluate_lobe_;
  bool has_shadowing_;
  Colour colour_;
};

std::unique_ptr<const FusedKernel> make_kernel(const FusedSphere& sphere) {
  return std::make_unique<Kernel>(sphere);
}

}  // namespace
}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {

HWY_EXPORT(make_kernel);

std::unique_ptr<const FusedKernel> make_fused_kernel(const FusedSphere& sphere) {
  return HWY_DYNAMIC_DISPATCH(make_kernel)(sphere);
}

}  // namespace lobelia
#endif

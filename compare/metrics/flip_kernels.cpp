#include "compare/metrics/flip_kernels.hpp"

// As in renderer/kernels/kernels.cpp: a debug build keeps to the baseline.
#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compare/metrics/flip_kernels.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "compare/metrics/lanes-inl.hpp"

// The order of operations follows the formulas of the paper and the tool. Products and sums are rounded separately
// (Mul and Add, never MulAdd). Any other order changes the last digits.
HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
using Floats = hn::CappedTag<float, kFlipBlock>;
using Lanes = hn::Vec<Floats>;

struct Triple {
  Lanes x, y, z;
};

/// A row of a constant matrix.
struct Row {
  float x, y, z;
};

HWY_INLINE Lanes set(float x) { return hn::Set(Floats(), x); }

HWY_INLINE Lanes product(Row row, const Triple& v) {
  return hn::Add(hn::Add(hn::Mul(set(row.x), v.x), hn::Mul(set(row.y), v.y)),
                 hn::Mul(set(row.z), v.z));
}

// ---- powers

using Doubles = hn::Repartition<double, Floats>;
HWY_INLINE hn::Vec<Doubles> lower(Lanes v) {
  return hn::PromoteTo(Doubles(), hn::LowerHalf(hn::Half<Floats>(), v));
}
HWY_INLINE hn::Vec<Doubles> upper(Lanes v) {
  return hn::PromoteTo(Doubles(), hn::UpperHalf(hn::Half<Floats>(), v));
}
HWY_INLINE Lanes rounded(hn::Vec<Doubles> low, hn::Vec<Doubles> high) {
  const hn::Half<Floats> half;
  return hn::Combine(Floats(), hn::DemoteTo(half, high), hn::DemoteTo(half, low));
}

/// x^y, computed in double and rounded. Every processor gives the same float, and all but one in thousands equal
/// a good std::pow's. x >= 0; 0^y is 0.
HWY_INLINE Lanes power(Lanes x, Lanes y) {
  const auto half = [](auto base, auto exponent) HWY_ATTR {
    return pow(LanesOf<Doubles>(base), LanesOf<Doubles>(exponent)).v;
  };
  return rounded(half(lower(x), lower(y)), half(upper(x), upper(y)));
}

/// t^(1/3), the exponent rounded to float, for t in [0.008, 2]: the result of power() in a quarter of its time.
HWY_INLINE Lanes cube_root(Lanes t) {
  // z = t^(-1/3): begins with a third of t's bits and is refined to 2e-7 without a division.
  const hn::RebindToSigned<Floats> integers;
  const Lanes bits = hn::ConvertTo(Floats(), hn::BitCast(integers, t));
  Lanes z = hn::BitCast(
      Floats(), hn::ConvertTo(integers, hn::Sub(set(1.4199e9f), hn::Mul(bits, set(1.0f / 3)))));
  const auto rest = [t](Lanes root) HWY_ATTR {
    return hn::Sub(set(1), hn::Mul(hn::Mul(t, root), hn::Mul(root, root)));
  };
  Lanes h = rest(z);
  z = hn::Add(z, hn::Mul(hn::Mul(z, h), hn::Add(set(1.0f / 3), hn::Mul(set(2.0f / 9), h))));
  h = rest(z);
  z = hn::Add(z, hn::Mul(hn::Mul(z, h), set(1.0f / 3)));
  // t^(rounded - 1/3) = 1 + (rounded - 1/3) ln t. The bits approximate the logarithm well enough.
  constexpr double kExcess = double(1.0f / 3) - 1.0 / 3, kLn2 = 0.6931471805599453;
  const Lanes excess =
      hn::Mul(hn::Sub(bits, set(1065009152.0f)), set(float(kExcess * kLn2 / (1 << 23))));
  // t z^2 is the root; the last step in double.
  const auto last = [](auto t2, auto z2, auto excess2) HWY_ATTR {
    const Doubles d;
    const auto square = hn::Mul(z2, z2), root = hn::Mul(t2, square);
    const auto h2 = hn::Sub(hn::Set(d, 1), hn::Mul(root, z2));
    const auto step = hn::Add(hn::Mul(h2, hn::Set(d, 2.0 / 3)), excess2);
    return hn::Add(root, hn::Mul(root, step));
  };
  return rounded(last(lower(t), lower(z), lower(excess)), last(upper(t), upper(z), upper(excess)));
}

// ---- colour spaces

// D65 in the tool: the row sums of its matrix, and their reciprocals.
constexpr Row kWhite{0.950428545f, 1.0f, 1.088900371f};
constexpr Row kInverseWhite{1.052156925f, 1.0f, 0.918357670f};

HWY_INLINE Triple relative_xyz_from_rgb(const Triple& rgb) {
  constexpr float kX = 24577794.0f, kY = 12288897.0f, kZ = 73733382.0f;
  constexpr Row kRowX{10135552.0f / kX, 8788810.0f / kX, 4435075.0f / kX};
  constexpr Row kRowY{2613072.0f / kY, 8788810.0f / kY, 887015.0f / kY};
  constexpr Row kRowZ{1425312.0f / kZ, 8788810.0f / kZ, 70074185.0f / kZ};
  return {hn::Mul(product(kRowX, rgb), set(kInverseWhite.x)), product(kRowY, rgb),
          hn::Mul(product(kRowZ, rgb), set(kInverseWhite.z))};
}

HWY_INLINE Triple rgb_from_relative_xyz(const Triple& xyz) {
  constexpr Row kRowR{3.241003275f, -1.537398934f, -0.498615861f};
  constexpr Row kRowG{-0.969224334f, 1.875930071f, 0.041554224f};
  constexpr Row kRowB{0.055639423f, -0.204011202f, 1.057148933f};
  const Triple v{hn::Mul(xyz.x, set(kWhite.x)), xyz.y, hn::Mul(xyz.z, set(kWhite.z))};
  return {product(kRowR, v), product(kRowG, v), product(kRowB, v)};
}

/// L, a, b with less chroma in the dark (the Hunt effect).
HWY_INLINE Triple hunt_lab(const Triple& rgb) {
  const auto f = [](Lanes t) HWY_ATTR {
    constexpr float kDelta = 6.0f / 29.0f;
    const Lanes line =
        hn::Add(hn::Mul(set(1.0f / (3.0f * (kDelta * kDelta))), t), set(4.0f / 29.0f));
    return hn::IfThenElse(hn::Gt(t, set(kDelta * (kDelta * kDelta))), cube_root(t), line);
  };
  const Triple xyz = relative_xyz_from_rgb(rgb);
  const Lanes fx = f(xyz.x), fy = f(xyz.y), fz = f(xyz.z);
  const Lanes l = hn::Sub(hn::Mul(set(116), fy), set(16)), hunt = hn::Mul(set(0.01f), l);
  return {l, hn::Mul(hunt, hn::Mul(set(500), hn::Sub(fx, fy))),
          hn::Mul(hunt, hn::Mul(set(200), hn::Sub(fy, fz)))};
}

/// A filtered colour, clipped to what a display can show.
HWY_INLINE Triple shown_rgb(Lanes y, Lanes cx, Lanes cz) {
  const Lanes yy = hn::Div(hn::Add(y, set(16)), set(116));
  const Triple rgb = rgb_from_relative_xyz(
      {hn::Add(yy, hn::Div(cx, set(500))), yy, hn::Sub(yy, hn::Div(cz, set(200)))});
  const auto clamped = [](Lanes v) HWY_ATTR { return hn::Min(hn::Max(v, set(0)), set(1)); };
  return {clamped(rgb.x), clamped(rgb.y), clamped(rgb.z)};
}

/// Section 4.1.3: HyAB distance, raised to 0.7.
HWY_INLINE Lanes distance(const Triple& a, const Triple& b) {
  const Lanes da = hn::Sub(a.y, b.y), db = hn::Sub(a.z, b.z);
  const Lanes chroma = hn::Sqrt(hn::Add(hn::Mul(da, da), hn::Mul(db, db)));
  return power(hn::Add(hn::Abs(hn::Sub(a.x, b.x)), chroma), set(0.7f));
}

// ---- filters

/// Sums for kVectors registers of values, from the i-th on. The sums stay in registers: memory would cost a load and
/// a store for every weight.
template <std::size_t kSums, std::size_t kVectors, class D>
HWY_INLINE void sum_at(D d, const WeightedSum* sums, const float* const* rows, std::size_t i) {
  const std::size_t lanes = hn::Lanes(d), count = sums[0].weights.size();
  hn::Vec<D> sum[kSums][kVectors];
  for (auto& of_vectors : sum)
    for (auto& lane_sums : of_vectors) lane_sums = hn::Zero(d);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t v = 0; v < kVectors; ++v) {
      const auto in = hn::LoadU(d, rows[k] + i + v * lanes);
      for (std::size_t s = 0; s < kSums; ++s)
        sum[s][v] = hn::Add(sum[s][v], hn::Mul(hn::Set(d, sums[s].weights[k]), in));
    }
  for (std::size_t s = 0; s < kSums; ++s)
    for (std::size_t v = 0; v < kVectors; ++v)
      hn::StoreU(sum[s][v], d, sums[s].out + i + v * lanes);
}

template <std::size_t kSums>
HWY_INLINE void sum_all(const WeightedSum* sums, const float* const* rows, std::size_t size) {
  // At least four sums, to hide the latency of an addition; no more than there are registers.
  constexpr std::size_t kVectors = kSums == 1 ? 4 : 2;
  const hn::ScalableTag<float> d;
  const hn::CappedTag<float, 1> single;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + kVectors * lanes <= size; i += kVectors * lanes)
    sum_at<kSums, kVectors>(d, sums, rows, i);
  for (; i + lanes <= size; i += lanes) sum_at<kSums, 1>(d, sums, rows, i);
  for (; i < size; ++i) sum_at<kSums, 1>(single, sums, rows, i);
}

void weighted_sums_lanes(std::span<const WeightedSum> sums, const float* const* rows,
                         std::size_t size) {
  if (sums.size() == 1) sum_all<1>(sums.data(), rows, size);
  if (sums.size() == 2) sum_all<2>(sums.data(), rows, size);
  if (sums.size() == 3) sum_all<3>(sums.data(), rows, size);
}

// ---- the error

/// Section 4.1.4: distances above 0.4 of the largest are compressed into errors above 0.95.
HWY_INLINE Lanes colour_error(Lanes d, float largest) {
  constexpr float kErrorAtKnee = 0.95f;
  const float knee = 0.4f * largest;
  const Lanes below = hn::Mul(d, set(kErrorAtKnee / knee));
  const Lanes above = hn::Add(
      set(kErrorAtKnee),
      hn::Mul(hn::Div(hn::Sub(d, set(knee)), set(largest - knee)), set(1.0f - kErrorAtKnee)));
  return hn::IfThenElse(hn::Lt(d, set(knee)), below, above);
}

/// Section 4.2.2: the root of the difference in strength; 1 / sqrt(2) scales it to [0, 1].
HWY_INLINE Lanes feature_difference(Lanes edge_a, Lanes point_a, Lanes edge_b, Lanes point_b) {
  const Lanes edge = hn::Abs(hn::Sub(edge_a, edge_b)), point = hn::Abs(hn::Sub(point_a, point_b));
  return hn::Sqrt(hn::Mul(set(0.70710678f), hn::Max(edge, point)));
}

void colours_lanes(const float* rgb, const FlipColours& out, std::size_t count) {
  const Floats d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    Triple v;
    hn::LoadInterleaved3(d, rgb + 3 * i, v.x, v.y, v.z);
    const Triple xyz = relative_xyz_from_rgb(v);
    const Lanes y = hn::Sub(hn::Mul(set(116), xyz.y), set(16));
    hn::StoreU(y, d, out.y + i);
    hn::StoreU(hn::Mul(set(500), hn::Sub(xyz.x, xyz.y)), d, out.cx + i);
    hn::StoreU(hn::Mul(set(200), hn::Sub(xyz.y, xyz.z)), d, out.cz + i);
    hn::StoreU(hn::Add(hn::Mul(y, set(1.0f / 116.0f)), set(16.0f / 116.0f)), d, out.grey + i);
  }
}

void errors_lanes(const FlipFiltered& a, const FlipFiltered& b, float* errors, std::size_t count) {
  const Floats d;
  // No two colours of a display are farther apart than its green and its blue.
  const Lanes none = set(0), full = set(1);
  const float largest =
      hn::GetLane(distance(hunt_lab({none, full, none}), hunt_lab({none, none, full})));
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto at = [d, i](const float* row) HWY_ATTR { return hn::LoadU(d, row + i); };
    const auto colour = [&](const FlipFiltered& f) HWY_ATTR {
      return hunt_lab(shown_rgb(at(f.y), at(f.cx), hn::Add(at(f.cz_1), at(f.cz_2))));
    };
    const auto strength = [&](const float* across, const float* down) HWY_ATTR {
      const Lanes x = at(across), y = at(down);
      return hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
    };
    const Lanes feature = feature_difference(strength(a.dx, a.dy), strength(a.ddx, a.ddy),
                                             strength(b.dx, b.dy), strength(b.ddx, b.ddy));
    const Lanes error = colour_error(distance(colour(a), colour(b)), largest);
    hn::StoreU(power(error, hn::Sub(set(1), feature)), d, errors + i);
  }
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {

HWY_EXPORT(colours_lanes);
HWY_EXPORT(weighted_sums_lanes);
HWY_EXPORT(errors_lanes);

void flip_colours(const float* rgb, const FlipColours& out, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(colours_lanes)(rgb, out, count);
}

void weighted_sums(std::span<const WeightedSum> sums, const float* const* rows, std::size_t size) {
  HWY_DYNAMIC_DISPATCH(weighted_sums_lanes)(sums, rows, size);
}

void flip_errors(const FlipFiltered& a, const FlipFiltered& b, float* errors, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(errors_lanes)(a, b, errors, count);
}

}  // namespace lobelia
#endif  // HWY_ONCE

// FLIP's colours, and its error from filtered ones. Compiled once for each instruction set, like the files that include it.
#include <hwy/highway.h>

#include "compare/metrics/flip_filters.hpp"

#if defined(LOBELIA_COMPARE_METRICS_FLIP_PIXELS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LOBELIA_COMPARE_METRICS_FLIP_PIXELS_INL_HPP
#undef LOBELIA_COMPARE_METRICS_FLIP_PIXELS_INL_HPP
#else
#define LOBELIA_COMPARE_METRICS_FLIP_PIXELS_INL_HPP
#endif

#include "compare/metrics/flip_filters-inl.hpp"

// Pictures are filtered in float64, so that differences of almost equal pixels and of almost equal features are not
// rounding noise, which the powers would enlarge. From the differences on, float32 is enough: everything is a product
// with them, so that an error is relative.
HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
using Floats = hn::CappedTag<float, kFlipBlock>;
using Lanes = hn::Vec<Floats>;
using HalfFloats = hn::Half<Floats>;
using Doubles = hn::Rebind<double, HalfFloats>;
using DoubleLanes = hn::Vec<Doubles>;

HWY_INLINE Lanes set(float x) { return hn::Set(Floats(), x); }
HWY_INLINE DoubleLanes wide(double x) { return hn::Set(Doubles(), x); }

/// The coefficients from the constant on.
HWY_INLINE Lanes polynomial(Lanes, float last) { return set(last); }
template <class... More>
HWY_INLINE Lanes polynomial(Lanes x, float first, More... more) {
  return hn::MulAdd(x, polynomial(x, more...), set(first));
}

// ---- logarithms and roots

/// log2(x) to 1.5e-7 of itself or of 1, for x that is not denormal.
HWY_INLINE Lanes log_2(Lanes x) {
  const hn::RebindToSigned<Floats> integers;
  const auto bits = hn::BitCast(integers, x);
  // x = 2^exponent * m, m in [1/sqrt(2), sqrt(2)).
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(integers, 0x3f3504f3)));
  const Lanes m = hn::BitCast(Floats(), hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
  const Lanes s = hn::Div(hn::Sub(m, set(1)), hn::Add(m, set(1))), z = hn::Mul(s, s);
  constexpr double k = 2 / 0.6931471805599453;
  return hn::MulAdd(s,
                    polynomial(z, float(k), float(k / 3), float(k / 5), float(k / 7), float(k / 9)),
                    hn::ConvertTo(Floats(), exponent));
}

/// 2^x to a rounding, for x < 127; below -125 it is 0.
HWY_INLINE Lanes exp_2(Lanes x) {
  const Lanes limited = hn::Max(x, set(-126)), whole = hn::Round(limited);
  const Lanes rest = hn::Mul(hn::Sub(limited, whole), set(0.693147181f));
  const Lanes power = polynomial(rest, 1.0f, 1.0f, 1.0f / 2, 1.0f / 6, 1.0f / 24, 1.0f / 120,
                                 1.0f / 720, 1.0f / 5040);
  const hn::RebindToSigned<Floats> integers;
  const auto scale =
      hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(integers, whole), hn::Set(integers, 127)));
  return hn::IfThenElseZero(hn::Gt(x, set(-125)), hn::Mul(power, hn::BitCast(Floats(), scale)));
}

/// t^(1/3) to a rounding or two, for t in [0.008, 2].
HWY_INLINE Lanes cube_root(Lanes t) {
  // z = t^(-1/3): begins with a third of t's bits and is refined to 2e-7 without a division.
  const hn::RebindToSigned<Floats> integers;
  const Lanes bits = hn::ConvertTo(Floats(), hn::BitCast(integers, t));
  Lanes z = hn::BitCast(
      Floats(), hn::ConvertTo(integers, hn::NegMulAdd(bits, set(1.0f / 3), set(1.4199e9f))));
  // With h = 1 - t z^3, t^(-1/3) = z (1 + h/3 + 2/9 h^2 + 14/81 h^3 + ...). h begins below 0.11.
  const Lanes h = hn::NegMulAdd(hn::Mul(t, z), hn::Mul(z, z), set(1));
  z = hn::MulAdd(hn::Mul(z, h), polynomial(h, 1.0f / 3, 2.0f / 9, 14.0f / 81), z);
  const Lanes root = hn::Mul(t, hn::Mul(z, z));
  return hn::MulAdd(hn::Mul(root, hn::NegMulAdd(root, z, set(1))), set(2.0f / 3), root);
}

// ---- colour spaces

// The tool's matrix to XYZ, relative to white, which is the sum of each row. x - y and y - z of a pixel are sums of
// products with r - g and b - g, so that they are 0 for a grey.
constexpr double kRedY = 2613072.0 / 12288897, kBlueY = 887015.0 / 12288897;
constexpr double kRedCx = 10135552.0 / 23359437 - kRedY, kBlueCx = 4435075.0 / 23359437 - kBlueY;
constexpr double kRedCz = kRedY - 1425312.0 / 80288307, kBlueCz = kBlueY - 70074185.0 / 80288307;
constexpr double kDeterminant = kRedCx * kBlueCz - kBlueCx * kRedCz;

template <class V>
struct Triple {
  V x, y, z;
};

/// Light after the contrast filters, clipped to what a display can show.
HWY_INLINE Triple<DoubleLanes> shown_rgb(DoubleLanes y, DoubleLanes cx, DoubleLanes cz) {
  const auto red = hn::MulAdd(wide(kBlueCz / kDeterminant), cx,
                              hn::Mul(wide(-kBlueCx / kDeterminant), cz)),
             blue = hn::MulAdd(wide(-kRedCz / kDeterminant), cx,
                               hn::Mul(wide(kRedCx / kDeterminant), cz));
  const auto g = hn::NegMulAdd(wide(kRedY), red, hn::NegMulAdd(wide(kBlueY), blue, y));
  const auto clipped = [](DoubleLanes v) HWY_ATTR { return hn::Min(hn::Max(v, wide(0)), wide(1)); };
  return {clipped(hn::Add(g, red)), clipped(g), clipped(hn::Add(g, blue))};
}

/// X, Y and Z of linear light or of a difference.
HWY_INLINE Triple<Lanes> relative_xyz(const Triple<Lanes>& rgb) {
  const Lanes red = hn::Sub(rgb.x, rgb.y), blue = hn::Sub(rgb.z, rgb.y);
  const auto sum = [&](Lanes start, double of_red, double of_blue) HWY_ATTR {
    return hn::MulAdd(set(float(of_red)), red, hn::MulAdd(set(float(of_blue)), blue, start));
  };
  const Lanes y = sum(rgb.y, kRedY, kBlueY);
  return {sum(y, kRedCx, kBlueCx), y, sum(y, -kRedCz, -kBlueCz)};
}

// ---- the error

/// Lab's f() of one coordinate: the sum of both pictures' and their difference, which is `line` + `above` / `roots`.
struct Curve {
  Lanes sum, line, above, roots;
};

/// Exactly the same, but for signs, if the pictures are exchanged.
HWY_INLINE Curve lab_curve(Lanes a, Lanes b, Lanes difference) {
  constexpr float kDelta = 6.0f / 29, kKnee = kDelta * kDelta * kDelta,
                  kSlope = 1 / (3 * kDelta * kDelta);
  // f(t) is the root of the part of t above the knee, and a line of the part below. So is a difference; of roots it
  // is (a - b) / (a^(2/3) + a^(1/3) b^(1/3) + b^(2/3)), which does not cancel.
  const Lanes knee = set(kKnee), none = set(0);
  const Lanes root_a = cube_root(hn::Max(a, knee)), root_b = cube_root(hn::Max(b, knee));
  const Lanes over_a = hn::Sub(a, knee), over_b = hn::Sub(b, knee), roots = hn::Add(root_a, root_b);
  // Exactly the difference if both are above the knee, and 0 if both are below.
  const Lanes above = hn::IfThenElse(hn::Gt(hn::Min(over_a, over_b), none), difference,
                                     hn::Sub(hn::Max(over_a, none), hn::Max(over_b, none)));
  const Lanes below = hn::Add(hn::Min(over_a, none), hn::Min(over_b, none));
  return {hn::MulAdd(set(kSlope), below, roots), hn::Mul(set(kSlope), hn::Sub(difference, above)),
          above, hn::NegMulAdd(root_a, root_b, hn::Mul(roots, roots))};
}

/// Section 4.1.3: HyAB distance of L, a, b with less chroma in the dark (the Hunt effect).
HWY_INLINE Lanes distance(const Triple<Lanes>& rgb_a, const Triple<Lanes>& rgb_b,
                          const Triple<Lanes>& difference) {
  const Triple<Lanes> a = relative_xyz(rgb_a), b = relative_xyz(rgb_b),
                      rise = relative_xyz(difference);
  const Curve x = lab_curve(a.x, b.x, rise.x), y = lab_curve(a.y, b.y, rise.y),
              z = lab_curve(a.z, b.z, rise.z);
  // One division for all three.
  const Lanes x_y = hn::Mul(x.roots, y.roots), inverse = hn::Div(set(1), hn::Mul(x_y, z.roots));
  const auto difference_of = [inverse](const Curve& of, Lanes others) HWY_ATTR {
    return hn::MulAdd(of.above, hn::Mul(inverse, others), of.line);
  };
  const Lanes dx = difference_of(x, hn::Mul(y.roots, z.roots)),
              dy = difference_of(y, hn::Mul(x.roots, z.roots)), dz = difference_of(z, x_y);
  const Lanes dl = hn::Mul(set(116), dy), sum_l = hn::MulAdd(set(116), y.sum, set(-32));
  // A chroma is 0.01 L c (x - y). A difference of products is the sum of one times the difference of the other, and the
  // other way round, halved.
  const auto chroma = [&](float scale, Lanes sum, Lanes difference) HWY_ATTR {
    return hn::Mul(set(scale), hn::MulAdd(dl, sum, hn::Mul(sum_l, difference)));
  };
  const Lanes da = chroma(2.5f, hn::Sub(x.sum, y.sum), hn::Sub(dx, dy)),
              db = chroma(1, hn::Sub(y.sum, z.sum), hn::Sub(dy, dz));
  return hn::Add(hn::Abs(dl), hn::Sqrt(hn::MulAdd(da, da, hn::Mul(db, db))));
}

// No two colours of a display are farther apart than its green and its blue: their HyAB distance. Distances to the power
// of 0.7 above 0.4 of the largest are compressed into errors above 0.95 (section 4.1.4). kKnee = kLargest * 0.4^(1/0.7).
constexpr double kLargest = 203.301654610878, kKnee = kLargest * 0.270093587460062;
constexpr float kPower = 0.7f, kKneeShare = 0.4f, kKneeError = 0.95f, kLogKneeError = -0.074000581f;

/// log2 of the colour's error.
HWY_INLINE Lanes log_of_colour_error(Lanes distance) {
  const Lanes share = hn::Mul(distance, set(float(1 / kKnee)));
  // The logarithm begins at what is 0 in the error.
  const Lanes log = hn::Mul(set(kPower), log_2(hn::Max(share, set(1e-37f))));
  const auto is_above = hn::Gt(share, set(1));
  Lanes result = hn::Add(log, set(kLogKneeError));
  if (!hn::AllFalse(Floats(), is_above)) {
    // The power is d = 2^log of the knee's; above it, 1 + less = 0.95 + 0.05 * (0.4 d - 0.4) / 0.6.
    constexpr float kRise = (1 - kKneeError) * kKneeShare / (1 - kKneeShare);
    const Lanes power = exp_2(hn::Max(log, set(0)));
    const Lanes less = hn::Min(hn::MulAdd(set(kRise), power, set(kKneeError - 1 - kRise)), set(0));
    constexpr float k = 1.44269504f;
    const Lanes log_of_error =
        hn::Mul(less, polynomial(less, k, -k / 2, k / 3, -k / 4, k / 5, -k / 6));
    result = hn::IfThenElse(is_above, log_of_error, result);
  }
  return hn::IfThenElse(hn::Gt(share, set(1e-37f)), result, set(kNoFlip));
}

/// The values of filtered pixels that the float32 part uses.
template <class V>
struct Compared {
  Triple<V> rgb_a, rgb_b, difference;
  V edge_a, edge_b, edge_rise;  ///< squared strengths, and the first less the other
  V point_a, point_b, point_rise;
};

HWY_INLINE Compared<hn::Vec<HalfFloats>> compared(const FlipFiltered& a, const FlipFiltered& b,
                                                  std::size_t row, std::size_t column) {
  const Doubles d;
  const auto at = [&](const auto& values) HWY_ATTR { return hn::LoadU(d, values[row] + column); };
  const auto narrow = [](DoubleLanes v) HWY_ATTR { return hn::DemoteTo(HalfFloats(), v); };
  const Triple<DoubleLanes> rgb_a = shown_rgb(at(a.y), at(a.cx), hn::Add(at(a.cz_1), at(a.cz_2))),
                            rgb_b = shown_rgb(at(b.y), at(b.cx), hn::Add(at(b.cz_1), at(b.cz_2)));
  const auto square = [](DoubleLanes x, DoubleLanes y)
                          HWY_ATTR { return hn::MulAdd(x, x, hn::Mul(y, y)); };
  // a^2 - b^2 without cancellation.
  const auto rise = [](DoubleLanes ax, DoubleLanes ay, DoubleLanes bx, DoubleLanes by) HWY_ATTR {
    return hn::MulAdd(hn::Sub(ax, bx), hn::Add(ax, bx), hn::Mul(hn::Sub(ay, by), hn::Add(ay, by)));
  };
  const auto dx_a = at(a.dx), dy_a = at(a.dy), dx_b = at(b.dx), dy_b = at(b.dy);
  const auto ddx_a = at(a.ddx), ddy_a = at(a.ddy), ddx_b = at(b.ddx), ddy_b = at(b.ddy);
  return {{narrow(rgb_a.x), narrow(rgb_a.y), narrow(rgb_a.z)},
          {narrow(rgb_b.x), narrow(rgb_b.y), narrow(rgb_b.z)},
          {narrow(hn::Sub(rgb_a.x, rgb_b.x)), narrow(hn::Sub(rgb_a.y, rgb_b.y)),
           narrow(hn::Sub(rgb_a.z, rgb_b.z))},
          narrow(square(dx_a, dy_a)),
          narrow(square(dx_b, dy_b)),
          narrow(rise(dx_a, dy_a, dx_b, dy_b)),
          narrow(square(ddx_a, ddy_a)),
          narrow(square(ddx_b, ddy_b)),
          narrow(rise(ddx_a, ddy_a, ddx_b, ddy_b))};
}

/// log2 of FLIP's error of pixels of a row, from `column` on.
HWY_INLINE Lanes log_of_error(const FlipFiltered& a, const FlipFiltered& b, std::size_t row,
                              std::size_t column) {
  const auto low = compared(a, b, row, column),
             high = compared(a, b, row, column + hn::Lanes(Doubles()));
#define LOBELIA_JOINED(MEMBER) hn::Combine(Floats(), high.MEMBER, low.MEMBER)
#define LOBELIA_TRIPLE(MEMBER) \
  { LOBELIA_JOINED(MEMBER.x), LOBELIA_JOINED(MEMBER.y), LOBELIA_JOINED(MEMBER.z) }
  const Triple<Lanes> rgb_a LOBELIA_TRIPLE(rgb_a), rgb_b LOBELIA_TRIPLE(rgb_b),
      difference LOBELIA_TRIPLE(difference);
  // Section 4.2.2: the root of the difference in strength; 1 / sqrt(2) scales it to [0, 1]. Strengths of 1e-15 count
  // for none. A difference of strengths is that of their squares by their sum.
  const auto sum = [](Lanes square_a, Lanes square_b) HWY_ATTR {
    return hn::Max(hn::Add(hn::Sqrt(square_a), hn::Sqrt(square_b)), set(1e-15f));
  };
  const Lanes edges = sum(LOBELIA_JOINED(edge_a), LOBELIA_JOINED(edge_b)),
              points = sum(LOBELIA_JOINED(point_a), LOBELIA_JOINED(point_b));
  const Lanes larger = hn::Max(hn::Mul(hn::Abs(LOBELIA_JOINED(edge_rise)), points),
                               hn::Mul(hn::Abs(LOBELIA_JOINED(point_rise)), edges));
#undef LOBELIA_TRIPLE
#undef LOBELIA_JOINED
  const Lanes feature =
      hn::Sqrt(hn::Div(hn::Mul(set(0.70710678f), larger), hn::Mul(edges, points)));
  const Lanes rest = hn::Max(hn::Sub(set(1), feature), set(1e-6f));
  return hn::Mul(rest, log_of_colour_error(distance(rgb_a, rgb_b, difference)));
}

// ---- whole rows

void colours_lanes(const float* rgb, const FlipColours& out, std::size_t count) {
  const HalfFloats narrow;
  const Doubles d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    hn::Vec<HalfFloats> r, g, b;
    hn::LoadInterleaved3(narrow, rgb + 3 * i, r, g, b);
    const auto green = hn::PromoteTo(d, g), red = hn::Sub(hn::PromoteTo(d, r), green),
               blue = hn::Sub(hn::PromoteTo(d, b), green);
    const auto sum = [&](double of_red, double of_blue) HWY_ATTR {
      return hn::MulAdd(wide(of_red), red, hn::Mul(wide(of_blue), blue));
    };
    hn::StoreU(hn::Add(green, sum(kRedY, kBlueY)), d, out.y + i);
    hn::StoreU(sum(kRedCx, kBlueCx), d, out.cx + i);
    hn::StoreU(sum(kRedCz, kBlueCz), d, out.cz + i);
  }
}

void block_logs_lanes(const FlipFilters& filters, const FlipRows& a, const FlipRows& b,
                      std::size_t block, const FlipTapsDown& taps, float* logs,
                      std::size_t stride) {
  alignas(64) FlipFiltered of_a, of_b;
  filter_down(filters, a, block, taps, of_a);
  filter_down(filters, b, block, taps, of_b);
  for (std::size_t row = 0; row < taps.rows; ++row)
    for (std::size_t column = 0; column < kFlipBlock; column += hn::Lanes(Floats()))
      hn::StoreU(log_of_error(of_a, of_b, row, column), Floats(), logs + row * stride + column);
}

void errors_of_lanes(float* logs, std::size_t count) {
  const Floats d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d))
    hn::StoreU(hn::Min(exp_2(hn::LoadU(d, logs + i)), set(1)), d, logs + i);
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LOBELIA_COMPARE_METRICS_FLIP_PIXELS_INL_HPP

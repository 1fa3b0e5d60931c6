// FLIP's filters along rows and down columns, in float64. Compiled once for each instruction set, like the file that
// includes it.
#include <hwy/highway.h>

#include "compare/metrics/flip_error.hpp"
#include "compare/metrics/flip_kernels.hpp"

#if defined(LOBELIA_COMPARE_METRICS_FLIP_FILTERS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LOBELIA_COMPARE_METRICS_FLIP_FILTERS_INL_HPP
#undef LOBELIA_COMPARE_METRICS_FLIP_FILTERS_INL_HPP
#else
#define LOBELIA_COMPARE_METRICS_FLIP_FILTERS_INL_HPP
#endif

#include "compare/metrics/flip_error-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

using Samples = hn::CappedTag<double, 8>;
using SampleLanes = hn::Vec<Samples>;

/// GCC loads what it uses twice twice, and loads are what filtering along waits for.
HWY_INLINE void keep_in_registers([[maybe_unused]] SampleLanes& a,
                                  [[maybe_unused]] SampleLanes& b) {
#if HWY_ARCH_X86 && HWY_COMPILER_GCC_ACTUAL
  asm("" : "+v"(a.raw), "+v"(b.raw));
#endif
}

/// Filters a few pixels of a row of both pictures along, by kEven even filters and kOdd odd ones. Pairs of samples with the
/// same tap are added first, which halves the products. A load of a tap costs as much as one of samples, so it serves
/// kVectors registers of each picture.
template <std::size_t kVectors, std::size_t kEven, std::size_t kOdd>
struct AlongSums {
  SampleLanes sums[kEven + kOdd][2 * kVectors];

  static HWY_INLINE const double* at(const double* const (&in)[2], std::size_t v) {
    return in[v / kVectors] + v % kVectors * hn::Lanes(Samples());
  }
  /// `in` is the first pixel.
  HWY_INLINE void begin(const double* const (&in)[2], const double* const* taps) {
    const Samples d;
    for (std::size_t v = 0; v < 2 * kVectors; ++v) {
      const SampleLanes middle = hn::LoadU(d, at(in, v));
      for (std::size_t i = 0; i < kEven + kOdd; ++i)
        sums[i][v] = i < kEven ? hn::Mul(hn::Set(d, taps[i][0]), middle) : hn::Zero(d);
    }
  }
  /// Adds the tap k, on both sides, of filters first ... end - 1.
  template <std::size_t kFirst = 0, std::size_t kEnd = kEven + kOdd>
  HWY_INLINE void add(const double* const (&in)[2], std::size_t k, const double* const* taps) {
    const Samples d;
    SampleLanes tap[kEnd];
    for (std::size_t i = kFirst; i < kEnd; ++i) tap[i] = hn::Set(d, taps[i][k]);
    for (std::size_t v = 0; v < 2 * kVectors; ++v) {
      SampleLanes before = hn::LoadU(d, at(in, v) - k), after = hn::LoadU(d, at(in, v) + k);
      if constexpr (kEnd > kEven) keep_in_registers(before, after);
      for (std::size_t i = kFirst; i < kEnd; ++i) {
        const SampleLanes pair = i < kEven ? hn::Add(after, before) : hn::Sub(after, before);
        sums[i][v] = hn::MulAdd(tap[i], pair, sums[i][v]);
      }
    }
  }
  HWY_INLINE void store(std::size_t i, double* a, double* b) const {
    for (std::size_t v = 0; v < 2 * kVectors; ++v)
      hn::Store(sums[i][v], Samples(),
                (v < kVectors ? a : b) + v % kVectors * hn::Lanes(Samples()));
  }
};

void filter_along_lanes(const FlipFilters& filters, const FlipColours& a, const FlipColours& b,
                        const FlipRows& out_a, const FlipRows& out_b, std::size_t slot) {
  // As many sums as there are registers for.
  constexpr std::size_t kVectors = HWY_TARGET <= HWY_AVX3 ? 2 : 1;
  const std::size_t at_once = kVectors * hn::Lanes(Samples());
  const std::size_t luminance = filters.luminance.size(), features = filters.edge.size(),
                    both = std::min(luminance, features), red_green = filters.red_green.size(),
                    blue_yellow = filters.blue_yellow_1.size();
  const double *const of_y[] = {filters.luminance.data(), filters.gaussian.data(),
                                filters.point.data(), filters.edge.data()},
                      *const of_cx[] = {filters.red_green.data()},
                      *const of_cz[] = {filters.blue_yellow_1.data(), filters.blue_yellow_2.data()};
  for (std::size_t i = 0; i < out_a.blocks * kFlipBlock; i += at_once) {
    const auto store = [&](const auto& sums, std::size_t filter, FlipPlane plane) HWY_ATTR {
      const std::size_t to = slot * kFlipBlock + i % kFlipBlock;
      sums.store(filter, out_a.block(plane, i / kFlipBlock) + to,
                 out_b.block(plane, i / kFlipBlock) + to);
    };
    const double *const in_y[] = {a.y + i, b.y + i}, *const in_cx[] = {a.cx + i, b.cx + i},
                        *const in_cz[] = {a.cz + i, b.cz + i};
    AlongSums<kVectors, 3, 1> y;
    y.begin(in_y, of_y);
    for (std::size_t k = 1; k < both; ++k) y.add(in_y, k, of_y);
    for (std::size_t k = both; k < features; ++k) y.template add<1>(in_y, k, of_y);
    for (std::size_t k = both; k < luminance; ++k) y.template add<0, 1>(in_y, k, of_y);
    store(y, 0, kFlipY);
    store(y, 1, kFlipSmooth);
    store(y, 2, kFlipPoint);
    store(y, 3, kFlipEdge);
    AlongSums<kVectors, 1, 0> cx;
    cx.begin(in_cx, of_cx);
    for (std::size_t k = 1; k < red_green; ++k) cx.add(in_cx, k, of_cx);
    store(cx, 0, kFlipCx);
    AlongSums<kVectors, 2, 0> cz;
    cz.begin(in_cz, of_cz);
    for (std::size_t k = 1; k < blue_yellow; ++k) cz.add(in_cz, k, of_cz);
    store(cz, 0, kFlipCz1);
    store(cz, 1, kFlipCz2);
  }
}

/// Filters one register of kRows rows of a block down, by an even filter, and with kOdd also by an odd one. The samples of a
/// row at a tap are those of its neighbour at the next tap, so that each is loaded once for all rows.
template <std::size_t kRows, bool kOdd, class Write>
HWY_INLINE void filter_rows(const FlipTaps& even_taps, const FlipTaps& odd_taps, const double* base,
                            const std::size_t* offsets, Write write) {
  const Samples d;
  const auto at = [=](std::ptrdiff_t row) HWY_ATTR { return hn::Load(d, base + offsets[row]); };
  // below[j] is the sample k rows below row j, above[j] that k rows above it.
  SampleLanes even[kRows], odd[kRows], below[kRows], above[kRows];
  auto k = std::ptrdiff_t(even_taps.size()) - 1;
  for (std::size_t j = 0; j < kRows; ++j) {
    even[j] = odd[j] = hn::Zero(d);
    below[j] = at(std::ptrdiff_t(j) + k);
    above[j] = at(std::ptrdiff_t(j) - k);
  }
  const double *const even_tap = even_taps.data(), *const odd_tap = odd_taps.data();
  for (; k > 0; --k) {
    const SampleLanes tap = hn::Set(d, even_tap[k]), tap_of_odd = hn::Set(d, odd_tap[k]);
    for (std::size_t j = 0; j < kRows; ++j) {
      even[j] = hn::MulAdd(tap, hn::Add(below[j], above[j]), even[j]);
      if constexpr (kOdd) odd[j] = hn::MulAdd(tap_of_odd, hn::Sub(below[j], above[j]), odd[j]);
    }
    for (std::size_t j = kRows - 1; j > 0; --j) below[j] = below[j - 1];
    below[0] = at(k - 1);
    for (std::size_t j = 0; j + 1 < kRows; ++j) above[j] = above[j + 1];
    above[kRows - 1] = at(std::ptrdiff_t(kRows) - k);
  }
  const SampleLanes middle = hn::Set(d, even_tap[0]);
  for (std::size_t j = 0; j < kRows; ++j) write(j, hn::MulAdd(middle, below[j], even[j]), odd[j]);
}

/// Filters a block down, plane by plane, so that the rows of one stay in the first cache.
HWY_INLINE void filter_down(const FlipFilters& filters, const FlipRows& in, std::size_t block,
                            const FlipTapsDown& taps, FlipFiltered& out) {
  // As many rows as there are registers for.
  constexpr std::size_t kRows = HWY_TARGET <= HWY_AVX3 ? 8 : 4;
  static_assert(kFlipBand % kRows == 0);
  const Samples d;
  const auto for_plane = [&](FlipPlane plane, auto work) HWY_ATTR {
    for (std::size_t row = 0; row < kFlipBand; row += kRows)
      for (std::size_t column = 0; column < kFlipBlock; column += hn::Lanes(d))
        work(in.block(plane, block) + column, taps.offsets + row + taps.radius, row, column);
  };
  const auto filter = [&](FlipPlane plane, const FlipTaps& by, FlipFiltered::Values& to) HWY_ATTR {
    for_plane(plane, [&](const double* base, const std::size_t* offsets, std::size_t row,
                         std::size_t column) HWY_ATTR {
      filter_rows<kRows, false>(by, by, base, offsets,
                                [&](std::size_t next, auto sum, auto)
                                    HWY_ATTR { hn::Store(sum, d, to[row + next] + column); });
    });
  };
  filter(kFlipY, filters.luminance, out.y);
  filter(kFlipCx, filters.red_green, out.cx);
  filter(kFlipCz1, filters.blue_yellow_1, out.cz_1);
  filter(kFlipCz2, filters.blue_yellow_2, out.cz_2);
  filter(kFlipEdge, filters.gaussian, out.dx);
  filter(kFlipPoint, filters.gaussian, out.ddx);
  for_plane(kFlipSmooth, [&](const double* base, const std::size_t* offsets, std::size_t row,
                             std::size_t column) HWY_ATTR {
    filter_rows<kRows, true>(filters.point, filters.edge, base, offsets,
                             [&](std::size_t next, auto even, auto odd) HWY_ATTR {
                               hn::Store(even, d, out.ddy[row + next] + column);
                               hn::Store(odd, d, out.dy[row + next] + column);
                             });
  });
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

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LOBELIA_COMPARE_METRICS_FLIP_FILTERS_INL_HPP

// FLIP's filters along rows and down columns, in float64. Compiled once for each instruction set, like the file that
// includes it.
#include <hwy/highway.h>
#include <utility>

#include "compare/metrics/flip_filters.hpp"

#if defined(LOBELIA_COMPARE_METRICS_FLIP_FILTERS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LOBELIA_COMPARE_METRICS_FLIP_FILTERS_INL_HPP
#undef LOBELIA_COMPARE_METRICS_FLIP_FILTERS_INL_HPP
#else
#define LOBELIA_COMPARE_METRICS_FLIP_FILTERS_INL_HPP
#endif

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Samples = hn::CappedTag<double, 8>;
using SampleLanes = hn::Vec<Samples>;

/// Filters a register of pixels of a row of both pictures along, by kEven even filters and kOdd odd ones. Pairs of samples
/// with the same tap are added first, which halves the products.
template <std::size_t kEven, std::size_t kOdd>
struct AlongSums {
  SampleLanes sums[kEven + kOdd][2];

  /// `a` and `b` are the first pixel in each picture. Each filter has `count` taps.
  HWY_INLINE void filter(const double* a, const double* b, const double* const* taps,
                         std::size_t count) {
    const Samples d;
    const double* const pictures[] = {a, b};
    for (std::size_t v = 0; v < 2; ++v) {
      const SampleLanes middle = hn::Load(d, pictures[v]);
      for (std::size_t i = 0; i < kEven + kOdd; ++i)
        sums[i][v] = i < kEven ? hn::Mul(hn::Set(d, taps[i][0]), middle) : hn::Zero(d);
    }
    for (std::size_t k = 1; k < count; ++k)
      for (std::size_t v = 0; v < 2; ++v) {
        const SampleLanes before = hn::LoadU(d, pictures[v] - k),
                          after = hn::LoadU(d, pictures[v] + k);
        for (std::size_t i = 0; i < kEven + kOdd; ++i) {
          const SampleLanes pair = i < kEven ? hn::Add(after, before) : hn::Sub(after, before);
          sums[i][v] = hn::MulAdd(hn::Set(d, taps[i][k]), pair, sums[i][v]);
        }
      }
  }
  HWY_INLINE void store(std::size_t i, double* a, double* b) const {
    hn::Store(sums[i][0], Samples(), a);
    hn::Store(sums[i][1], Samples(), b);
  }
};

void filter_along_lanes(const FlipFilters& filters, const FlipColours& a, const FlipColours& b,
                        const FlipRows& out_a, const FlipRows& out_b, std::size_t slot) {
  const double *const of_y[] = {filters.luminance.data(), filters.gaussian.data(),
                                filters.point.data(), filters.edge.data()},
                      *const of_cx[] = {filters.red_green.data()},
                      *const of_cz[] = {filters.blue_yellow_1.data(), filters.blue_yellow_2.data()};
  for (std::size_t i = 0; i < out_a.blocks * kFlipBlock; i += hn::Lanes(Samples())) {
    const auto store = [&](const auto& sums, std::size_t filter, FlipPlane plane) HWY_ATTR {
      const std::size_t to = slot * kFlipBlock + i % kFlipBlock;
      sums.store(filter, out_a.block(plane, i / kFlipBlock) + to,
                 out_b.block(plane, i / kFlipBlock) + to);
    };
    AlongSums<3, 1> y;
    y.filter(a.y + i, b.y + i, of_y, filters.edge.size());
    store(y, 0, kFlipY);
    store(y, 1, kFlipSmooth);
    store(y, 2, kFlipPoint);
    store(y, 3, kFlipEdge);
    AlongSums<1, 0> cx;
    cx.filter(a.cx + i, b.cx + i, of_cx, filters.red_green.size());
    store(cx, 0, kFlipCx);
    AlongSums<2, 0> cz;
    cz.filter(a.cz + i, b.cz + i, of_cz, filters.blue_yellow_1.size());
    store(cz, 0, kFlipCz1);
    store(cz, 1, kFlipCz2);
  }
}

/// One register of rows of a block, filtered down by an even filter, and with kOdd also by an odd one. The samples of a row
/// at a tap are those of its neighbour at the next tap, so that each is loaded once for all rows.
template <bool kOdd, std::size_t... kRow>
struct DownSums {
  static constexpr std::size_t kRows = sizeof...(kRow);

  const double *even_taps, *odd_taps;
  std::size_t count;  ///< of taps
  const double* base;
  const std::size_t* offsets;           ///< row j is at base + offsets[j]
  SampleLanes even[kRows], odd[kRows];  // of each row
  // The rows k below and above each: row r at r modulo kRows, so that nothing moves from tap to tap.
  SampleLanes below[kRows], above[kRows];

  HWY_INLINE SampleLanes at(std::ptrdiff_t row) const {
    return hn::Load(Samples(), base + offsets[row]);
  }
  HWY_INLINE void filter() {
    const Samples d;
    ((below[kRow] = above[kRow] = at(kRow)), ...);
    ((even[kRow] = hn::Mul(hn::Set(d, even_taps[0]), below[kRow])), ...);
    ((odd[kRow] = hn::Zero(d)), ...);
    for (std::size_t k = 1; k < count; k += kRows) add<1>(k);
  }
  /// Adds kLeft taps from k on, as far as there are any; kTurn is k modulo kRows.
  template <std::size_t kTurn, std::size_t kLeft = kRows>
  HWY_INLINE void add(std::size_t k) {
    const Samples d;
    below[(kTurn + kRows - 1) % kRows] = at(std::ptrdiff_t(kRows - 1 + k));
    above[(kRows - kTurn) % kRows] = at(-std::ptrdiff_t(k));
    const SampleLanes tap = hn::Set(d, even_taps[k]);
    ((even[kRow] = hn::MulAdd(
          tap, hn::Add(below[(kRow + kTurn) % kRows], above[(kRow + kRows - kTurn) % kRows]),
          even[kRow])),
     ...);
    if constexpr (kOdd) {
      const SampleLanes odd_tap = hn::Set(d, odd_taps[k]);
      ((odd[kRow] = hn::MulAdd(
            odd_tap, hn::Sub(below[(kRow + kTurn) % kRows], above[(kRow + kRows - kTurn) % kRows]),
            odd[kRow])),
       ...);
    }
    if (k + 1 >= count) return;
    if constexpr (kLeft > 1) add<(kTurn + 1) % kRows, kLeft - 1>(k + 1);
  }
};

template <bool kOdd, class Write, std::size_t... kRow>
HWY_INLINE void filter_rows(const FlipTaps& even_taps, const FlipTaps& odd_taps, const double* base,
                            const std::size_t* offsets, const Write& write,
                            std::index_sequence<kRow...>) {
  DownSums<kOdd, kRow...> sums;
  sums.even_taps = even_taps.data();
  sums.odd_taps = odd_taps.data();
  sums.count = even_taps.size();
  sums.base = base;
  sums.offsets = offsets;
  sums.filter();
  (write(kRow, sums.even[kRow], sums.odd[kRow]), ...);
}

/// Filters a block down, plane by plane, so that the rows of one stay in the first cache.
HWY_INLINE void filter_down(const FlipFilters& filters, const FlipRows& in, std::size_t block,
                            const FlipTapsDown& taps, FlipFiltered& out) {
  // As many rows as there are registers for.
  constexpr std::size_t kRows = HWY_TARGET <= HWY_AVX3 ? 8 : 4,
                        kRowsOfTwo = HWY_TARGET <= HWY_AVX3 ? 4 : 2;
  static_assert(kFlipBand % kRows == 0 && kFlipBand % kRowsOfTwo == 0);
  const Samples d;
  const auto for_plane = [&](FlipPlane plane, std::size_t rows, auto work) HWY_ATTR {
    for (std::size_t row = 0; row < kFlipBand; row += rows)
      for (std::size_t column = 0; column < kFlipBlock; column += hn::Lanes(d))
        work(in.block(plane, block) + column, taps.offsets + row + taps.radius, row, column);
  };
  const auto filter = [&](FlipPlane plane, const FlipTaps& by, FlipFiltered::Values& to) HWY_ATTR {
    for_plane(plane, kRows,
              [&](const double* base, const std::size_t* offsets, std::size_t row,
                  std::size_t column) HWY_ATTR {
                filter_rows<false>(
                    by, by, base, offsets,
                    [&](std::size_t next, auto sum, auto)
                        HWY_ATTR { hn::Store(sum, d, to[row + next] + column); },
                    std::make_index_sequence<kRows>());
              });
  };
  filter(kFlipY, filters.luminance, out.y);
  filter(kFlipCx, filters.red_green, out.cx);
  filter(kFlipCz1, filters.blue_yellow_1, out.cz_1);
  filter(kFlipCz2, filters.blue_yellow_2, out.cz_2);
  filter(kFlipEdge, filters.gaussian, out.dx);
  filter(kFlipPoint, filters.gaussian, out.ddx);
  for_plane(kFlipSmooth, kRowsOfTwo,
            [&](const double* base, const std::size_t* offsets, std::size_t row, std::size_t column)
                HWY_ATTR {
                  filter_rows<true>(
                      filters.point, filters.edge, base, offsets,
                      [&](std::size_t next, auto even, auto odd) HWY_ATTR {
                        hn::Store(even, d, out.ddy[row + next] + column);
                        hn::Store(odd, d, out.dy[row + next] + column);
                      },
                      std::make_index_sequence<kRowsOfTwo>());
                });
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LOBELIA_COMPARE_METRICS_FLIP_FILTERS_INL_HPP

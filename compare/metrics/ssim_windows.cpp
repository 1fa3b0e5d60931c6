// Source, formula and agreement: see ssim.cpp.
#include "compare/metrics/ssim_windows.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/system/scratch_memory.hpp"
#include "compare/metrics/shared_work.hpp"

// As in renderer/kernels/kernels.cpp: a debug build keeps to the baseline.
#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compare/metrics/ssim_windows.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "compare/metrics/lanes-inl.hpp"

#ifndef LOBELIA_COMPARE_METRICS_SSIM_WINDOWS_CPP
#define LOBELIA_COMPARE_METRICS_SSIM_WINDOWS_CPP
namespace lobelia {
namespace {

// (K L)^2 with K1 = 0.01, K2 = 0.03 and the range L of luma, which is 1.
constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;

/// Rows of windows are padded to a multiple of this number, so that no kernel has a remainder.
constexpr std::size_t kSsimBlock = 8;

/// Averaged within a window: a, b, a^2 + b^2 and a b.
constexpr std::size_t kMoments = 4;
using MomentRows = std::array<double*, kMoments>;

using Taps = std::array<double, kSsimSide>;

}  // namespace
}  // namespace lobelia
#endif

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace {

// Products and sums are rounded separately, which gives the same bits on every processor.

/// The curve of IEC 61966-2-1, in float to 2e-7. 1.055 x^(1 / 2.4) - 0.055 is a polynomial of the fourth root of x, by
/// Chebyshev's points from x = 0.0031308 to 1, which are t = -1 and 1; it is off by 8e-9 at the most.
template <class D>
HWY_INLINE hn::Vec<D> encoded(D d, hn::Vec<D> light) {
  const auto root = hn::Sqrt(hn::Sqrt(light));
  const auto t = hn::Mul(hn::Sub(root, hn::Set(d, 0.618272516f)), hn::Set(d, 2.6196699f));
  auto sum = hn::Set(d, 8.803491674e-6f);
  for (const float coefficient :
       {-1.868181768e-5f, 1.68271088e-5f, -4.296050173e-5f, 0.0001423038856f, -0.0004127122999f,
        0.001414944471f, -0.006876498698f, 0.1002521277f, 0.4871259052f, 0.4183899443f})
    sum = hn::Add(hn::Mul(sum, t), hn::Set(d, coefficient));
  return hn::IfThenElse(hn::Gt(light, hn::Set(d, 0.0031308f)), sum,
                        hn::Mul(light, hn::Set(d, 12.92f)));
}

template <class D>
HWY_INLINE void luma_at(D d, const float* rgb, float* out) {
  hn::Vec<D> r, g, b;
  hn::LoadInterleaved3(d, rgb, r, g, b);
  r = encoded(d, r), g = encoded(d, g), b = encoded(d, b);
  const auto weighted =
      hn::Add(hn::Add(hn::Mul(r, hn::Set(d, 0.2126f)), hn::Mul(g, hn::Set(d, 0.7152f))),
              hn::Mul(b, hn::Set(d, 0.0722f)));
  // A grey stays as it is: the weights add up to 1, their rounded products do not.
  const auto is_grey = hn::And(hn::Eq(r, g), hn::Eq(g, b));
  hn::StoreU(hn::IfThenElse(is_grey, r, weighted), d, out);
}

using Block = hn::CappedTag<double, kSsimBlock>;

/// The sum of the taps times values. values(k) is where those of the k-th tap are.
template <class Values>
HWY_INLINE LanesOf<Block> windowed(const Taps& taps, const Values& values) {
  LanesOf<Block> sum(0.0);
  for (std::size_t k = 0; k < kSsimSide; ++k)
    sum = sum + taps[k] * LanesOf<Block>(hn::LoadU(Block(), values(k)));
  return sum;
}

}  // namespace

void luma_lanes(const float* rgb, float* out, std::size_t count) {
  const hn::ScalableTag<float> d;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) luma_at(d, rgb + 3 * i, out + i);
  // The last register overlaps the one before; fewer pixels come one by one.
  if (i > 0 && i < count) {
    i = count - hn::Lanes(d);
    luma_at(d, rgb + 3 * i, out + i);
    return;
  }
  for (; i < count; ++i) luma_at(hn::CappedTag<float, 1>(), rgb + 3 * i, out + i);
}

void products_lanes(const float* row_a, const float* row_b, const MomentRows& out,
                    std::size_t count) {
  const hn::Rebind<float, Block> narrow;
  for (std::size_t i = 0; i < count; i += hn::Lanes(Block())) {
    const auto a = hn::PromoteTo(Block(), hn::LoadU(narrow, row_a + i)),
               b = hn::PromoteTo(Block(), hn::LoadU(narrow, row_b + i));
    hn::StoreU(a, Block(), out[0] + i);
    hn::StoreU(b, Block(), out[1] + i);
    hn::StoreU(hn::Add(hn::Mul(a, a), hn::Mul(b, b)), Block(), out[2] + i);
    hn::StoreU(hn::Mul(a, b), Block(), out[3] + i);
  }
}

void along_lanes(const Taps& taps, const MomentRows& in, const MomentRows& out, std::size_t count) {
  for (std::size_t m = 0; m < kMoments; ++m)
    for (std::size_t i = 0; i < count; i += hn::Lanes(Block()))
      hn::StoreU(windowed(taps, [&](std::size_t k) HWY_ATTR { return in[m] + i + k; }).v, Block(),
                 out[m] + i);
}

/// Writes l c s and c s of each window, from rows that are filtered along.
void similarity_lanes(const Taps& taps, const MomentRows* rows, double* similarity,
                      double* contrast, std::size_t count) {
  using Real = LanesOf<Block>;
  for (std::size_t i = 0; i < count; i += hn::Lanes(Block())) {
    const auto mean = [&](std::size_t m) HWY_ATTR {
      return windowed(taps, [&](std::size_t k) HWY_ATTR { return rows[k][m] + i; });
    };
    const Real a = mean(0), b = mean(1), squares = mean(2), product = mean(3);
    const Real ab = a * b, aa_bb = a * a + b * b;
    // Population moments. Rounding can make variances of 0 a little negative, and a covariance larger than their mean.
    const Real variances = max(squares - aa_bb, 0.0), most = variances * 0.5;
    const Real covariance = max(min(product - ab, most), -most);
    const Real cs = (2 * covariance + kC2) / (variances + kC2);
    hn::StoreU(cs.v, Block(), contrast + i);
    hn::StoreU(((2 * ab + kC1) / (aa_bb + kC1) * cs).v, Block(), similarity + i);
  }
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {

HWY_EXPORT(luma_lanes);
HWY_EXPORT(products_lanes);
HWY_EXPORT(along_lanes);
HWY_EXPORT(similarity_lanes);

namespace {

constexpr double kWindowSigma = 1.5;
constexpr int kAround = kSsimSide - 1;  ///< pixels that a window has more than one

// Windows of a tile: few enough columns to keep all moments of a window's rows in the first cache. Both are even, so that
// the pixels of the next scale are of one tile.
constexpr int kTileWidth = 64, kTileHeight = 256;

Taps gaussian_window() {
  Taps taps;
  double sum = 0;
  for (int i = 0; i < kSsimSide; ++i) {
    const double x = i - kSsimSide / 2;
    sum += taps[std::size_t(i)] = std::exp(-x * x / (2 * kWindowSigma * kWindowSigma));
  }
  for (double& tap : taps) tap /= sum;
  return taps;
}

/// Columns [left, right), rows [top, bottom).
struct Area {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// The pixels of a tile's windows.
struct TileLuma {
  TileLuma(const LumaRows& rows, const Area& area)
      : stride((std::size_t(area.right - area.left) + kSsimBlock - 1) / kSsimBlock * kSsimBlock +
               2 * kSsimBlock),
        values(stride * std::size_t(area.bottom - area.top)) {
    for (int y = area.top; y < area.bottom; ++y)
      rows.fill(y, area.left, {row(y - area.top), std::size_t(area.right - area.left)});
  }
  float* row(int y) { return values.data() + stride * std::size_t(y); }
  const float* row(int y) const { return values.data() + stride * std::size_t(y); }

  std::size_t stride;  ///< with room for the padding of windows
  std::vector<float> values;
};

/// The windows of `area`, relative to it, that have a pixel where the pictures differ. The others have a similarity of 1.
Area differing_windows(const TileLuma& a, const TileLuma& b, int columns, int rows) {
  Area found{columns, rows, 0, 0};
  for (int y = 0; y < rows + kAround; ++y) {
    const std::span one(a.row(y), std::size_t(columns + kAround)),
        other(b.row(y), std::size_t(columns + kAround));
    const auto first = std::ranges::mismatch(one, other).in1;
    if (first == one.end()) continue;
    const auto last = std::mismatch(one.rbegin(), one.rend(), other.rbegin()).first;
    found.left = std::min(found.left, std::max(0, int(first - one.begin()) - kAround));
    found.right = std::max(found.right, std::min(columns, int(one.rend() - last)));
    found.top = std::min(found.top, std::max(0, y - kAround));
    found.bottom = std::min(rows, y + 1);
  }
  return found;
}

/// Calls visit(row, similarity, contrast) for all rows of a tile's windows from the top.
template <class Visit>
void for_each_window_row(const Taps& taps, const TileLuma& a, const TileLuma& b, int columns,
                         int rows, const Visit& visit) {
  const Area part = differing_windows(a, b, columns, rows);
  const std::size_t padded =
      (std::size_t(std::max(0, part.right - part.left)) + kSsimBlock - 1) / kSsimBlock * kSsimBlock;
  const std::size_t extended = padded + 2 * kSsimBlock;
  std::vector<double> memory(kMoments * (extended + kSsimSide * padded));
  double* free = memory.data();
  const auto take = [&](std::size_t size) {
    MomentRows moments;
    for (double*& row : moments) row = std::exchange(free, free + size);
    return moments;
  };
  const MomentRows products = take(extended);
  std::array<MomentRows, kSsimSide> filtered;  // of row y in filtered[y % kSsimSide]
  for (MomentRows& row : filtered) row = take(padded);
  std::vector<double> similarity(std::size_t(columns) + kSsimBlock, 1.0), contrast(similarity);
  int next = part.top;  // rows above it are filtered
  for (int y = 0; y < rows; ++y) {
    const bool inside = y >= part.top && y < part.bottom;
    if (inside) {
      for (; next < y + kSsimSide; ++next) {
        HWY_DYNAMIC_DISPATCH(products_lanes)
        (a.row(next) + part.left, b.row(next) + part.left, products, padded + 2 * kSsimBlock);
        HWY_DYNAMIC_DISPATCH(along_lanes)
        (taps, products, filtered[std::size_t(next % kSsimSide)], padded);
      }
      std::array<MomentRows, kSsimSide> window;
      for (int k = 0; k < kSsimSide; ++k)
        window[std::size_t(k)] = filtered[std::size_t((y + k) % kSsimSide)];
      HWY_DYNAMIC_DISPATCH(similarity_lanes)
      (taps, window.data(), similarity.data() + part.left, contrast.data() + part.left, padded);
    }
    if (!inside || part.right < columns) {
      const int first = inside ? part.right : 0;
      std::fill(similarity.begin() + first, similarity.end(), 1.0);
      std::fill(contrast.begin() + first, contrast.end(), 1.0);
    }
    visit(y, similarity.data(), contrast.data());
  }
}

/// Writes the pixels of the next scale of which the first lies in `area` of the whole.
void halve(const TileLuma& luma, const Area& area, int width, int height, LumaPlane& half) {
  for (int y = area.top; y < area.bottom; y += 2) {
    const float *upper = luma.row(y - area.top),
                *lower = luma.row(std::min(y + 1, height - 1) - area.top);
    float* out = half.values.data() + std::size_t(y / 2) * std::size_t(half.width);
    for (int x = area.left; x < area.right; x += 2) {
      const int left = x - area.left, right = std::min(x + 1, width - 1) - area.left;
      out[x / 2] = ((upper[left] + upper[right]) + (lower[left] + lower[right])) / 4;
    }
  }
}

LumaPlane half_of(const LumaRows& rows) {
  const int width = (rows.width + 1) / 2, height = (rows.height + 1) / 2;
  return {width, height, LumaPlane::Values(std::size_t(width) * std::size_t(height))};
}

}  // namespace

LumaRows luma(const DisplayLight& shown) {
  return {shown.width(), shown.height(), [shown](int y, int first, std::span<float> row) {
            std::vector<float> rgb(3 * row.size());
            shown.fill(y, first, rgb);
            HWY_DYNAMIC_DISPATCH(luma_lanes)(rgb.data(), row.data(), row.size());
          }};
}

LumaRows rows_of(const LumaPlane& plane) {
  return {plane.width, plane.height, [&plane](int y, int first, std::span<float> row) {
            std::copy_n(plane.row(y) + first, row.size(), row.data());
            looked_at(row.size_bytes());
          }};
}

SsimScale ssim_scale(const LumaRows& a, const LumaRows& b,
                     std::span<const std::span<const std::uint8_t>> regions) {
  struct Sum {
    double similarity = 0, contrast = 0;
    std::size_t count = 0;
  };
  const Taps taps = gaussian_window();
  const int windows_across = a.width - kAround, windows_down = a.height - kAround;
  const int across = (windows_across + kTileWidth - 1) / kTileWidth,
            down = (windows_down + kTileHeight - 1) / kTileHeight;
  SsimScale result{{}, half_of(a), half_of(b)};
  std::vector<Sum> sums(regions.size() * std::size_t(across * down));
  oneapi::tbb::parallel_for(0, across * down, [&](int i) {
    const int left = i % across * kTileWidth, top = i / across * kTileHeight;
    const int columns = std::min(kTileWidth, windows_across - left),
              rows = std::min(kTileHeight, windows_down - top);
    const Area pixels{left, top, left + columns + kAround, top + rows + kAround};
    const TileLuma tile_a(a, pixels), tile_b(b, pixels);
    // The last tiles have the pixels around their windows as well.
    const Area own{left, top, left + columns == windows_across ? a.width : left + columns,
                   top + rows == windows_down ? a.height : top + rows};
    halve(tile_a, own, a.width, a.height, result.half_a);
    halve(tile_b, own, b.width, b.height, result.half_b);
    for_each_window_row(taps, tile_a, tile_b, columns, rows,
                        [&](int y, const double* similarity, const double* contrast) {
                          constexpr int kMiddle = kSsimSide / 2;
                          const std::size_t first =
                              std::size_t(top + y + kMiddle) * std::size_t(a.width) +
                              std::size_t(left + kMiddle);
                          for (std::size_t r = 0; r < regions.size(); ++r) {
                            Sum& sum = sums[regions.size() * std::size_t(i) + r];
                            for (std::size_t x = 0; x < std::size_t(columns); ++x) {
                              if (!regions[r].empty() && regions[r][first + x] == 0) continue;
                              sum.similarity += similarity[x];
                              sum.contrast += contrast[x];
                              ++sum.count;
                            }
                          }
                        });
    // The regions, and a quarter of the pixels in two planes of floats: in whole rows, which the system brings.
    looked_at(std::size_t(rows) * std::size_t(a.width) * (regions.size() + 2));
  });
  // In order of the tiles: the sum must not depend on the number of threads.
  for (std::size_t r = 0; r < regions.size(); ++r) {
    Sum all;
    for (std::size_t i = r; i < sums.size(); i += regions.size())
      all = {all.similarity + sums[i].similarity, all.contrast + sums[i].contrast,
             all.count + sums[i].count};
    const double count = double(std::max<std::size_t>(all.count, 1));
    result.of_region.push_back({all.similarity / count, all.contrast / count});
  }
  return result;
}

std::shared_ptr<const SsimScale> shown_ssim(const MetricInput& input) {
  return shared(input, kSsimWork, [&] {
    return ssim_scale(luma(input.shown_a), luma(input.shown_b),
                      input.regions.empty() ? std::span(&input.region, 1) : input.regions);
  });
}

SsimMeans means_of(const SsimScale& scale, const MetricInput& input) {
  const auto found = std::ranges::find(input.regions, input.region.data(),
                                       [](auto region) { return region.data(); });
  return scale.of_region[input.regions.empty() ? 0 : std::size_t(found - input.regions.begin())];
}

}  // namespace lobelia
#endif  // HWY_ONCE

// Source, formula and agreement: see ssim.cpp.
#include "compare/metrics/ssim_windows.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

// As in renderer/kernels/kernels.cpp: a debug build keeps to the baseline.
#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compare/metrics/ssim_windows.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "compare/metrics/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace {

template <class Real>
HWY_INLINE Real encoded(Real light) {
  return where(light > 0.0031308, 1.055 * pow(light, 1 / 2.4) - 0.055, 12.92 * light);
}

}  // namespace

void luma_lanes(const float* rgb, float* out, std::size_t count) {
  for_all_pixels(count, [&](auto d, std::size_t i) HWY_ATTR {
    const auto light = load_rgb(d, rgb + 3 * i);
    const auto r = encoded(light.r), g = encoded(light.g), b = encoded(light.b);
    // A grey stays as it is: the weights add up to 1, their rounded products do not.
    const auto is_grey = hn::And(r == g, g == b);
    store(where(is_grey, r, 0.2126 * r + 0.7152 * g + 0.0722 * b), out + i);
  });
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {
namespace {

constexpr double kWindowSigma = 1.5;
// (K L)^2 with K1 = 0.01, K2 = 0.03 and the range L of luma, which is 1.
constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;

// Rows of windows in one task. Ten rows of pixels above them are filtered twice.
constexpr int kRowsPerTask = 64;

/// Values averaged within a window.
enum Moment { kA, kB, kAA, kBB, kAB, kMoments };
using Moments = std::array<std::vector<double>, kMoments>;

std::array<double, kSsimSide> gaussian_window() {
  std::array<double, kSsimSide> taps;
  double sum = 0;
  for (int i = 0; i < kSsimSide; ++i) {
    const double x = i - kSsimSide / 2;
    sum += taps[std::size_t(i)] = std::exp(-x * x / (2 * kWindowSigma * kWindowSigma));
  }
  for (double& tap : taps) tap /= sum;
  return taps;
}

void add_scaled(double factor, const double* in, std::span<double> out) {
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += factor * in[i];
}

}  // namespace

HWY_EXPORT(luma_lanes);

LumaRows luma(const DisplayLight& shown) {
  return {shown.width(), shown.height(), [shown](int y, float* row) {
            const auto width = std::size_t(shown.width());
            std::vector<float> rgb(3 * width);
            shown.fill(y, 0, rgb);
            HWY_DYNAMIC_DISPATCH(luma_lanes)(rgb.data(), row, width);
          }};
}

LumaRows rows_of(const LumaPlane& plane) {
  return {plane.width, plane.height,
          [&plane](int y, float* row) { std::copy_n(plane.row(y), plane.width, row); }};
}

LumaPlane half_size(const LumaRows& whole) {
  LumaPlane result{(whole.width + 1) / 2, (whole.height + 1) / 2, {}};
  result.values.resize(std::size_t(result.width) * std::size_t(result.height));
  oneapi::tbb::parallel_for(0, result.height, [&](int y) {
    std::vector<float> upper(std::size_t(whole.width)), lower(upper);
    whole.fill(2 * y, upper.data());
    whole.fill(std::min(2 * y + 1, whole.height - 1), lower.data());
    float* out = result.values.data() + std::size_t(y) * std::size_t(result.width);
    for (int x = 0; x < result.width; ++x) {
      const auto left = 2 * std::size_t(x), right = std::min(left + 1, upper.size() - 1);
      out[x] = ((upper[left] + upper[right]) + (lower[left] + lower[right])) / 4;
    }
  });
  return result;
}

SsimMeans ssim_means(const LumaRows& a, const LumaRows& b, std::span<const std::uint8_t> region) {
  const auto taps = gaussian_window();
  const int across = a.width - kSsimSide + 1, down = a.height - kSsimSide + 1;
  const auto width = std::size_t(a.width), windows = std::size_t(across);
  std::vector<double> row_similarity(std::size_t(down), 0.0), row_contrast(row_similarity);
  std::vector<std::size_t> row_count(std::size_t(down), 0);
  const auto has_window = [&](int row, std::size_t x) {
    constexpr std::size_t kMiddle = kSsimSide / 2;
    return region.empty() || region[(std::size_t(row) + kMiddle) * width + x + kMiddle] != 0;
  };
  const int tasks = (down + kRowsPerTask - 1) / kRowsPerTask;
  oneapi::tbb::parallel_for(0, tasks, [&](int task) {
    const int first = task * kRowsPerTask, last = std::min(down, first + kRowsPerTask);
    for (int row = first; row < last; ++row)
      for (std::size_t x = 0; x < windows; ++x) row_count[std::size_t(row)] += has_window(row, x);
    if (std::all_of(row_count.begin() + first, row_count.begin() + last,
                    [](std::size_t count) { return count == 0; }))
      return;
    const int rows = last - first + kSsimSide - 1;
    // Filtered along the rows, then down the columns.
    Moments source, filtered, mean;
    for (int m = 0; m < kMoments; ++m) {
      source[m].resize(width);
      filtered[m].resize(windows * std::size_t(rows));
      mean[m].resize(windows);
    }
    std::vector<float> in_a(width), in_b(width);
    for (int row = 0; row < rows; ++row) {
      a.fill(first + row, in_a.data());
      b.fill(first + row, in_b.data());
      for (std::size_t x = 0; x < width; ++x) {
        const double va = in_a[x], vb = in_b[x];
        source[kA][x] = va;
        source[kB][x] = vb;
        source[kAA][x] = va * va;
        source[kBB][x] = vb * vb;
        source[kAB][x] = va * vb;
      }
      for (int m = 0; m < kMoments; ++m)
        for (std::size_t k = 0; k < taps.size(); ++k)
          add_scaled(taps[k], source[m].data() + k,
                     std::span(filtered[m]).subspan(windows * std::size_t(row), windows));
    }
    for (int row = first; row < last; ++row) {
      for (int m = 0; m < kMoments; ++m) {
        std::fill(mean[m].begin(), mean[m].end(), 0.0);
        for (std::size_t k = 0; k < taps.size(); ++k)
          add_scaled(taps[k], filtered[m].data() + windows * (std::size_t(row - first) + k),
                     mean[m]);
      }
      double similarity = 0, contrast = 0;
      for (std::size_t x = 0; x < windows; ++x) {
        if (!has_window(row, x)) continue;
        const double ma = mean[kA][x], mb = mean[kB][x];
        // Population moments. Rounding can make a variance of 0 a little negative.
        const double variance_a = std::max(0.0, mean[kAA][x] - ma * ma);
        const double variance_b = std::max(0.0, mean[kBB][x] - mb * mb);
        const double covariance = variance_a > 0 && variance_b > 0 ? mean[kAB][x] - ma * mb : 0;
        const double luminance = (2 * (ma * mb) + kC1) / (ma * ma + mb * mb + kC1);
        const double cs = (2 * covariance + kC2) / (variance_a + variance_b + kC2);
        similarity += luminance * cs;
        contrast += cs;
      }
      row_similarity[std::size_t(row)] = similarity;
      row_contrast[std::size_t(row)] = contrast;
    }
  });
  // In order of the rows: the sum must not depend on the number of threads.
  const auto mean_of = [&](const std::vector<double>& sums) {
    return std::accumulate(sums.begin(), sums.end(), 0.0) /
           double(std::accumulate(row_count.begin(), row_count.end(), std::size_t{0}));
  };
  return {mean_of(row_similarity), mean_of(row_contrast)};
}

}  // namespace lobelia
#endif  // HWY_ONCE

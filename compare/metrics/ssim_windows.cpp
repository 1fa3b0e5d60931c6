// Source, formula and agreement: see ssim.cpp.
#include "compare/metrics/ssim_windows.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace lobelia {
namespace {

constexpr double kWindowSigma = 1.5;
// (K L)^2 with K1 = 0.01, K2 = 0.03 and the range L of luma, which is 1.
constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;

// Rows of windows at once: the rows above them, which are filtered again, are ten.
constexpr int kRowsPerTask = 64;

/// The values that are averaged within a window.
enum Moment { kA, kB, kAA, kBB, kAB, kMoments };
using Moments = std::array<std::vector<double>, kMoments>;

std::array<double, kSsimWindow> gaussian_window() {
  std::array<double, kSsimWindow> taps;
  double sum = 0;
  for (int i = 0; i < kSsimWindow; ++i) {
    const double x = i - kSsimWindow / 2;
    sum += taps[std::size_t(i)] = std::exp(-x * x / (2 * kWindowSigma * kWindowSigma));
  }
  for (double& tap : taps) tap /= sum;
  return taps;
}

void add_scaled(double factor, const double* in, std::span<double> out) {
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += factor * in[i];
}

}  // namespace

SsimMeans ssim_means(const LumaRows& a, const LumaRows& b) {
  const auto taps = gaussian_window();
  const int across = a.width - kSsimWindow + 1, down = a.height - kSsimWindow + 1;
  const auto width = std::size_t(a.width), windows = std::size_t(across);
  std::vector<double> row_similarity(std::size_t(down), 0.0), row_contrast(row_similarity);
  const int tasks = (down + kRowsPerTask - 1) / kRowsPerTask;
  oneapi::tbb::parallel_for(0, tasks, [&](int task) {
    const int first = task * kRowsPerTask, last = std::min(down, first + kRowsPerTask);
    const int rows = last - first + kSsimWindow - 1;
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
  SsimMeans result{0, 0};
  for (const double sum : row_similarity) result.similarity += sum;
  for (const double sum : row_contrast) result.contrast_structure += sum;
  const double count = double(across) * double(down);
  return {result.similarity / count, result.contrast_structure / count};
}

}  // namespace lobelia

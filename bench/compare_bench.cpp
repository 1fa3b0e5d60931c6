// A comparison with all metrics; LDR-FLIP and HDR-FLIP of a pair of 1920 x 1080; and FLIP's filters without separation: a
// double loop over each pixel's window, on a crop, as the whole picture would take minutes.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "compare/compare.hpp"
#include "compare/metrics/catalogue.hpp"
#include "compare/metrics/flip_error.hpp"
#include "compare/metrics/flip_kernels.hpp"
#include "core/threads.hpp"

namespace lobelia {
namespace {

constexpr HdrExposures kEightExposures{-4, 3, 8};

/// A highlight with a peak of 16, with noise: not flat anywhere, so that no pixel is cheap.
Image picture(int width, int height, unsigned seed, float noise) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = double(x) / width - 0.5, v = double(y) / height - 0.5;
      const double light = 0.05 + 16 * std::exp(-40 * (u * u + v * v));
      for (float& value : image.pixel(x, y)) {
        seed = seed * 1664525u + 1013904223u;
        value = float(light) * (1 + noise * (float(seed >> 8) / float(1 << 24) - 0.5f));
      }
    }
  return image;
}

void compare_pictures(benchmark::State& state) {
  const int size = int(state.range(0));
  const Image a = picture(size, size, 1, 0.2f), b = picture(size, size, 2, 0.1f);
  for (auto _ : state)
    if (compare(a, b, {}).verdict == Verdict::kNonFinite) state.SkipWithError("wrong verdict");
  state.SetItemsProcessed(std::int64_t(state.iterations()) * size * size);
}
BENCHMARK(compare_pictures)->Name("compare")->Arg(256)->Arg(1024)->UseRealTime();

/// The argument of the benchmark is the number of threads.
void measure_flip(benchmark::State& state, const char* id) {
  constexpr int kWidth = 1920, kHeight = 1080;
  const Image a = picture(kWidth, kHeight, 1, 0.2f), b = picture(kWidth, kHeight, 2, 0.1f);
  const Metric* metric = find_metric(id);
  std::vector<double> values(metric->outputs.size());
  ThreadLimit threads{int(state.range(0))};
  for (auto _ : state) {
    threads.run([&] {
      metric->measure({a, b, DisplayLight(a, 0), DisplayLight(b, 0), kDefaultPixelsPerDegree,
                       nullptr, &kEightExposures},
                      values);
    });
    benchmark::DoNotOptimize(values.data());
  }
  state.SetItemsProcessed(std::int64_t(state.iterations()) * kWidth * kHeight);
}

const int kRegistered = [] {
  for (const auto& [name, id] :
       {std::pair{"compare/flip_ldr_1080p", "flip.ldr.mean"},
        std::pair{"compare/flip_hdr_8_exposures_1080p", "flip.hdr.mean"}}) {
    auto* flip = benchmark::RegisterBenchmark(name, measure_flip, id);
    flip->Arg(1)->Arg(0)->MeasureProcessCPUTime()->UseRealTime();
  }
  return 0;
}();

/// The sum of in(x + i, y + j) * across[i] * down[j] over the window. Border pixels repeat.
template <class In>
double convolve(const In& in, int width, int height, int x, int y, const FlipTaps& across,
                const FlipTaps& down) {
  const int radius = int(std::min(across.size(), down.size())) - 1;
  double sum = 0;
  for (int j = -radius; j <= radius; ++j)
    for (int i = -radius; i <= radius; ++i)
      sum += across[std::size_t(std::abs(i))] * down[std::size_t(std::abs(j))] *
             in(std::clamp(x + i, 0, width - 1), std::clamp(y + j, 0, height - 1));
  return sum;
}

/// The filters of LDR-FLIP for both pictures on a crop, without the distance of the results.
void plain_filters(benchmark::State& state) {
  constexpr int kWidth = 192, kHeight = 108;
  const FlipFilters f(kDefaultPixelsPerDegree);
  const Image images[] = {picture(kWidth, kHeight, 1, 0.2f), picture(kWidth, kHeight, 2, 0.1f)};
  double sum = 0;
  for (auto _ : state)
    for (const Image& image : images) {
      static_assert(kWidth * kHeight % kFlipBlock == 0);
      std::vector<double> planes[3];
      for (auto& plane : planes) plane.resize(image.pixel_count());
      std::vector<float> shown(image.values().size());
      for (int y = 0; y < kHeight; ++y)
        DisplayLight(image, 0).fill(
            y, 0, std::span(shown).subspan(std::size_t(3 * kWidth * y), 3 * kWidth));
      flip_colours(shown.data(), {planes[0].data(), planes[1].data(), planes[2].data()},
                   image.pixel_count());
      const auto plane = [&](std::size_t i) {
        return [&values = planes[i]](int x, int y) {
          return values[std::size_t(y) * kWidth + std::size_t(x)];
        };
      };
      const auto lum = plane(0), cx = plane(1), cz = plane(2), &grey = lum;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const auto filtered = [&](const auto& in, const auto& across, const auto& down) {
            sum += convolve(in, kWidth, kHeight, x, y, across, down);
          };
          filtered(lum, f.luminance, f.luminance);
          filtered(cx, f.red_green, f.red_green);
          filtered(cz, f.blue_yellow_1, f.blue_yellow_1);
          filtered(cz, f.blue_yellow_2, f.blue_yellow_2);
          filtered(grey, f.edge, f.gaussian);
          filtered(grey, f.gaussian, f.edge);
          filtered(grey, f.point, f.gaussian);
          filtered(grey, f.gaussian, f.point);
        }
    }
  benchmark::DoNotOptimize(sum);
  state.SetItemsProcessed(std::int64_t(state.iterations()) * kWidth * kHeight);
}
BENCHMARK(plain_filters)->Name("compare/flip_plain_filters_192x108")->UseRealTime();

}  // namespace
}  // namespace lobelia

// Nanoseconds to shade one point: every model and lobe, and std::pow of a dot product as in a textbook. One thread,
// points in the first-level cache.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>

#include "renderer/highlight.hpp"
#include "renderer/kernels/kernels.hpp"

namespace lobelia {
namespace {

constexpr double kExponent = 128;

/// Points of a sphere around its highlight.
struct Points {
  Vec3Chunk normal{}, to_eye{}, to_light{};
  alignas(64) double value[kChunk]{};
  Points() {
    std::mt19937_64 random(1);
    std::normal_distribution<double> spread(0, 0.1);
    for (std::size_t i = 0; i < kChunk; ++i) {
      const auto put = [&](Vec3Chunk& to, Vec3 v) {
        v = normalize(v);
        to.x[i] = v.x, to.y[i] = v.y, to.z[i] = v.z;
      };
      put(normal, {spread(random), spread(random), 1});
      put(to_eye, {0.3, 0, 1});
      put(to_light, {-0.3, 0, 1});
    }
  }
};

void shade(benchmark::State& state, ModelId model, LobeId lobe, Precision precision) {
  Points points;
  const Highlight highlight{model, lobe, Normalisation::kExact, kExponent};
  const auto kernel = kernels().shade(highlight, precision);
  for (auto _ : state) {
    kernel(highlight, kChunk, points.normal, points.to_eye, points.to_light, points.value);
    benchmark::DoNotOptimize(points.value);
  }
  // Checked after timing: a wrong kernel may be fast.
  for (std::size_t i = 0; i < kChunk; ++i) {
    const Vec3 n{points.normal.x[i], points.normal.y[i], points.normal.z[i]};
    const Vec3 v{points.to_eye.x[i], points.to_eye.y[i], points.to_eye.z[i]};
    const Vec3 l{points.to_light.x[i], points.to_light.y[i], points.to_light.z[i]};
    const Vec3 d = info(model).angle == LobeAngle::kReflection ? 2 * dot(n, v) * n - v - l
                                                               : n - normalize(l + v);
    const double truth = highlight_radiance(highlight, dot(n, l), dot(n, v), dot(d, d) / 2) /
                         radiance_coefficient(highlight);
    const double allowed = precision == Precision::kFloat64 ? 1e-12 : 2e-5;
    if (std::abs(points.value[i] - truth) > allowed) state.SkipWithError("wrong result");
  }
  state.SetItemsProcessed(std::int64_t(state.iterations()) * std::int64_t(kChunk));
  state.SetLabel(kernels().instruction_set);
}

void shade_with_pow(benchmark::State& state) {
  Points p;
  for (auto _ : state) {
    for (std::size_t i = 0; i < kChunk; ++i) {
      const double n_dot_v = p.normal.x[i] * p.to_eye.x[i] + p.normal.y[i] * p.to_eye.y[i] +
                             p.normal.z[i] * p.to_eye.z[i];
      const double n_dot_l = p.normal.x[i] * p.to_light.x[i] + p.normal.y[i] * p.to_light.y[i] +
                             p.normal.z[i] * p.to_light.z[i];
      const double v_dot_l = p.to_eye.x[i] * p.to_light.x[i] + p.to_eye.y[i] * p.to_light.y[i] +
                             p.to_eye.z[i] * p.to_light.z[i];
      const double r_dot_l = 2 * n_dot_v * n_dot_l - v_dot_l;
      p.value[i] = n_dot_l > 0 && r_dot_l > 0 ? std::pow(r_dot_l, kExponent) : 0;
    }
    benchmark::DoNotOptimize(p.value);
  }
  state.SetItemsProcessed(std::int64_t(state.iterations()) * std::int64_t(kChunk));
  state.SetLabel("scalar, std::pow");
}

const int kRegistered = [] {
  benchmark::RegisterBenchmark("shade/phong_rdf/std_pow", shade_with_pow);
  for (const ModelId model : all_models())
    for (const LobeId& lobe : all_lobes())
      for (std::size_t p = 0; p < std::size_t(Precision::kFloat16); ++p)  // not the emulated one
        benchmark::RegisterBenchmark(
            fmt::format("shade/{}/{}/{}", info(model).name, info(lobe).name, precision_names()[p])
                .c_str(),
            shade, model, lobe, Precision(p));
  return 0;
}();

}  // namespace
}  // namespace lobelia

// A comparison of two pictures, all metrics together.
#include <benchmark/benchmark.h>

#include <cmath>

#include "compare/compare.hpp"

namespace lobelia {
namespace {

/// A highlight somewhere in the picture.
Image picture(int size, double x0) {
  Image image(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double u = double(x) / size - x0, v = double(y) / size - 0.5;
      for (float& c : image.pixel(x, y)) c = float(std::exp(-100 * (u * u + v * v)));
    }
  return image;
}

void compare_pictures(benchmark::State& state) {
  const int size = int(state.range(0));
  const Image a = picture(size, 0.5), b = picture(size, 0.51);
  for (auto _ : state)
    if (compare(a, b, {}).verdict == Verdict::kNonFinite) state.SkipWithError("wrong verdict");
  state.SetItemsProcessed(std::int64_t(state.iterations()) * size * size);
}
BENCHMARK(compare_pictures)->Name("compare")->Arg(256)->Arg(1024)->UseRealTime();

}  // namespace
}  // namespace lobelia

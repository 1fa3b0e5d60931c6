#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <cstring>

#include "bench/sections.hpp"
#include "renderer/kernels/kernels.hpp"
#include "studies/cost/lobe_variants.hpp"

namespace lobelia::bench {
namespace {

using cost::lobe_lanes;

constexpr double kExponent = 128;
constexpr std::size_t kPoints = 1024;  // in the first-level cache
constexpr int kRepeats = 20;

struct Points {
  alignas(64) double s[kPoints], value[kPoints];
  alignas(64) float s32[kPoints], value32[kPoints];
  Points() {
    // Across the highlight, where the lobe is neither 1 nor 0.
    for (std::size_t i = 0; i < kPoints; ++i)
      s32[i] = float(s[i] = 8 / kExponent * double(i * 389 % kPoints) / kPoints);
  }
};

void check(double value, double truth, double allowed) {
  if (std::abs(value - truth) <= allowed) return;
  fmt::print(stderr, "wrong result: {} for {}\n", value, truth);
  std::exit(EXIT_FAILURE);
}

void repeat(const std::function<void()>& work) {
  for (int i = 0; i < kRepeats; ++i) work();
}

}  // namespace

void lobes() {
  static Points p;
  std::vector<std::function<void()>> cases;
  cases.push_back([] {
    repeat([] {
      for (std::size_t i = 0; i < kPoints; ++i) p.value[i] = std::pow(1 - p.s[i], kExponent);
    });
  });
  cases.push_back([] {
    repeat([] {
      for (std::size_t i = 0; i < kPoints; ++i)
        p.value32[i] = std::pow(1 - p.s32[i], float(kExponent));
    });
  });
  cases.push_back([] {
    repeat([] {
      std::memcpy(p.value32, p.s32, sizeof(p.s32));
      asm volatile("" ::"r"(p.value32) : "memory");
    });
  });
  const std::size_t first = cases.size();
  std::vector<PreparedLobe> prepared;
  for (const LobeId& lobe : all_lobes()) prepared.push_back(prepare(lobe, kExponent));
  for (std::size_t k = 0; k < all_lobes().size(); ++k) {
    const LobeId lobe = all_lobes()[k];
    cases.push_back([&, k] {
      repeat([&] {
        for (std::size_t i = 0; i < kPoints; ++i) p.value[i] = prepared[k].value(p.s[i]);
      });
    });
    cases.push_back(
        [lobe] { repeat([&] { lobe_lanes(lobe, kExponent, kPoints, p.s, p.value); }); });
    cases.push_back(
        [lobe] { repeat([&] { lobe_lanes(lobe, kExponent, kPoints, p.s32, p.value32); }); });
  }
  const auto times = interleaved(cases, 41);
  const auto ns = [&](std::size_t i) { return times[i].median * 1e9 / (kPoints * kRepeats); };

  fmt::print(
      "\nA lobe at one point, n = {}: ns, one thread, {}; medians of 41 interleaved rounds\n",
      kExponent, kernels().instruction_set);
  fmt::print("{:<20}{:>12}{:>12}{:>12}{:>12}\n", "lobe", "double", "float64", "float32", "spread");
  fmt::print("{:<20}{:>12}{:>12}{:>12}\n", "", "scalar", "lanes", "lanes");
  fmt::print("{:<20}{:>12.2f}{:>12}{:>12}{:>11.1f}%\n", "std::pow, double", ns(0), "", "",
             100 * times[0].spread);
  fmt::print("{:<20}{:>12.2f}{:>12}{:>12}{:>11.1f}%\n", "std::pow, float", ns(1), "", "",
             100 * times[1].spread);
  double slowest = 0, cheapest = 1e9;
  for (std::size_t k = 0; k < all_lobes().size(); ++k) {
    const LobeId lobe = all_lobes()[k];
    const std::size_t at = first + 3 * k;
    fmt::print("{:<20}{:>12.2f}{:>12.3f}{:>12.3f}{:>11.1f}%\n", lobe_names()[k], ns(at), ns(at + 1),
               ns(at + 2), 100 * times[at + 2].spread);
    slowest = std::max(slowest, ns(at + 2));
    cheapest = std::min(cheapest, ns(at + 2));
    lobe_lanes(lobe, kExponent, kPoints, p.s, p.value);
    lobe_lanes(lobe, kExponent, kPoints, p.s32, p.value32);
    const Float32Error error = lobe_float32_error(lobe, kExponent);
    for (std::size_t i = 0; i < kPoints; ++i) {
      check(p.value[i], lobe_value(lobe, p.s[i], kExponent), 1e-13);
      check(p.value32[i], lobe_value(lobe, double(p.s32[i]), kExponent), error.of_peak + 1e-9);
    }
  }
  const double copy = ns(2);
  fmt::print(
      "Limit: {}. Reading and writing as many floats takes {:.3f} ns a point, the cheapest lobe {:.1f} "
      "times that and the dearest {:.0f} times.\n",
      cheapest > 2 * copy ? "compute"
                          : "the first-level cache for the cheapest, compute for the rest",
      copy, cheapest / copy, slowest / copy);
}

}  // namespace lobelia::bench

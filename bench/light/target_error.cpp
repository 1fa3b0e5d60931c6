// What RenderOptions::target_error promises and what it keeps.
#include <fmt/format.h>

#include <cmath>

#include "bench/light/sections.hpp"
#include "core/timing.hpp"
#include "studies/cost/convergence.hpp"

namespace lobelia::bench {
namespace {

using namespace cost;

constexpr int kRepeats = 3, kConverged = 2048;

double median(std::vector<double> values) { return summary(std::move(values)).median; }

}  // namespace

void measure_target_error(const char* title, const Scene& scene) {
  const Image half = render_timed(scene, kConverged, 101).result.image;
  const Image other = render_timed(scene, kConverged, 102).result.image;
  const Image truth = mean_of(half, other);
  const double truth_error = rms_of_difference(half, other) / 2;
  constexpr double kTarget = 1e-2;
  RenderOptions options;
  options.target_error = kTarget;
  std::vector<double> seconds, direct;
  double estimated = 0, squared = 0;
  int samples = 0;
  for (int repeat = 1; repeat <= kRepeats; ++repeat) {
    const Timed timed = render_timed(scene, 64, std::uint64_t(repeat), options);
    seconds.push_back(timed.seconds);
    estimated += timed.result.error.value_or(0) / kRepeats;
    squared += std::pow(rms_of_difference(timed.result.image, truth), 2) / kRepeats;
    samples = timed.result.samples;
    direct.push_back(render_timed(scene, samples, std::uint64_t(repeat)).seconds);
  }
  const double real = std::sqrt(std::max(0.0, squared - truth_error * truth_error)) / rms(truth);
  fmt::print("{:<24} {:>8} {:>12.2e} {:>12.2e} {:>12.2f} {:>10.4f} {:>10.4f}\n", title, samples,
             estimated, real, real / estimated, median(seconds), median(direct));
  fmt::print("  {}\n", median(seconds) < 1.15 * median(direct)
                           ? "limited by sampling, as the picture without a target is"
                           : "limited in part by the rounds: stopping and estimating after each");
}

}  // namespace lobelia::bench

// Light from everywhere: error and time beside Cycles, and growth of time with threads and spheres.
//
//   bench_light [light|threads|crowd]...    the sections to run; all by default
#include <fmt/format.h>
#include <stdlib.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <optional>
#include <span>
#include <thread>

#include "bench/inputs.hpp"
#include "core/threads.hpp"
#include "core/timing.hpp"
#include "renderer/accelerator.hpp"
#include "renderer/plan/plan.hpp"
#include "studies/cost/benchmarks.hpp"
#include "studies/cost/convergence.hpp"
#include "studies/cost/scenes.hpp"
#include "studies/cost/table.hpp"

namespace lobelia::bench {
namespace {

using namespace cost;

double median(std::vector<double> values) { return summary(std::move(values)).median; }

/// From this efficiency on, the processors do not wait for anything that they share.
constexpr double kGoodEfficiency = 0.8;

int processors() { return int(std::max(1u, std::thread::hardware_concurrency())); }

/// The columns, rows and layers of 10^decade spheres, as close to a cube as factors of two and five allow.
constexpr int kDecades = 6;
constexpr std::array<int, 3> kLattices[kDecades + 1] = {
    {1, 1, 1}, {5, 2, 1}, {5, 5, 4}, {10, 10, 10}, {25, 20, 20}, {50, 50, 40}, {100, 100, 100}};

/// The share of the picture covered by spheres, from a sample of its pixels.
double coverage(const Scene& scene, const Accelerator& accelerator) {
  constexpr int kGrid = 64;
  const CameraFrame f = camera_frame(scene.camera, scene.film);
  int hits = 0;
  for (int j = 0; j < kGrid; ++j)
    for (int i = 0; i < kGrid; ++i) {
      const double u = (2 * (i + 0.5) / kGrid - 1) * f.half_width;
      const double v = (1 - 2 * (j + 0.5) / kGrid) * f.half_height;
      if (accelerator.nearest(f.origin, normalize(f.forward + u * f.right + v * f.up), -1).sphere >=
          0)
        ++hits;
    }
  return double(hits) / (kGrid * kGrid);
}

struct CrowdTimes {
  std::vector<double> plan, build, render;  ///< seconds; plan and render without build
  double coverage = 0;
};

void measure_once(const Scene& scene, int threads, CrowdTimes& times) {
  const bool sorted = scene.spheres.size() > kMaxLoopSpheres;
  std::optional<Accelerator> accelerator;
  const double build =
      seconds_of([&] { ThreadLimit(threads).run([&] { accelerator.emplace(scene.spheres); }); });
  if (times.render.empty()) times.coverage = coverage(scene, *accelerator);
  accelerator.reset();
  RenderOptions options;
  options.threads = threads;
  const RenderResult result = render_timed(scene, 1, 0, options).result;
  times.plan.push_back(result.plan_seconds);
  times.build.push_back(sorted ? build : 0);
  times.render.push_back(result.render_seconds - times.build.back());
}

void measure_crowd() {
  constexpr int kSide = 512;
  constexpr double kRays = double(kSide) * kSide;
  std::vector<Scene> scenes;
  for (const auto& lattice : kLattices) scenes.push_back(crowd(lattice, kSide));
  std::vector<CrowdTimes> all(scenes.size()), one(scenes.size());
  for (int repeat = 0; repeat < 5; ++repeat)
    for (std::size_t d = 0; d < scenes.size(); ++d) {
      measure_once(scenes[d], 0, all[d]);
      if (repeat < 3 && (d == 3 || d == kDecades)) measure_once(scenes[d], 1, one[d]);
    }

  fmt::print(
      "\nCrowd: spheres in the same cube, a ray meets as many on the average; {} x {}, one sample, "
      "one lamp with shadows, {} threads, median of 5\n",
      kSide, kSide, processors());
  fmt::print("{:>10} {:>9} {:>9} {:>9} {:>9} {:>9} {:>14} {:>10}\n", "spheres", "covered", "plan s",
             "build s", "render s", "in all s", "ns a ray", "increment");
  std::vector<double> ns;
  for (std::size_t d = 0; d < scenes.size(); ++d) {
    const double plan = median(all[d].plan), build = median(all[d].build);
    const double render = median(all[d].render);
    ns.push_back(1e9 * render / kRays);
    fmt::print("{:>10} {:>8.0f}% {:>9.4f} {:>9.4f} {:>9.4f} {:>9.4f} {:>14.0f}",
               scenes[d].spheres.size(), 100 * all[d].coverage, plan, build, render,
               plan + build + render, ns.back());
    fmt::print("{}\n", d == 0 ? "" : fmt::format(" {:>10.0f}", ns[d] - ns[d - 1]));
  }
  fmt::print(
      "(to {} spheres each is tried; beyond, Embree's hierarchy is built, timed by itself)\n",
      kMaxLoopSpheres);
  const double first = ns[3] - ns[2], last = ns[kDecades] - ns[kDecades - 1];
  fmt::print(
      "each factor of ten costs {:.0f} ns more from 100 to 1000, {:.0f} ns from 1e5 to 1e6: ratio "
      "{:.1f} (a logarithm: 1; in proportion: 1000); first decade {:.0f} ns\n",
      first, last, last / first, ns[1] - ns[0]);
  const double speedup = median(one[kDecades].render) / median(all[kDecades].render);
  const double speedup_small = median(one[3].render) / median(all[3].render);
  fmt::print("{} threads are {:.2f} times as fast as one at 1e6 spheres, {:.2f} at 1000: {}\n",
             processors(), speedup, speedup_small,
             speedup > kGoodEfficiency * speedup_small
                 ? "not what the processors share, but each ray's own steps and waits"
                 : "memory, which they share, limits the large one");
  const double build_share =
      median(all[kDecades].build) /
      (median(all[kDecades].plan) + median(all[kDecades].build) + median(all[kDecades].render));
  fmt::print("building is {:.0f} % of a first picture of 1e6\n", 100 * build_share);
}

void measure_threads() {
  const Scene scene = below_rectangle(256);
  constexpr int kSamples = 64, kRepeats = 5;
  std::vector<int> counts;
  for (int n = 1; n < processors(); n *= 2) counts.push_back(n);
  counts.push_back(processors());
  std::vector<std::vector<double>> seconds(counts.size());
  for (int repeat = 0; repeat < kRepeats; ++repeat)
    for (std::size_t i = 0; i < counts.size(); ++i) {
      RenderOptions options;
      options.threads = counts[i];
      seconds[i].push_back(render_timed(scene, kSamples, 1, options).seconds);
    }
  fmt::print("\nThreads: sphere below a rectangle, 256 x 256, {} samples, median of {}\n", kSamples,
             kRepeats);
  fmt::print("{:>10} {:>10} {:>10} {:>12}\n", "threads", "s", "speed-up", "efficiency");
  double efficiency = 1;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double speedup = median(seconds[0]) / median(seconds[i]);
    efficiency = speedup / counts[i];
    fmt::print("{:>10} {:>10.4f} {:>10.2f} {:>11.0f}%\n", counts[i], median(seconds[i]), speedup,
               100 * efficiency);
  }
  fmt::print("limited by {}\n",
             efficiency > kGoodEfficiency
                 ? "compute"
                 : "what the processors share: memory, power, or other programs");
}

/// The error that RenderOptions::target_error promises, and the real one.
void measure_target_error(const char* title, const Scene& scene) {
  constexpr int kTargetRepeats = 3, kConverged = 2048;
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
  for (int repeat = 1; repeat <= kTargetRepeats; ++repeat) {
    const Timed timed = render_timed(scene, 64, std::uint64_t(repeat), options);
    seconds.push_back(timed.seconds);
    estimated += timed.result.error.value_or(0) / kTargetRepeats;
    squared += std::pow(rms_of_difference(timed.result.image, truth), 2) / kTargetRepeats;
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

void measure_light() {
  records::Cost report;
  report.tables = cost::measure_transport({});
  for (cost::Table& table : report.tables) cost::add_fronts(table);
  fmt::print("{}", cost::cost_text(report, true));
  constexpr int kSide = 96;
  fmt::print(
      "\nAn error of 1e-2 asked: what is estimated and what it is, and the time beside that of as "
      "many samples at once\n{:<24} {:>8} {:>12} {:>12} {:>12} {:>10} {:>10}\n",
      "", "samples", "estimated", "real", "ratio", "s", "at once s");
  measure_target_error("rectangle of light", cost::below_rectangle(kSide));
  measure_target_error("sky with a small sun", cost::below_sky(kSide));
}

}  // namespace
}  // namespace lobelia::bench

int main(int count, char** arguments) try {
  using namespace lobelia::bench;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // someone may watch through a pipe
  double load = 0;
  if (::getloadavg(&load, 1) == 1 && load > 0.5 * processors())
    fmt::print("other programs keep {:.1f} of {} processors busy: times are not to be relied on\n",
               load, processors());
  const std::span<char*> chosen(arguments + 1, arguments + count);
  const auto wanted = [&](std::string_view name) {
    return chosen.empty() || std::ranges::find(chosen, name) != chosen.end();
  };
  if (wanted("light")) measure_light();
  if (wanted("threads")) measure_threads();
  if (wanted("crowd")) measure_crowd();
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "bench_light: {}\n", error.what());
  return 1;
}

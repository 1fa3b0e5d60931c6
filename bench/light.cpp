// Light from everywhere: error and time beside Cycles, and growth of time with threads and spheres.
//
//   bench_light [light|threads|crowd]...    the sections to run; all by default
#include <fmt/format.h>
#include <malloc.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <span>
#include <thread>

#include "bench/inputs.hpp"
#include "core/timing.hpp"
#include "renderer/accelerator.hpp"
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

/// Bytes of memory that this process holds now.
double resident_bytes() {
  std::int64_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return double(resident) * double(::sysconf(_SC_PAGESIZE));
}

void measure_crowd(CrowdKind kind, const char* title) {
  constexpr int kSide = 256, kSamples = 16;
  fmt::print(
      "\n{}: {} x {}, {} samples, one lamp with shadows, {} threads, median of 5\n"
      "{:>10} {:>13} {:>9} {:>9} {:>9} {:>16} {:>10}\n",
      title, kSide, kSide, kSamples, processors(), "spheres", "bytes of each", "plan s", "build s",
      "render s", "ns a camera ray", "increment");
  double before = 0;
  for (const auto& lattice :
       {std::array{10, 10, 10}, {25, 20, 20}, {50, 50, 40}, {100, 100, 100}, {200, 200, 100}}) {
    const Scene scene = crowd(kind, lattice, kSide);
    ::malloc_trim(0);  // what was released before would be counted as well
    const double without = resident_bytes();
    auto accelerator = std::make_unique<Accelerator>(scene.spheres);
    const double bytes =
        sizeof(Sphere) + (resident_bytes() - without) / double(scene.spheres.size());
    accelerator.reset();
    std::vector<double> plan, build, trace;
    double rays = 0;
    for (int repeat = 0; repeat < 5; ++repeat) {
      const RenderResult result = render_timed(scene, kSamples, 1).result;
      plan.push_back(result.plan_seconds);
      build.push_back(result.build_seconds);
      trace.push_back(result.render_seconds - result.build_seconds);
      rays = double(result.work.camera_rays);
    }
    const double ns = 1e9 * median(trace) / rays;
    // Below that, what a few pages more or less hold would be counted.
    constexpr std::size_t kCountable = 100000;
    fmt::print("{:>10} {:>13} {:>9.4f} {:>9.4f} {:>9.4f} {:>16.0f} {:>10}\n", scene.spheres.size(),
               scene.spheres.size() >= kCountable ? fmt::format("{:.0f}", bytes) : "", median(plan),
               median(build), median(trace), ns,
               before > 0 ? fmt::format("{:.0f}", ns - before) : "");
    before = ns;
  }
}

void measure_crowds() {
  measure_crowd(CrowdKind::kPacked, "Packed crowd, spheres of 0.4 times their spacing");
  measure_crowd(CrowdKind::kThin, "Thin crowd, a ray through it meets half a sphere on average");
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
  if (wanted("crowd")) measure_crowds();
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "bench_light: {}\n", error.what());
  return 1;
}

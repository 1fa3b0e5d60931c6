// Light that comes from everywhere: time to equal error beside Cycles, and how time grows with threads
// and spheres.
//
//   bench_light [LOBELIA [light|threads|crowd]...]    the program, for whole processes; what to measure
#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <span>
#include <string_view>

#include "bench/light/measure.hpp"
#include "bench/light/scenes.hpp"
#include "bench/light/sections.hpp"
#include "core/files.hpp"
#include "core/process.hpp"

namespace lobelia::bench {
namespace {

void measure_light(const std::filesystem::path& program) {
  constexpr int kSide = 96;
  const TemporaryDirectory directory;
  const auto blender = find_program("blender");
  if (blender.empty()) fmt::print("Blender is not installed: ours alone\n");
  const Scene lamp = below_rectangle(kSide), sky = below_sky(kSide, directory.path());
  const Converged lamp_truth =
      compare_with_cycles("Rectangle of light", lamp, directory.path(), blender, program);
  const Converged sky_truth =
      compare_with_cycles("Sky with a small sun", sky, directory.path(), blender, program);
  fmt::print(
      "\nAn error of 1e-2 asked: what is estimated and what it is, and the time beside that of as "
      "many samples at once\n{:<24} {:>8} {:>12} {:>12} {:>12} {:>10} {:>10}\n",
      "", "samples", "estimated", "real", "ratio", "s", "at once s");
  measure_target_error("rectangle of light", lamp, lamp_truth);
  measure_target_error("sky with a small sun", sky, sky_truth);
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
  const std::span<char*> chosen(arguments + std::min(count, 2), arguments + count);
  const auto wanted = [&](std::string_view name) {
    return chosen.empty() || std::ranges::find(chosen, name) != chosen.end();
  };
  if (wanted("light")) measure_light(count > 1 ? arguments[1] : "");
  if (wanted("threads")) measure_threads();
  if (wanted("crowd")) measure_crowd();
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "bench_light: {}\n", error.what());
  return 1;
}

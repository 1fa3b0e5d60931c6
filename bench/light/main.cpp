// Light that comes from everywhere: error and time beside Cycles, and how time grows with threads
// and spheres.
//
//   bench_light [light|threads|crowd]...    what to measure
#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <span>
#include <string_view>

#include "bench/light/sections.hpp"
#include "studies/cost/benchmarks.hpp"
#include "studies/cost/scenes.hpp"
#include "studies/cost/table.hpp"

namespace lobelia::bench {
namespace {

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

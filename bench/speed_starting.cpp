#include <fmt/format.h>

#include "bench/sections.hpp"
#include "core/process.hpp"
#include "core/timing.hpp"

namespace lobelia::bench {

void starting() {
  const auto times = interleaved({[] { run_process({"/bin/true"}, {}); }}, 1000).front();
  fmt::print("a program that does nothing: {:.2f} ms, spread {:.0f} %, {:.2f} to {:.2f} ms\n",
             1e3 * times.median, 100 * times.spread, 1e3 * times.least, 1e3 * times.most);
}

}  // namespace lobelia::bench

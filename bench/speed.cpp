#include <fmt/format.h>

#include <cstdlib>
#include <string_view>

#include "bench/sections.hpp"

/// speed lobes|pictures|threads|plan|exr|reading|starting, speed trace SCENE, speed sizes|comparisons PROGRAM
int main(int count, char** arguments) {
  using namespace lobelia::bench;
  const std::string_view what = count > 1 ? arguments[1] : "";
  const std::string which = count > 2 ? arguments[2] : "";
  if (what == "lobes")
    lobes();
  else if (what == "pictures")
    pictures();
  else if (what == "trace")
    trace(which);
  else if (what == "threads")
    threads();
  else if (what == "sizes")
    sizes(which);
  else if (what == "comparisons")
    comparisons(which);
  else if (what == "plan")
    plan();
  else if (what == "exr")
    exr();
  else if (what == "reading")
    reading();
  else if (what == "starting")
    starting();
  else
    return fmt::print(stderr, "speed: no section '{}'\n", what), EXIT_FAILURE;
  return EXIT_SUCCESS;
}

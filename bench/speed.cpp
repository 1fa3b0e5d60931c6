#include <fmt/format.h>

#include <map>

#include "bench/sections.hpp"

/// bench_speed lobes|pictures|threads|plan|exr|reading|starting, bench_speed trace SCENE,
/// bench_speed sizes|comparisons|others PROGRAM
int main(int count, char** arguments) try {
  using namespace lobelia::bench;
  const std::string name = count > 1 ? arguments[1] : "", argument = count > 2 ? arguments[2] : "";
  const std::map<std::string, std::function<void()>> sections = {
      {"lobes", lobes},
      {"pictures", pictures},
      {"trace", [&] { trace(argument); }},
      {"threads", threads},
      {"sizes", [&] { sizes(argument); }},
      {"comparisons", [&] { comparisons(argument); }},
      {"others", [&] { others(argument); }},
      {"plan", plan},
      {"exr", exr},
      {"reading", reading},
      {"starting", starting}};
  const auto section = sections.find(name);
  if (section == sections.end()) {
    fmt::print(stderr, "speed: no section '{}'\n", name);
    return EXIT_FAILURE;
  }
  section->second();
  return EXIT_SUCCESS;
} catch (const std::exception& error) {
  fmt::print(stderr, "speed: {}\n", error.what());
  return EXIT_FAILURE;
}

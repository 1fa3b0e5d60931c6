#include <fmt/format.h>

#include <cstdlib>
#include <map>

#include "bench/sections.hpp"
#include "lobelia_paths.hpp"

namespace lobelia::bench {

std::string scene_file(std::string_view name) {
  return fmt::format("{}/reference_scenes/scenes/{}.xml", LOBELIA_SOURCE_DIR, name);
}

ProcessResult run(const std::vector<std::string>& command) {
  ProcessResult result = run_process(command, {});
  if (result.exit_code == 0) return result;
  fmt::print(stderr, "{} failed\n", command[0]);
  std::exit(EXIT_FAILURE);
}

}  // namespace lobelia::bench

/// bench_speed lobes|pictures|threads|plan|exr|reading|starting, bench_speed trace SCENE,
/// bench_speed sizes|comparisons|others PROGRAM
int main(int count, char** arguments) {
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
}

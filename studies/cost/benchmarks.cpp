#include "studies/cost/benchmarks.hpp"

#include <algorithm>

#include "base/system/error.hpp"
#include "base/system/host.hpp"
#include "renderer/kernels/kernels.hpp"

namespace lobelia::cost {
namespace {

constexpr Benchmark kBenchmarks[] = {
    {"lobe", "every lobe, computed in every variant", false, &measure_lobes},
    {"picture", "milliseconds a megapixel over the errors of the picture", true, &measure_pictures},
    {"transport",
     "light transport: error over samples and time, with and without importance sampling", false,
     &measure_transport},
};

}  // namespace

std::span<const Benchmark> benchmarks() { return kBenchmarks; }

std::vector<const Benchmark*> chosen_benchmarks(const std::vector<std::string>& names,
                                                bool has_scenes) {
  std::vector<const Benchmark*> chosen;
  for (const Benchmark& one : kBenchmarks) {
    const bool named = std::ranges::count(names, one.name) > 0;
    const bool lacks_scene = one.needs_scenes && !has_scenes;
    if (named && lacks_scene) throw Error(ExitCode::kUsage, "--level {} needs a SCENE", one.name);
    if (named || (names.empty() && !lacks_scene)) chosen.push_back(&one);
  }
  return chosen;
}

records::Cost measure(const std::vector<const Benchmark*>& chosen, Options options,
                      std::vector<std::string> command) {
  records::Cost report{std::move(command), records::this_host(), kernels().instruction_set, {}};
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    options.done = double(i) / double(chosen.size());
    options.level = chosen[i]->name;
    options.progress("begins");
    for (Table& table : chosen[i]->measure(options)) {
      add_fronts(table);
      report.tables.push_back(std::move(table));
    }
  }
  return report;
}

}  // namespace lobelia::cost

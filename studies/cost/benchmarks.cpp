#include "studies/cost/benchmarks.hpp"

#include "core/host.hpp"

namespace lobelia::cost {
namespace {

constexpr Benchmark kBenchmarks[] = {
    {"lobe", "every lobe, computed in every variant", false, &measure_lobes},
    {"picture", "milliseconds a megapixel over the errors of the picture", true, &measure_pictures},
    {"transport",
     "light transport: error over samples and time, with and without importance sampling", false,
     &measure_transport},
    {"engine", "whole programs on the same picture: ours, POV-Ray, Cycles", true, &measure_engines},
    {"effects", "each effect of light: what it costs, and what the picture loses without it", false,
     &measure_effects},
};

}  // namespace

std::span<const Benchmark> benchmarks() { return kBenchmarks; }

std::filesystem::path Options::program(std::string_view engine) const {
  for (const auto& [name, path] : programs)
    if (name == engine) return path;
  // Resolved here: in the keeper process that starts it, the link would lead to the keeper.
  return engine == "lobelia" ? program_file() : std::filesystem::path();
}

}  // namespace lobelia::cost

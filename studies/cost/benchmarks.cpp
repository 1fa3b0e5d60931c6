#include "studies/cost/benchmarks.hpp"

#include "studies/cost/effects_benchmark.hpp"
#include "studies/cost/engine_benchmark.hpp"
#include "studies/cost/fixed_point_benchmark.hpp"
#include "studies/cost/lobe_benchmark.hpp"
#include "studies/cost/picture_benchmark.hpp"
#include "studies/cost/transport_benchmark.hpp"

namespace lobelia::cost {
namespace {

constexpr Benchmark kBenchmarks[] = {
    {"lobe", "every lobe and every way of computing it", false, &measure_lobes},
    {"fixed-point", "lobes as circuits, by their number of bits", false, &measure_fixed_point},
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

}  // namespace lobelia::cost

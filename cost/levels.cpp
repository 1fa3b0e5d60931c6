#include "cost/levels.hpp"

#include "cost/effects_level.hpp"
#include "cost/engine_level.hpp"
#include "cost/fixed_point_level.hpp"
#include "cost/lobe_level.hpp"
#include "cost/picture_level.hpp"
#include "cost/transport_level.hpp"

namespace lobelia::cost {
namespace {

constexpr Level kLevels[] = {
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

std::span<const Level> levels() { return kLevels; }

}  // namespace lobelia::cost

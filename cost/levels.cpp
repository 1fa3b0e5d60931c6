#include "cost/levels.hpp"

#include "cost/level_fixed_point.hpp"
#include "cost/level_lobe.hpp"
#include "cost/level_picture.hpp"

namespace lobelia::cost {
namespace {

constexpr Level kLevels[] = {
    {"lobe", "every lobe and every way of computing it", false, &measure_lobes},
    {"fixed-point", "lobes as circuits, by their number of bits", false, &measure_fixed_point},
    {"picture", "milliseconds a megapixel over the errors of the picture", true, &measure_pictures},
};

}  // namespace

std::span<const Level> levels() { return kLevels; }

const Level* find_level(std::string_view name) {
  for (const Level& level : levels())
    if (level.name == name) return &level;
  return nullptr;
}

}  // namespace lobelia::cost

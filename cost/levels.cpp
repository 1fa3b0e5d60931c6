#include "cost/levels.hpp"

#include "cost/level_picture.hpp"

namespace lobelia::cost {
namespace {

constexpr Level kLevels[] = {
    {"picture", "milliseconds a megapixel over the errors of the picture", true, measure_pictures},
};

}  // namespace

std::span<const Level> levels() { return kLevels; }

const Level* find_level(std::string_view name) {
  for (const Level& level : levels())
    if (level.name == name) return &level;
  return nullptr;
}

}  // namespace lobelia::cost

#include "cost/levels.hpp"

namespace lobelia::cost {
namespace {

constexpr std::span<const Level> kLevels{};

}  // namespace

std::span<const Level> levels() { return kLevels; }

const Level* find_level(std::string_view name) {
  for (const Level& level : levels())
    if (level.name == name) return &level;
  return nullptr;
}

}  // namespace lobelia::cost

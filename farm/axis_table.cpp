#include "farm/axis_table.hpp"

#include <fmt/format.h>

#include "core/text.hpp"

namespace lobelia {

std::size_t part_count(const Scene& scene) {
  return scene.spheres.size() + scene.planes.size() + scene.materials.size() + scene.lights.size();
}

std::optional<ValueIndex> AxisTable::find(const std::string& text) const {
  const auto found = by_text_.find(text);
  if (found == by_text_.end()) return std::nullopt;
  return found->second;
}

ValueIndex AxisTable::find_or_add(const std::string& text) {
  // By the text first, so that a file named a thousand times is read once.
  if (const auto known = find(text)) return *known;
  if (axis_.values.size() >= kMaxAxisValues)
    throw std::runtime_error(fmt::format("over {} values on the axis '{}'; allowed: {}",
                                         kMaxAxisValues, axis_.name, kMaxAxisValues));
  AxisValue value = kind_->parse(text, directory_);
  if (!tokens_.insert(value.token).second)
    throw std::runtime_error(
        fmt::format("'{}' would have the same file name as another value of the axis '{}'",
                    printable(text), axis_.name));
  if (value.scene) parts_ += part_count(*value.scene);
  if (parts_ > kMaxHeldParts)
    throw std::runtime_error(
        fmt::format("over {} shapes, materials and lights in the scenes of the axis; allowed: {}",
                    kMaxHeldParts, kMaxHeldParts));
  const auto index = ValueIndex(axis_.values.size());
  axis_.values.push_back(std::move(value));
  by_text_.emplace(text, index);
  return index;
}

}  // namespace lobelia

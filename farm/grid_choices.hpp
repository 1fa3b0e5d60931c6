// The values of a grid file's axes, what it takes away from their product, and what it adds.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "base/words/text.hpp"
#include "farm/grid.hpp"
#include "renderer/scene/xml_source.hpp"

namespace lobelia {

inline constexpr std::size_t kMaxAxisValues = 10000;

/// An axis, or the axes of a list: each step has one value of each axis.
struct GridFactor {
  std::vector<std::vector<ValueIndex>> steps;  ///< by axis; all of one length, at least 1

  std::size_t size() const { return steps.front().size(); }
};

/// Shapes, materials and lights of all scenes of an axis, which stay in memory.
inline constexpr std::size_t kMaxHeldParts = 10000000;
/// Combinations that all exclusions of a grid may name together, counted as often as they are named.
inline constexpr std::size_t kMaxExcluded = 20000000;

/// Shapes, materials and lights.
inline std::size_t part_count(const Scene& scene) {
  return scene.spheres.size() + scene.planes.size() + scene.materials.size() + scene.lights.size();
}

/// The values of an axis while its grid is read: each once, by its text.
class AxisTable {
 public:
  AxisTable(const AxisKind& kind, std::filesystem::path directory)
      : kind_(&kind), directory_(std::move(directory)), axis_{std::string(kind.name), {}} {}

  const Axis& axis() const { return axis_; }
  Axis take() { return std::move(axis_); }

  std::optional<ValueIndex> find(const std::string& text) const {
    const auto found = by_text_.find(text);
    if (found == by_text_.end()) return std::nullopt;
    return found->second;
  }
  /// Reads the value if it is new. Throws std::runtime_error as AxisKind::parse, for too many values, or two with one token.
  ValueIndex find_or_add(const std::string& text) {
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

 private:
  const AxisKind* kind_;
  std::filesystem::path directory_;
  Axis axis_;
  std::unordered_map<std::string, ValueIndex> by_text_;
  std::unordered_set<std::string> tokens_;
  std::size_t parts_ = 0;
};

/// Advances like a counter whose last digit runs fastest; false after the last.
inline bool count_on(std::vector<std::size_t>& digits, std::span<const std::size_t> sizes) {
  for (std::size_t i = digits.size(); i-- > 0;) {
    if (++digits[i] < sizes[i]) return true;
    digits[i] = 0;
  }
  return false;
}

/// The combinations of values that a grid has: the product of its factors without what is excluded.
class GridPlaces {
 public:
  explicit GridPlaces(std::vector<GridFactor> factors) : factors_(std::move(factors)) {
    std::size_t count = 1;
    for (const auto& factor : factors_) count *= factor.size();
    excluded_.resize(count);
  }

  /// Removes the combinations of the values chosen on each axis (none: all values). Returns how many that names. Throws
  /// std::runtime_error over kMaxExcluded.
  std::size_t exclude(std::span<const std::vector<bool>> chosen) {
    // Visits named combinations only: a grid may have many exclusions of few cells each.
    std::vector<std::vector<std::size_t>> named;
    std::vector<std::size_t> sizes;
    std::size_t axis = 0, count = 1;
    for (const auto& factor : factors_) {
      auto& steps = named.emplace_back();
      for (std::size_t step = 0; step < factor.size(); ++step) {
        bool all = true;
        for (std::size_t i = 0; i < factor.steps.size(); ++i) {
          const auto& choices = chosen[axis + i];
          all = all && (choices.empty() || choices[factor.steps[i][step]]);
        }
        if (all) steps.push_back(step);
      }
      axis += factor.steps.size();
      sizes.push_back(steps.size());
      count *= steps.size();
    }
    if (count == 0) return 0;
    named_ += count;
    if (named_ > kMaxExcluded)
      throw std::runtime_error(
          fmt::format("the <exclude> elements name over {} cells together; allowed: {}",
                      kMaxExcluded, kMaxExcluded));
    std::vector<std::size_t> digits(factors_.size());
    do {
      std::size_t number = 0;
      for (std::size_t f = 0; f < factors_.size(); ++f)
        number = number * factors_[f].size() + named[f][digits[f]];
      excluded_[number] = true;
    } while (count_on(digits, sizes));
    return count;
  }

  /// The values on all axes, combination after combination, the last factor running fastest.
  std::vector<ValueIndex> kept() const {
    std::vector<std::size_t> sizes;
    for (const auto& factor : factors_) sizes.push_back(factor.size());
    std::vector<ValueIndex> places;
    std::vector<std::size_t> digits(factors_.size());
    std::size_t number = 0;
    do {
      if (excluded_[number++]) continue;
      for (std::size_t f = 0; f < factors_.size(); ++f)
        for (const auto& steps : factors_[f].steps) places.push_back(steps[digits[f]]);
    } while (count_on(digits, sizes));
    return places;
  }

 private:
  std::vector<GridFactor> factors_;
  std::vector<bool> excluded_;  ///< by number in the product
  std::size_t named_ = 0;       ///< by all exclusions
};

class ChoiceReader {
 public:
  ChoiceReader(XmlSource& source, std::vector<AxisTable>& axes) : source_(source), axes_(axes) {
    for (const auto& table : axes_) names_.push_back(table.axis().name);
  }

  void exclude(pugi::xml_node node, GridPlaces& places) {
    if (!has_known_attributes(node)) return;
    std::vector<std::vector<bool>> chosen;
    bool valid = true, any = false;
    for (const auto& table : axes_) {
      chosen.emplace_back();
      const auto attribute = node.attribute(table.axis().name.c_str());
      any = any || attribute;
      if (attribute) valid = read_chosen(node, attribute, table, chosen.back()) && valid;
    }
    if (!any)
      source_.error(node, fmt::format("<exclude> names no axis; allowed: {}", join(names_)));
    if (!any || !valid) return;
    try {
      if (places.exclude(chosen) == 0)
        source_.error(node, "the <exclude> matches no cell: the values never stand together");
    } catch (const std::runtime_error& error) {
      source_.error(node, error.what());
    }
  }

  /// The values of the cell, or none if something is wrong.
  std::vector<ValueIndex> include(pugi::xml_node node) {
    if (!has_known_attributes(node)) return {};
    std::vector<ValueIndex> at;
    for (auto& table : axes_) {
      const char* name = table.axis().name.c_str();
      const std::string text = source_.required(node, name);
      if (!node.attribute(name)) continue;
      try {
        const auto values = split_values(name, text);
        if (values.size() != 1)
          throw std::runtime_error(
              fmt::format("'{}' is not one value; an <include> adds one cell", printable(text)));
        at.push_back(table.find_or_add(values.front()));
      } catch (const std::runtime_error& error) {
        source_.error(node.attribute(name), node, error.what());
      }
    }
    if (at.size() < axes_.size()) at.clear();
    return at;
  }

 private:
  bool has_known_attributes(pugi::xml_node node) {
    if (source_.full()) {
      source_.count_error();
      return false;
    }
    bool known = true;
    for (const auto attribute : node.attributes())
      known = known && std::find(names_.begin(), names_.end(), attribute.name()) != names_.end();
    if (!known) source_.check_attributes(node, names_);
    return known;
  }

  bool read_chosen(pugi::xml_node node, pugi::xml_attribute attribute, const AxisTable& table,
                   std::vector<bool>& chosen) {
    const Axis& axis = table.axis();
    chosen.resize(axis.values.size());
    const auto texts = split_values(axis.name, attribute.value());
    if (texts.empty())
      source_.error(attribute, node, fmt::format("no value of the axis '{}'", axis.name));
    for (const auto& text : texts) {
      if (const auto index = table.find(text)) {
        chosen[*index] = true;
        continue;
      }
      std::vector<std::string_view> values;
      for (const auto& value : axis.values) values.push_back(value.value);
      const std::size_t shown = std::min<std::size_t>(values.size(), 12);
      source_.error(
          attribute, node,
          fmt::format("the <exclude> matches no cell: '{}' is not on the axis '{}'; there "
                      "are: {}{}{}",
                      printable(text), axis.name,
                      printable(join(std::span(values).first(shown)), 400),
                      values.size() > shown ? ", ..." : "", did_you_mean(text, values)));
      return false;
    }
    return !texts.empty();
  }

  XmlSource& source_;
  std::vector<AxisTable>& axes_;
  std::vector<std::string_view> names_;
};

inline void check_ids(XmlSource& source, pugi::xml_node root, const Grid& grid,
                      const std::vector<pugi::xml_node>& includes) {
  const std::size_t width = grid.axes.size(), cells = grid.cell_count();
  std::unordered_set<std::string> ids(cells);
  for (std::size_t c = 0; c < cells && !source.full(); ++c) {
    const std::size_t in_product = cells - includes.size();
    const auto node = c < in_product ? root : includes[c - in_product];
    std::string id = cell_id(grid, std::span(grid.places).subspan(c * width, width));
    if (id.size() > kMaxIdBytes)
      return source.error(node, fmt::format("the cell '{}' has a name of {} bytes; allowed: {}",
                                            printable(id), id.size(), kMaxIdBytes));
    const auto [at, is_new] = ids.insert(std::move(id));
    if (is_new) continue;
    source.error(node,
                 c < in_product
                     ? fmt::format("two cells would be called '{}'; rename a file or leave out "
                                   "a value",
                                   *at)
                     : fmt::format("the cell '{}' is there already", *at));
  }
}

/// Reads the <exclude> and <include> elements of `root` and fills the grid's axes and places. Notes errors in `source`.
/// `axes` are those of the factors, in that order, and are used up. The product of `factors` has at most kMaxCells cells.
inline void read_choices(XmlSource& source, pugi::xml_node root, std::vector<AxisTable>& axes,
                         std::vector<GridFactor> factors, Grid& grid) {
  ChoiceReader reader(source, axes);
  GridPlaces product(std::move(factors));
  for (const auto node : root.children("exclude")) reader.exclude(node, product);
  grid.places = product.kept();
  std::vector<pugi::xml_node> includes;
  for (const auto node : root.children("include")) {
    const auto at = reader.include(node);
    if (at.empty()) continue;
    grid.places.insert(grid.places.end(), at.begin(), at.end());
    includes.push_back(node);
  }
  for (auto& table : axes) grid.axes.push_back(table.take());
  if (grid.places.empty())
    source.error(root, "no cell is left; an <exclude> may not take away all of them");
  if (grid.cell_count() > kMaxCells)
    source.error(root, fmt::format("over {} cells; allowed: {}", kMaxCells, kMaxCells));
  else
    check_ids(source, root, grid, includes);
}

}  // namespace lobelia

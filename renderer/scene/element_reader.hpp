// Elements of a scene file against their tables: names, types, ranges, defaults.
#pragma once

#include <fmt/format.h>

#include <array>
#include <initializer_list>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "core/vec.hpp"
#include "renderer/scene/scene_format.hpp"
#include "renderer/scene/xml_source.hpp"

namespace lobelia {

/// The values of an element's parameters, every one of its table.
class Values {
 public:
  /// The value of one parameter and where it stands.
  struct Value {
    std::array<double, 3> numbers{};
    std::string text;
    pugi::xml_node node;  ///< empty if it is the default
  };

  void set(std::string_view name, Value value) { values_.emplace_back(name, std::move(value)); }
  bool contains(std::string_view name) const { return find(name) != nullptr; }
  const Value& operator[](std::string_view name) const { return *find(name); }
  double number(std::string_view name) const { return find(name)->numbers[0]; }
  Vec3 vec3(std::string_view name) const {
    const auto& n = find(name)->numbers;
    return {n[0], n[1], n[2]};
  }
  Rgb rgb(std::string_view name) const {
    const auto& n = find(name)->numbers;
    return {n[0], n[1], n[2]};
  }

 private:
  const Value* find(std::string_view name) const {
    for (const auto& [known, value] : values_)
      if (known == name) return &value;
    return nullptr;
  }
  std::vector<std::pair<std::string_view, Value>> values_;  ///< few: a search in order is fastest
};

/// The parts between commas and spaces; none of a text too long for three numbers.
std::vector<std::string> split_numbers(std::string_view text);

/// Notes in the source what is wrong, and goes on with a value that can do no harm.
class ElementReader {
 public:
  using Tags = std::initializer_list<std::string_view>;

  explicit ElementReader(XmlSource& source) : source_(source) {}
  XmlSource& source() { return source_; }

  /// Children that are elements; text between them is an error (a forgotten bracket).
  std::vector<pugi::xml_node> elements(pugi::xml_node parent);
  void expect_tag(pugi::xml_node node, Tags allowed);
  /// The format among `formats` that the element's type attribute names; null after an error.
  const ElementFormat* format_of(pugi::xml_node node, std::span<const ElementFormat> formats);
  /// Reads the parameters of an element; children with a tag in `nested` are left to the caller.
  Values read_parameters(pugi::xml_node element, std::span<const Parameter> table, Tags nested);
  /// Whether one more may be read; says so once where not. What is over the limit is not looked at.
  bool within(pugi::xml_node node, std::string_view what, std::int64_t limit, std::int64_t seen);
  bool once(pugi::xml_node node, int& count);
  /// A vector that must have a direction, as a unit vector.
  Vec3 direction(pugi::xml_node element, const Values& values, std::string_view name);

  /// Looks up the value's name with `find`.
  template <class Id, class Find>
  void choose(const Values::Value& value, pugi::xml_node element, std::string_view what,
              std::span<const std::string_view> names, const std::string& allowed, Find find,
              Id& id) {
    if (const auto found = find(value.text)) {
      id = *found;
      return;
    }
    const pugi::xml_node where = value.node ? value.node : element;
    source_.error(where.attribute("value"), where,
                  fmt::format("unknown {} '{}'; allowed: {}{}", what, printable(value.text),
                              allowed, did_you_mean(value.text, names)));
  }

 private:
  std::optional<Values::Value> parse(pugi::xml_node node, const Parameter& parameter,
                                     const std::string& text);
  std::string value_text(pugi::xml_node node);
  Values::Value default_of(const Parameter& parameter);
  void unknown_child(pugi::xml_node node, Tags nested);

  XmlSource& source_;
  std::set<std::string> over_limit_;
};

}  // namespace lobelia

// Reads elements of a scene file by their tables: names, types, ranges, defaults.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "base/words/text.hpp"
#include "base/words/vec.hpp"
#include "renderer/scene/scene_format.hpp"
#include "renderer/scene/xml_source.hpp"

namespace lobelia {

/// The values of all parameters in an element's table.
class Values {
 public:
  /// The value of one parameter, and its place in the file.
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

/// The linear light of a colour such as "#ff8800", as on the web.
std::optional<Rgb> colour_of_hex(std::string_view text);

/// The parts between commas and spaces; none if the text is too long for three numbers.
std::vector<std::string> split_numbers(std::string_view text);

/// Notes errors in the source, and goes on with a harmless value.
class ElementReader {
 public:
  using Tags = const std::vector<std::string_view>&;

  explicit ElementReader(XmlSource& source) : source_(source) {}
  XmlSource& source() { return source_; }

  /// The children that are elements. Text between them is an error: a forgotten bracket.
  std::vector<pugi::xml_node> elements(pugi::xml_node parent);
  /// These three check an element of a scene by the table of its elements.
  void expect_tag(pugi::xml_node node);
  void check_attributes(pugi::xml_node node);
  Values read_parameters(pugi::xml_node element, std::span<const Parameter> table);
  /// The format with the type that the element's attribute names; null after an error.
  const ElementFormat* format_of(pugi::xml_node node, std::span<const ElementFormat> formats);
  /// Reads the parameters of an element. Skips children with a tag in `nested`.
  Values read_parameters(pugi::xml_node element, std::span<const Parameter> table, Tags nested);
  /// Whether one more may be read. Notes a single error if not; the rest is not read.
  bool within(pugi::xml_node node, std::string_view what, std::int64_t limit, std::int64_t seen);
  bool once(pugi::xml_node node, int& count);
  /// A vector that must have a direction, as a unit vector.
  Vec3 direction(pugi::xml_node element, const Values& values, std::string_view name);

  /// Sets `id` to find(value), or notes an error.
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
  void unknown_element(pugi::xml_node node, std::span<const std::string_view> allowed);

  XmlSource& source_;
  std::set<std::string> over_limit_;
};

}  // namespace lobelia

#include "renderer/scene/xml_format.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/words/text.hpp"
#include "renderer/scene/scene_format.hpp"

namespace lobelia {
namespace {

bool is_triple(ParameterType type) {
  return type == ParameterType::kPoint || type == ParameterType::kVector ||
         type == ParameterType::kRgb;
}

std::string annotation(std::string_view text) {
  if (text.empty()) return "";
  return fmt::format("<xs:annotation><xs:documentation>{}</xs:documentation></xs:annotation>",
                     escape_markup(text));
}

std::string choice_of(std::string_view value, std::string_view meaning) {
  return fmt::format("<xs:enumeration value=\"{}\">{}</xs:enumeration>", escape_markup(value),
                     annotation(meaning));
}

std::string describe(const Parameter& p) {
  const std::string allowed =
      p.type == ParameterType::kString
          ? string_choices(p)
          : fmt::format("{:g} to {:g}{}{}", p.min, p.max, p.unit.empty() ? "" : " ", p.unit);
  return fmt::format(
      "{}; allowed: {}; {}", p.meaning, allowed,
      p.default_value.empty() ? "required" : fmt::format("default: {}", p.default_value));
}

std::string restriction(std::string_view base, const std::string& facets) {
  return fmt::format(
      "<xs:simpleType><xs:restriction base=\"xs:{}\">{}</xs:restriction></xs:simpleType>", base,
      facets);
}

std::string number_type(const Parameter& p) {
  const bool whole = p.type == ParameterType::kInteger;
  const auto bound = [&](double value) {
    return whole ? fmt::format("{:.0f}", value) : fmt::format("{}", value);
  };
  return restriction(whole ? "integer" : "double",
                     fmt::format("<xs:minInclusive value=\"{}\"/><xs:maxInclusive value=\"{}\"/>",
                                 bound(p.min), bound(p.max)));
}

/// A list in XML Schema has no commas. So this is a pattern, which knows of the range only whether there is a sign.
std::string triple_type(const Parameter& p) {
  const std::string number =
      fmt::format(R"({}?(\d+(\.\d*)?|\.\d+)([eE][+\-]?\d+)?)", p.min < 0 ? R"([+\-])" : R"(\+)");
  const std::string triple =
      restriction("token", fmt::format("<xs:pattern value=\"{0}([, ]+{0}){{2}}\"/>", number));
  if (p.type != ParameterType::kRgb) return triple;
  return fmt::format("<xs:simpleType><xs:union>{}{}</xs:union></xs:simpleType>", number_type(p),
                     triple);
}

std::string type_of(const Parameter& p) {
  if (p.type == ParameterType::kString) return "";  // any text
  return is_triple(p.type) ? triple_type(p) : number_type(p);
}

std::string attribute(std::string_view name, bool required, std::string_view meaning,
                      std::string_view type) {
  return fmt::format("    <xs:attribute name=\"{}\"{}>{}{}</xs:attribute>\n", name,
                     required ? " use=\"required\"" : "", annotation(meaning), type);
}

/// The parameters of all types of an element that are written with one tag.
struct MergedParameters {
  ParameterType type;
  std::vector<Parameter> parameters;  ///< each name once
  bool always_required = true;        ///< by every type, and the first of them

  Parameter widest() const {
    Parameter result = parameters.front();
    for (const Parameter& p : parameters) {
      result.min = std::min(result.min, p.min);
      result.max = std::max(result.max, p.max);
    }
    return result;
  }
};

std::vector<MergedParameters> merged_parameters(const XmlElement& element) {
  std::vector<MergedParameters> result;
  for (const ElementFormat& format : element.types)
    for (const Parameter& p : format.parameters) {
      auto of_type = std::ranges::find(result, p.type, &MergedParameters::type);
      if (of_type == result.end()) of_type = result.insert(result.end(), {p.type, {}});
      const auto known = std::ranges::find(of_type->parameters, p.name, &Parameter::name);
      if (known == of_type->parameters.end()) {
        of_type->parameters.push_back(p);
        continue;
      }
      known->min = std::min(known->min, p.min);
      known->max = std::max(known->max, p.max);
    }
  for (MergedParameters& merged : result)
    for (const ElementFormat& format : element.types) {
      const auto p =
          std::ranges::find(format.parameters, merged.parameters.front().name, &Parameter::name);
      merged.always_required =
          merged.always_required && p != format.parameters.end() && p->default_value.empty();
    }
  return result;
}

class SchemaWriter {
 public:
  std::string element_type(const XmlElement& element) {
    const auto parameters = merged_parameters(element);
    std::string types;
    parameter_tags_.clear();
    owner_ = element.tag;
    auto groups = element.children;
    for (const MergedParameters& merged : parameters) {
      const std::string_view tag = parameter_tag(merged.type);
      parameter_tags_.push_back(tag);
      // Only a single name can be counted.
      const bool single = merged.parameters.size() == 1;
      groups.push_back({{tag}, single && merged.always_required ? 1 : 0, single ? 1 : kAnyNumber});
      types += parameter_type(merged);
    }
    std::string attributes;
    if (!element.types.empty()) {
      std::string choices;
      for (const ElementFormat& format : element.types)
        choices += choice_of(format.type, format.meaning);
      attributes += attribute("type", true, "", restriction("string", choices));
    }
    for (const auto& [parameter, allowed] : element.attributes) {
      std::string choices;
      for (const std::string_view value : allowed) choices += choice_of(value, "");
      attributes +=
          attribute(parameter.name, parameter.default_value.empty(), parameter.meaning,
                    choices.empty() ? type_of(parameter) : restriction("string", choices));
    }
    return types + fmt::format("  <xs:complexType name=\"{}\">{}\n{}{}  </xs:complexType>\n",
                               element.tag, annotation(element.meaning),
                               groups.empty() ? "" : any_order(groups, 4), attributes);
  }

 private:
  std::string parameter_type(const MergedParameters& merged) {
    std::string names;
    for (const Parameter& p : merged.parameters) names += choice_of(p.name, describe(p));
    const Parameter widest = merged.widest();
    const bool by_axes =
        merged.type == ParameterType::kPoint || merged.type == ParameterType::kVector;
    std::string text =
        fmt::format("  <xs:complexType name=\"{}.{}\">\n", owner_, parameter_tag(merged.type)) +
        attribute("name", true, "", restriction("string", names)) +
        attribute("value", !by_axes, "", type_of(widest));
    if (by_axes)
      for (const char* axis : {"x", "y", "z"})
        text += attribute(axis, false, "", number_type(widest));
    return text + "  </xs:complexType>\n";
  }

  std::string one_of(const std::vector<std::string_view>& tags, int indent,
                     std::string_view occurrence = "") const {
    std::string text;
    for (const std::string_view tag : tags) {
      const bool is_parameter = std::ranges::find(parameter_tags_, tag) != parameter_tags_.end();
      text += fmt::format("{:{}}<xs:element name=\"{}\" type=\"{}{}\"{}/>\n", "",
                          tags.size() > 1 ? indent + 2 : indent, tag,
                          is_parameter ? fmt::format("{}.", owner_) : "", tag,
                          tags.size() > 1 ? "" : occurrence);
    }
    if (tags.size() == 1) return text;
    return fmt::format("{0:{1}}<xs:choice{2}>\n{3}{0:{1}}</xs:choice>\n", "", indent, occurrence,
                       text);
  }

  /// XML Schema counts children only in a fixed order. So this spells out every order of the groups with a limit; the
  /// others may stand anywhere between.
  std::string any_order(const std::vector<XmlChildren>& groups, int indent) const {
    std::vector<std::string_view> free;
    std::vector<XmlChildren> counted;
    for (const XmlChildren& group : groups)
      if (group.most == kAnyNumber && group.least <= 0)
        free.insert(free.end(), group.tags.begin(), group.tags.end());
      else if (group.most != 0)
        counted.push_back(group);
    std::string text = fmt::format("{:{}}<xs:sequence>\n", "", indent);
    if (!free.empty()) text += one_of(free, indent + 2, " minOccurs=\"0\" maxOccurs=\"unbounded\"");
    if (!counted.empty()) {
      const bool may_end = std::ranges::all_of(counted, [](const auto& g) { return g.least <= 0; });
      text +=
          fmt::format("{:{}}<xs:choice{}>\n", "", indent + 2, may_end ? " minOccurs=\"0\"" : "");
      for (std::size_t i = 0; i < counted.size(); ++i) {
        auto rest = counted;
        --rest[i].least;
        if (rest[i].most != kAnyNumber) --rest[i].most;
        if (!free.empty()) rest.push_back({free});
        text += fmt::format("{0:{1}}<xs:sequence>\n{2}{3}{0:{1}}</xs:sequence>\n", "", indent + 4,
                            one_of(counted[i].tags, indent + 6), any_order(rest, indent + 6));
      }
      text += fmt::format("{:{}}</xs:choice>\n", "", indent + 2);
    }
    return text + fmt::format("{:{}}</xs:sequence>\n", "", indent);
  }

  std::string_view owner_;
  std::vector<std::string_view> parameter_tags_;  ///< of the element that is written
};

}  // namespace

std::vector<std::string_view> XmlElement::attribute_names() const {
  std::vector<std::string_view> names;
  if (!types.empty()) names.push_back("type");
  for (const XmlAttribute& attribute : attributes) names.push_back(attribute.parameter.name);
  return names;
}

std::vector<std::string_view> XmlElement::child_tags() const {
  std::vector<std::string_view> all;
  for (const XmlChildren& group : children)
    all.insert(all.end(), group.tags.begin(), group.tags.end());
  return all;
}

const XmlElement& find_element(std::span<const XmlElement> elements, std::string_view tag) {
  return *std::ranges::find(elements, tag, &XmlElement::tag);
}

std::string xml_schema(std::span<const XmlElement> elements, XmlReferences ids) {
  const std::string_view root = elements.front().tag;
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\">\n"
      "  <xs:element name=\"{0}\" type=\"{0}\">\n",
      root);
  if (!ids.keys.empty())
    text += fmt::format(
        "    <xs:unique name=\"id\"><xs:selector xpath=\".//{0}\"/><xs:field xpath=\"@id\"/></xs:unique>\n"
        "    <xs:key name=\"named\"><xs:selector xpath=\"{0}\"/><xs:field xpath=\"@id\"/></xs:key>\n"
        "    <xs:keyref name=\"reference\" refer=\"id\"><xs:selector xpath=\".//{1}\"/>"
        "<xs:field xpath=\"@id\"/></xs:keyref>\n",
        ids.keys, ids.references);
  text += "  </xs:element>\n";
  SchemaWriter writer;
  for (const XmlElement& element : elements) text += writer.element_type(element);
  return text + "</xs:schema>\n";
}

}  // namespace lobelia

// The elements of an XML file as data. The readers check against these tables, and the XML Schema is printed from them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/parameter.hpp"

namespace lobelia {

/// An element <tag type="type">.
struct ElementFormat {
  std::string_view tag, type, meaning;
  std::span<const Parameter> parameters;
};

struct XmlAttribute {
  Parameter parameter;                         ///< of a list of numbers, a point or a vector
  std::vector<std::string_view> choices = {};  ///< of a text; empty: any text
};

/// The most of a kind of children that have no limit of their own.
inline constexpr int kAnyNumber = -1;

/// Children that are elements: from `least` to `most` with one of the tags.
struct XmlChildren {
  std::vector<std::string_view> tags;
  int least = 0, most = kAnyNumber;
};

/// An element. Attributes and children may come in any order.
struct XmlElement {
  std::string_view tag, meaning;
  std::vector<XmlAttribute> attributes;
  std::vector<XmlChildren> children = {};
  /// If there are any: its types, for an attribute "type", and the parameters that each of them may have.
  std::span<const ElementFormat> types = {};

  std::vector<std::string_view> attribute_names() const;
  std::vector<std::string_view> child_tags() const;
};

/// The element of the tag, which must be there.
const XmlElement& find_element(std::span<const XmlElement> elements, std::string_view tag);

/// An identity rule: the attribute "id" of the elements `keys` differs, and that of the elements `references` is one of
/// theirs.
struct XmlReferences {
  std::string_view keys, references;
};

/// An XML Schema 1.0 of files whose root is the first element. Its language cannot tie a parameter to the element's type:
/// a parameter of any of the types is allowed, in the widest of their ranges.
std::string xml_schema(std::span<const XmlElement> elements, XmlReferences ids = {});

}  // namespace lobelia

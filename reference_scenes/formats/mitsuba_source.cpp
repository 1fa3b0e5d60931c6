#include "reference_scenes/formats/mitsuba_source.hpp"

#include <cctype>
#include <cmath>
#include <vector>

#include "base/pictures/colour.hpp"
#include "base/words/constants.hpp"

namespace lobelia {
namespace {

/// Elements of a scene are this deep at most, whatever is meant by them.
constexpr int kMostDepth = 16;
/// The longest attribute with its parameters filled in.
constexpr std::size_t kMostFilledIn = 4096;

/// They say how to sample or to store a picture, or only where rays are cut off.
constexpr std::string_view kWithoutEffect[] = {"near_clip",
                                               "far_clip",
                                               "shutter_open",
                                               "shutter_close",
                                               "sampling_weight",
                                               "component_format",
                                               "pixel_format",
                                               "file_format",
                                               "sample_border",
                                               "banner",
                                               "rr_depth",
                                               "silhouette_sampling_weight",
                                               "srf"};

/// The mirror image of "toWorld" and "intIOR" in names of version 3: "to_world", "int_ior".
std::string in_lower_case_with_underscores(std::string_view name) {
  std::string text;
  bool was_upper = false;
  for (const char c : name) {
    const bool is_upper = std::isupper(static_cast<unsigned char>(c)) != 0;
    if (is_upper && !was_upper) text += '_';
    text += is_upper ? char(c - 'A' + 'a') : c;
    was_upper = is_upper;
  }
  return text;
}

bool is_name_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

Affine rotation(Vec3 axis, double degrees) {
  const double turn = degrees * kPi / 180, c = std::cos(turn), s = std::sin(turn);
  const Vec3 a = normalize(axis);
  const auto turned = [&](Vec3 v) { return c * v + s * cross(a, v) + (1 - c) * dot(a, v) * a; };
  return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1}), {}};
}

}  // namespace

MitsubaSource::MitsubaSource(std::string text, std::string file_name)
    : xml_(std::move(text), std::move(file_name), kMaxSceneBytes) {
  const auto root = xml_.root();
  if (std::string_view(root.name()) != "scene") {
    xml_.error(root, fmt::format("the root element is <{}>; a scene of Mitsuba begins with <scene>",
                                 printable(root.name())));
    xml_.throw_if_errors();
  }
  const std::string version = xml_.required(root, "version");
  is_old_ = version.starts_with("0.") || version.starts_with("1.");
  read_defaults();
  prepare(root, 0);
}

void MitsubaSource::unsupported(pugi::xml_node element, std::string_view instead) {
  if (xml_.full()) return xml_.count_error();
  const std::string its_type =
      type(element).empty() ? "" : fmt::format(" type=\"{}\"", printable(type(element)));
  xml_.error(element, fmt::format("<{}{}> is not supported; {}", printable(element.name()),
                                  its_type, instead));
}

Values MitsubaSource::values(pugi::xml_node element, std::span<const Parameter> table,
                             ElementReader::Tags nested) {
  xml_.check_attributes(element, {"type", "id", "name"});
  return reader_.read_parameters(element, table, nested);
}

void MitsubaSource::read_defaults() {
  for (const auto node : root().children("default")) {
    if (const auto value = node.attribute("value")) fill_in(node, value);
    const std::string name = xml_.required(node, "name");
    if (!name.empty()) defaults_.emplace(name, xml_.required(node, "value"));
  }
}

void MitsubaSource::fill_in(pugi::xml_node node, pugi::xml_attribute attribute) {
  const std::string_view text = attribute.value();
  if (text.find('$') == text.npos) return;
  std::string filled;
  for (std::size_t at = 0; at < text.size();) {
    if (text.substr(at, 2) == "\\$") {
      filled += '$';
      at += 2;
    } else if (text[at] != '$') {
      filled += text[at++];
    } else {
      std::size_t end = at + 1;
      while (end < text.size() && is_name_letter(text[end])) ++end;
      const std::string name(text.substr(at + 1, end - at - 1));
      const auto found = defaults_.find(name);
      if (found == defaults_.end())
        return xml_.error(node,
                          fmt::format("the parameter '${}' has no <default>", printable(name)));
      filled += found->second;
      at = end;
    }
    if (filled.size() > kMostFilledIn)
      return xml_.error(node,
                        fmt::format("a value with its parameters filled in is longer than {} bytes",
                                    kMostFilledIn));
  }
  attribute.set_value(filled.c_str());
}

void MitsubaSource::prepare(pugi::xml_node node, int depth) {
  for (auto child = node.first_child(); child;) {
    const auto next = child.next_sibling();
    if (child.type() == pugi::node_element) {
      if (depth >= kMostDepth) {
        xml_.error(child, fmt::format("<{}> is nested deeper than {} elements; it is left out",
                                      printable(child.name()), kMostDepth));
        node.remove_child(child);
        child = next;
        continue;
      }
      if (std::string_view(child.name()) != "default")
        for (const auto attribute : child.attributes()) fill_in(child, attribute);
      auto name = child.attribute("name");
      if (is_old_ && name) {
        name.set_value(in_lower_case_with_underscores(name.value()).c_str());
      }
      // A new name that is not longer leaves the element its place in the file.
      if (is_old_ && std::string_view(child.name()) == "lookAt") child.set_name("lookat");
      const std::string_view tag = child.name();
      if (std::ranges::find(kWithoutEffect, std::string_view(name.value())) !=
              std::end(kWithoutEffect) &&
          tag != "default") {
        node.remove_child(child);
      } else {
        // A spectrum of one number is the same in every channel.
        const bool has_value = bool(child.attribute("value"));
        if (tag == "spectrum" && has_value && !child.attribute("type")) child.set_name("rgb");
        read_colour(child);
        prepare(child, depth + 1);
      }
    }
    child = next;
  }
}

void MitsubaSource::read_colour(pugi::xml_node node) {
  const bool is_encoded = std::string_view(node.name()) == "srgb";
  auto value = node.attribute("value");
  if ((!is_encoded && std::string_view(node.name()) != "rgb") || !value) return;
  if (const auto colour = colour_of_hex(value.value())) {
    value.set_value(fmt::format("{}, {}, {}", colour->r, colour->g, colour->b).c_str());
  } else if (is_encoded) {
    std::string linear;
    for (const std::string& part : split_numbers(value.value())) {
      double number = 0;
      if (!parse_number(part, number)) return;  // the reader of parameters says so
      linear += fmt::format("{}{}", linear.empty() ? "" : ", ", srgb_decoded(float(number)));
    }
    value.set_value(linear.c_str());
  }
  if (is_encoded) node.set_name("rgb");
}

std::optional<double> MitsubaSource::number(pugi::xml_node node, std::string_view text) {
  double value = 0;
  if (parse_number(text, value) && std::abs(value) <= kFar) return value;
  xml_.error(node,
             fmt::format("'{}' is not a number from {:g} to {:g}", printable(text), -kFar, kFar));
  return std::nullopt;
}

std::optional<Vec3> MitsubaSource::triple(pugi::xml_node node, const char* attribute) {
  const auto parts = split_numbers(node.attribute(attribute).value());
  if (parts.size() != 3) {
    xml_.error(node,
               fmt::format("<{}> needs three numbers in '{}'", printable(node.name()), attribute));
    return std::nullopt;
  }
  const auto x = number(node, parts[0]), y = number(node, parts[1]), z = number(node, parts[2]);
  if (!x || !y || !z) return std::nullopt;
  return Vec3{*x, *y, *z};
}

/// x, y and z, or value with one or three numbers.
std::optional<Vec3> MitsubaSource::components(pugi::xml_node node, double otherwise) {
  if (const auto value = node.attribute("value")) {
    if (split_numbers(value.value()).size() != 1) return triple(node, "value");
    const auto all = number(node, value.value());
    return all ? std::optional(Vec3{*all, *all, *all}) : std::nullopt;
  }
  const auto component = [&](const char* name) {
    const auto attribute = node.attribute(name);
    return attribute ? number(node, attribute.value()) : std::optional(otherwise);
  };
  const auto x = component("x"), y = component("y"), z = component("z");
  if (!x || !y || !z) return std::nullopt;
  return Vec3{*x, *y, *z};
}

std::optional<Affine> MitsubaSource::step(pugi::xml_node node, std::optional<LookAt>& lookat) {
  const std::string_view tag = node.name();
  Affine step;
  if (tag == "translate") {
    const auto by = components(node, 0);
    if (!by) return std::nullopt;
    step.origin = *by;
    return step;
  }
  if (tag == "scale") {
    const auto by = components(node, 1);
    if (!by) return std::nullopt;
    return Affine{{by->x, 0, 0}, {0, by->y, 0}, {0, 0, by->z}, {}};
  }
  if (tag == "rotate") {
    const auto axis = components(node, 0);
    const auto angle = number(node, node.attribute("angle").value());
    if (!axis || !angle) return std::nullopt;
    if (length(*axis) > 0) return rotation(*axis, *angle);
    xml_.error(node, "<rotate> needs an axis that is not zero");
    return std::nullopt;
  }
  if (tag == "lookat") {
    const auto origin = triple(node, "origin"), target = triple(node, "target"),
               up = triple(node, "up");
    if (!origin || !target || !up) return std::nullopt;
    lookat = LookAt{*origin, *target, *up};
    const Vec3 z = normalize(*target - *origin), x = normalize(cross(*up, z));
    if (std::isfinite(dot(x, x))) return Affine{x, cross(z, x), z, *origin};
    xml_.error(node, "<lookat> looks nowhere, or along its up");
    return std::nullopt;
  }
  if (tag == "matrix") {
    const auto parts = split_numbers(node.attribute("value").value());
    const std::size_t side = parts.size() == 9 ? 3 : 4;
    std::vector<double> m;
    for (const auto& part : parts)
      if (const auto value = number(node, part)) m.push_back(*value);
    if (m.size() == parts.size() && m.size() == side * side &&
        (side == 3 || (m[12] == 0 && m[13] == 0 && m[14] == 0 && m[15] == 1))) {
      const auto column = [&](std::size_t c) { return Vec3{m[c], m[side + c], m[2 * side + c]}; };
      return Affine{column(0), column(1), column(2), side == 4 ? column(3) : Vec3{}};
    }
    if (m.size() == parts.size())
      xml_.error(node, "<matrix> needs 9 or 16 numbers, the last four of 16 being 0 0 0 1");
    return std::nullopt;
  }
  xml_.error(node, fmt::format("<{}> is not supported in a transform", printable(tag)));
  return std::nullopt;
}

std::optional<Transform> MitsubaSource::transform(pugi::xml_node element) {
  Transform result;
  for (const auto node : element.children("transform")) {
    if (std::string_view(node.attribute("name").value()) != "to_world" || !result.is_identity) {
      xml_.error(node, "one <transform name=\"to_world\"> is supported here");
      return std::nullopt;
    }
    for (const auto child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      std::optional<LookAt> lookat;
      const auto next = step(child, lookat);
      if (!next) return std::nullopt;
      // The first is taken as it is: a product with the identity could change the sign of a zero.
      result.matrix = result.is_identity ? *next : next->after(result.matrix);
      result.lookat = result.is_identity ? lookat : std::nullopt;
      result.is_identity = false;
    }
  }
  return result;
}

bool MitsubaSource::flag(pugi::xml_node element, std::string_view name) {
  for (const auto node : element.children("boolean"))
    if (name == node.attribute("name").value())
      return lower_case(node.attribute("value").value()) == "true";
  return false;
}

}  // namespace lobelia

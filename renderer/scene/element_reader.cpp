#include "renderer/scene/element_reader.hpp"

#include <charconv>

#include "base/pictures/colour.hpp"

namespace lobelia {
namespace {

constexpr std::string_view kParameterTags[] = {"float", "integer", "string",
                                               "point", "vector",  "rgb"};

/// The beginning of a text, without line breaks and runs of spaces.
std::string join_words(std::string_view text) {
  std::string result;
  for (const auto& word : split(text.substr(0, 200), " \t\n\r"))
    result += (result.empty() ? "" : " ") + word;
  return result;
}

/// For "#ff8800" the linear numbers that it stands for; else "".
std::string linear_text(std::string_view text) {
  const auto colour = colour_of_hex(text);
  return colour ? fmt::format(" (in linear light it is '{:.4g}, {:.4g}, {:.4g}')", colour->r,
                              colour->g, colour->b)
                : "";
}

std::string allowed_range(const Parameter& p) {
  return fmt::format("{:g} to {:g}{}{}", p.min, p.max, p.unit.empty() ? "" : " ", p.unit);
}

}  // namespace

std::optional<Rgb> colour_of_hex(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  double linear[3];
  for (const std::size_t i : {0, 1, 2}) {
    const char* digits = text.data() + 1 + 2 * i;
    int code = 0;
    if (std::from_chars(digits, digits + 2, code, 16).ptr != digits + 2) return std::nullopt;
    linear[i] = double(srgb_decoded(float(code) / 255));
  }
  return Rgb{linear[0], linear[1], linear[2]};
}

std::vector<std::string> split_numbers(std::string_view text) {
  if (text.size() > 1024) return {};  // megabytes of commas would be gigabytes of parts
  return split(text, ", \t\n\r");
}

std::vector<pugi::xml_node> ElementReader::elements(pugi::xml_node parent) {
  std::vector<pugi::xml_node> result;
  for (const auto node : parent.children()) {
    if (node.type() == pugi::node_element)
      result.push_back(node);
    else if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata)
      source_.error(node,
                    fmt::format("text '{}' inside <{}>; values stand in attributes",
                                printable(join_words(node.value()), 20), printable(parent.name())));
  }
  return result;
}

void ElementReader::expect_tag(pugi::xml_node node) {
  const auto allowed = find_element(scene_elements(), node.parent().name()).child_tags();
  if (std::ranges::find(allowed, node.name()) == allowed.end()) unknown_element(node, allowed);
}

void ElementReader::check_attributes(pugi::xml_node node) {
  source_.check_attributes(node, find_element(scene_elements(), node.name()).attribute_names());
}

Values ElementReader::read_parameters(pugi::xml_node element, std::span<const Parameter> table) {
  return read_parameters(element, table,
                         find_element(scene_elements(), element.name()).child_tags());
}

void ElementReader::unknown_element(pugi::xml_node node,
                                    std::span<const std::string_view> allowed) {
  if (source_.full()) return source_.count_error();
  const bool is_variable = std::string_view(node.name()) == "default";
  source_.error(node, fmt::format("unknown element <{}> in <{}>; allowed: {}{}{}",
                                  printable(node.name()), printable(node.parent().name()),
                                  join(allowed), did_you_mean(node.name(), allowed),
                                  is_variable ? "; a scene has no variables, but a grid can vary "
                                                "its values (docs/grid_format.md)"
                                              : ""));
}

const ElementFormat* ElementReader::format_of(pugi::xml_node node,
                                              std::span<const ElementFormat> formats) {
  const std::string type = source_.required(node, "type");
  if (!node.attribute("type")) return nullptr;
  for (const auto& format : formats)
    if (format.type == type) return &format;
  std::vector<std::string_view> types;
  for (const auto& format : formats) types.push_back(format.type);
  source_.error(node.attribute("type"), node,
                fmt::format("unknown {} type '{}'; allowed: {}{}", node.name(), printable(type),
                            join(types), did_you_mean(type, types)));
  return nullptr;
}

std::optional<Values::Value> ElementReader::parse(pugi::xml_node node, const Parameter& parameter,
                                                  const std::string& text) {
  Values::Value value{{}, text, node};
  if (parameter.type == ParameterType::kString) return value;
  const auto complain = [&](const std::string& what) {
    const auto attribute = node.attribute("value");
    source_.error(attribute ? attribute : node.first_attribute(), node,
                  fmt::format("{} '{}' {}; allowed: {}", parameter.name, printable(text), what,
                              allowed_range(parameter)));
    return std::nullopt;
  };
  const auto parts = split_numbers(text);
  const bool triple =
      parameter.type != ParameterType::kFloat && parameter.type != ParameterType::kInteger;
  const bool grey = parameter.type == ParameterType::kRgb && parts.size() == 1;
  if (parts.size() != (triple && !grey ? 3 : 1))
    return complain(parameter.type == ParameterType::kRgb ? "is not one or three numbers"
                    : triple                              ? "is not three numbers"
                                                          : "is not one number");
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parse_number(parts[i], value.numbers[i]))
      return complain("is not a finite number" + linear_text(text));
    if (value.numbers[i] < parameter.min || value.numbers[i] > parameter.max)
      return complain("is out of range");
    if (parameter.type == ParameterType::kInteger &&
        value.numbers[i] != std::floor(value.numbers[i]))
      return complain("is not a whole number");
  }
  if (grey) value.numbers[1] = value.numbers[2] = value.numbers[0];
  return value;
}

/// The text of a parameter: value="..." or, for points and vectors, x= y= z= as in Mitsuba.
std::string ElementReader::value_text(pugi::xml_node node) {
  const auto x = node.attribute("x"), y = node.attribute("y"), z = node.attribute("z");
  if (!node.attribute("value") && (x || y || z)) {
    source_.check_attributes(node, {"name", "x", "y", "z"});
    return fmt::format("{}, {}, {}", x.as_string("0"), y.as_string("0"), z.as_string("0"));
  }
  source_.check_attributes(node, {"name", "value"});
  return source_.required(node, "value");
}

Values ElementReader::read_parameters(pugi::xml_node element, std::span<const Parameter> table,
                                      Tags nested) {
  Values values;
  for (const auto node : elements(element)) {
    if (std::ranges::find(kParameterTags, node.name()) == std::end(kParameterTags)) {
      if (std::ranges::find(nested, node.name()) != nested.end()) continue;
      std::vector<std::string_view> allowed(std::begin(kParameterTags), std::end(kParameterTags));
      allowed.insert(allowed.end(), nested.begin(), nested.end());
      unknown_element(node, allowed);
      continue;
    }
    const std::string name = source_.required(node, "name");
    if (name.empty()) continue;
    const auto parameter = std::ranges::find(table, name, &Parameter::name);
    if (parameter == table.end()) {
      std::vector<std::string_view> names;
      for (const auto& known : table) names.push_back(known.name);
      source_.error(node.attribute("name"), node,
                    fmt::format("<{}> has no parameter '{}'; allowed: {}{}", element.name(),
                                printable(name), join(names), did_you_mean(name, names)));
      continue;
    }
    if (node.name() != parameter_tag(parameter->type)) {
      source_.error(node, fmt::format("parameter '{}' is written <{}>, not <{}>", name,
                                      parameter_tag(parameter->type), node.name()));
      continue;
    }
    if (values.contains(parameter->name)) {
      source_.error(node, fmt::format("parameter '{}' is given twice", name));
      continue;
    }
    const std::string text = value_text(node);
    // After an error the default will do, to find the errors behind it.
    if (auto value = parse(node, *parameter, text))
      values.set(parameter->name, *std::move(value));
    else
      values.set(parameter->name, default_of(*parameter));
  }
  for (const auto& parameter : table) {
    if (values.contains(parameter.name)) continue;
    if (parameter.default_value.empty())
      source_.error(element,
                    fmt::format("<{} type=\"{}\"> needs the parameter '{}' ({})", element.name(),
                                printable(element.attribute("type").value()), parameter.name,
                                parameter.meaning));
    values.set(parameter.name, default_of(parameter));
  }
  return values;
}

Values::Value ElementReader::default_of(const Parameter& parameter) {
  if (parameter.default_value.empty()) return {{1, 1, 1}, "", {}};  // after an error: anything
  return parse({}, parameter, std::string(parameter.default_value)).value();
}

bool ElementReader::within(pugi::xml_node node, std::string_view what, std::int64_t limit,
                           std::int64_t seen) {
  if (seen < limit) return true;
  if (over_limit_.insert(std::string(what)).second)
    source_.error(node, fmt::format("over {} {}; allowed: {}", limit, what, limit));
  return false;
}

bool ElementReader::once(pugi::xml_node node, int& count) {
  if (++count > 1) source_.error(node, fmt::format("a second <{}>; one is allowed", node.name()));
  return count == 1;
}

Vec3 ElementReader::direction(pugi::xml_node element, const Values& values, std::string_view name) {
  const Vec3 vector = values.vec3(name);
  if (length(vector) > 0) return as_unit(vector);
  source_.error(element, fmt::format("{} is zero; allowed: any other vector", name));
  return {0, 0, 1};
}

}  // namespace lobelia

#include "studies/shader_check/shader_values.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/words/text.hpp"

namespace lobelia::shader_check {

std::string number_text(double number) {
  std::string text = fmt::format("{:.9g}", number);
  if (text.find_first_of(".e") == text.npos) text += ".0";
  return text;
}

std::string value_text(const std::string& type, std::vector<std::string> components,
                       ShaderText language) {
  const TypeShape shape = shape_of(type);
  const auto count = std::size_t(shape.components());
  if (!shape.is_number() || components.empty()) return "";
  if (components.size() == 1 && count > 1) {
    const std::string one = components.front();
    components.clear();
    for (int column = 0; column < shape.columns; ++column)
      for (int row = 0; row < shape.rows; ++row)
        components.push_back(shape.columns == 1 || row == column ? one : "0.0");
  }
  if (components.size() == 3 && count == 4) components.emplace_back("1.0");
  if (components.size() != count) return "";
  if (language == ShaderText::kWgsl) {
    const std::string_view element = type.find("f16") != type.npos || type.ends_with('h') ? "f16"
                                     : shape.element == TypeShape::Element::kInt          ? "i32"
                                     : shape.element == TypeShape::Element::kUint         ? "u32"
                                     : shape.element == TypeShape::Element::kBool         ? "bool"
                                                                                          : "f32";
    for (std::string& one : components) one = fmt::format("{}({})", element, one);
  }
  const std::vector<std::string_view> views(components.begin(), components.end());
  return fmt::format("{}({})", type, join(views));
}

std::string variable_text(const std::string& type, const std::string& name,
                          const std::string& dimensions, ShaderText language) {
  switch (language) {
    case ShaderText::kGlsl:
      return fmt::format("{} {}{};\n", type, name, dimensions);
    case ShaderText::kHlsl:
      return dimensions.empty() ? fmt::format("{0} {1} = ({0})0;\n", type, name)
                                : fmt::format("{} {}{};\n", type, name, dimensions);
    case ShaderText::kWgsl:
      return fmt::format("var {}: {};\n", name, type);
  }
  return "";
}

std::string declared_text(const Declared& declared, std::string_view path) {
  return printable(fmt::format("{} {}{}", declared.type, path, declared.dimensions));
}

std::vector<std::string> parts_of_path(std::string_view path) {
  std::vector<std::string> parts;
  const std::vector<Token> tokens = plain_tokens(path, 0, path.size());
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (i > 0 && tokens[i - 1].end() != tokens[i].at) return {};
    const bool is_first = parts.empty();
    if (tokens[i] == "[" && !is_first && i + 2 < tokens.size() && tokens[i + 2] == "]" &&
        tokens[i + 1].text.find_first_not_of("0123456789") == std::string_view::npos) {
      parts.push_back(fmt::format("[{}]", tokens[i + 1].text));
      i += 2;
    } else if (is_first && is_name(tokens[i].text)) {
      parts.emplace_back(tokens[i].text);
    } else if (tokens[i] == "." && !is_first && i + 1 < tokens.size() &&
               is_name(tokens[i + 1].text)) {
      parts.emplace_back(tokens[++i].text);
    } else {
      return {};
    }
  }
  return parts;
}

}  // namespace lobelia::shader_check

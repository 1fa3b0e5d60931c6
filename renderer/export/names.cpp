#include "renderer/export/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace lobelia {

std::string function_name(const Highlight& highlight, bool fixed_exponent, bool fresnel) {
  std::string name =
      fmt::format("lobelia_{}_{}{}", info(highlight.model).name, identifier(highlight.lobe),
                  highlight.normalisation == Normalisation::kPaper ? "_paper" : "");
  if (fixed_exponent) {
    name += fmt::format("_n{}", highlight.exponent);
    std::ranges::replace(name, '.', '_');
  }
  return fresnel ? name + "_fresnel" : name;
}

std::string capitalised(std::string_view name) {
  std::string result;
  for (const char c : name)
    result += result.empty() || result.back() == '_'
                  ? char(std::toupper(static_cast<unsigned char>(c)))
                  : c;
  return result;
}

std::string heading(const Highlight& highlight) {
  return fmt::format("{} with the lobe {}, normalisation \"{}\"", info(highlight.model).title,
                     info(highlight.lobe).title, name(highlight.normalisation));
}

std::string fill(std::string_view text,
                 std::initializer_list<std::pair<std::string_view, std::string_view>> values) {
  std::string result(text);
  for (const auto& [name, value] : values) {
    const std::string mark = "%" + std::string(name) + "%";
    for (std::size_t at = 0; (at = result.find(mark, at)) != std::string::npos; at += value.size())
      result.replace(at, mark.size(), value);
  }
  return result;
}

void Parts::add(const std::string& name, std::string_view text) {
  if (!names_.insert(name).second) return;
  text_ += "\n" + fill(begin_, {{"name", name}}) + std::string(text) + fill(end_, {{"name", name}});
}

}  // namespace lobelia

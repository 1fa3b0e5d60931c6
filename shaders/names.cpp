#include "shaders/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace lobelia {

std::string function_name(const Highlight& highlight, bool fixed_exponent) {
  std::string name =
      fmt::format("lobelia_{}_{}{}", info(highlight.model).name, info(highlight.lobe).name,
                  highlight.normalisation == Normalisation::kPaper ? "_paper" : "");
  if (fixed_exponent) {
    name += fmt::format("_n{}", highlight.exponent);
    std::ranges::replace(name, '.', '_');
  }
  return name;
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

}  // namespace lobelia

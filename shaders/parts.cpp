#include "shaders/parts.hpp"

namespace lobelia {

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

#include "reference_scenes/engines/outside/command_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "core/text.hpp"

namespace lobelia {

std::string filled_in(std::string_view text,
                      const std::function<std::string(std::string_view name)>& value_of) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c != '{' && c != '}') {
      result += c;
    } else if (text.substr(i + 1).starts_with(c)) {
      result += c;
      ++i;
    } else {
      const std::size_t end = text.find('}', i);
      if (c == '}' || end == text.npos)
        throw std::runtime_error(fmt::format(
            "'{}' has a brace without its other; {{{{ stands for a brace", printable(text, 200)));
      result += value_of(text.substr(i + 1, end - i - 1));
      i = end;
    }
  }
  return result;
}

std::vector<std::string> arguments_of(std::string_view line) {
  std::vector<std::string> arguments;
  bool in_argument = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
      in_argument = false;
      continue;
    }
    if (!in_argument) arguments.emplace_back();
    in_argument = true;
    if (c != '"' && c != '\'') {
      arguments.back() += c;
      continue;
    }
    const std::size_t end = line.find(c, i + 1);
    if (end == line.npos)
      throw std::runtime_error(fmt::format("the quotation mark {} is not closed", c));
    arguments.back() += line.substr(i + 1, end - i - 1);
    i = end;
  }
  constexpr std::string_view kOfShells[] = {"|", "||", "&", "&&", ";", ">", ">>", "<", "2>&1"};
  for (const std::string& argument : arguments)
    if (std::ranges::find(kOfShells, argument) != std::end(kOfShells))
      throw std::runtime_error(fmt::format(
          "'{}' means something to a shell, and no shell reads it; write a script", argument));
  return arguments;
}

}  // namespace lobelia

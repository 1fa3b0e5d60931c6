// Words and signs of a shader's plain text, without the directives and what conditions leave out.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "studies/shader_check/run_shaders.hpp"

namespace lobelia {

struct Token {
  std::string_view text;  ///< a name, a number, a string, or one other character
  std::size_t at = 0;     ///< place in the plain text
  std::size_t end() const { return at + text.size(); }
  bool operator==(std::string_view other) const { return text == other; }
};

bool is_word_character(char c);
bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words);
bool is_name(std::string_view token);

struct TokenList {
  std::vector<Token> tokens;
  /// For each bracket of () [] {} the place of its partner in `tokens`; for all others, and without a partner, its size.
  std::vector<std::size_t> partner;
  /// The first bracket without a partner: where it is in the text, and what is wrong. Empty if all have one.
  std::size_t wrong_at = 0;
  std::string wrong;
  /// The text of each #define, by its name.
  std::map<std::string, std::vector<Token>, std::less<>> macros;

  std::size_t size() const { return tokens.size(); }
  bool is(std::size_t i, std::string_view text) const { return i < size() && tokens[i] == text; }
  bool is_name_at(std::size_t i) const { return i < size() && is_name(tokens[i].text); }
};

/// In one pass over the text, which has to outlive the list. A condition of the preprocessor that depends on what is not
/// known holds.
TokenList tokens_of(std::string_view plain, ShaderText language);

/// Words, numbers and signs of any text, such as a line.
std::vector<Token> plain_tokens(std::string_view text, std::size_t begin, std::size_t end);

}  // namespace lobelia

#include "studies/shader_check/shader_tokens.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/words/text.hpp"

namespace lobelia {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The conditions of a preprocessor, as far as the text alone decides them.
class Conditions {
 public:
  explicit Conditions(TokenList& list) : list_(list) { values_["VULKAN"] = "100"; }

  bool is_active() const { return open_.empty() || open_.back().active; }

  /// `line`: the tokens behind '#'.
  void read(const std::vector<Token>& line) {
    if (line.empty()) return;
    const std::string_view word = line[0].text;
    if (word == "if" || word == "ifdef" || word == "ifndef") {
      const bool holds = is_active() && condition(word, line);
      open_.push_back({is_active(), holds, holds});
    } else if (word == "elif" || word == "else") {
      if (open_.empty()) return;
      Open& at = open_.back();
      at.active = at.within && !at.done && (word == "else" || condition("if", line));
      at.done = at.done || at.active;
    } else if (word == "endif") {
      if (!open_.empty()) open_.pop_back();
    } else if (is_active()) {
      define(word, line);
    }
  }

 private:
  struct Open {
    bool within;  ///< whether what is around it is active
    bool active, done;
  };

  void define(std::string_view word, const std::vector<Token>& line) {
    if (word == "version") {
      const bool is_es =
          (line.size() > 2 && line[2] == "es") || (line.size() > 1 && line[1] == "100");
      if (is_es) values_["GL_ES"] = "1";
      if (line.size() > 1) values_["__VERSION__"] = std::string(line[1].text);
    }
    if (line.size() < 2) return;
    const std::string name(line[1].text);
    if (word == "undef") values_.erase(name);
    if (word != "define") return;
    std::size_t body = 2;
    if (line.size() > 2 && line[2] == "(" && line[2].at == line[1].end())
      while (body < line.size() && !(line[body++] == ")")) {
      }
    values_[name] = line.size() == 3 ? std::string(line[2].text) : "";
    // Texts of conditions that both hold are added: what may be read counts.
    std::vector<Token>& tokens = list_.macros[name];
    tokens.insert(tokens.end(), line.begin() + std::ptrdiff_t(body), line.end());
  }

  bool condition(std::string_view word, const std::vector<Token>& line) const {
    if (word != "if") return line.size() > 1 && values_.contains(line[1].text) == (word == "ifdef");
    constexpr std::size_t kMost = 200;  // it goes down a level for each bracket
    if (line.size() > kMost) return true;
    std::size_t at = 1;
    return any(line, at);
  }
  bool any(const std::vector<Token>& line, std::size_t& at) const {
    bool holds = all(line, at);
    while (at + 1 < line.size() && line[at] == "|" && line[at + 1] == "|") {
      at += 2;
      holds = all(line, at) || holds;
    }
    return holds;
  }
  bool all(const std::vector<Token>& line, std::size_t& at) const {
    bool holds = one(line, at);
    while (at + 1 < line.size() && line[at] == "&" && line[at + 1] == "&") {
      at += 2;
      holds = one(line, at) && holds;
    }
    return holds;
  }
  /// A comparison of numbers, `defined(X)`, a bracket, or a negation of one. Unknown numbers hold.
  bool one(const std::vector<Token>& line, std::size_t& at) const {
    if (at >= line.size()) return true;
    if (line[at] == "!") return !one(line, ++at);
    if (line[at] == "(") {
      const bool holds = any(line, ++at);
      if (at < line.size() && line[at] == ")") ++at;
      return holds;
    }
    if (line[at] == "defined") {
      const bool has_bracket = at + 1 < line.size() && line[at + 1] == "(";
      at += has_bracket ? 2 : 1;
      const bool holds = at < line.size() && values_.contains(line[at].text);
      at += has_bracket ? 2 : 1;
      return holds;
    }
    std::string sign;
    double left = 0, right = 0;
    const bool known = number(line[at++].text, left);
    while (at < line.size() &&
           std::string_view("<>=!").find(line[at].text) != std::string_view::npos)
      sign += line[at++].text;
    if (sign.empty()) return !known || left != 0;
    if (at >= line.size() || !number(line[at++].text, right) || !known) return true;
    return sign == "<"    ? left < right
           : sign == ">"  ? left > right
           : sign == "<=" ? left <= right
           : sign == ">=" ? left >= right
           : sign == "!=" ? left != right
                          : left == right;
  }
  bool number(std::string_view word, double& value) const {
    constexpr int kMostSteps = 8;
    for (int step = 0; step < kMostSteps; ++step) {
      if (parse_number(word, value)) return true;
      const auto found = values_.find(word);
      if (found == values_.end()) return value = 0, is_name(word);  // as in C
      word = found->second;
    }
    return false;
  }

  TokenList& list_;
  std::vector<Open> open_;
  std::map<std::string, std::string, std::less<>> values_;
};

void find_partners(TokenList& list, std::string_view plain) {
  list.partner.assign(list.size(), list.size());
  std::vector<std::size_t> open;
  const auto line_of = [&](std::size_t i) {
    return 1 + std::ranges::count(plain.substr(0, list.tokens[i].at), '\n');
  };
  const auto is_wrong = [&](std::size_t i, std::string what) {
    if (!list.wrong.empty()) return;
    list.wrong_at = list.tokens[i].at;
    list.wrong = std::move(what);
  };
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string_view text = list.tokens[i].text;
    if (text == "(" || text == "[" || text == "{") open.push_back(i);
    if (text != ")" && text != "]" && text != "}") continue;
    if (open.empty()) {
      is_wrong(i, fmt::format("'{}' closes nothing", text));
      continue;
    }
    const std::string_view opened = list.tokens[open.back()].text;
    if (list.wrong.empty() && opened != (text == ")" ? "(" : text == "]" ? "[" : "{"))
      is_wrong(i, fmt::format("'{}' where the '{}' of line {} is still open", text, opened,
                              line_of(open.back())));
    list.partner[i] = open.back();
    list.partner[open.back()] = i;
    open.pop_back();
  }
  if (!open.empty())
    is_wrong(open.back(), fmt::format("'{}' is never closed", list.tokens[open.back()].text));
}

}  // namespace

bool is_word_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_';
}
bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}
bool is_name(std::string_view token) {
  return !token.empty() && is_word_character(token[0]) && !is_digit(token[0]);
}

std::vector<Token> plain_tokens(std::string_view text, std::size_t begin, std::size_t end) {
  std::vector<Token> tokens;
  for (std::size_t at = begin; at < end;) {
    std::size_t stop = at + 1;
    if (is_word_character(text[at])) {
      const bool is_number = is_digit(text[at]);
      while (stop < end && (is_word_character(text[stop]) || (is_number && text[stop] == '.')))
        ++stop;
    } else if (text[at] == '"') {
      stop = std::min(text.find_first_of("\"\n", at + 1), end);
      if (stop < end && text[stop] == '"') ++stop;
    }
    // Letters beyond ASCII are WGSL's names.
    if (const auto c = static_cast<unsigned char>(text[at]); c > ' ')
      tokens.push_back({text.substr(at, stop - at), at});
    at = stop;
  }
  return tokens;
}

TokenList tokens_of(std::string_view plain, ShaderText language) {
  TokenList list;
  Conditions conditions(list);
  for (std::size_t at = 0; at < plain.size();) {
    const std::size_t end = std::min(plain.find('\n', at), plain.size());
    const std::size_t first = plain.find_first_not_of(" \t\v\f", at);
    if (language != ShaderText::kWgsl && first < end && plain[first] == '#') {
      conditions.read(plain_tokens(plain, first + 1, end));
    } else if (conditions.is_active()) {
      const auto more = plain_tokens(plain, at, end);
      list.tokens.insert(list.tokens.end(), more.begin(), more.end());
    }
    at = end + 1;
  }
  find_partners(list, plain);
  return list;
}

}  // namespace lobelia

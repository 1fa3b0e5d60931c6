#include <algorithm>

#include "studies/shader_check/token_cursor.hpp"

namespace lobelia {
namespace {

using Kind = GlobalVariable::Kind;

class WgslParser : TokenCursor {
 public:
  WgslParser(const TokenList& list, std::string_view plain) : TokenCursor(list, plain) {}

  Declarations all() {
    read_all([&] { one(); });
    return std::move(found_);
  }

 private:
  void skip() {
    while (at_ < list_.size() && !is(at_, ";") && !is(at_, "{"))
      at_ = is(at_, "(") || is(at_, "[") ? behind(at_) : at_ + 1;
    if (at_ < list_.size()) at_ = is(at_, "{") ? behind(at_) : at_ + 1;
  }

  struct Attributes {
    std::string first;  ///< "location(0)", "builtin(position)"
    bool is_fragment = false;
  };
  /// Attributes from `i` on, which is behind them then. Outside of structures none is of use to a function that is called.
  Attributes attributes(std::size_t& i, bool drop) {
    Attributes found;
    while (is(i, "@")) {
      const std::size_t begin = i;
      i += 2;
      if (is(i, "(")) i = behind(i);
      i = std::min(i, list_.size());
      const std::string_view name = word(begin + 1);
      if (name == "location" || name == "builtin") found.first = text_of(begin + 1, i);
      found.is_fragment = found.is_fragment || name == "fragment";
      if (drop && name != "must_use") replace(begin, i);
    }
    return found;
  }

  /// The end of the type that begins at `i`.
  std::size_t behind_type(std::size_t i, std::size_t end) const {
    int depth = 0;
    for (; i < std::min(end, list_.size()); ++i) {
      const std::string_view text = word(i);
      if (text == "<") ++depth;
      if (text == ">" && --depth < 0) break;
      if (depth == 0 &&
          (text == "," || text == "=" || text == ";" || text == "{" || text == ")" || text == "@"))
        break;
      if (text == ";" || text == "{") break;
    }
    return i;
  }
  /// A list of a length that only a buffer has becomes one of a single element.
  void end_array(std::size_t begin, std::size_t end) {
    if (word(begin) != "array" || end < begin + 3) return;
    int depth = 0;
    for (std::size_t i = begin + 1; i < end; ++i) {
      depth += is(i, "<") ? 1 : is(i, ">") ? -1 : 0;
      if (depth == 1 && is(i, ",")) return;
    }
    found_.edits.push_back({list_.tokens[end - 1].at, list_.tokens[end - 1].at, ", 1"});
  }

  /// A type of lists becomes the type of an element, with the numbers of elements.
  static void split_array(Declared& made) {
    while (made.type.starts_with("array<") && made.type.ends_with('>')) {
      const std::string inner = made.type.substr(6, made.type.size() - 7);
      std::size_t end = inner.size();
      int depth = 0;
      for (std::size_t i = 0; i < inner.size(); ++i) {
        depth += inner[i] == '<' ? 1 : inner[i] == '>' ? -1 : 0;
        if (depth == 0 && inner[i] == ',' && end == inner.size()) end = i;
      }
      const std::size_t first = std::min(inner.find_first_not_of(", ", end), inner.size());
      made.dimensions += "[" + (first < inner.size() ? inner.substr(first) : "1") + "]";
      made.type = inner.substr(0, end);
    }
  }

  /// name : type, ... between `open` and its partner.
  std::vector<Declared> list_of(std::size_t open, bool is_struct) {
    std::vector<Declared> all;
    const std::size_t end = std::min(list_.partner[open], list_.size());
    for (std::size_t i = open + 1; i < end;) {
      const Attributes of = attributes(i, !is_struct);
      if (!list_.is_name_at(i) || !is(i + 1, ":")) {
        ++i;
        continue;
      }
      Declared made;
      made.semantic = of.first;
      made.name = word(i);
      const std::size_t type = i + 2;
      i = behind_type(type, end);
      made.type = text_of(type, i);
      if (is_struct) {
        end_array(type, i);
        split_array(made);
      }
      all.push_back(std::move(made));
      if (is(i, ",")) ++i;
    }
    return all;
  }

  void one() {
    const Attributes of = attributes(at_, true);
    const std::string_view first = word(at_);
    if (first == "fn") {
      function(of.is_fragment);
    } else if (first == "struct") {
      const std::string name(word(at_ + 1));
      at_ += 2;
      if (is(at_, "{")) found_.structs.push_back({name, list_of(at_, true)});
      skip();
    } else if (first == "alias") {
      const std::size_t begin = at_;
      skip();
      if (is(begin + 2, "=") && at_ > begin + 4)
        found_.aliases.emplace(word(begin + 1), text_of(begin + 3, at_ - 1));
    } else if (first == "var" || first == "override" || first == "const") {
      variable(first);
    } else if (list_.is_name_at(at_)) {
      skip();
    }
  }

  void function(bool is_fragment) {
    FunctionDeclaration made;
    made.name = word(at_ + 1);
    made.is_entry = is_fragment;
    at_ = std::min(at_ + 2, list_.size());
    if (at_ < list_.size()) made.at = list_.tokens[at_ - 1].at;
    if (!is(at_, "(")) return skip();
    made.parameters = list_of(at_, false);
    at_ = behind(at_);
    if (is(at_, "-") && is(at_ + 1, ">")) {
      at_ += 2;
      made.semantic = attributes(at_, true).first;
      const std::size_t type = at_;
      at_ = behind_type(at_, list_.size());
      made.result = text_of(type, at_);
    }
    if (!is(at_, "{")) return skip();
    made.has_body = true;
    made.begin = at_;
    made.end = std::min(list_.partner[at_], list_.size());
    at_ = behind(at_);
    found_.functions.push_back(std::move(made));
  }

  void variable(std::string_view keyword) {
    const std::size_t begin = at_++;
    GlobalVariable made;
    std::string_view space;
    std::size_t head = at_;
    if (is(at_, "<")) {
      space = word(at_ + 1);
      while (at_ < list_.size() && !is(at_, ">") && !is(at_, ";")) ++at_;
      head = at_ = std::min(at_ + 1, list_.size());
    }
    if (!list_.is_name_at(at_)) return skip();
    made.name = word(at_++);
    std::size_t type = at_;
    if (is(at_, ":")) {
      type = ++at_;
      at_ = behind_type(at_, list_.size());
      made.type = text_of(type, at_);
    }
    const bool is_texture = is_texture_type(made.type, ShaderText::kWgsl);
    made.kind = keyword == "const"                                        ? Kind::kConstant
                : is_texture                                              ? Kind::kTexture
                : made.type.starts_with("atomic") || space == "workgroup" ? Kind::kFixed
                : space == "private"                                      ? Kind::kPrivate
                                                                          : Kind::kInput;
    if (made.kind == Kind::kInput || made.kind == Kind::kTexture) {
      replace(begin, head, "var<private>");
      end_array(type, at_);
    }
    if (is(at_, "=")) {
      made.begin = ++at_;
      while (at_ < list_.size() && !is(at_, ";"))
        at_ = is(at_, "(") || is(at_, "[") ? behind(at_) : at_ + 1;
      made.end = at_;
      made.value = text_of(made.begin, made.end);
    }
    split_array(made);
    skip();
    found_.globals.push_back(std::move(made));
  }
};

}  // namespace

Declarations wgsl_declarations_of(const TokenList& list, std::string_view plain) {
  return WgslParser(list, plain).all();
}

}  // namespace lobelia

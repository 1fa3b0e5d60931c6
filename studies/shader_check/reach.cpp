#include "studies/shader_check/reach.hpp"

#include <algorithm>

namespace lobelia {
namespace {

class Walk {
 public:
  Walk(const TokenList& list, const Declarations& declared, const std::vector<TextEdit>& dropped)
      : list_(list), declared_(declared), dropped_(dropped) {
    std::ranges::sort(dropped_, {}, &TextEdit::begin);
    for (const GlobalVariable& one : declared.globals) globals_.emplace(one.name, &one);
    for (const FunctionDeclaration& one : declared.functions)
      if (one.has_body) functions_.emplace(one.name, &one);
  }

  Reach from(std::string_view function) {
    visit(function);
    while (!open_.empty()) {
      const std::string_view name = open_.back();
      open_.pop_back();
      const auto [begin, end] = functions_.equal_range(name);
      for (auto one = begin; one != end; ++one) body(*one->second);
      if (const auto global = globals_.find(name);
          global != globals_.end() && global->second->kind != GlobalVariable::Kind::kTexture)
        for (std::size_t i = global->second->begin; i < global->second->end; ++i) word(i);
      if (const auto macro = list_.macros.find(name); macro != list_.macros.end())
        for (std::size_t i = 0; i < macro->second.size(); ++i)
          name_at(macro->second[i], i > 0 ? macro->second[i - 1].text : "");
    }
    return std::move(reach_);
  }

 private:
  void visit(std::string_view name) {
    if (!seen_.insert(name).second) return;
    reach_.names.emplace(name);
    if (globals_.contains(name)) reach_.globals.emplace(name);
    if (is_one_of(name, {"dFdx", "dFdy", "fwidth", "ddx", "ddy", "dpdx", "dpdy"}) ||
        name.starts_with("dFdxC") || name.starts_with("dFdxF") || name.starts_with("ddx_") ||
        name.starts_with("ddy_"))
      reach_.derivative = name;
    open_.push_back(name);
  }

  void name_at(const Token& token, std::string_view before) {
    if (!is_name(token.text)) return;
    if (before == ".")
      reach_.members.emplace(token.text);
    else
      visit(token.text);
  }
  void word(std::size_t i) { name_at(list_.tokens[i], i > 0 ? list_.tokens[i - 1].text : ""); }

  bool is_dropped(const Token& token) const {
    const auto behind = std::ranges::upper_bound(dropped_, token.at, {}, &TextEdit::begin);
    return behind != dropped_.begin() && token.at < std::prev(behind)->end;
  }

  /// Whether the name at `i` is that of a new variable.
  bool is_declared(std::size_t i) const {
    if (i == 0 || i + 1 >= list_.size()) return false;
    const std::string_view before = list_.tokens[i - 1].text, behind = list_.tokens[i + 1].text;
    if (is_one_of(before, {"return", "else", "case", "do", "in", "discard"})) return false;
    const bool follows_type =
        is_name(before) ||
        (before == "]" && list_.partner[i - 1] > 1 && list_.partner[i - 1] < list_.size() &&
         is_name(list_.tokens[list_.partner[i - 1] - 1].text));
    return follows_type && is_one_of(behind, {"=", ";", ",", "[", ":", ")"});
  }

  /// Names of variables of the function hide those of the file from their declaration to the end of the block.
  void body(const FunctionDeclaration& function) {
    std::map<std::string_view, int> hidden;
    for (const Declared& one : function.parameters) ++hidden[one.name];
    std::vector<std::pair<std::string_view, int>> own, begun;
    int depth = 0;
    const auto begin_scope = [&] {
      for (const auto& [name, at] : begun) {
        ++hidden[name];
        own.emplace_back(name, at);
      }
      begun.clear();
    };
    for (std::size_t i = function.begin; i < std::min(function.end, list_.size()); ++i) {
      const Token& token = list_.tokens[i];
      if (token == "{") ++depth;
      if (token == "}") {
        --depth;
        for (; !own.empty() && own.back().second > depth; own.pop_back())
          --hidden[own.back().first];
      }
      if (token == ";" || token == "{") begin_scope();
      if (!is_name(token.text) || is_dropped(token)) continue;
      const bool is_member = i > 0 && list_.tokens[i - 1] == ".";
      if (!is_member && is_declared(i)) {
        begun.emplace_back(token.text, depth);
        continue;
      }
      const auto found = hidden.find(token.text);
      if (!is_member && found != hidden.end() && found->second > 0) {
        reach_.names.emplace(token.text);
        continue;
      }
      word(i);
    }
  }

  const TokenList& list_;
  const Declarations& declared_;
  std::vector<TextEdit> dropped_;
  std::map<std::string_view, const GlobalVariable*, std::less<>> globals_;
  std::multimap<std::string_view, const FunctionDeclaration*, std::less<>> functions_;
  std::set<std::string_view> seen_;
  std::vector<std::string_view> open_;
  Reach reach_;
};

}  // namespace

Reach reach_of(std::string_view function, const TokenList& list, const Declarations& declared,
               const std::vector<TextEdit>& dropped) {
  return Walk(list, declared, dropped).from(function);
}

std::vector<std::string> uncalled_functions(const TokenList& list, const Declarations& declared) {
  std::set<std::string_view> called;
  for (const FunctionDeclaration& one : declared.functions) {
    if (!one.has_body) continue;
    for (std::size_t i = one.begin; i < std::min(one.end, list.size()); ++i)
      if (list.is(i + 1, "(") && list.tokens[i].text != one.name)
        called.insert(list.tokens[i].text);
  }
  std::vector<std::string> names;
  for (const FunctionDeclaration& one : declared.functions)
    if (one.has_body && called.insert(one.name).second) names.push_back(one.name);
  return names;
}

}  // namespace lobelia

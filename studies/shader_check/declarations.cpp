#include "studies/shader_check/token_cursor.hpp"

#include <algorithm>
#include <array>

namespace lobelia {
namespace {

using Kind = GlobalVariable::Kind;

bool is_precision(std::string_view word) { return is_one_of(word, {"highp", "mediump", "lowp"}); }

bool is_qualifier(std::string_view word, ShaderText language) {
  if (is_one_of(word, {"const", "in", "out", "inout", "uniform", "shared", "volatile", "precise",
                       "centroid", "sample"}))
    return true;
  return language == ShaderText::kHlsl
             ? is_one_of(word, {"static", "extern", "groupshared", "row_major", "column_major",
                                "linear", "nointerpolation", "noperspective", "inline", "unorm",
                                "snorm", "globallycoherent"})
             : is_precision(word) ||
                   is_one_of(word, {"varying", "attribute", "flat", "smooth", "noperspective",
                                    "invariant", "patch", "buffer", "coherent", "restrict",
                                    "readonly", "writeonly", "subroutine", "layout"});
}

/// A declaration's words before its name.
struct Head {
  std::vector<std::size_t> qualifiers;  ///< tokens
  std::size_t begin = 0, type = 0, type_end = 0;
};

/// GLSL and HLSL.
class Parser : TokenCursor {
 public:
  Parser(const TokenList& list, std::string_view plain, ShaderText language)
      : TokenCursor(list, plain), is_hlsl_(language == ShaderText::kHlsl), language_(language) {}

  Declarations all() {
    read_all([&] { one(); });
    return std::move(found_);
  }

 private:
  void insert(std::size_t i, std::string text) {
    if (i >= list_.size()) return;
    found_.edits.push_back({list_.tokens[i].at, list_.tokens[i].at, std::move(text)});
  }

  /// Behind the next ';', or behind the next block, whichever is first.
  void skip() {
    while (at_ < list_.size()) {
      const std::size_t i = at_;
      if (is(i, "(") || is(i, "[") || is(i, "{")) {
        at_ = behind(i);
        if (is(i, "{")) return;
      } else {
        ++at_;
        if (is(i, ";")) return;
      }
    }
  }

  void one() {
    const std::string_view first = word(at_);
    if (is_one_of(first, {";", "}", ")", "]"})) {
      ++at_;
    } else if (first == "[") {
      at_ = behind(at_);
    } else if (first == "precision" || first == "typedef") {
      const std::size_t begin = at_;
      skip();
      if (first == "typedef" && at_ > begin + 3)
        found_.aliases.emplace(word(at_ - 2), text_of(begin + 1, at_ - 2));
      if (is_texture_type(word(begin + 2), language_)) replace(begin, at_);
    } else if (is_hlsl_ && is_one_of(first, {"technique", "technique10", "technique11"})) {
      const std::size_t begin = at_;
      skip();
      replace(begin, at_);
    } else if (is_hlsl_ && is_one_of(first, {"cbuffer", "tbuffer"})) {
      constant_buffer();
    } else {
      declaration();
    }
  }

  /// Qualifiers from `i` on; `i` is behind them then.
  std::vector<std::size_t> qualifiers(std::size_t& i) const {
    std::vector<std::size_t> found;
    while (is_qualifier(word(i), language_)) {
      found.push_back(i++);
      if (word(i - 1) == "layout" && is(i, "(")) i = behind(i);
    }
    return found;
  }
  bool has(const Head& head, std::initializer_list<std::string_view> words) const {
    return std::ranges::any_of(head.qualifiers,
                               [&](std::size_t i) { return is_one_of(word(i), words); });
  }
  void drop_qualifiers(const Head& head) {
    for (const std::size_t i : head.qualifiers) {
      if (is_precision(word(i)) || is_one_of(word(i), {"row_major", "column_major", "const"}))
        continue;
      replace(i, word(i) == "layout" && is(i + 1, "(") ? behind(i + 1) : i + 1);
    }
  }

  /// Behind a type's arguments, if it has any: Texture2D<float4>.
  std::size_t behind_arguments(std::size_t i) const {
    if (!is_hlsl_ || !is(i, "<")) return i;
    constexpr std::size_t kMost = 16;
    for (std::size_t k = i + 1; k < std::min(list_.size(), i + kMost); ++k)
      if (is(k, ">")) return k + 1;
    return i;
  }
  std::size_t behind_dimensions(std::size_t i) const {
    while (is(i, "[")) i = behind(i);
    return i;
  }

  void declaration() {
    Head head;
    head.begin = at_;
    head.qualifiers = qualifiers(at_);
    if (is(at_, "struct")) return structure(head);
    head.type = at_;
    if (!list_.is_name_at(at_)) {
      // layout(...) in;
      const bool alone = is(at_, ";") && !head.qualifiers.empty();
      skip();
      if (alone && !is_hlsl_) replace(head.begin, at_);
      return;
    }
    at_ = head.type_end = behind_arguments(at_ + 1);
    const std::size_t dimensions = at_;
    at_ = behind_dimensions(at_);
    if (!is_hlsl_ && is(at_, "{") && !head.qualifiers.empty()) return block(head);
    if ((is(at_, ";") || is(at_, ",")) && has(head, {"invariant", "precise"})) {
      skip();  // a variable's second declaration
      replace(head.begin, at_);
      return;
    }
    if (!list_.is_name_at(at_)) return skip();
    if (is(at_ + 1, "(")) return function(head);
    variables(head, text_of(dimensions, at_));
  }

  void function(const Head& head) {
    FunctionDeclaration made;
    made.name = word(at_);
    made.at = list_.tokens[at_].at;
    made.result = text_of(head.type, head.type_end);
    const std::size_t open = at_ + 1;
    at_ = behind(open);
    made.parameters = parameters(open + 1, list_.partner[open]);
    if (is(at_, ":")) {
      made.semantic = word(at_ + 1);
      at_ += 2;
    }
    made.is_entry = made.name == "main" || made.semantic.starts_with("SV_Target") ||
                    made.semantic.starts_with("SV_TARGET") || made.semantic.starts_with("COLOR");
    if (is(at_, "{")) {
      made.has_body = true;
      made.begin = at_;
      made.end = std::min(list_.partner[at_], list_.size());
      at_ = behind(at_);
    } else if (!is(at_, ";")) {
      return skip();
    }
    found_.functions.push_back(std::move(made));
  }

  std::vector<Declared> parameters(std::size_t begin, std::size_t end) const {
    std::vector<Declared> all;
    for (std::size_t i = begin; i < end && i < list_.size();) {
      Declared made;
      for (const std::size_t q : qualifiers(i)) {
        made.is_out = made.is_out || is_one_of(word(q), {"out", "inout"});
        if (word(q) == "out") made.is_in = false;
      }
      const std::size_t type = i;
      i = behind_arguments(i + 1);
      made.type = text_of(type, i);
      const std::size_t first = i;
      i = behind_dimensions(i);
      made.dimensions = text_of(first, i);
      if (i < end && list_.is_name_at(i)) made.name = word(i++);
      const std::size_t second = i;
      i = behind_dimensions(i);
      made.dimensions += text_of(second, i);
      if (is(i, ":")) made.semantic = word(i + 1), i += 2;
      std::size_t value = 0;
      for (; i < end && !is(i, ",");) {
        if (is(i, "=") && value == 0) value = i + 1;
        i = is(i, "(") || is(i, "{") || is(i, "[") ? behind(i) : i + 1;
      }
      if (value > 0) made.value = text_of(value, std::min(i, end));
      ++i;
      if (made.type != "void" || !made.name.empty()) all.push_back(std::move(made));
    }
    return all;
  }

  /// Members between the brackets. As globals, `kind` tells which; they are changed so that they can be that.
  std::vector<Declared> members(std::size_t open, bool is_global, bool is_block) {
    std::vector<Declared> all;
    const std::size_t end = std::min(list_.partner[open], list_.size());
    for (std::size_t i = open + 1; i < end;) {
      Head head;
      head.begin = i;
      head.qualifiers = qualifiers(i);
      if (is_block) drop_qualifiers(head);
      head.type = i;
      if (is(i, "{") || is(i, "(") || is(i, "[")) {
        i = behind(i);
        continue;
      }
      i = head.type_end = behind_arguments(i + 1);
      const std::size_t dimensions = i;
      i = behind_dimensions(i);
      const std::string common = text_of(dimensions, i);
      if (is_global && is_hlsl_ && list_.is_name_at(head.type) && list_.is_name_at(i))
        insert(head.type, "static ");
      while (i < end && list_.is_name_at(i)) {
        Declared made;
        made.type = text_of(head.type, head.type_end);
        made.name = word(i++);
        const std::size_t own = i;
        if (is_block && is(i, "[") && is(i + 1, "]")) insert(i + 1, "1");
        i = behind_dimensions(i);
        made.dimensions = text_of(own, i) + common;
        if (is(i, ":")) {
          made.semantic = word(i + 1);
          const std::size_t colon = i;
          i += 2;
          if (is(i, "(")) i = behind(i);
          if (is_global) replace(colon, i);
        }
        while (i < end && !is(i, ",") && !is(i, ";"))
          i = is(i, "(") || is(i, "{") || is(i, "[") ? behind(i) : i + 1;
        all.push_back(std::move(made));
        if (!is(i, ",")) break;
        ++i;
      }
      while (i < end && !is(i, ";")) i = is(i, "{") || is(i, "(") ? behind(i) : i + 1;
      ++i;
    }
    return all;
  }

  void add_global(Declared declared, Kind kind, std::size_t begin = 0, std::size_t end = 0) {
    GlobalVariable made;
    static_cast<Declared&>(made) = std::move(declared);
    made.kind = is_texture_type(made.type, language_) ? Kind::kTexture : kind;
    made.begin = begin;
    made.end = end;
    found_.globals.push_back(std::move(made));
  }

  Kind kind_of(const Head& head) const {
    if (has(head, {"const"}) && !has(head, {"uniform", "in", "varying"})) return Kind::kConstant;
    if (is_hlsl_) return has(head, {"static", "groupshared"}) ? Kind::kPrivate : Kind::kInput;
    if (has(head, {"uniform", "in", "varying", "attribute", "buffer"})) return Kind::kInput;
    if (has(head, {"out", "inout"})) return Kind::kOutput;
    return Kind::kPrivate;
  }

  /// GLSL: uniform Block { ... } name;
  void block(const Head& head) {
    const std::size_t name = head.type, open = at_;
    at_ = behind(open);
    const std::size_t close = at_ - 1, instance = at_;
    const bool has_instance = list_.is_name_at(at_);
    const Kind kind = kind_of(head) == Kind::kOutput ? Kind::kOutput : Kind::kInput;
    std::vector<Declared> found = members(open, !has_instance, true);
    drop_qualifiers(head);
    if (has_instance) {
      insert(name, "struct ");
      ++at_;
      if (is(at_, "[") && is(at_ + 1, "]")) insert(at_ + 1, "1");
      const std::size_t dimensions = at_;
      at_ = behind_dimensions(at_);
      found_.structs.push_back({std::string(word(name)), std::move(found)});
      Declared made;
      made.type = word(name);
      made.name = word(instance);
      made.dimensions = text_of(dimensions, at_);
      add_global(std::move(made), kind);
    } else {
      replace(name, open + 1);
      if (is(close, "}")) replace(close, is(at_, ";") ? at_ + 1 : at_);
      for (Declared& member : found) add_global(std::move(member), kind);
    }
    skip();
  }

  /// HLSL: cbuffer Name : register(b0) { ... }
  void constant_buffer() {
    const std::size_t begin = at_;
    while (at_ < list_.size() && !is(at_, "{") && !is(at_, ";")) ++at_;
    if (!is(at_, "{")) return skip();
    const std::size_t open = at_;
    at_ = behind(open);
    std::vector<Declared> found = members(open, true, true);
    replace(begin, open + 1);
    if (is(at_ - 1, "}")) replace(at_ - 1, is(at_, ";") ? at_ + 1 : at_);
    for (Declared& member : found) add_global(std::move(member), Kind::kInput);
  }

  void structure(Head& head) {
    const std::size_t name = ++at_;
    while (at_ < list_.size() && !is(at_, "{") && !is(at_, ";") && !is(at_, "(")) ++at_;
    if (!is(at_, "{")) return skip();
    const std::size_t open = at_;
    at_ = behind(open);
    StructDeclaration made{list_.is_name_at(name) ? std::string(word(name)) : "", {}};
    made.members = members(open, false, false);
    found_.structs.push_back(made);
    head.type = name;
    head.type_end = name + (made.name.empty() ? 0 : 1);
    if (list_.is_name_at(at_))
      variables(head, "");
    else
      skip();
  }

  void variables(const Head& head, const std::string& dimensions) {
    const std::string type = text_of(head.type, head.type_end);
    const bool is_buffer = is_hlsl_ && type.find("Buffer<") != type.npos,
               is_struct =
                   head.type_end > head.type && is(head.type - 1, "struct") && head.type > 0;
    Kind kind = kind_of(head);
    if (type.starts_with("image") || type.starts_with("iimage") || type.starts_with("uimage") ||
        type.starts_with("RWTexture") || type.find("ByteAddress") != type.npos ||
        is_one_of(type, {"atomic_uint", "subpassInput"}))
      kind = Kind::kFixed;
    if (is_hlsl_ && type == "texture") {  // of Direct3D 9, for sampler_state alone
      skip();
      return replace(head.begin, at_);
    }
    const bool changes = kind == Kind::kInput || kind == Kind::kOutput;
    if (changes) {
      drop_qualifiers(head);
      for (const std::size_t i : head.qualifiers)
        if (word(i) == "const") replace(i, i + 1);
      if (is_hlsl_) insert(is_struct ? head.type - 1 : head.type, "static ");
      if (is_buffer) {
        const std::size_t open = head.type + 1;
        replace(head.type, open + 1);
        replace(head.type_end - 1, head.type_end);
      }
    }
    while (list_.is_name_at(at_)) {
      Declared made;
      made.type = is_buffer ? text_of(head.type + 2, head.type_end - 1) : type;
      made.name = word(at_++);
      const std::size_t own = at_;
      at_ = behind_dimensions(at_);
      made.dimensions = text_of(own, at_) + dimensions;
      if (changes && is_buffer && own == at_) {
        found_.edits.push_back({list_.tokens[own - 1].end(), list_.tokens[own - 1].end(), "[1]"});
        made.dimensions = "[1]";
      }
      if (changes && is(own, "[") && is(own + 1, "]")) insert(own + 1, "1");
      annotations(made, changes);
      std::size_t begin = 0, end = 0;
      if (is(at_, "=")) {
        begin = ++at_;
        while (at_ < list_.size() && !is(at_, ",") && !is(at_, ";"))
          at_ = is(at_, "(") || is(at_, "{") || is(at_, "[") ? behind(at_) : at_ + 1;
        end = at_;
        made.value = text_of(begin, end);
        if (made.value.starts_with("sampler_state")) replace(begin - 1, end);
      } else if (is_hlsl_ && is(at_, "{")) {
        replace(at_, behind(at_));
        at_ = behind(at_);
      }
      add_global(std::move(made), kind, begin, end);
      if (!is(at_, ",")) break;
      ++at_;
    }
    skip();
  }

  /// HLSL: `: register(b0)`, `: SEMANTIC`, `< string UIName = "..."; >`
  void annotations(Declared& made, bool changes) {
    if (!is_hlsl_) return;
    while (is(at_, ":")) {
      const std::size_t begin = at_;
      made.semantic = word(at_ + 1);
      at_ = std::min(at_ + 2, list_.size());
      if (is(at_, "(")) at_ = behind(at_);
      if (changes) replace(begin, at_);
    }
    if (!is(at_, "<")) return;
    const std::size_t begin = at_;
    while (at_ < list_.size() && !is(at_, ">")) ++at_;
    at_ = std::min(at_ + 1, list_.size());
    replace(begin, at_);
  }

  bool is_hlsl_;
  ShaderText language_;
};

}  // namespace

const StructDeclaration* Declarations::find_struct(std::string_view name) const {
  const auto found = std::ranges::find(structs, name, &StructDeclaration::name);
  return found == structs.end() ? nullptr : &*found;
}
const GlobalVariable* Declarations::find_global(std::string_view name) const {
  const auto found = std::ranges::find(globals, name, &GlobalVariable::name);
  return found == globals.end() ? nullptr : &*found;
}

Declarations declarations_of(const TokenList& list, std::string_view plain, ShaderText language) {
  return language == ShaderText::kWgsl ? wgsl_declarations_of(list, plain)
                                       : Parser(list, plain, language).all();
}

bool is_texture_type(std::string_view type, ShaderText language) {
  const auto begins = [&](std::string_view with) { return type.starts_with(with); };
  switch (language) {
    case ShaderText::kGlsl:
      return begins("sampler") || begins("isampler") || begins("usampler") ||
             is_one_of(type, {"texture1D", "texture2D", "texture3D", "textureCube",
                              "texture2DArray", "textureCubeArray"});
    case ShaderText::kHlsl:
      return begins("Texture") || begins("sampler") || begins("Sampler");
    case ShaderText::kWgsl:
      return begins("texture_") || begins("sampler");
  }
  return false;
}

std::string edited(std::string_view text, std::vector<TextEdit> edits) {
  std::ranges::stable_sort(edits, {}, &TextEdit::begin);
  std::string made;
  std::size_t at = 0;
  for (const TextEdit& edit : edits) {
    if (edit.begin < at) continue;
    made += text.substr(at, edit.begin - at);
    made += edit.text;
    const std::string_view old = text.substr(edit.begin, edit.end - edit.begin);
    made.append(std::size_t(std::ranges::count(old, '\n')), '\n');
    at = edit.end;
  }
  return made += text.substr(at);
}

}  // namespace lobelia

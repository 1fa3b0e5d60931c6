#include "studies/shader_check/textures.hpp"

#include <algorithm>
#include <set>

namespace lobelia {
namespace {

class Textures {
 public:
  Textures(const Declarations& declared, ShaderText language) : language_(language) {
    for (const GlobalVariable& one : declared.globals) add(one);
    for (const FunctionDeclaration& function : declared.functions) {
      functions_.insert(function.name);
      for (const Declared& one : function.parameters) add(one);
    }
    for (const StructDeclaration& one : declared.structs)
      for (const Declared& member : one.members) add(member);
  }

  /// `behind(i)` is the token behind the bracket that opens at token `i`.
  template <class Behind>
  void read(const std::vector<Token>& tokens, Behind behind) {
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      const std::string_view word = tokens[i].text;
      const bool is_call = i + 1 < tokens.size() && tokens[i + 1] == "(";
      if (is_texture_type(word, language_) && !is_call && !types_.contains(word)) {
        i = type(tokens, i) - 1;
      } else if (is_call && language_ == ShaderText::kHlsl && i > 0 && tokens[i - 1] == "." &&
                 is_method(word)) {
        const std::size_t end = behind(i + 1);
        edits_.push_back({tokens[i].at, tokens[end - 1].end(),
                          "value" + swizzle(i > 1 ? tokens[i - 2].text : "", word)});
        i = end - 1;
      } else if (is_call && is_function(word) && !functions_.contains(word)) {
        i = call(tokens, i, behind) - 1;
      }
    }
  }

  std::vector<TextEdit> edits() { return std::move(edits_); }

 private:
  void add(const Declared& one) {
    if (is_texture_type(one.type, language_)) types_.emplace(one.name, one.type);
  }

  /// The end of the type that begins at `i`.
  std::size_t type(const std::vector<Token>& tokens, std::size_t i) {
    std::size_t begin = i, end = i + 1;
    if (language_ == ShaderText::kGlsl) {
      if (i > 0 && is_one_of(tokens[i - 1].text, {"highp", "mediump", "lowp"})) --begin;
      if (i > 1 && tokens[i - 2] == "precision") return end;
    } else if (end < tokens.size() && tokens[end] == "<") {
      constexpr std::size_t kMost = 12;
      for (std::size_t k = end; k < std::min(tokens.size(), end + kMost); ++k)
        if (tokens[k] == ">") {
          end = k + 1;
          break;
        }
    }
    edits_.push_back({tokens[begin].at, tokens[end - 1].end(), kTextureType});
    return end;
  }

  static bool is_method(std::string_view word) {
    return word.starts_with("Sample") || word.starts_with("Gather") || word == "Load";
  }
  bool is_function(std::string_view word) const {
    switch (language_) {
      case ShaderText::kGlsl:
        return word == "texelFetch" || word == "texelFetchOffset" || word == "shadow2D" ||
               (word.starts_with("texture") && !is_one_of(word, {"textureQueryLevels"}));
      case ShaderText::kHlsl:
        return word.starts_with("tex1D") || word.starts_with("tex2D") ||
               word.starts_with("tex3D") || word.starts_with("texCUBE");
      case ShaderText::kWgsl:
        return word.starts_with("textureSample") || word == "textureLoad" ||
               word == "textureDimensions";
    }
    return false;
  }

  /// The part of the value that a reading of a texture of that name has.
  std::string swizzle(std::string_view name, std::string_view function) const {
    const auto found = types_.find(name);
    const std::string_view type = found == types_.end() ? std::string_view() : found->second;
    const auto has = [&](std::string_view part) { return type.find(part) != type.npos; };
    if (function.find("Cmp") != function.npos || function.find("Compare") != function.npos ||
        has("Shadow") || has("depth") || has("<float>") || has("<half>"))
      return ".x";
    return has("<float2>") || has("<half2>")   ? ".xy"
           : has("<float3>") || has("<half3>") ? ".xyz"
                                               : "";
  }

  /// texture(E, ...) becomes ((E).value).
  template <class Behind>
  std::size_t call(const std::vector<Token>& tokens, std::size_t i, Behind behind) {
    const std::size_t end = behind(i + 1);
    const std::string_view word = tokens[i].text;
    if (end < i + 4 || !(tokens[end - 1] == ")")) return i + 1;
    if (word == "textureSize" || word == "textureDimensions") {
      edits_.push_back({tokens[i].at, tokens[end - 1].end(),
                        language_ == ShaderText::kWgsl ? "vec2u(1u)" : "ivec2(1)"});
      return end;
    }
    // The texture itself: sampler2D(tex, state) of Vulkan is one too.
    std::size_t begin = i + 2;
    if (is_texture_type(tokens[begin].text, language_) && tokens[begin + 1] == "(") begin += 2;
    std::size_t stop = begin;
    while (stop < end - 1 && !(tokens[stop] == ",") && !(tokens[stop] == ")"))
      stop = tokens[stop] == "(" || tokens[stop] == "[" ? behind(stop) : stop + 1;
    if (stop == begin || stop >= end) return i + 1;
    std::string before = "((", after = ").value" + swizzle(tokens[stop - 1].text, word) + ")";
    const auto found = types_.find(tokens[stop - 1].text);
    if (found != types_.end() && found->second.starts_with("isampler")) before = "ivec4" + before;
    if (found != types_.end() && found->second.starts_with("usampler")) before = "uvec4" + before;
    edits_.push_back({tokens[i].at, tokens[begin].at, before});
    edits_.push_back({tokens[stop - 1].end(), tokens[end - 1].end(), after});
    // An element of an array may depend on a texture itself; nothing else within is read.
    return end;
  }

  ShaderText language_;
  std::map<std::string, std::string, std::less<>> types_;
  std::set<std::string, std::less<>> functions_;
  std::vector<TextEdit> edits_;
};

}  // namespace

TextureEdits texture_edits(const TokenList& list, const Declarations& declared,
                           ShaderText language) {
  Textures textures(declared, language);
  textures.read(list.tokens,
                [&](std::size_t i) { return std::min(list.partner[i] + 1, list.size()); });
  constexpr std::size_t kLongest = 400;  // each call in it looks for its end
  for (const auto& macro : list.macros) {
    const std::vector<Token>& tokens = macro.second;
    if (tokens.size() > kLongest) continue;
    textures.read(tokens, [&](std::size_t i) {
      int depth = 0;
      for (; i < tokens.size(); ++i) {
        depth += tokens[i] == "(" ? 1 : tokens[i] == ")" ? -1 : 0;
        if (depth == 0) return i + 1;
      }
      return i;
    });
  }
  TextureEdits found{textures.edits(), ""};
  if (found.edits.empty()) return found;
  const char* const number = language == ShaderText::kGlsl   ? "highp vec4 value;"
                             : language == ShaderText::kHlsl ? "float4 value;"
                                                             : "value: vec4f,";
  found.prelude = std::string("struct ") + kTextureType + " { " + number + " };\n";
  if (language == ShaderText::kWgsl) found.prelude.erase(found.prelude.size() - 2, 1);
  return found;
}

}  // namespace lobelia

#include "studies/shader_check/read_shader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "studies/shader_check/arguments.hpp"
#include "studies/shader_check/meanings.hpp"
#include "studies/shader_check/program_text.hpp"
#include "studies/shader_check/textures.hpp"

namespace lobelia::shader_check {
namespace {

struct BuiltIn {
  const char *name, *type, *dimensions, *value;
  bool is_output;
};
/// Those of GLSL that a fragment shader alone has, or none any more.
constexpr BuiltIn kBuiltIns[] = {
    {"gl_FragColor", "vec4", "", "", true},        {"gl_FragData", "vec4", "[8]", "", true},
    {"gl_FragDepth", "float", "", "", true},       {"gl_FragDepthEXT", "float", "", "", true},
    {"gl_FragCoord", "vec4", "", "", false},       {"gl_PointCoord", "vec2", "", "", false},
    {"gl_FrontFacing", "bool", "", "true", false},
};

const BuiltIn* built_in(std::string_view name) {
  const auto found = std::ranges::find(kBuiltIns, name, &BuiltIn::name);
  return found == std::end(kBuiltIns) ? nullptr : found;
}

void add_built_ins(ReadShader& shader, std::vector<TextEdit>& edits) {
  std::set<std::string_view> found;
  const auto read = [&](const std::vector<Token>& tokens) {
    for (const Token& token : tokens)
      if (token.text.starts_with("gl_") && built_in(token.text)) {
        found.insert(token.text);
        edits.push_back({token.at, token.at, "lobelia_"});
      }
  };
  read(shader.tokens.tokens);
  for (const auto& [name, tokens] : shader.tokens.macros) read(tokens);
  for (const std::string_view name : found) {
    const BuiltIn& one = *built_in(name);
    GlobalVariable made;
    made.type = one.type;
    made.name = name;
    made.dimensions = one.dimensions;
    made.value = one.value;
    made.kind = one.is_output ? GlobalVariable::Kind::kOutput : GlobalVariable::Kind::kInput;
    shader.prelude +=
        fmt::format("{}{} lobelia_{}{}{}{};\n", made.type == "bool" ? "" : "highp ", made.type,
                    name, made.dimensions, made.value.empty() ? "" : " = ", made.value);
    shader.declared.globals.push_back(std::move(made));
  }
}

/// Numbers of 16 bits become those of 32: what they change is measured apart, and most drivers ignore them.
void raise_precision(ReadShader& shader, std::vector<TextEdit>& edits) {
  const auto read = [&](const std::vector<Token>& tokens) {
    for (const Token& token : tokens)
      if (is_one_of(token.text, {"mediump", "lowp"})) {
        shader.has_low_precision = true;
        edits.push_back({token.at, token.end(), "highp"});
      }
  };
  read(shader.tokens.tokens);
  for (const auto& [name, tokens] : shader.tokens.macros) read(tokens);
}

/// A type that is a macro or an alias becomes what it stands for.
void resolve(std::string& type, const ReadShader& shader) {
  constexpr int kMostSteps = 4;
  const auto& macros = shader.tokens.macros;
  const auto& aliases = shader.declared.aliases;
  for (int step = 0; step < kMostSteps; ++step) {
    if (const auto alias = aliases.find(type); alias != aliases.end()) {
      type = alias->second;
    } else if (const auto macro = macros.find(type);
               macro != macros.end() && macro->second.size() == 1) {
      type = macro->second.front().text;
    } else {
      return;
    }
  }
}

/// glslang computes h m for the h^m of HLSL's lit(l, h, m).
void mend_lit(ReadShader& shader, std::vector<TextEdit>& edits) {
  constexpr std::string_view kLit = "lit";
  if (std::ranges::count(shader.declared.functions, kLit, &FunctionDeclaration::name) > 0) return;
  bool is_called = false;
  const auto read = [&](const std::vector<Token>& tokens) {
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i)
      if (tokens[i] == kLit && tokens[i + 1] == "(") {
        edits.push_back({tokens[i].at, tokens[i].at, "lobelia_"});
        is_called = true;
      }
  };
  read(shader.tokens.tokens);
  for (const auto& [name, tokens] : shader.tokens.macros) read(tokens);
  if (is_called)
    shader.prelude +=
        "float4 lobelia_lit(float l, float h, float m) { return float4(1.0, max(l, 0.0), "
        "l < 0.0 || h < 0.0 ? 0.0 : pow(h, m), 1.0); }\n";
}

bool is_own_name(std::string_view word) {
  if (word.starts_with("Lobelia"))
    return word == kTextureType || word.starts_with("LobeliaPoint") || word == "LobeliaResults";
  if (!word.starts_with("lobelia_")) return false;
  word.remove_prefix(8);
  if (word.size() > 1 && (word[0] == 'p' || word[0] == 'a') &&
      word.find_first_not_of("0123456789", 1) == word.npos)
    return true;
  constexpr std::string_view kOwn[] = {"as_four", "points", "result", "results", "main",
                                       "i",       "k",      "t",      "value",   "main_of_file",
                                       "id",      "v",      "lit"};
  return std::ranges::find(kOwn, word) != std::end(kOwn) || word.starts_with("gl_");
}

void refuse_own_names(const ReadShader& shader, std::string_view file) {
  const auto check = [&](std::string_view name, std::size_t at) {
    if (is_own_name(name))
      throw Error(ExitCode::kInput,
                  "{}: '{}' is a name of the program around the shader; choose another",
                  shader.place(file, at), printable(name));
  };
  for (const Token& token : shader.tokens.tokens) check(token.text, token.at);
  for (const auto& [name, tokens] : shader.tokens.macros) {
    if (is_own_name(name)) check(name, shader.plain.find(name));
    for (const Token& token : tokens) check(token.text, token.at);
  }
}

/// An entry of HLSL may give a structure with the target in it.
void find_entries(Declarations& declared) {
  for (FunctionDeclaration& function : declared.functions)
    if (const StructDeclaration* result = declared.find_struct(function.result))
      function.is_entry =
          function.is_entry || std::ranges::any_of(result->members, [](const Declared& member) {
            const std::string semantic = lower_case(member.semantic);
            return semantic.starts_with("sv_target") || semantic == "color0";
          });
}

std::vector<std::string_view> names_of(const std::vector<std::string>& names) {
  std::vector<std::string_view> views(names.begin(), names.end());
  constexpr std::size_t kMost = 20;
  if (views.size() > kMost) {
    views.resize(kMost);
    views.emplace_back("...");
  }
  return views;
}

std::vector<std::string> functions_of(const ReadShader& shader) {
  std::set<std::string> names;
  for (const FunctionDeclaration& one : shader.declared.functions)
    if (one.has_body) names.insert(one.name);
  return {names.begin(), names.end()};
}

/// Whether a parameter, or a member of it, is a vector, or with `is_vector` false a number.
bool takes(const Declarations& declared, const FunctionDeclaration& function, bool is_vector) {
  const auto is_one = [&](const Declared& one) {
    const TypeShape shape = shape_of(one.type);
    return one.is_in && shape.columns == 1 && (is_vector ? shape.rows >= 3 : shape.rows == 1);
  };
  return std::ranges::any_of(function.parameters, [&](const Declared& parameter) {
    const StructDeclaration* made = declared.find_struct(parameter.type);
    return made ? std::ranges::any_of(made->members, is_one) : is_one(parameter);
  });
}

std::string found_name(const ReadShader& shader, std::string_view file) {
  std::set<std::string> entries;
  for (const FunctionDeclaration& one : shader.declared.functions)
    if (one.has_body && one.is_entry) entries.insert(one.name);
  if (entries.size() == 1) return *entries.begin();
  const std::vector<std::string> all = functions_of(shader),
                                 roots = uncalled_functions(shader.tokens, shader.declared);
  if (all.size() == 1) return all.front();
  if (roots.size() == 1) return roots.front();
  // Helpers that nothing calls take numbers alone, or vectors alone.
  std::set<std::string> of_vectors, of_both;
  for (const FunctionDeclaration& one : shader.declared.functions) {
    if (!one.has_body || std::ranges::count(roots, one.name) == 0 ||
        !takes(shader.declared, one, true))
      continue;
    of_vectors.insert(one.name);
    if (takes(shader.declared, one, false)) of_both.insert(one.name);
  }
  for (const std::set<std::string>& found : {of_vectors, of_both})
    if (found.size() == 1) return *found.begin();
  if (!all.empty())
    throw Error(ExitCode::kUsage, "{}: --function has to say which one is meant: {}", file,
                join(names_of(roots.empty() ? all : roots)));
  return "";
}

}  // namespace

std::string ReadShader::place(std::string_view file, std::size_t at) const {
  return fmt::format("{}:{}", file,
                     1 + std::ranges::count(std::string_view(plain).substr(0, at), '\n'));
}

std::unique_ptr<ReadShader> read_shader(const ShaderSource& source) {
  auto shader = std::make_unique<ReadShader>();
  shader->plain = plain_text(source);
  shader->tokens = tokens_of(shader->plain, source.language);
  refuse_own_names(*shader, source.name);
  shader->declared = declarations_of(shader->tokens, shader->plain, source.language);
  TextureEdits textures = texture_edits(shader->tokens, shader->declared, source.language);
  shader->prelude = textures.prelude;
  std::vector<TextEdit> edits = std::move(shader->declared.edits);
  edits.insert(edits.end(), textures.edits.begin(), textures.edits.end());
  shader->dropped = std::move(textures.edits);
  if (source.language == ShaderText::kGlsl) {
    add_built_ins(*shader, edits);
    raise_precision(*shader, edits);
  } else if (source.language == ShaderText::kHlsl) {
    mend_lit(*shader, edits);
  }
  shader->text = edited(shader->plain, std::move(edits));
  for (FunctionDeclaration& function : shader->declared.functions) {
    resolve(function.result, *shader);
    for (Declared& one : function.parameters) resolve(one.type, *shader);
  }
  for (StructDeclaration& one : shader->declared.structs)
    for (Declared& member : one.members) resolve(member.type, *shader);
  for (GlobalVariable& one : shader->declared.globals) resolve(one.type, *shader);
  find_entries(shader->declared);
  return shader;
}

std::string inner_name(std::string_view name, ShaderText language) {
  if (name == "main" && language != ShaderText::kWgsl) return "lobelia_main_of_file";
  if (language == ShaderText::kGlsl && built_in(name)) return "lobelia_" + std::string(name);
  return std::string(name);
}

const FunctionDeclaration& chosen_function(const ReadShader& shader, std::string_view file,
                                           std::string_view name, int parameters) {
  const std::string wanted = name.empty() ? found_name(shader, file) : std::string(name);
  const FunctionDeclaration* best = nullptr;
  for (const FunctionDeclaration& one : shader.declared.functions) {
    if (!one.has_body || one.name != wanted) continue;
    if (!best || std::ranges::count_if(one.parameters, takes_word) == parameters) best = &one;
  }
  if (best && best->end < shader.tokens.size()) return *best;
  if (!shader.tokens.wrong.empty())
    throw Error(ExitCode::kInput, "{}: syntax error: {}",
                shader.place(file, shader.tokens.wrong_at), shader.tokens.wrong);
  const std::vector<std::string> names = functions_of(shader);
  const std::vector<std::string_view> known = names_of(names);
  throw Error(ExitCode::kInput, known.empty() ? fmt::format("{}: has no function", file)
                                              : fmt::format("{}: has no function '{}'; it has {}{}",
                                                            file, printable(wanted), join(known),
                                                            did_you_mean(wanted, known)));
}

}  // namespace lobelia::shader_check

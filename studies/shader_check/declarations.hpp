// The functions, structures and global variables that a shader's text declares, in GLSL, HLSL and WGSL.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "studies/shader_check/shader_tokens.hpp"

namespace lobelia {

/// A parameter, a member of a structure, or a global variable.
struct Declared {
  std::string type;  ///< "vec3", without qualifiers
  std::string name;
  std::string dimensions;  ///< "[4]"; "" of no array
  std::string value;       ///< the text behind '='; "" without
  std::string semantic;    ///< "SV_Target", "location(0)"; "" without
  bool is_in = true, is_out = false;
};

struct FunctionDeclaration {
  std::string name, result;  ///< `result` is "" of a WGSL function without one
  std::string semantic;      ///< of the result
  std::vector<Declared> parameters;
  bool is_entry = false;  ///< of the fragment stage, by an attribute or a semantic, or `main`
  bool has_body = false;
  std::size_t begin = 0, end = 0;  ///< the body's brackets among the tokens
  std::size_t at = 0;              ///< place of its name in the text
};

struct StructDeclaration {
  std::string name;
  std::vector<Declared> members;
};

struct GlobalVariable : Declared {
  enum class Kind : std::uint8_t {
    kInput,  ///< the program around it sets it: uniform, in, varying, member of a block, var<uniform>
    kOutput,   ///< out of a fragment shader
    kPrivate,  ///< of the shader itself
    kConstant,
    kTexture,  ///< or a sampler
    kFixed,    ///< of a kind that cannot be set: an image, a counter
  } kind = Kind::kPrivate;
  std::size_t begin = 0, end = 0;  ///< the tokens of `value`
};

/// A part of the text to replace. Line ends in it are kept.
struct TextEdit {
  std::size_t begin = 0, end = 0;
  std::string text = {};
};

struct Declarations {
  std::vector<FunctionDeclaration> functions;
  std::vector<StructDeclaration> structs;
  std::vector<GlobalVariable> globals;
  std::map<std::string, std::string, std::less<>> aliases;  ///< types by their other names
  /// Make private variables of all globals that can be set, without bindings, locations and semantics.
  std::vector<TextEdit> edits;

  const StructDeclaration* find_struct(std::string_view name) const;
  const GlobalVariable* find_global(std::string_view name) const;
};

/// In one pass. What it does not understand it leaves to the compiler.
Declarations declarations_of(const TokenList& list, std::string_view plain, ShaderText language);

/// The same for WGSL, which has a grammar of its own.
Declarations wgsl_declarations_of(const TokenList& list, std::string_view plain);

/// Whether a type is a texture or a sampler, which has no value of its own.
bool is_texture_type(std::string_view type, ShaderText language);

/// The text with the edits, which may come in any order but do not overlap, and the same lines.
std::string edited(std::string_view text, std::vector<TextEdit> edits);

}  // namespace lobelia

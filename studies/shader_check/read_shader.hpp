// Somebody's shader as it is read: its declarations, and the text whose global variables are private ones.
#pragma once

#include <memory>

#include "studies/shader_check/declarations.hpp"
#include "studies/shader_check/reach.hpp"

namespace lobelia::shader_check {

struct ReadShader {
  std::string plain;
  TokenList tokens;
  Declarations declared;          ///< with gl_FragColor and the like, if they are there
  std::vector<TextEdit> dropped;  ///< readings of textures
  std::string prelude, text;
  bool has_low_precision = false;  ///< it asked for mediump or lowp

  ReadShader() = default;
  ReadShader(const ReadShader&) = delete;  // `tokens` are parts of `plain`
  ReadShader& operator=(const ReadShader&) = delete;

  /// "mine.glsl:3"
  std::string place(std::string_view file, std::size_t at) const;
};

/// Throws Error(kInput) as plain_text(), and for names that the program around a shader has.
std::unique_ptr<ReadShader> read_shader(const ShaderSource& source);

/// The name by which the program around it calls a function or a variable.
std::string inner_name(std::string_view name, ShaderText language);

/// The function of that name, or the one to check if `name` is "": the entry of the fragment stage, or the one that no
/// other calls. Throws Error(kUsage) or Error(kInput) if there is none, naming those that there are, or the first bracket
/// without a partner. Of several with one name, that with `parameters` of them that take words; -1: the first.
const FunctionDeclaration& chosen_function(const ReadShader& shader, std::string_view file,
                                           std::string_view name, int parameters);

}  // namespace lobelia::shader_check

// The languages that share the texts in renderer/export/gpu/. All about one of them is its row in languages.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lobelia {

struct GpuLanguage {
  std::string_view name;            ///< "glsl", as on the command line
  std::string_view title;           ///< "GLSL"
  std::string_view note;            ///< how a text is used; the lines of a comment
  std::string_view begin = {};      ///< what has to stand before the functions, after a blank line
  std::string_view vector, colour;  ///< types
  std::string_view normal = "normal";  ///< name of a parameter; it is a word of OSL's own
  std::string_view function = {};      ///< what stands before a function's type
  /// A guard against reading a part twice; "%name%" is the part's name.
  std::string_view guard_begin = "#ifndef %name%\n#define %name%\n", guard_end = "#endif\n";
  /// For ShaderPrecision: the word for half floats; empty where there is no export in them.
  std::string_view half_word = {};
  std::string_view half_note = {};  ///< in place of `note`
  std::string_view half_end = {};   ///< what has to stand behind such functions
  std::string (*narrow)(const std::string& text) = nullptr;  ///< from floats to that word's
  /// From the C that the other languages have in common; null where the language is one of them.
  std::string (*translate)(const std::string& text) = nullptr;
};
std::span<const GpuLanguage> gpu_languages();

}  // namespace lobelia

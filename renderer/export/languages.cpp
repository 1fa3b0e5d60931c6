#include "renderer/export/languages.hpp"

#include <regex>

namespace lobelia {
namespace {

/// `text` with what `form` says in place of each match.
template <class Form>
std::string replaced(const std::string& text, const std::regex& pattern, Form form) {
  std::string result;
  auto rest = text.begin();
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
    result.append(rest, (*match)[0].first) += form(*match);
    rest = (*match)[0].second;
  }
  return result.append(rest, text.end());
}

/// WGSL writes a type behind the name, and says whether a variable changes. The rest of our texts is the same in it.
std::string wgsl_from_c(const std::string& text) {
  static const std::regex heading("\n(float|vec3f) (\\w+)\\(([^)]*)\\)\n\\{"),
      parameter("(float|vec3f) (\\w+)"), declaration("\n( +)(?:float|vec3f) (\\w+) = ");
  const auto type = [](const std::string& name) { return name == "float" ? "f32" : name; };
  const std::string headed = replaced(text, heading, [&](const std::smatch& function) {
    return "\nfn " + function.str(2) + "(" +
           replaced(function.str(3), parameter,
                    [&](const std::smatch& p) { return p.str(2) + ": " + type(p.str(1)); }) +
           ") -> " + type(function.str(1)) + "\n{";
  });
  return replaced(headed, declaration, [&](const std::smatch& variable) {
    const bool changes = std::regex_search(headed, std::regex("\n +" + variable.str(2) + " = "));
    return "\n" + variable.str(1) + (changes ? "var " : "let ") + variable.str(2) + " = ";
  });
}

/// A qualifier before types, but not in a constructor: vec3(x, y, z).
std::string mediump_from_c(const std::string& text) {
  static const std::regex declared("\\b(float|vec3) (?=\\w)");
  return std::regex_replace(text, declared, "mediump $1 ");
}

std::string min16float_from_c(const std::string& text) {
  static const std::regex type("\\bfloat(3?)\\b");
  return std::regex_replace(text, type, "min16float$1");
}

constexpr GpuLanguage kLanguages[] = {
    {.name = "glsl",
     .title = "GLSL",
     .note =
         "For every version of GLSL and GLSL ES (WebGL). What follows it in a shader has highp floats, too,\n"
         "// until it says otherwise: half floats do not hold these numbers.",
     .begin = "#ifdef GL_FRAGMENT_PRECISION_HIGH\nprecision highp float;\n#endif\n",
     .vector = "vec3",
     .colour = "vec3",
     .half_word = "mediump",
     .half_note =
         "For GLSL ES (WebGL), and for GLSL from version 1.30, which accepts `mediump` and ignores it. What follows it\n"
         "// in a shader has mediump floats, until it says otherwise. Only a coefficient is computed in highp.",
     .half_end = "\n#ifdef GL_FRAGMENT_PRECISION_HIGH\nprecision mediump float;\n#endif\n",
     .narrow = mediump_from_c},
    {.name = "hlsl",
     .title = "HLSL",
     .note = "For every shader model.",
     .vector = "float3",
     .colour = "float3",
     .half_word = "min16float",
     .half_note =
         "For shader model 4 and later, with Direct3D 11.1. Only a coefficient is computed in float.",
     .narrow = min16float_from_c},
    {.name = "wgsl",
     .title = "WGSL",
     .note = "WGSL has no preprocessor: of functions that two exports have in common, keep one.",
     .vector = "vec3f",
     .colour = "vec3f",
     .guard_begin = "",
     .guard_end = "",
     .translate = wgsl_from_c},
    {.name = "msl",
     .title = "Metal's language (MSL)",
     .note = "For every version of Metal.",
     .begin = "#include <metal_stdlib>\nusing namespace metal;\n",
     .vector = "float3",
     .colour = "float3",
     .function = "inline "},
    {.name = "osl",
     .title = "OSL",
     .note = "To be included before a shader, where to_eye is -I and surface_normal is N.",
     .vector = "vector",
     .colour = "color",
     .normal = "surface_normal"},
};

}  // namespace

std::span<const GpuLanguage> gpu_languages() { return kLanguages; }

}  // namespace lobelia

// Declarations of a shader's text, meanings of its names, and the text with private variables in place of uniforms.
#include "studies/shader_check/declarations.hpp"

#include <random>

#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "studies/shader_check/arguments.hpp"
#include "studies/shader_check/meanings.hpp"
#include "studies/shader_check/read_shader.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using shader_check::read_shader;
using testing::ElementsAre;
using testing::IsEmpty;

std::unique_ptr<shader_check::ReadShader> read(const std::string& text,
                                               ShaderText language = ShaderText::kGlsl) {
  return read_shader({language, "mine", text, {}});
}

/// Each as "vec3 name[2]", with '!' behind those that nothing sets from outside.
std::vector<std::string> globals_of(const std::string& text,
                                    ShaderText language = ShaderText::kGlsl) {
  std::vector<std::string> found;
  const auto shader = read(text, language);
  for (const GlobalVariable& one : shader->declared.globals)
    found.push_back(
        one.type + " " + one.name + one.dimensions +
        (one.kind == GlobalVariable::Kind::kPrivate || one.kind == GlobalVariable::Kind::kConstant
             ? "!"
             : ""));
  return found;
}

std::vector<std::string> functions_of(const std::string& text,
                                      ShaderText language = ShaderText::kGlsl) {
  std::vector<std::string> found;
  const auto shader = read(text, language);
  for (const FunctionDeclaration& one : shader->declared.functions) {
    std::string parameters;
    for (const Declared& at : one.parameters)
      parameters += (parameters.empty() ? "" : ", ") +
                    std::string(at.is_out ? at.is_in ? "inout " : "out " : "") + at.type + " " +
                    at.name + at.dimensions + (at.value.empty() ? "" : " = " + at.value);
    found.push_back(one.result + " " + one.name + "(" + parameters + ")" +
                    (one.has_body ? "" : ";") + (one.is_entry ? " entry" : ""));
  }
  return found;
}

TEST(Declarations, FunctionsHaveTheirParametersInEveryLanguage) {
  EXPECT_THAT(
      functions_of(
          "// float no(float x) {\nhighp float a(const in vec3 N /* (normal) */,\n  float n) "
          "// here\n{ if (n > 0.0) { return b(n); } else if (n < 1.0) { for (;;) {} } }\n"
          "float later(float x);\nvoid main(void){}\nvec4 c(inout float w[3], out vec3 s) {}"),
      ElementsAre("float a(vec3 N, float n)", "float later(float x);", "void main() entry",
                  "vec4 c(inout float w[3], out vec3 s)"));
  EXPECT_THAT(functions_of("float4 c(float x : TEXCOORD0, float3 n = float3(0, 0, 1)) : SV_Target "
                           "{ return x; } [numthreads(1, 1, 1)] void d(vector<float, 3> v) {}",
                           ShaderText::kHlsl),
              ElementsAre("float4 c(float x, float3 n = float3(0, 0, 1)) entry",
                          "void d(vector<float, 3> v)"));
  EXPECT_THAT(
      functions_of("fn d(N: vec3f, n: vec2<f32>,) -> f32 { return n; } @fragment fn m(@location(0) "
                   "a: vec3f) -> @location(0) vec4f { return vec4f(a, 1); }",
                   ShaderText::kWgsl),
      ElementsAre("f32 d(vec3f N, vec2<f32> n)", "vec4f m(vec3f a) entry"));
}

TEST(Declarations, GlobalVariablesOfEveryKind) {
  EXPECT_THAT(
      globals_of("#version 300 es\nprecision highp float;\nlayout(location = 2) flat in vec3 a, "
                 "b[2];\nuniform mediump float c;\nconst float kPi = 3.14;\nvec2 d = vec2(1, "
                 "2);\nuniform M { vec3 e; layout(offset = 16) float f; };\nuniform K { float "
                 "g; } k[2];\nuniform struct S { float h; } s;\nout vec4 o;\nlayout(local_size_x "
                 "= 1) in;\nuniform sampler2D t;\ninvariant gl_FragCoord;\n"),
      ElementsAre("vec3 a", "vec3 b[2]", "float c", "float kPi!", "vec2 d!", "vec3 e", "float f",
                  "K k[2]", "S s", "vec4 o", "sampler2D t", "vec4 gl_FragCoord"));
  EXPECT_THAT(
      globals_of(
          "float3 a : COLOR < string UIName = \"a; b\"; > = {1, 2, 3};\nstatic float b;\nstatic "
          "const float kPi = 3;\ncbuffer M : register(b0) { row_major float4x4 c : packoffset(c0); "
          "float d, e; };\nTexture2D<float4> t : register(t0);\nSamplerState s { Filter = X; "
          "};\nStructuredBuffer<float3> l;\ntechnique T { pass P { } }\nfloat f;",
          ShaderText::kHlsl),
      ElementsAre("float3 a", "float b!", "float kPi!", "float4x4 c", "float d", "float e",
                  "Texture2D<float4> t", "SamplerState s", "float3 l[1]", "float f"));
  EXPECT_THAT(
      globals_of("enable f16;\nstruct U { a: vec3f, @size(16) b: array<f32> }\n@group(0) "
                 "@binding(0) var<uniform> u: U;\n@id(3) override n: f32 = 16;\nconst kPi = "
                 "3.14;\nvar<private> p: vec3<f32>;\n@group(0) @binding(1) var t: "
                 "texture_2d<f32>;\nvar<storage, read> l: array<vec3f>;",
                 ShaderText::kWgsl),
      ElementsAre("U u", "f32 n", " kPi!", "vec3<f32> p!", "texture_2d<f32> t", "vec3f l[1]"));
}

TEST(Declarations, InputsBecomePrivateVariables) {
  EXPECT_EQ(
      read("uniform vec3 a;\nlayout(location = 0)\nin vec3 b;\nuniform M { vec3 c; };\nin V { "
           "flat vec3 d; } v;\nvoid main() { gl_FragColor = vec4(a, 1); }\n")
          ->text,
      " vec3 a;\n\n vec3 b;\n  vec3 c; \n struct V {  vec3 d; } v;\nvoid main() { "
      "lobelia_gl_FragColor = vec4(a, 1); }\n");
  EXPECT_EQ(
      read("uniform float a : register(c0);\ncbuffer M { float b; }\n", ShaderText::kHlsl)->text,
      " static float a ;\n static float b; \n");
  EXPECT_EQ(
      read("@group(0) @binding(0) var<uniform> a: vec3f;\n@fragment fn f(@location(0) b: f32) "
           "-> @location(0) vec4f { return vec4f(b); }\n",
           ShaderText::kWgsl)
          ->text,
      "  var<private> a: vec3f;\n fn f( b: f32) ->  vec4f { return vec4f(b); }\n");
}

TEST(Declarations, ReadingsOfTexturesBecomeTheirValue) {
  EXPECT_EQ(
      read("uniform lowp sampler2D t;\nfloat f(sampler2D s, vec2 p) { return texture(s, p).r + "
           "texture2D(t, vec2(1, (2))).r; }\n#define T(x) texture(t, x)\n")
          ->text,
      " LobeliaTexture t;\nfloat f(LobeliaTexture s, vec2 p) { return ((s).value).r + "
      "((t).value).r; }\n#define T(x) ((t).value)\n");
  EXPECT_EQ(
      read("Texture2D<float> t; sampler2D u;\nfloat4 a(SamplerState s) { return t.Sample(s, "
           "p) + tex2D(u, p); }",
           ShaderText::kHlsl)
          ->text,
      "static LobeliaTexture t; static LobeliaTexture u;\nfloat4 a(LobeliaTexture s) { return "
      "t.value.x + ((u).value); }");
  EXPECT_EQ(read("@group(0) @binding(0) var t: texture_2d<f32>;\nfn f() -> vec4f { return "
                 "textureSample(t, s, p); }",
                 ShaderText::kWgsl)
                ->text,
            "  var<private> t: LobeliaTexture;\nfn f() -> vec4f { return ((t).value); }");
}

TEST(Declarations, FalseConditionsHideTheirText) {
  EXPECT_THAT(
      globals_of("#define A 2\n#ifdef A\nuniform float a;\n#else\nuniform float b;\n#endif\n"
                 "#if A == 1 || defined(B)\nuniform float c;\n#elif (A > 1)\nuniform float d;\n"
                 "#endif\n#if 0\nuniform float e;\n#endif\n#ifdef GL_ES\nuniform float f;\n"
                 "#endif\n#undef A\n#ifndef A\nuniform float g;\n#endif\n"),
      ElementsAre("float a", "float d", "float g"));
}

TEST(Reach, VariablesOfTheFunctionHideThoseOfTheFile) {
  const auto reached = [](const std::string& text) {
    const auto shader = read(text);
    return reach_of("f", shader->tokens, shader->declared, shader->dropped).globals;
  };
  const std::string head = "uniform float a; uniform float b; uniform sampler2D t;\n";
  EXPECT_THAT(reached(head + "float f(float a) { return a; }"), IsEmpty());
  EXPECT_THAT(reached(head + "float f() { float a = a; return a; }"), ElementsAre("a"));
  EXPECT_THAT(reached(head + "float f() { { float a = 1.0; } return a; }"), ElementsAre("a"));
  EXPECT_THAT(reached(head + "float f() { return x.a; }"), IsEmpty());
  EXPECT_THAT(reached(head + "float g() { return a; } float f() { return g(); }"),
              ElementsAre("a"));
  EXPECT_THAT(reached(head + "#define A (a + b)\nfloat f() { return A; }"), ElementsAre("a", "b"));
  EXPECT_THAT(reached(head + "float c = a; float f() { return c; }"), ElementsAre("a", "c"));
  EXPECT_THAT(reached(head + "float f() { return texture(t, vec2(a)).x; }"), ElementsAre("t"));
}

TEST(Meanings, NamesTellWithTheirTypes) {
  const auto meaning = [](const char* name, const char* type) {
    const auto found = shader_check::meaning_of(name, shader_check::shape_of(type));
    return found.is_told ? found.values.front() : "";
  };
  for (const auto& [names, type, value] : std::initializer_list<std::array<const char*, 3>>{
           {"N normal vNormal v_normal worldNormal i.normalWS nrm fs_in.Normal", "vec3", "N"},
           {"V view viewDir eye uEyePos cameraPosition v_dir wo E toEye camPos", "float3", "V"},
           {"L l lightDir uLight u_lightPos light.direction light.position sunDirection wi",
            "vec3f", "L"},
           {"H h halfVector halfDir halfway hv wh", "half3", "H"},
           {"R reflectDir r reflected mirrorDir", "vec3", "R"},
           {"vPos fragPos position v_position worldPos pos P", "vec3", "position"},
           {"n shininess uShininess material.shininess specularPower specPow exponent Ns", "float",
            "n"},
           {"roughness perceptualRoughness u_roughness mat.rough", "float", "roughness"},
           {"alpha a alphaRoughness roughness2", "f32", "alpha"},
           {"alpha2 a2 alphaSq", "float", "alpha2"},
           {"NdotL NoL nDotL dotNL nl LdotN n_dot_l NL", "float", "N.L"},
           {"NdotH NoH dotNH nh", "half", "N.H"},
           {"VdotH VoH LdotH loh HdotV", "float", "V.H"},
           {"NdotV nv NoV", "float", "N.V"},
           {"lightColor specColor uLightCol ambient normalMap reflectance tangent diffuse", "vec3",
            ""},
           {"time x count strength normal", "float", ""},
           {"normalMatrix viewMatrix", "mat3", ""}})
    for (const std::string& name : split(names, " "))
      EXPECT_EQ(meaning(name.c_str(), type), value) << name;
}

TEST(Meanings, TypesHaveTheirComponents) {
  for (const auto& [type, rows, columns] :
       std::initializer_list<std::tuple<const char*, int, int>>{{"float", 1, 1},
                                                                {"vec3", 3, 1},
                                                                {"float4", 4, 1},
                                                                {"half3", 3, 1},
                                                                {"vec3f", 3, 1},
                                                                {"vec3<f32>", 3, 1},
                                                                {"vector<float, 3>", 3, 1},
                                                                {"min16float3", 3, 1},
                                                                {"ivec2", 2, 1},
                                                                {"mat3", 3, 3},
                                                                {"float4x4", 4, 4},
                                                                {"mat3x3f", 3, 3},
                                                                {"float3x4", 3, 4},
                                                                {"bool", 1, 1},
                                                                {"Light", 0, 1},
                                                                {"", 0, 1},
                                                                {"vec", 0, 1},
                                                                {"sampler2D", 0, 1}}) {
    EXPECT_EQ(shader_check::shape_of(type).rows, rows) << type;
    EXPECT_EQ(shader_check::shape_of(type).columns, columns) << type;
  }
}

TEST(LikelyArguments, AreTheNamedOnesOrEachOrder) {
  const auto lists = [](const std::string& parameters, std::size_t most) {
    const auto shader = read("float f(" + parameters + ") { return 1.0; }");
    return shader_check::likely_arguments(shader->declared.functions.at(0), most);
  };
  EXPECT_THAT(lists("vec3 lightDir, vec3 viewDir, vec3 normal, float shininess", 9),
              ElementsAre("L,V,N,n"));
  EXPECT_THAT(lists("float NoH, float roughness, out float pdf", 9), ElementsAre("N.H,roughness"));
  EXPECT_THAT(lists("vec3 a, vec3 b, vec3 c, float n", 2), ElementsAre("N,V,L,n", "N,L,V,n"));
  EXPECT_THAT(lists("vec3 R, vec3 V, float n", 9), ElementsAre("RL,V,n"));
  const std::vector<std::string> all = lists("vec3 a, vec3 b, vec3 c, float q", 50);
  EXPECT_EQ(all.size(), 50u);
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), 50u);
}

/// Parts of shaders in any order, with brackets and directives that do not fit.
TEST(Declarations, RandomTextsKeepTheirLines) {
  constexpr const char* kParts[] = {
      "uniform ",   "vec3 ",   "in ",      "a",        "b",          "(",
      ")",          "{",       "}",        "[",        "]",          ";",
      ",",          "=",       ":",        "<",        ">",          "struct S ",
      "\n",         "#if A\n", "#else\n",  "#endif\n", "#define A(", "texture2D(",
      "sampler2D ", "layout",  "cbuffer ", "fn ",      "var<",       "@",
      "array<",     "->",      "\"",       ".Sample(", "precision ", "gl_FragColor",
      "1.0",        "static ", "register", "return ",  "float f() {"};
  std::mt19937 random(7);
  for (const ShaderText language : {ShaderText::kGlsl, ShaderText::kHlsl, ShaderText::kWgsl})
    for (int round = 0; round < 2000; ++round) {
      std::string text;
      for (int k = int(random() % 40); k >= 0; --k) text += kParts[random() % std::size(kParts)];
      try {
        const auto shader = read(text, language);
        EXPECT_EQ(std::ranges::count(shader->text, '\n'), std::ranges::count(shader->plain, '\n'))
            << text;
        for (const FunctionDeclaration& one : shader->declared.functions)
          reach_of(one.name, shader->tokens, shader->declared, shader->dropped);
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::kInput) << text;
      }
    }
}

TEST(Declarations, AQuarterMillionBytesOfAnythingAreReadInOnePass) {
  for (const std::string part : {"(",
                                 "{",
                                 "a a(\n",
                                 "a b(){}",
                                 "uniform vec3 a;",
                                 "texture(a ",
                                 "texture(a,",
                                 "#if A\n",
                                 "#define A(\n",
                                 "struct S{",
                                 "float f(float a){",
                                 "@a(",
                                 "array<",
                                 "a<",
                                 "fn f(",
                                 "var a:",
                                 "cbuffer A{",
                                 "float f(){float a;a;",
                                 "}",
                                 "layout(",
                                 "#define A texture2D(\n"})
    for (const ShaderText language : {ShaderText::kGlsl, ShaderText::kHlsl, ShaderText::kWgsl}) {
      std::string text;
      while (text.size() < (1 << 18)) text += part;
      const auto shader = read(text, language);
      uncalled_functions(shader->tokens, shader->declared);
      for (const FunctionDeclaration& one : shader->declared.functions) {
        reach_of(one.name, shader->tokens, shader->declared, shader->dropped);
        break;
      }
    }
}

TEST(Declarations, NamesOfTheProgramAroundAShaderAreRefused) {
  for (const char* text :
       {"\nfloat lobelia_p3;", "\n#define lobelia_points 1", "\n#define A lobelia_as_four(1)",
        "\nstruct LobeliaTexture { float a; };"})
    try {
      read(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(),
                  testing::AnyOf(HasSubstr("mine:2: 'lobelia"), HasSubstr("mine:2: 'Lobelia")))
          << text;
    }
  EXPECT_NO_THROW(read("float lobelia_phong_rdf_cosine(float n) { return n; }"));
}

}  // namespace
}  // namespace lobelia

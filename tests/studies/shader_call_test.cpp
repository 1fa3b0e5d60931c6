// Shaders as people write them: with uniforms, blocks, textures, structures and a main. All of them are right.
#include <fmt/format.h>

#include <chrono>

#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "studies/shader_check/check.hpp"
#include "studies/shader_check/explain.hpp"
#include "tests/shaders/shader_runner.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

struct Written {
  const char* what;
  std::string text;
  std::vector<std::pair<std::string, std::string>> settings = {};
  const char* function = "";
  const char* by_name = "";  ///< in the bindings, as "uShininess = n"
};

/// blinn_phong_heightfield of N, V, L, n.
constexpr char kGlslBody[] =
    "{ vec3 H = normalize(L + V); return (n + 2.0) / 25.1327412 * pow(max(dot(N, H), 0.0), n) * "
    "max(dot(N, L), 0.0); }\n";
std::string glsl(const std::string& before, const std::string& head,
                 const std::string& body = kGlslBody, const std::string& behind = "") {
  return before + head + body + behind;
}
std::string hlsl(const std::string& before, const std::string& head,
                 const std::string& behind = "") {
  std::string text = glsl(before, head, kGlslBody, behind);
  for (std::size_t at; (at = text.find("vec3")) != text.npos;) text.replace(at, 4, "float3");
  return text;
}
constexpr char kHead[] = "float f(vec3 N, vec3 V, vec3 L, float n)\n";

std::vector<Written> glsl_shaders() {
  const std::string f = std::string(kHead) + kGlslBody;
  return {
      {"no more than a function", f},
      {"another order, by names",
       glsl("", "float f(vec3 lightDir, vec3 viewDir, vec3 normal, float shininess)\n",
            "{ vec3 L = lightDir, V = viewDir, N = normal; float n = shininess; " +
                std::string(kGlslBody).substr(1))},
      {"a uniform exponent",
       glsl("uniform float uShininess;\n", "float f(vec3 N, vec3 V, vec3 L)\n",
            "{ float n = uShininess; " + std::string(kGlslBody).substr(1)),
       {},
       "",
       "uShininess = n"},
      {"a colour that is set",
       "uniform vec3 lightColor;\n" + f +
           "vec3 g(vec3 N, vec3 V, vec3 L, float n) { return lightColor * f(N, V, L, n); }\n",
       {{"lightColor", "1"}}},
      {"a block without a name",
       glsl("layout(std140) uniform Material { vec4 color; float shininess; };\n",
            "float f(vec3 N, vec3 V, vec3 L)\n",
            "{ float n = shininess; " + std::string(kGlslBody).substr(1)),
       {},
       "",
       "shininess = n"},
      {"a block with a name",
       glsl("layout(std140, binding = 0) uniform Material { vec4 color; float shininess; } m[2];\n",
            "float f(vec3 N, vec3 V, vec3 L)\n",
            "{ float n = m[1].shininess * m[1].color.x; " + std::string(kGlslBody).substr(1)),
       {{"m[1].shininess", "n"}, {"m[1].color", "1,0,0,0"}}},
      {"structures as uniforms",
       "struct Light { vec3 position; vec3 color; }; struct Material { float shininess; vec3 kd; };\n"
       "uniform Light light; uniform Material mat;\n" +
           f + "float g(vec3 N, vec3 V) { return f(N, V, light.position, mat.shininess); }\n",
       {},
       "",
       "light.position = L"},
      {"a structure as a parameter",
       "struct Surface { vec3 normal; vec2 uv; float shininess; };\n" + f +
           "float g(Surface s, vec3 viewDir, vec3 lightDir) { return f(s.normal, viewDir, lightDir, "
           "s.shininess); }\n",
       {},
       "g",
       "s.normal = N"},
      {"an out parameter",
       f + "void g(vec3 N, vec3 V, vec3 L, float n, out vec3 diffuse, out vec3 specular) { diffuse = "
           "vec3(2.0); specular = vec3(f(N, V, L, n)); }\n",
       {},
       "",
       "specular = the result"},
      {"a structure as a result",
       "struct Shade { vec3 diffuse; vec3 specular; };\n" + f +
           "Shade g(vec3 N, vec3 V, vec3 L, float n) { return Shade(vec3(9.0), vec3(f(N, V, L, n))); }\n",
       {},
       "",
       "specular = the result"},
      {"a whole shader of WebGL 1",
       "#extension GL_OES_standard_derivatives : enable\n#ifdef GL_ES\nprecision mediump float;\n#endif\n"
       "varying vec3 vNormal; varying vec3 vPos; varying vec2 vUv;\nuniform vec3 uLightPos, uEyePos; "
       "uniform float uShininess; uniform sampler2D uMap;\n" +
           f +
           "void main() { vec3 N = normalize(vNormal), V = normalize(uEyePos - vPos), L = "
           "normalize(uLightPos - vPos);\n gl_FragColor = vec4(texture2D(uMap, vUv).rgb * f(N, V, L, "
           "uShininess), 1.0); }\n",
       {{"uMap", "1"}},
       "",
       "vPos = position"},
      {"version 100",
       "#version 100\nprecision mediump float;\nvarying vec3 n_;\nuniform vec3 light, eye;\n" + f +
           "void main() { gl_FragColor = vec4(vec3(f(n_, eye, light, 16.0)), 1.0); }\n",
       {{"n_", "N"}},
       "f",
       ""},
      {"a whole shader of version 330",
       "#version 330 core\nin VS_OUT { vec3 FragPos; vec3 Normal; vec2 uv; } fs_in;\nlayout(location = "
       "0) out vec4 FragColor; out vec4 bright;\nuniform vec3 viewPos; uniform vec3 lightPos; uniform "
       "float shininess = 32.0;\n" +
           f +
           "void main() { bright = vec4(7.0); FragColor = vec4(f(fs_in.Normal, normalize(viewPos - "
           "fs_in.FragPos), normalize(lightPos - fs_in.FragPos), shininess)); }\n",
       {},
       "main",
       "fs_in.Normal = N"},
      {"an initialiser that reads a uniform",
       "uniform vec3 lightDir; vec3 gL = normalize(lightDir);\n" + f +
           "float g(vec3 N, vec3 V, float n) { return f(N, V, gL, n); }\n",
       {},
       "",
       "lightDir = L"},
      {"names and macros of short letters",
       "#define k 4.0\n#define i 2\n#define t 3\n#define result 7\n" + f},
      {"an array that is set",
       "uniform float a[3];\n" + f +
           "float g(vec3 N, vec3 V, vec3 L, float n) { return a[2] * f(N, V, L, n); }\n",
       {{"a[2]", "1"}}},
      {"a matrix that is set",
       "uniform mat3 normalMatrix;\n" + f +
           "float g(vec3 N, vec3 V, vec3 L, float n) { return f(normalMatrix * N, V, L, n); }\n",
       {{"normalMatrix", "1"}}},
      {"textures as parameters",
       "uniform sampler2D a;\nvec4 get(sampler2D s, vec2 p) { return texture(s, p); }\n" + f +
           "float g(vec3 N, vec3 V, vec3 L, float n) { return get(a, vec2(0)).r * f(N, V, L, n); }\n",
       {{"a", "1,0,0,0"}}},
      {"unread variables of every kind",
       "uniform sampler2D a; uniform samplerCube b; uniform mat4 m; in vec4 c; uniform ivec2 d; uniform "
       "bool e;\nvec4 no() { return texture(a, vec2(0)) + textureLod(b, vec3(0), 1.0) + m * c + (e ? "
       "vec4(d, 0, 0) : vec4(0)); }\n" +
           f,
       {},
       "f"},
  };
}

std::vector<Written> hlsl_shaders() {
  const std::string f = hlsl("", kHead);
  return {
      {"global variables",
       hlsl("float3 SpecColor;\nuniform float shininess : register(c1);\n", kHead) +
           "float3 g(float3 N, float3 V, float3 L) { return SpecColor * f(N, V, L, shininess); }\n",
       {{"SpecColor", "1,1,1"}},
       "",
       "shininess = n"},
      {"constant buffers",
       "cbuffer M : register(b0) { float3 SpecColor : packoffset(c0); row_major float4x4 W; };\ncbuffer "
       "P { float gloss, power; }\n" +
           f + "float3 g(float3 N, float3 V, float3 L) { return SpecColor * f(N, V, L, power); }\n",
       {{"SpecColor", "1"}},
       "",
       "power = n"},
      {"a ConstantBuffer and a StructuredBuffer",
       "struct M { float3 c; float n; }; struct Light { float3 dir; };\nStructuredBuffer<Light> lights : "
       "register(t0);\nM m;\n" +
           f + "float3 g(float3 N, float3 V) { return m.c * f(N, V, lights[0].dir, m.n); }\n",
       {{"lights[0].dir", "L"}, {"m.c", "1"}},
       "",
       "m.n = n"},
      {"a pixel shader with a structure",
       "struct VSOut { float4 pos : SV_Position; float3 normal : NORMAL; float2 uv : TEXCOORD0; };\nfloat3 "
       "lightDir, viewDir; float shininess;\nTexture2D<float4> map : register(t0); SamplerState s : "
       "register(s0);\n" +
           f +
           "float4 PSMain(VSOut i) : SV_Target { return map.Sample(s, i.uv) * f(i.normal, viewDir, "
           "lightDir, shininess); }\n",
       {{"map", "1"}},
       "",
       "i.normal = N"},
      {"a main that is not asked for",
       f + "float4 main(float4 p : SV_Position) : SV_Target { return f(p.xyz, p.xyz, p.xyz, 3); }\n",
       {},
       "f"},
      {"a default", hlsl("", "float f(vec3 N, vec3 V, vec3 L, float n, float scale = 1)\n")},
      {"an effect of Direct3D 9",
       "float shininess < string UIName = \"n; m\"; > = 30;\ntexture t; sampler2D s = sampler_state { "
       "Texture = <t>; MipFilter = LINEAR; };\n" +
           f +
           "float4 g(float3 N : TEXCOORD0, float3 V : TEXCOORD1, float3 L : TEXCOORD2) : COLOR { return "
           "tex2D(s, N.xy) * f(N, V, L, shininess); }\ntechnique T { pass P { PixelShader = compile "
           "ps_3_0 g(); } }\n",
       {{"s", "1"}},
       "",
       "shininess = n"},
      {"static variables that read uniforms",
       "float3 _Light; static float3 gL = normalize(_Light);\n" + f +
           "float g(float3 N, float3 V, float n) { return f(N, V, gL, n); }\n",
       {},
       "",
       "_Light = L"},
  };
}

std::vector<Written> wgsl_shaders() {
  const std::string f =
      "fn f(N: vec3f, V: vec3f, L: vec3f, n: f32) -> f32 { let H = normalize(L + V); return (n + 2.0) / "
      "25.1327412 * pow(max(dot(N, H), 0.0), n) * max(dot(N, L), 0.0); }\n";
  return {
      {"a uniform of a structure",
       "struct U { light: vec3f, shininess: f32, color: vec3<f32>, }\n@group(0) @binding(0) "
       "var<uniform> u: U;\n" +
           f +
           "fn g(N: vec3f, V: vec3f) -> vec3f { return u.color * f(N, V, u.light, u.shininess); }\n",
       {{"u.color", "1"}},
       "",
       "u.light = L"},
      {"a fragment shader",
       "struct In { @builtin(position) at: vec4f, @location(0) normal: vec3f, @location(1) uv: vec2f }\n"
       "@group(0) @binding(0) var map: texture_2d<f32>; @group(0) @binding(1) var state: sampler;\n"
       "@group(0) @binding(2) var<storage, read> lights: array<vec3f>;\noverride shininess: f32 = "
       "8;\nvar<private> unread: f32;\n" +
           f +
           "@fragment fn main(i: In, @location(2) viewDir: vec3f) -> @location(0) vec4f { return "
           "textureSample(map, state, i.uv) * f(i.normal, viewDir, lights[0], shininess); }\n",
       {{"map", "1"}, {"lights[0]", "L"}},
       "",
       "i.normal = N"},
      {"a pointer for the result",
       f + "fn g(N: vec3f, V: vec3f, L: vec3f, n: f32, a: ptr<function, vec3f>) -> f32 { *a = N; return "
           "f(N, V, L, n); }\n"},
  };
}

shader_check::Request request_of(const Written& written, ShaderText language, ShaderApi api) {
  shader_check::Request request;
  request.file = "mine";
  request.text = written.text;
  request.language = language;
  request.api = api;
  request.function = written.function;
  request.settings = written.settings;
  request.highlight = {*find_model("blinn_phong_heightfield"), *find_lobe("cosine")};
  request.exponents = {4, 64};
  request.costs = false;
  request.time_limit = std::chrono::hours(1);
  return request;
}

void expect_right(const std::vector<Written>& shaders, ShaderText language, ShaderApi api) {
  for (const Written& written : shaders) try {
      const auto record = shader_check::check_shader(request_of(written, language, api)).record;
      EXPECT_EQ(record.verdict, "passes") << written.what << "\n"
                                          << shader_check::report_text(record);
      std::string bound;
      for (const auto& one : record.bindings) bound += one.name + " = " + one.value + "; ";
      EXPECT_THAT(bound, HasSubstr(written.by_name)) << written.what;
    } catch (const Error& error) {
      ADD_FAILURE() << written.what << ": " << error.what();
    }
}

class ShaderCall : public NeedsShaderRunner {};

TEST_F(ShaderCall, RightShadersOfGlslPassHoweverTheyGetTheirValues) {
  expect_right(glsl_shaders(), ShaderText::kGlsl, ShaderApi::kEgl);
}

TEST_F(ShaderCall, RightShadersOfGlslPassOnVulkan) {
  expect_right(glsl_shaders(), ShaderText::kGlsl, ShaderApi::kVulkan);
}

TEST_F(ShaderCall, RightShadersOfHlslPassHoweverTheyGetTheirValues) {
  expect_right(hlsl_shaders(), ShaderText::kHlsl, ShaderApi::kVulkan);
}

TEST_F(NeedsWebGpu, RightShadersOfWgslPassHoweverTheyGetTheirValues) {
  expect_right(wgsl_shaders(), ShaderText::kWgsl, ShaderApi::kWebGpu);
}

records::ShaderCheck checked(const std::string& text,
                             std::vector<std::pair<std::string, std::string>> settings = {},
                             const char* arguments = "") {
  shader_check::Request request =
      request_of({"", text, std::move(settings)}, ShaderText::kGlsl, ShaderApi::kEgl);
  request.arguments = arguments;
  request.exponents = {4, 64};
  return shader_check::check_shader(request).record;
}

TEST_F(ShaderCall, TriesTheMeaningsOfNamesThatTellNothing) {
  std::vector<std::string> words{"L", "N", "V"};
  do {
    const std::string text = fmt::format(
        "float f(vec3 p0, vec3 p1, vec3 p2, float p3) {{ vec3 {} = p0, {} = p1, {} = p2; float n = "
        "p3; {}",
        words[0], words[1], words[2], std::string(kGlslBody).substr(1));
    const records::ShaderCheck record = checked(text);
    EXPECT_EQ(record.verdict, "passes");
    EXPECT_EQ(record.arguments, fmt::format("{},{},{},n", words[0], words[1], words[2]));
    ASSERT_FALSE(record.bindings.empty());
    EXPECT_EQ(record.bindings[0].by, "trial");
    EXPECT_EQ(record.bindings[0].value, words[0]);
  } while (std::ranges::next_permutation(words).found);
}

TEST_F(ShaderCall, TriesTheRulesOfAGloss) {
  for (const auto& [word, rule] : {std::pair{"n", "gloss"},
                                   {"n/128", "gloss * 128.0"},
                                   {"gloss", "exp2(10.0 * gloss + 1.0)"},
                                   {"smoothness", "2.0 / pow(1.0 - gloss, 4.0) - 2.0"}}) {
    const records::ShaderCheck record =
        checked(fmt::format("float f(vec3 N, vec3 V, vec3 L, float gloss) {{ float n = {}; {}",
                            rule, std::string(kGlslBody).substr(1)));
    EXPECT_EQ(record.verdict, "passes") << word;
    EXPECT_EQ(record.arguments, std::string("N,V,L,") + word);
    EXPECT_EQ(record.bindings.size(), 1u) << "names that tell are not tried";
  }
}

TEST_F(ShaderCall, ADiscardedCallIsAsDarkAsZero) {
  const auto discards = [&](const char* where) {
    return checked(
        fmt::format("{}{{ if ({}) discard; {}", kHead, where, std::string(kGlslBody).substr(1)));
  };
  const records::ShaderCheck right = discards("dot(N, L) <= 0.0");
  EXPECT_EQ(right.verdict, "passes");
  EXPECT_EQ(right.oddities.unwritten, 0u);
  const records::ShaderCheck wrong = discards("dot(N, L) <= 0.5");
  EXPECT_EQ(wrong.verdict, "differs");
  EXPECT_GT(wrong.oddities.unwritten, 0u);
}

TEST_F(ShaderCall, TakesTheOneFunctionOfVectors) {
  const records::ShaderCheck record =
      checked("float square(float x) { return x * x; }\n" + std::string(kHead) + kGlslBody);
  EXPECT_EQ(record.function, "f");
  EXPECT_EQ(record.verdict, "passes");
}

TEST_F(ShaderCall, FindsAMemberOfOneNameWithoutItsVariable) {
  const std::string text =
      "struct In { vec3 a; vec3 b; }; struct Other { vec3 b; }; uniform Other other;\n" +
      std::string(kHead) + kGlslBody +
      "float g(In i, vec3 V, vec3 L, float n) { return f(i.a, V, L, n) * i.b.x * other.b.x; }\n";
  EXPECT_EQ(checked(text, {{"a", "N"}, {"i.b", "1"}, {"other.b", "1"}}).verdict, "passes");
  EXPECT_THROW(checked(text, {{"a", "N"}, {"b", "1"}}), Error) << "two have a b";
}

TEST_F(ShaderCall, FindsTheModelOfAShaderOfWhichNoneIsGiven) {
  shader_check::Request request =
      request_of({"", std::string(kHead) + kGlslBody}, ShaderText::kGlsl, ShaderApi::kEgl);
  request.highlights = shader_check::all_highlights();
  request.highlight = request.highlights.front();
  const auto record = shader_check::check_shader(request).record;
  EXPECT_EQ(record.verdict, "passes");
  EXPECT_TRUE(record.model_found);
  EXPECT_EQ(record.model, "blinn_phong_heightfield");
  EXPECT_EQ(record.lobe, "cosine");
  request.text = std::string(kHead) +
                 "{ vec3 H = normalize(V - L); return (n + 2.0) / 6.28318531 * pow(max(dot(N, H), "
                 "0.0), n) * max(dot(N, -L), 0.0); }\n";
  const auto wrong = shader_check::check_shader(request).record;
  // Which coefficient was meant is open.
  EXPECT_EQ(info(*find_model(wrong.model)).angle, LobeAngle::kHalfVector);
  ASSERT_TRUE(wrong.explanation);
  EXPECT_TRUE(wrong.explanation->complete);
  EXPECT_EQ(wrong.explanation->mistakes.size(), 2u);
  EXPECT_THAT(wrong.explanation->mistakes, testing::Contains("light-reversed"));
  EXPECT_THAT(shader_check::report_text(wrong), HasSubstr("differs from " + wrong.model + ": "));
  request.arguments = "N,V,L,coefficient";
  EXPECT_THROW(shader_check::check_shader(request), Error);
}

std::string refusal_of(const Written& written, ShaderText language = ShaderText::kGlsl,
                       const std::string& arguments = "") {
  shader_check::Request request = request_of(written, language, ShaderApi::kVulkan);
  request.arguments = arguments;
  try {
    shader_check::check_shader(request);
  } catch (const Error& error) {
    return fmt::format("{}: {}", int(error.code()), error.what());
  }
  return "";
}

TEST(ShaderCallWithoutADriver, NamesWhatNothingSetsWithALineToCopy) {
  EXPECT_EQ(
      refusal_of(
          {"",
           "struct M { vec3 kd, ks; }; uniform M m; uniform vec3 lightColor[2]; uniform "
           "sampler2D map; uniform mat3 N_;\nfloat f(vec3 N, vec3 V, vec3 L, float n) { return m.ks.x * "
           "lightColor[0].x * texture(map, vec2(0)).x * (N_ * N).x; }\n"}),
      "2: mine: f reads what nothing sets: vec3 m.ks, vec3 lightColor[0], sampler2D map, mat3 N_; set "
      "them, as in --set m.ks=1,1,1 --set 'lightColor[0]=1,1,1' --set map=1,1,1,1 --set N_=1");
  EXPECT_THAT(refusal_of({"",
                          "layout(rgba32f) uniform image2D a; float f() { return imageLoad(a, "
                          "ivec2(0)).x; }"}),
              HasSubstr("image2D a; such variables cannot be set"));
}

TEST(ShaderCallWithoutADriver, RefusesInOneLine) {
  const std::string f = std::string(kHead) + kGlslBody;
  EXPECT_EQ(refusal_of({"", "\nfloat f(vec3 N, float n)\n{\n  if (n > 1.0) {\n  return 1.0;\n}\n"}),
            "3: mine:3: syntax error: '{' is never closed");
  EXPECT_EQ(refusal_of({"", "\nfloat f(vec3 N, float n\n{ return 1.0; }\n"}),
            "3: mine:2: syntax error: '(' is never closed");
  EXPECT_EQ(refusal_of({"", f + "float g(vec3 x, float y) { return x.z * y; }\n"}),
            "2: mine: --function has to say which one is meant: f, g");
  EXPECT_EQ(refusal_of({"", "uniform float a;\n", {}, "f"}), "3: mine: has no function");
  EXPECT_EQ(refusal_of({"", f, {}, "g"}),
            "3: mine: has no function 'g'; it has f; did you mean 'f'?");
  EXPECT_EQ(refusal_of({"", f, {{"m", "1"}}}),
            "2: mine: --set m: there is no such variable; it has N, V, L, n; did you mean 'N'?");
  EXPECT_EQ(refusal_of({"", f, {{"N", "1,2"}}}), "2: mine: --set N: '1,2' does not fit a vec3");
  EXPECT_THAT(refusal_of({"", f, {{"N", "1,x"}}}),
              HasSubstr("2: --set N: 'x' is unknown; allowed: N, V"));
  EXPECT_THAT(refusal_of({"", f, {{"N..", "1"}}}), HasSubstr("--set N..: a name is expected"));
  EXPECT_EQ(refusal_of({"", f, {}, ""}, ShaderText::kGlsl, "N,V,L,N"),
            "2: mine: --arguments: 'N' has 3 components, which does not fit float n");
  EXPECT_EQ(refusal_of({"", "const float k = 1.0;\n" + f, {{"k", "1"}}}),
            "2: mine: --set k: it is a constant");
  EXPECT_EQ(
      refusal_of({"", "float f(vec3 N) { return dFdx(N.x); }"}),
      "3: mine: f calls dFdx, which compares neighbouring pixels; the points of a check have no "
      "neighbours");
  EXPECT_EQ(refusal_of({"", "vec2 f(vec3 N) { return N.xy; }"}),
            "2: mine: f gives a vec2; a number, a vector of 3 or 4, or a structure with one can be "
            "compared");
  EXPECT_THAT(refusal_of({"", "void f(vec3 N) { }"}),
              HasSubstr("f gives nothing that can be compared"));
}

}  // namespace
}  // namespace lobelia

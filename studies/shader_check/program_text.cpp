#include "studies/shader_check/program_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "renderer/export/names.hpp"
#include "studies/shader_check/declarations.hpp"
#include "studies/shader_check/runner_protocol.hpp"

namespace lobelia {
namespace {

/// A fragment shader of ES has an int of 16 bits otherwise, which is too short for the number of a point.
constexpr char kOwnPrecision[] =
    "#undef main\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n";

constexpr std::string_view kAsFour = R"(
%vec4% lobelia_as_four(float lobelia_v) { return %vec4%(lobelia_v, lobelia_v, lobelia_v, 1.0); }
%vec4% lobelia_as_four(%vec3% lobelia_v) { return %vec4%(lobelia_v, 1.0); }
%vec4% lobelia_as_four(%vec4% lobelia_v) { return %vec4%(lobelia_v.xyz, 1.0); }
)";

constexpr std::string_view kFragmentMain = R"(
uniform highp sampler2D lobelia_points;
out highp vec4 lobelia_result;
void main()
{
    int lobelia_i = int(gl_FragCoord.y) * %width% + int(gl_FragCoord.x);
    int lobelia_k = lobelia_i / %points%;
    int lobelia_t = (lobelia_i - lobelia_k * %points%) * %texels%;
    vec4 lobelia_value = vec4(0.0);
%fetches%%calls%    lobelia_result = lobelia_value;
}
)";

constexpr std::string_view kGlslComputeMain = R"(
layout(local_size_x = %group%) in;
struct LobeliaPoint { vec4 texels[%texels%]; };
layout(std430, set = 0, binding = 0) readonly buffer LobeliaPoints { LobeliaPoint lobelia_points[]; };
layout(std430, set = 0, binding = 1) writeonly buffer LobeliaResults { vec4 lobelia_results[]; };
void main()
{
    int lobelia_i = int(gl_GlobalInvocationID.y) * %row% + int(gl_GlobalInvocationID.x);
    int lobelia_k = lobelia_i / %points%;
    if (lobelia_k < %outputs%) {
        int lobelia_t = lobelia_i - lobelia_k * %points%;
        vec4 lobelia_value = vec4(0.0);
%fetches%%calls%        lobelia_results[lobelia_i] = lobelia_value;
    }
}
)";

constexpr std::string_view kHlslMain = R"(
struct LobeliaPoint { float4 texels[%texels%]; };
[[vk::binding(0, 0)]] StructuredBuffer<LobeliaPoint> lobelia_points;
[[vk::binding(1, 0)]] RWStructuredBuffer<float4> lobelia_results;
[numthreads(%group%, 1, 1)] void lobelia_main(uint3 lobelia_id : SV_DispatchThreadID)
{
    int lobelia_i = int(lobelia_id.y) * %row% + int(lobelia_id.x);
    int lobelia_k = lobelia_i / %points%;
    if (lobelia_k < %outputs%) {
        int lobelia_t = lobelia_i - lobelia_k * %points%;
        float4 lobelia_value = float4(0.0, 0.0, 0.0, 0.0);
%fetches%%calls%        lobelia_results[lobelia_i] = lobelia_value;
    }
}
)";

constexpr std::string_view kWgslMain = R"(
@group(0) @binding(0) var<storage, read> lobelia_points: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> lobelia_results: array<vec4f>;
@compute @workgroup_size(%group%)
fn lobelia_main(@builtin(global_invocation_id) lobelia_id: vec3u)
{
    let lobelia_i = i32(lobelia_id.y) * %row% + i32(lobelia_id.x);
    let lobelia_k = lobelia_i / %points%;
    if (lobelia_k >= %outputs%) { return; }
    let lobelia_t = (lobelia_i - lobelia_k * %points%) * %texels%;
    var lobelia_value = vec4f(0.0);
%fetches%%calls%    lobelia_results[lobelia_i] = lobelia_value;
}
)";

std::size_t count_lines(std::string_view text) {
  return std::size_t(std::ranges::count(text, '\n'));
}

[[noreturn]] void refuse_line(const ShaderSource& source, std::string_view text, std::size_t at,
                              std::string_view why) {
  throw Error(ExitCode::kInput, "{}:{}: {}", source.name, 1 + count_lines(text.substr(0, at)), why);
}

/// A byte order mark belongs to the file, not to the shader.
std::string_view without_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

/// With '\n' as the only line end. `joins`: a line that ends with '\\' goes on in the next one, and the line ends that are
/// missing follow behind, so that the lines after keep their numbers.
std::string joined_lines(std::string_view text, bool joins) {
  std::string lines;
  std::size_t missing = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool is_end = text[at] == '\n' || text[at] == '\r';
    if (text.substr(at, 2) == "\r\n") ++at;
    if (!is_end) {
      lines += text[at];
    } else if (joins && lines.ends_with('\\')) {
      lines.pop_back();
      ++missing;
    } else {
      lines.append(1 + missing, '\n');
      missing = 0;
    }
  }
  lines.append(missing, '\n');
  return lines;
}

/// The place of the first line break from `at` on; the text's end if there is none. WGSL has more of them (3.1, "Blankspace
/// and Line Breaks"): VT, FF, U+0085, U+2028, U+2029.
std::size_t end_of_line(std::string_view text, std::size_t at, bool is_wgsl) {
  std::size_t end = std::min(text.find('\n', at), text.size());
  if (is_wgsl)
    for (const std::string_view line_break :
         {"\v", "\f", "\xc2\x85", "\xe2\x80\xa8", "\xe2\x80\xa9"})
      end = std::min(text.substr(0, end).find(line_break, at), end);
  return end;
}

/// The place behind the string of HLSL that begins at `at`, as glslang sees it: no escapes, and none beyond the line. A
/// character's quotation mark begins none.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  if (text.substr(at, 3) == "'\"'") return at + 3;
  if (text[at] != '"') return at;
  const std::size_t end = text.find_first_of("\"\n", at + 1);
  return end == text.npos ? text.size() : end + (text[end] == '"' ? 1 : 0);
}

/// The place behind the comment that begins at `at`; npos if it does not end. Those of WGSL may hold others.
std::size_t end_of_comment(std::string_view text, std::size_t at, bool is_wgsl) {
  if (text.substr(at, 2) == "//") return end_of_line(text, at, is_wgsl);
  std::size_t open = 0;
  while (at < text.size()) {
    const std::string_view two = text.substr(at, 2);
    if (two == "/*" && (is_wgsl || open == 0)) {
      ++open;
      at += 2;
    } else if (two == "*/") {
      at += 2;
      if (--open == 0) return at;
    } else {
      ++at;
    }
  }
  return text.npos;
}

/// A blank in place of each comment. The line ends in it stay where they are, but for a directive, which they would end:
/// they follow behind it.
std::string without_comments(const ShaderSource& source, std::string_view text) {
  std::string plain;
  std::size_t missing = 0;
  char first = 0;  // of the line, but for blanks
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view two = text.substr(at, 2);
    if (two == "//" || two == "/*") {
      const std::size_t end = end_of_comment(text, at, source.language == ShaderText::kWgsl);
      if (end == text.npos) refuse_line(source, text, at, "this comment does not end");
      const std::size_t inside = count_lines(text.substr(at, end - at));
      at = end;
      plain += ' ';
      if (first == '#') {
        missing += inside;
      } else if (inside > 0) {
        plain.append(inside, '\n');
        first = 0;
      }
      continue;
    }
    if (source.language == ShaderText::kHlsl)
      if (const std::size_t end = end_of_string(text, at); end > at) {
        plain += text.substr(at, end - at);
        if (first == 0) first = text[at];
        at = end;
        continue;
      }
    const char c = text[at++];
    plain += c;
    if (c == '\n') {
      plain.append(missing, '\n');
      missing = 0;
      first = 0;
    } else if (first == 0 && c > ' ') {
      first = c;
    }
  }
  return plain;
}

/// An included file would be any that the user may read, or one that never ends.
void refuse_includes(const ShaderSource& source, std::string_view plain) {
  // Also where no directive can begin: a compiler may take for a comment what we take for a string.
  for (std::size_t at = 0; (at = plain.find('#', at)) != plain.npos; ++at) {
    const std::size_t word = plain.find_first_not_of(" \t\v\f", at + 1);
    if (word == plain.npos) break;
    const std::string_view rest = plain.substr(word);
    if (rest.starts_with("include") && (rest.size() == 7 || !is_word_character(rest[7])))
      refuse_line(source, plain, at,
                  "#include is not allowed; a shader is one file, so put the text in its place");
  }
}

/// The text without its #version and its #extension lines, which have to come first, and those that a driver needs for it.
struct Version {
  std::string lines, rest;
  std::size_t at = 0;          ///< the line of the text that had the version; 0: none
  std::string directive = {};  ///< as the text has it
};
Version take_version(const std::string& text, ShaderApi api) {
  Version version;
  std::vector<TextEdit> edits;
  std::string extensions;
  long long number = 0;
  bool is_es = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::size_t first = std::min(text.find_first_not_of(" \t\v\f", at), end);
    const auto tokens =
        first < end && text[first] == '#' ? plain_tokens(text, first, end) : std::vector<Token>();
    if (tokens.size() >= 3 && tokens[1] == "version" && version.at == 0 &&
        parse_integer(tokens[2].text, number)) {
      is_es = (tokens.size() > 3 && tokens[3] == "es") || number == 100;
      version.directive = text.substr(at, end - at);
      version.at = 1 + count_lines(text.substr(0, at));
      edits.push_back({at, end});
    } else if (tokens.size() >= 5 && tokens[1] == "extension") {
      // Those that a newer version has in itself cannot be required.
      if (!(tokens[4] == "disable"))
        extensions += fmt::format("#extension {} : enable\n", tokens[2].text);
      edits.push_back({at, end});
    }
    at = end + 1;
  }
  number = std::clamp(number, is_es ? 300LL : 330LL, 999LL);
  version.lines =
      (api == ShaderApi::kVulkan ? "#version 450\n"
                                 : fmt::format("#version {}{}\n", number, is_es ? " es" : "")) +
      extensions;
  if (is_es && api != ShaderApi::kVulkan) version.lines += "precision highp float;\n";
  version.rest = edited(text, std::move(edits));
  return version;
}

}  // namespace

std::string_view vector_type(ShaderText language) {
  constexpr std::string_view kNames[] = {"vec3", "float3", "vec3f"};
  return kNames[std::size_t(language)];
}

std::string shader_component(std::size_t i) {
  return fmt::format("lobelia_p{}.{}", i / 4, "xyzw"[i % 4]);
}

std::string plain_text(const ShaderSource& source) {
  const std::string_view text = without_mark(source.text);
  if (text.find('\0') != text.npos)
    throw Error(ExitCode::kInput, "{}: it has zero bytes, as UTF-16 has; save it as UTF-8",
                source.name);
  std::string plain =
      without_comments(source, joined_lines(text, source.language != ShaderText::kWgsl));
  refuse_includes(source, plain);
  return plain;
}

ShaderProgram program_text(const ShaderSource& source, ShaderApi api, std::size_t points,
                           std::size_t components) {
  const bool is_hlsl = source.language == ShaderText::kHlsl,
             is_wgsl = source.language == ShaderText::kWgsl;
  const std::size_t texels = texels_of_point(components);
  std::string fetches, calls = source.setup;
  for (std::size_t t = 0; t < texels; ++t)
    fetches +=
        is_wgsl ? fmt::format("    var lobelia_p{0} = lobelia_points[lobelia_t + {0}];\n", t)
        : api == ShaderApi::kEgl
            ? fmt::format(
                  "    vec4 lobelia_p{0} = texelFetch(lobelia_points, ivec2((lobelia_t + "
                  "{0}) % {1}, (lobelia_t + {0}) / {1}), 0);\n",
                  t, kRunnerWidth)
            : fmt::format("        {1} lobelia_p{0} = lobelia_points[lobelia_t].texels[{0}];\n", t,
                          is_hlsl ? "float4" : "vec4");
  for (std::size_t k = 0; k < source.calls.size(); ++k) {
    // WGSL has no overloads, but vec3f() of a number and of a vector.
    const std::string value = is_wgsl ? fmt::format("vec4f(vec3f({}), 1.0)", source.calls[k])
                                      : fmt::format("lobelia_as_four({})", source.calls[k]);
    calls +=
        fmt::format("    {}{{ lobelia_value = {}; }}\n",
                    source.calls.size() > 1 ? fmt::format("if (lobelia_k == {}) ", k) : "", value);
  }
  std::string begin, text = plain_text(source);
  std::size_t version_line = 0;
  if (is_wgsl) {
    // WGSL has no directives, and ends lines at characters that plain_text() does not know.
    text = without_mark(source.text);
  } else if (!is_hlsl) {
    Version version = take_version(text, api);
    begin = version.lines;
    text = std::move(version.rest);
    version_line = version.at;
  }
  if (!is_wgsl && text.find("main") != text.npos) begin += "#define main lobelia_main_of_file\n";
  if (!is_wgsl) begin += source.prelude;
  ShaderProgram program{source.name, "", count_lines(begin), 0, version_line, source.is_own};
  if (text.empty() || text.back() != '\n') text += '\n';
  program.lines = count_lines(text);
  const std::string_view main = is_wgsl                  ? kWgslMain
                                : is_hlsl                ? kHlslMain
                                : api == ShaderApi::kEgl ? kFragmentMain
                                                         : kGlslComputeMain;
  program.bytes = begin + text +
                  (is_wgsl   ? source.prelude
                   : is_hlsl ? ""
                             : kOwnPrecision) +
                  fill((is_wgsl ? "" : std::string(kAsFour)) + std::string(main),
                       {{"vec4", is_hlsl ? "float4" : "vec4"},
                        {"vec3", is_hlsl ? "float3" : "vec3"},
                        {"width", std::to_string(kRunnerWidth)},
                        {"group", std::to_string(kGroupSize)},
                        {"row", std::to_string(kGroupSize * kGroupsInRow)},
                        {"points", std::to_string(points)},
                        {"outputs", std::to_string(source.calls.size())},
                        {"texels", std::to_string(texels)},
                        {"fetches", fetches},
                        {"calls", calls}});
  return program;
}

std::string version_directive(const ShaderSource& source) {
  return source.language == ShaderText::kGlsl
             ? take_version(plain_text(source), ShaderApi::kEgl).directive
             : "";
}

std::string words_for(const ShaderProgram& program) {
  return program.is_own ? "Lobelia's own shader" : program.name + ": the shader";
}

Error refusal(const std::string& log, const ShaderProgram& program) {
  // Mesa: "0:12(5): error: WORDS"; NVIDIA: "0(12) : error C1: WORDS"; glslang: "ERROR: FILE:12: WORDS".
  static const std::regex mesa("^[0-9]+:([0-9]+)\\([0-9]+\\): error: (.*)$"),
      nvidia("^[0-9]+\\(([0-9]+)\\) : error (.*)$"), glslang("^ERROR: (?:.*:)?([0-9]+): (.*)$");
  for (std::string line : split(log, "\n")) {
    constexpr std::size_t kLongest = 500;  // std::regex takes stack for each character
    line.resize(std::min(line.size(), kLongest));
    std::smatch found;
    if (!std::regex_match(line, found, mesa) && !std::regex_match(line, found, nvidia) &&
        !std::regex_match(line, found, glslang))
      continue;
    const std::size_t at = std::stoul(found[1].str().substr(0, 9));
    const std::string words = printable(found[2].str(), 200);
    if (at > 0 && at <= program.first_line && program.version_line > 0)
      return {ExitCode::kInput, "{}:{}: {}", program.name, program.version_line, words};
    if (program.is_own)
      return {ExitCode::kEngine, "Lobelia's own shader does not compile on this driver: {}", words};
    if (at > program.first_line && at <= program.first_line + program.lines)
      return {ExitCode::kInput, "{}:{}: {}", program.name, at - program.first_line, words};
    return {ExitCode::kInput, "{}: the call of the function does not compile: {}", program.name,
            words};
  }
  return {program.is_own ? ExitCode::kEngine : ExitCode::kInput, "{}: the compiler refuses it: {}",
          program.is_own ? "Lobelia's own shader" : program.name,
          printable(log.empty() ? "no reason given" : log, 200)};
}

}  // namespace lobelia

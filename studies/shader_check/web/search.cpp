// The search for mistakes as WebAssembly, for the explorer's page: points out, values in, a verdict out. A page calls
//
//   lobelia_text(bytes)       room for UTF-8 that it writes
//   lobelia_begin(n)          with the text "model\nlobe\nnormalisation\nlanguage\nfunction\narguments\nsettings\nSOURCE",
//                             where settings are "shininess=n;light=1,1,1"; and the exponent of arc and spheres. Returns
//                             the number of points. Function and arguments are found if they are empty.
//   lobelia_texels()          of each point, four floats each
//   lobelia_points()          all texels, to a whole row of kRunnerWidth; their number is lobelia_floats() / 4
//   lobelia_function()        "highlight(N,V,L,n)", as they were given or found
//   lobelia_program()         the text of a fragment shader for WebGL 2, or of a compute shader of WGSL
//   lobelia_first_line()      lines in it before the source
//   lobelia_values()          room for four floats a point: red, green, blue, 1 if written
//   lobelia_judge()           a text, as write_findings() has it
//
// and for other points than those of a check
//
//   lobelia_vectors(count)    room for N, V, L and the exponent of so many, ten doubles each
//   lobelia_take()            makes them the points. Returns their number.
//
// Whatever throws ends in a trap; lobelia_reason() then has the message, and the page makes a new instance.
#include <fmt/format.h>

#include <iterator>
#include <optional>
#include <typeinfo>

#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "studies/shader_check/judge.hpp"
#include "studies/shader_check/program_text.hpp"
#include "studies/shader_check/runner_protocol.hpp"
#include "studies/shader_check/shader_call.hpp"

namespace lobelia::shader_check {
namespace {

/// With a result as bits, which every WebGL 2 can read back.
void give_bits(std::string& program) {
  constexpr std::string_view kType = "out highp vec4 lobelia_result", kGives = "lobelia_result = ";
  const std::size_t type = program.rfind(kType), gives = program.rfind(kGives),
                    end = program.find(';', gives);
  if (type == program.npos || gives == program.npos || end == program.npos)
    throw Error(ExitCode::kInternal, "the program gives no result");
  program.insert(end, ")").insert(gives + kGives.size(), "floatBitsToUint(");
  program.replace(type, kType.size(), "out highp uvec4 lobelia_result");
}

struct Session {
  Highlight highlight;
  ShaderCall call;
  Arguments arguments;
  std::string function;
  Plan plan;
  ShaderProgram program;
  std::size_t texels = 0;
  std::vector<float> points;  ///< as texels
  std::vector<ShaderValue> values;
  std::vector<float> written;  ///< by the page
  std::vector<double> vectors;

  void use_points() {
    const ShaderPoints all = arguments.of(plan.points);
    texels = texels_of_point(all.components);
    points.assign(
        (plan.points.size() * texels + kRunnerWidth - 1) / kRunnerWidth * kRunnerWidth * 4, 0);
    for (std::size_t i = 0; i < all.count(); ++i)
      std::copy_n(&all.values[i * all.components], all.components, &points[i * 4 * texels]);
    written.assign(4 * plan.points.size(), 0);
    const bool is_wgsl = call.source.language == ShaderText::kWgsl;
    program = program_text(call.source, is_wgsl ? ShaderApi::kWebGpu : ShaderApi::kEgl, all.count(),
                           all.components);
    if (is_wgsl) return;
    // Whatever version it asks for: WebGL 2 has this one.
    constexpr std::string_view kHead =
        "#version 300 es\nprecision highp float;\nprecision highp int;\n";
    program.bytes.replace(0, program.bytes.find('\n') + 1, kHead);
    program.first_line += 2;
    give_bits(program.bytes);
  }
};
std::string text, reason;
std::optional<Session> session;

/// The verdict; the sentence; the mistakes' names; "complete" or "incomplete"; what is left of the peak; counts of odd
/// calls; then a line of numbers for each exponent. Each in a line, numbers with a blank between them.
std::string findings_text(const records::ShaderCheck& record) {
  const records::ShaderExplanation none;
  const records::ShaderExplanation& why = record.explanation ? *record.explanation : none;
  const records::ShaderOddities& odd = record.oddities;
  std::string all = fmt::format("{}\n{}\n{}\n{}\n{}\n{} {} {} {} {} {} {} {} {}\n", record.verdict,
                                why.sentence, fmt::join(why.mistakes, " "),
                                why.complete ? "complete" : "incomplete", why.left_of_peak,
                                odd.calls, odd.nan, odd.infinite, odd.negative, odd.outside_support,
                                odd.unwritten, odd.coloured, odd.hard_calls, odd.hard_nonfinite);
  for (const records::ShaderError& error : record.errors)
    all += fmt::format("{} {} {} {} {} {} {} {}\n", error.exponent, error.max_of_peak,
                       error.allowed_of_peak, error.place.n_dot_l, error.place.n_dot_v,
                       error.place.lobe_degrees, error.place.value, error.place.expected);
  return all;
}

template <std::size_t kCount>
std::size_t index_of(const std::string_view (&names)[kCount], const std::string& name) {
  const auto at = std::ranges::find(names, name);
  if (at == std::end(names)) throw Error(ExitCode::kUsage, "'{}' is unknown", printable(name));
  return std::size_t(at - std::begin(names));
}

/// From "shininess=n;light=1,1,1".
std::vector<std::pair<std::string, std::string>> settings_in(const std::string& words) {
  std::vector<std::pair<std::string, std::string>> settings;
  for (const std::string& word : split(words, ";")) {
    const std::size_t at = word.find('=');
    if (word.empty()) continue;
    if (at == word.npos)
      throw Error(ExitCode::kUsage, "'{}': NAME=VALUE is expected", printable(word));
    settings.emplace_back(word.substr(0, at), word.substr(at + 1));
  }
  return settings;
}

}  // namespace

#ifdef __wasm__
#define LOBELIA_EXPORT(name) extern "C" __attribute__((export_name("lobelia_" #name)))
#else
#define LOBELIA_EXPORT(name) extern "C"
#endif

LOBELIA_EXPORT(text) char* search_text(std::size_t bytes) {
  text.assign(bytes, ' ');
  return text.data();
}

LOBELIA_EXPORT(begin) std::size_t search_begin(double shown_exponent) {
  std::vector<std::string> lines;
  std::string rest = text;
  for (int i = 0; i < 7; ++i) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    lines.push_back(rest.substr(0, end));
    rest.erase(0, end + 1);
  }
  const auto model = find_model(lines[0]);
  const auto lobe = find_lobe(lines[1]);
  const auto normalisation = find_normalisation(lines[2]);
  if (!model || !lobe || !normalisation) throw Error(ExitCode::kUsage, "no such highlight");
  Request request;
  request.file = "your shader";
  request.text = rest;
  request.language = ShaderText(index_of(kShaderTextNames, lines[3]));
  if (request.language == ShaderText::kWgsl) request.api = ShaderApi::kWebGpu;
  request.function = lines[4];
  request.arguments = lines[5];
  request.settings = settings_in(lines[6]);
  request.highlight = {*model, *lobe, *normalisation};
  ShaderCalls calls = shader_calls(request, 1);
  ShaderCall& call = calls.calls.front();
  const std::string function = fmt::format("{}({})", call.function, call.list);
  const std::vector<double> exponents(std::begin(kUsualExponents), std::end(kUsualExponents));
  session.emplace(Session{request.highlight,
                          std::move(call),
                          std::move(calls.arguments),
                          function,
                          judged_plan(request.highlight, exponents, shown_exponent),
                          {},
                          0,
                          {},
                          {},
                          {},
                          {}});
  session->use_points();
  return session->plan.points.size();
}

LOBELIA_EXPORT(texels) std::size_t search_texels() { return session->texels; }
LOBELIA_EXPORT(points) const float* search_points() { return session->points.data(); }
LOBELIA_EXPORT(floats) std::size_t search_floats() { return session->points.size(); }
LOBELIA_EXPORT(function) const char* search_function() { return session->function.c_str(); }
LOBELIA_EXPORT(program) const char* search_program() { return session->program.bytes.c_str(); }
LOBELIA_EXPORT(first_line) std::size_t search_first_line() { return session->program.first_line; }
LOBELIA_EXPORT(values) float* search_values() { return session->written.data(); }

LOBELIA_EXPORT(judge) const char* search_judge() {
  session->values.clear();
  for (std::size_t i = 0; i < session->plan.points.size(); ++i) {
    const float* at = &session->written[4 * i];
    session->values.push_back({at[0], at[1], at[2], at[3] == 1});
  }
  records::ShaderCheck record;
  Judge judge(session->highlight, session->plan, session->values);
  judge.judge(record);
  if (record.verdict != records::kShaderVerdicts[0])
    record.explanation = judge.explanation(record.oddities, session->call.of_roughness);
  text = findings_text(record);
  return text.c_str();
}

LOBELIA_EXPORT(vectors) double* search_vectors(std::size_t count) {
  session->vectors.assign(10 * count, 0);
  return session->vectors.data();
}

LOBELIA_EXPORT(take) std::size_t search_take() {
  std::vector<Point> points;
  const auto rounded = [](const double* at) {
    return Vec3{float(at[0]), float(at[1]), float(at[2])};
  };
  for (std::size_t i = 0; i + 10 <= session->vectors.size(); i += 10) {
    const double* v = &session->vectors[i];
    points.push_back({rounded(v), rounded(v + 3), rounded(v + 6), double(float(v[9]))});
  }
  session->plan = {};
  session->plan.domain = session->plan.add(points);
  session->use_points();
  return points.size();
}

LOBELIA_EXPORT(reason) const char* search_reason() { return reason.c_str(); }

}  // namespace lobelia::shader_check

#ifdef __wasm__
// There are no exceptions in WebAssembly here: a throw leaves its message, and traps. Nothing is destroyed at an exit.
extern "C" {
int __cxa_thread_atexit(void (*)(void*), void*, void*) { return 0; }
void* __cxa_allocate_exception(std::size_t bytes) { return ::operator new(bytes); }
void __cxa_free_exception(void* exception) { ::operator delete(exception); }
[[noreturn]] void __cxa_throw(void* thrown, std::type_info* type, void (*)(void*)) {
  if (*type == typeid(lobelia::Error))
    lobelia::shader_check::reason = static_cast<lobelia::Error*>(thrown)->what();
  __builtin_trap();
}
}
#endif

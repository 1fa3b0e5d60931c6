// SPIR-V by the tools of Khronos: glslang compiles, spirv-opt optimises and converts.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/process.hpp"
#include "shaders/program_text.hpp"

namespace lobelia {
namespace {

constexpr std::uint64_t kMostSpirv = std::uint64_t{64} << 20, kToolMemory = std::uint64_t{2} << 30;
constexpr auto kToolTimeLimit = std::chrono::minutes(2);

std::string tool(const char* name, const char* package) {
  const std::string path = find_program(name).string();
  if (path.empty())
    throw Error(ExitCode::kEngine,
                fmt::format("no program '{}': sudo apt-get install {}", name, package));
  return path;
}

/// Runs a tool on the file "in", which gives "out".
struct ToolRun {
  ProcessResult result;
  std::string said, out;
};
ToolRun run_tool(std::vector<std::string> command, const std::string& in) {
  const TemporaryDirectory scratch;
  write_file(scratch.path() / "in", in);
  ToolRun run;
  ProcessOptions process;
  process.working_directory = process.writable = scratch.path();
  process.only_environment = true;
  process.timeout = kToolTimeLimit;
  process.memory_limit = kToolMemory;
  process.on_line = [&](std::string_view line) {
    if (run.said.size() < (1 << 14)) run.said.append(line) += '\n';
  };
  run.result = run_process(command, process);
  if (run.result.interrupted) throw Error(ExitCode::kInterrupted, "interrupted");
  if (run.result.exit_code == 0) run.out = read_file(scratch.path() / "out", kMostSpirv);
  return run;
}

std::string optimised(const ShaderProgram& program, std::vector<std::string> passes) {
  passes.insert(passes.begin(), tool("spirv-opt", "spirv-tools"));
  passes.insert(passes.end(), {"in", "-o", "out"});
  ToolRun run = run_tool(passes, program.bytes);
  if (run.out.empty())
    throw Error(ExitCode::kEngine,
                fmt::format("{}: spirv-opt refuses it: {}", program.name, run.said.substr(0, 200)));
  return run.out;
}

}  // namespace

ShaderProgram make_program(const ShaderSource& source, ShaderApi api, std::size_t points,
                           std::size_t components) {
  ShaderProgram program = program_text(source, api, points, components);
  if (api != ShaderApi::kVulkan) return program;
  std::vector<std::string> command{tool("glslangValidator", "glslang-tools"), "-V", "-S", "comp"};
  if (source.language == ShaderText::kHlsl)
    command.insert(command.end(), {"-D", "-e", "main", "--source-entrypoint", "lobelia_main"});
  command.insert(command.end(), {"-o", "out", "in"});
  const ToolRun run = run_tool(command, program.bytes);
  if (run.out.empty()) throw Error(ExitCode::kInput, compiler_message(run.said, program));
  program.bytes = run.out;
  return program;
}

ShaderProgram in_half_floats(const ShaderProgram& program) {
  ShaderProgram half = program;
  half.bytes = optimised(program, {"-O", "--relax-float-ops", "--convert-relaxed-to-half", "-O"});
  return half;
}

std::size_t count_instructions(const ShaderProgram& program) {
  const std::string bytes = optimised(program, {"-O"});
  // After five words of header, each instruction begins with its number of words and its code.
  constexpr std::size_t kHeader = 5;
  constexpr std::uint32_t kFunction = 54, kFunctionEnd = 56;
  // Variable, load, store, access chain; vectors put together and apart; merge and label.
  constexpr std::uint32_t kNoWork[] = {kFunction, 59, 61, 62, 65, 79, 80, 81, 246, 247, 248};
  std::vector<std::uint32_t> words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), words.size() * 4);
  std::size_t count = 0;
  bool inside = false;
  for (std::size_t at = kHeader; at < words.size() && words[at] >> 16 > 0; at += words[at] >> 16) {
    const std::uint32_t code = words[at] & 0xffff;
    if (code == kFunction) inside = true;
    if (code == kFunctionEnd) inside = false;
    if (inside && std::ranges::count(kNoWork, code) == 0) ++count;
  }
  return count;
}

}  // namespace lobelia

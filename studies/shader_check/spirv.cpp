// SPIR-V by the tools of Khronos: glslang compiles, spirv-opt optimises and converts.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "studies/shader_check/program_text.hpp"

namespace lobelia {
namespace {

constexpr std::uint64_t kMostSpirv = std::uint64_t{64} << 20, kToolMemory = std::uint64_t{2} << 30;

struct Tool {
  const char *name, *package;
};
constexpr Tool kCompiler{"glslangValidator", "glslang-tools"},
    kOptimiser{"spirv-opt", "spirv-tools"};

/// A tool's messages and its output, which is empty if it refuses the program.
struct ToolRun {
  std::string said, out;
};

/// Runs a tool that reads the file "in" and writes "out". Throws Error(kInput) if it does not end in time, and
/// Error(kEngine) if it is missing, crashes or takes too much memory.
ToolRun run_tool(const Tool& tool, std::vector<std::string> options, const ShaderProgram& program,
                 const TimeLimit& limit) {
  const std::string path = find_program(tool.name).string();
  if (path.empty())
    throw Error(ExitCode::kEngine, "no program '{}': sudo apt-get install {}", tool.name,
                tool.package);
  options.insert(options.begin(), path);
  const TemporaryDirectory scratch;
  write_file(scratch.path() / "in", program.bytes);
  ToolRun run;
  ProcessOptions process;
  process.working_directory = process.writable = scratch.path();
  process.only_environment = true;
  process.memory_limit = kToolMemory;
  process.on_line = [&](std::string_view line) {
    if (run.said.size() < (1 << 14)) run.said.append(line) += '\n';
  };
  const ProcessResult result = run_within(limit, options, std::move(process));
  const auto fail = [&](ExitCode code, const std::string& what) {
    throw Error(code, fmt::format("{}: {} {}", program.name, tool.name, what));
  };
  if (result.interrupted) throw Error(ExitCode::kInterrupted, "interrupted");
  if (result.timed_out)
    fail(ExitCode::kInput, fmt::format("did not end within {:g} s", limit.seconds()));
  if (result.out_of_memory)
    fail(ExitCode::kEngine, fmt::format("takes over {} GiB of memory", kToolMemory >> 30));
  if (result.exit_code > kSignalBase)
    fail(ExitCode::kEngine, fmt::format("was ended by signal {}", result.exit_code - kSignalBase));
  if (result.exit_code == 0) run.out = read_file(scratch.path() / "out", kMostSpirv);
  return run;
}

std::string optimised(const ShaderProgram& program, std::vector<std::string> passes,
                      const TimeLimit& limit) {
  passes.insert(passes.end(), {"in", "-o", "out"});
  const ToolRun run = run_tool(kOptimiser, std::move(passes), program, limit);
  if (run.out.empty())
    throw Error(ExitCode::kEngine, "{}: spirv-opt refuses it: {}", program.name,
                run.said.substr(0, 200));
  return run.out;
}

}  // namespace

ShaderProgram make_program(const ShaderSource& source, ShaderApi api, std::size_t points,
                           std::size_t components, const TimeLimit& limit) {
  ShaderProgram program = program_text(source, api, points, components);
  if (api != ShaderApi::kVulkan) return program;
  std::vector<std::string> options{"-V", "-S", "comp"};
  if (source.language == ShaderText::kHlsl)
    options.insert(options.end(), {"-D", "-e", "main", "--source-entrypoint", "lobelia_main"});
  options.insert(options.end(), {"-o", "out", "in"});
  const ToolRun run = run_tool(kCompiler, std::move(options), program, limit);
  if (run.out.empty()) throw refusal(run.said, program);
  program.bytes = run.out;
  return program;
}

ShaderProgram in_half_floats(const ShaderProgram& program, const TimeLimit& limit) {
  ShaderProgram half = program;
  half.bytes =
      optimised(program, {"-O", "--relax-float-ops", "--convert-relaxed-to-half", "-O"}, limit);
  return half;
}

std::size_t count_instructions(const ShaderProgram& program, const TimeLimit& limit) {
  const std::string bytes = optimised(program, {"-O"}, limit);
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

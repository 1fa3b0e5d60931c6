#include "studies/shader_check/run_shaders.hpp"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <random>

#include "base/pictures/image_io_module.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/words/text.hpp"
#include "studies/shader_check/program_text.hpp"
#include "studies/shader_check/runner_protocol.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;

constexpr char kPackages[] = "libegl-dev, libgl-dev, libvulkan-dev";
constexpr std::uint64_t kRunnerMemory = std::uint64_t{4} << 30;

std::string runner_path() {
  try {
    return companion_file(kShaderRunnerFile).string();
  } catch (const Error&) {
    throw Error(ExitCode::kEngine,
                "shaders cannot be run: this build of Lobelia has no {}; install {} and "
                "build again",
                kShaderRunnerFile, kPackages);
  }
}

/// The runner's own lines, and the rest: what a compiler or a driver prints, which may quote the shader.
struct Said {
  explicit Said(std::size_t programs) : token(random_token()), seconds(programs) {}
  const std::string token;
  std::string device, driver, rest;
  std::size_t program = 0;  ///< that is compiled or run
  std::vector<std::vector<double>> seconds;

  void add(std::string_view line) {
    // A driver's line before it may lack its end.
    const std::size_t own = line.find(token + ' ');
    if (const std::string_view others = line.substr(0, own);
        !others.empty() && rest.size() < (1 << 14))
      rest.append(others) += '\n';
    if (own != line.npos) add_own(line.substr(own + token.size() + 1));
  }

 private:
  void add_own(std::string_view line) {
    if (line.starts_with(kDeviceLine)) {
      device = printable(line.substr(std::strlen(kDeviceLine)));
    } else if (line.starts_with(kDriverLine)) {
      driver = printable(line.substr(std::strlen(kDriverLine)));
    } else if (line.starts_with(kProgramLine)) {
      long long k = 0;
      if (parse_integer(line.substr(std::strlen(kProgramLine)), k) && k >= 0 &&
          std::size_t(k) < seconds.size())
        program = std::size_t(k);
    } else if (line.starts_with(kSecondsLine)) {
      const auto parts = split(line, " ");
      long long program = 0;
      double value = 0;
      if (parts.size() == 3 && parse_integer(parts[1], program) && parse_number(parts[2], value) &&
          program >= 0 && std::size_t(program) < seconds.size())
        seconds[std::size_t(program)].push_back(value);
    }
  }
};

std::vector<ShaderValue> values_of(const fs::path& file, std::size_t count) {
  const std::string bytes = read_file(file, kMostInvocations * 4 * sizeof(float));
  if (bytes.size() < count * 4 * sizeof(float))
    throw Error(ExitCode::kEngine, "the shader runner wrote too few values");
  return shader_values(bytes, count);
}

[[noreturn]] void fail(const ProcessResult& result, ShaderApi api, const Said& said,
                       const std::vector<ShaderProgram>& programs,
                       const ShaderRunOptions& options) {
  const ShaderProgram& program = programs[said.program];
  const ExitCode whose = program.is_own ? ExitCode::kEngine : ExitCode::kInput;
  if (result.interrupted) throw Error(ExitCode::kInterrupted, "interrupted");
  if (result.timed_out)
    throw Error(whose, "{} did not end within {:g} s on {}", words_for(program),
                options.time_limit.seconds(),
                said.device.empty() ? kShaderApiNames[int(api)] : said.device);
  if (result.out_of_memory)
    throw Error(ExitCode::kEngine, "{} made the runner run out of memory", words_for(program));
  if (result.exit_code == kRunnerRefusedProgram) throw refusal(said.rest, program);
  if (result.exit_code == kRunnerNoDevice)
    throw Error(ExitCode::kEngine, "no driver runs shaders here ({}); install {}",
                printable(split(said.rest + "\n", "\n").empty() ? std::string("no reason given")
                                                                : split(said.rest, "\n").front()),
                api == ShaderApi::kEgl ? "libgl1-mesa-dri" : "mesa-vulkan-drivers");
  throw Error(ExitCode::kEngine,
              result.exit_code > kSignalBase
                  ? fmt::format("{} ended the driver by signal {}", words_for(program),
                                result.exit_code - kSignalBase)
                  : fmt::format("{} stopped the runner with exit code {}: {}", words_for(program),
                                result.exit_code, printable(said.rest, 200)));
}

}  // namespace

ProcessResult run_within(const TimeLimit& limit, const std::vector<std::string>& command,
                         ProcessOptions options) {
  options.timeout = limit.left();
  if (options.timeout.count() > 0) return run_process(command, options);
  ProcessResult over;
  over.timed_out = true;
  return over;
}

std::string random_token() {
  std::random_device device;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", device(), device(), device(), device());
}

bool has_graphics_hardware() {
  std::error_code ignored;
  for (const char* node : {"/dev/dri", "/dev/nvidiactl", "/dev/kfd", "/dev/dxg"})
    if (fs::exists(node, ignored)) return true;
  return false;
}

std::vector<ShaderValue> shader_values(std::string_view bytes, std::size_t count) {
  std::vector<ShaderValue> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    float v[4];
    std::memcpy(v, bytes.data() + i * sizeof v, sizeof v);
    values[i] = {v[0], v[1], v[2], v[3] == 1};
  }
  return values;
}

std::vector<float> texels_of(const ShaderPoints& points) {
  const std::size_t floats = 4 * texels_of_point(points.components);
  std::vector<float> padded(points.count() * floats);
  for (std::size_t i = 0; i < points.count(); ++i)
    std::copy_n(points.values.begin() + std::ptrdiff_t(i * points.components), points.components,
                padded.begin() + std::ptrdiff_t(i * floats));
  return padded;
}

ShaderRun run_programs(ShaderApi api, const ShaderPoints& points,
                       const std::vector<ShaderProgram>& programs, std::size_t calls,
                       const ShaderRunOptions& options) {
  if (api == ShaderApi::kWebGpu) return run_in_browser(points, programs, calls, options);
  const std::string runner = runner_path();
  const TemporaryDirectory scratch;
  const std::size_t texels = texels_of_point(points.components);
  const std::vector<float> padded = texels_of(points);
  write_file(scratch.path() / kPointsFile,
             {reinterpret_cast<const std::uint8_t*>(padded.data()), padded.size() * sizeof(float)});
  Said said(programs.size());
  std::vector<std::string> command{runner,
                                   std::string(kShaderApiNames[int(api)]),
                                   said.token,
                                   std::to_string(points.count()),
                                   std::to_string(texels),
                                   std::to_string(calls),
                                   std::to_string(options.rounds)};
  for (std::size_t k = 0; k < programs.size(); ++k) {
    command.push_back(fmt::format("program{}", k));
    write_file(scratch.path() / command.back(), programs[k].bytes);
  }
  ProcessOptions process;
  process.working_directory = scratch.path();
  // The user's own variables, which choose drivers, are kept. No driver may cache another person's shader.
  process.environment = {"MESA_SHADER_CACHE_DISABLE=true", "__GL_SHADER_DISK_CACHE=0",
                         "TMPDIR=" + scratch.path().string()};
  if (!has_graphics_hardware()) process.writable = scratch.path();
  process.memory_limit = kRunnerMemory;
  process.on_line = [&](std::string_view line) { said.add(line); };
  const ProcessResult result = run_within(options.time_limit, command, std::move(process));
  if (result.exit_code != kRunnerDone || result.timed_out)
    fail(result, api, said, programs, options);
  ShaderRun run{said.device, said.driver, {}, std::move(said.seconds)};
  for (std::size_t k = 0; k < programs.size(); ++k)
    run.values.push_back(
        values_of(scratch.path() / fmt::format("program{}.out", k), points.count() * calls));
  return run;
}

}  // namespace lobelia

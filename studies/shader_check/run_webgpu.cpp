// WGSL by WebGPU, in a page that says on its console what shaders give.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <optional>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/words/base64.hpp"
#include "base/words/text.hpp"
#include "studies/shader_check/program_text.hpp"
#include "studies/shader_check/runner_protocol.hpp"

namespace lobelia {
namespace embedded {
extern const std::string_view webgpu_script;
}
namespace {

namespace fs = std::filesystem;

/// The page's lines on the console, to which Chromium adds words. Warnings that quote the shader stand there too, but
/// without the token.
class Heard {
 public:
  Heard(const std::string& token, std::size_t programs, std::size_t bytes)
      : mark_("\"" + token + " "), bytes_(bytes), values(programs), seconds(programs) {}

  void add(std::string_view line) {
    const std::size_t begin = line.find(mark_), end = line.find("\", source:", begin);
    if (begin == line.npos || end == line.npos) return;
    const auto words = split(line.substr(begin + mark_.size(), end - begin - mark_.size()), " ");
    long long k = 0;
    if (words.empty()) return;
    if (words[0] == "done" || words[0] == "none") {
      is_none = is_none || words[0] == "none";
      done = true;
    } else if (words[0] == "device" && words.size() == 2) {
      device = printable(base64_decoded(words[1]));
    } else if (words[0] == "broken" && words.size() == 2) {
      broken = printable(base64_decoded(words[1]), 200);
    } else if (words.size() == 3 && parse_integer(words[1], k) && k >= 0 &&
               std::size_t(k) < values.size()) {
      double number = 0;
      std::string& bytes = values[std::size_t(k)];
      if (words[0] == "refused") {
        refused = std::size_t(k);
        log = base64_decoded(words[2]);
      } else if (words[0] == "values" && bytes.size() < bytes_) {
        bytes += base64_decoded(words[2]);
      } else if (words[0] == "seconds" && parse_number(words[2], number)) {
        seconds[std::size_t(k)].push_back(number);
      }
    }
  }

 private:
  std::string mark_;   ///< before the page's own words
  std::size_t bytes_;  ///< of the values of a program

 public:
  std::atomic<bool> done = false;
  bool is_none = false;
  std::string device, broken, log;
  std::optional<std::size_t> refused;
  std::vector<std::string> values;
  std::vector<std::vector<double>> seconds;
};

std::string page_of(const std::string& token, const ShaderPoints& points,
                    const std::vector<ShaderProgram>& programs, std::size_t calls,
                    const ShaderRunOptions& options) {
  const std::vector<float> texels = texels_of(points);
  const std::size_t invocations = points.count() * calls,
                    groups = (invocations + kGroupSize - 1) / kGroupSize;
  std::string list;
  for (const ShaderProgram& program : programs) list += "'" + base64(program.bytes) + "',";
  return fmt::format(
      "<!doctype html><meta charset=\"utf-8\" /><script>\n"
      "const job = {{ token: '{}', invocations: {}, groups: [{}, {}], rounds: {}, programs: [{}], "
      "points: '{}' }};\n"
      "{}</script>\n",
      token, invocations, std::min(groups, kGroupsInRow),
      (groups + kGroupsInRow - 1) / kGroupsInRow, options.rounds, list,
      base64({reinterpret_cast<const char*>(texels.data()), texels.size() * sizeof(float)}),
      embedded::webgpu_script);
}

}  // namespace

ShaderRun run_in_browser(const ShaderPoints& points, const std::vector<ShaderProgram>& programs,
                         std::size_t calls, const ShaderRunOptions& options) {
  const std::string browser = find_program("chromium").string();
  if (browser.empty())
    throw Error(ExitCode::kEngine, "no program 'chromium': sudo apt-get install chromium");
  const TemporaryDirectory scratch;
  const fs::path page = scratch.path() / "page.html";
  const std::string token = random_token();
  write_file(page, page_of(token, points, programs, calls, options));
  const std::size_t count = points.count() * calls;
  Heard heard(token, programs.size(), count * 4 * sizeof(float));
  std::vector<std::string> command{browser,
                                   "--headless",
                                   "--enable-unsafe-webgpu",
                                   "--enable-logging=stderr",
                                   "--disable-background-networking",
                                   "--disable-component-update",
                                   "--disable-extensions",
                                   "--no-first-run",
                                   "--user-data-dir=" + (scratch.path() / "profile").string()};
  command.push_back(has_graphics_hardware() ? "--enable-features=Vulkan"
                                            : "--use-webgpu-adapter=swiftshader");
  // As root Chromium has no sandbox of its own; it still runs in ours.
  if (::geteuid() == 0) command.push_back("--no-sandbox");
  command.push_back(page.string());
  ProcessOptions process;
  process.working_directory = scratch.path();
  // Chromium is stopped before it removes its own files. The name is relative, because it makes a socket there, and the
  // path of a socket has at most 107 bytes.
  process.environment = {"TMPDIR=."};
  for (const char* name : {"HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME"})
    process.environment.push_back(fmt::format("{}={}", name, scratch.path().string()));
  process.stop = &heard.done;
  process.on_line = [&](std::string_view line) { heard.add(line); };
  const ProcessResult result = run_within(options.time_limit, command, std::move(process));
  const std::string& name = programs.back().name;
  if (!heard.done && result.interrupted) throw Error(ExitCode::kInterrupted, "interrupted");
  if (heard.refused) throw refusal(heard.log, programs[*heard.refused]);
  if (heard.is_none)
    throw Error(ExitCode::kEngine, "no driver runs shaders here: Chromium has no WebGPU");
  if (!heard.done)
    throw Error(result.timed_out ? ExitCode::kInput : ExitCode::kEngine,
                result.timed_out
                    ? fmt::format("{}: the shader did not end within {:g} s on {}", name,
                                  options.time_limit.seconds(),
                                  heard.device.empty() ? "webgpu" : heard.device)
                    : fmt::format("{}: Chromium ended with exit code {} while it ran the shader",
                                  name, result.exit_code));
  ShaderRun run{heard.device, "Chromium's WebGPU", {}, std::move(heard.seconds)};
  for (const std::string& bytes : heard.values) {
    if (!heard.broken.empty() || bytes.size() < count * 4 * sizeof(float))
      throw Error(ExitCode::kEngine, "{}: WebGPU failed: {}", name,
                  heard.broken.empty() ? "too few values" : heard.broken);
    run.values.push_back(shader_values(bytes, count));
  }
  return run;
}

}  // namespace lobelia

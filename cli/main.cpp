// The program: builds the command line, runs one subcommand, prints errors, chooses the exit code.
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <span>

#include "cli/commands.hpp"
#include "core/interrupt.hpp"
#include "core/no_resources.hpp"
#include "core/standard_streams.hpp"
#include "core/text.hpp"
#include "core/threads.hpp"
#include "core/version.hpp"

namespace lobelia::cli {
namespace {

std::vector<std::string> g_command_line;

constexpr char kFooter[] =
    "Begin with:\n"
    "  lobelia render reference_scenes/scenes/oblique_45.xml -o highlight.exr\n"
    "  lobelia reference reference_scenes/scenes/oblique_45.xml --engine povray -o povray.exr\n"
    "  lobelia compare highlight.exr povray.exr\n"
    "\n"
    "Exit codes: 0 done, 1 differs, 2 usage, 3 bad input, 4 cannot write, 5 engine missing\n"
    "or failed, 70 a bug of ours, 71 too little memory, threads or files, 130 Ctrl-C, 143 SIGTERM.";

constexpr char kStdoutFailed[] = "standard output: cannot write";
constexpr char kOutOfMemory[] = "lobelia: not enough memory (ulimit -v or -d, cgroup memory.max)\n";

/// Prints each message on its own line, with unprintable bytes escaped, and returns the exit code.
int fail(ExitCode code, std::span<const std::string> messages) noexcept {
  take_over_end();
  if (code == ExitCode::kInterrupted) code = interrupt_exit_code();
  try {
    for (const std::string& message : messages) say("lobelia: {}\n", printable(message, 2000));
  } catch (const std::bad_alloc&) {
    write_message(kOutOfMemory);
  }
  return int(code);
}

int fail(ExitCode code, const std::string& message) { return fail(code, std::span(&message, 1)); }

/// Flushes stdout and returns the exit code.
int flushed(ExitCode code) {
  if (interrupted_in_time()) throw_if_interrupted();
  std::cout.flush();  // CLI11 prints its help there
  if (!std::cout || std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    return fail(ExitCode::kOutput, kStdoutFailed);
  take_over_end();
  return int(code);
}

/// A message about the first word that should be a subcommand and is not, or "". CLI11 would only
/// say that one is missing.
std::string unknown_subcommand(CLI::App& app, int argc, char** argv) {
  CLI::App* command = &app;
  for (int i = 1; i < argc && argv[i][0] != '-'; ++i) {
    std::vector<std::string_view> names;
    for (const auto* sub : command->get_subcommands({})) names.push_back(sub->get_name());
    if (names.empty()) break;
    if (std::ranges::count(names, std::string_view(argv[i])) == 0) {
      // `farm GRID` and `farm status DIR`: a word that is no subcommand is a file.
      if (command->get_require_subcommand_min() == 0) break;
      return fmt::format("unknown subcommand '{}'; allowed: {}{}", printable(argv[i]), join(names),
                         did_you_mean(argv[i], names));
    }
    command = command->get_subcommand(argv[i]);
  }
  return "";
}

int run(int argc, char** argv) {
  CLI::App app{
      "Lobelia renders specular highlights with all normalised models, renders the same\n"
      "scenes with POV-Ray and Blender Cycles, and says how far they are apart.",
      "lobelia"};
  app.set_version_flag("--version", kNameAndVersion);
  app.require_subcommand(1);
  app.footer(kFooter);
  ExitCode exit_code = ExitCode::kSuccess;
#define LOBELIA_ADD(name) add_##name(app, exit_code);
  LOBELIA_COMMANDS(LOBELIA_ADD)
  if (const std::string error = unknown_subcommand(app, argc, argv); !error.empty())
    return fail(ExitCode::kUsage, error);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // --help and --version
      app.exit(error);
      return flushed(ExitCode::kSuccess);
    }
    std::string help = "lobelia";
    for (const auto* command : app.get_subcommands()) help += " " + command->get_name();
    return fail(ExitCode::kUsage, fmt::format("{} (see {} --help)", error.what(), help));
  }
  return flushed(exit_code);
}

/// Memory may run out where nothing may be thrown: the destructor of a JSON value allocates.
[[noreturn]] void end_for_want_of_memory() noexcept {
  try {
    if (const auto current = std::current_exception()) std::rethrow_exception(current);
  } catch (const std::bad_alloc&) {
    write_message(kOutOfMemory);
    ::_exit(int(ExitCode::kNoResources));
  } catch (...) {
  }
  std::abort();
}

}  // namespace

const std::vector<std::string>& command_line() { return g_command_line; }

}  // namespace lobelia::cli

int main(int argc, char** argv) {
  using namespace lobelia;
  hold_standard_descriptors();
  // A closed pipe or a file over the size limit is an error of that write, not the end of the process.
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
  catch_interrupts();
  end_soon_when_interrupted();
  cli::g_command_line.assign(argv, argv + argc);
  if (!cli::g_command_line.empty()) cli::g_command_line[0] = "lobelia";
  std::set_terminate(cli::end_for_want_of_memory);
  try {
    keep_to_usual_threads();
    return cli::run(argc, argv);
  } catch (const Error& error) {
    return cli::fail(error.code(), error.lines());
  } catch (const std::bad_alloc&) {
    write_message(cli::kOutOfMemory);
    return int(ExitCode::kNoResources);
  } catch (const std::exception& error) {
    // fmt::print throws where more than a buffer could not be written.
    if (std::ferror(stdout)) return cli::fail(ExitCode::kOutput, cli::kStdoutFailed);
    if (const std::string lack = lacking(error); !lack.empty())
      return cli::fail(ExitCode::kNoResources, lack);
    return cli::fail(ExitCode::kInternal, fmt::format("internal error: {}", error.what()));
  }
}

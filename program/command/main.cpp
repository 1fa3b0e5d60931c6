// The program: builds the command line, runs one subcommand, prints errors, chooses the exit code.
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <span>
#include <vector>

#include "base/system/interrupt.hpp"
#include "base/system/no_resources.hpp"
#include "base/system/standard_streams.hpp"
#include "base/system/threads.hpp"
#include "base/system/timing.hpp"
#include "base/system/version.hpp"
#include "base/words/numbers.hpp"
#include "base/words/text.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"

namespace lobelia::cli {
namespace {

constexpr char kFooter[] =
    "Begin with:\n"
    "  lobelia render reference_scenes/scenes/oblique_45.xml -o highlight.exr\n"
    "  lobelia reference reference_scenes/scenes/oblique_45.xml --engine povray -o povray.exr\n"
    "  lobelia compare highlight.exr povray.exr\n"
    "\n"
    "Exit codes: 0 done, 1 differs, 2 usage, 3 bad input, 4 cannot write, 5 engine missing or failed,\n"
    "6 undecided, 70 a bug of ours, 71 too little memory, threads or files, 124 --time-limit,\n"
    "129 hung up, 130 Ctrl-C, 141 nobody reads stdout, 143 SIGTERM.";

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

/// The exit code when stdout cannot be written. Quiet if its reader has seen enough, as in `lobelia models | head`.
int stdout_failed() {
  pollfd out{STDOUT_FILENO, POLLOUT, 0};
  if (::poll(&out, 1, 0) == 1 && (out.revents & POLLERR))
    return fail(ExitCode::kBrokenPipe, std::span<const std::string>());
  return fail(ExitCode::kOutput, kStdoutFailed);
}

/// Flushes stdout and returns the exit code.
int flushed(ExitCode code) {
  if (interrupted_in_time()) throw_if_interrupted();
  std::cout.flush();  // CLI11 prints its help there
  if (!std::cout || std::fflush(stdout) != 0 || std::ferror(stdout) != 0) return stdout_failed();
  take_over_end();
  return int(code);
}

/// The command that the words name, and how many of them do.
std::pair<CLI::App*, int> named_command(CLI::App& app, std::span<char*> words) {
  CLI::App* command = &app;
  std::size_t i = 1;
  for (; i < words.size(); ++i) {
    const auto subcommands = command->get_subcommands(nullptr);
    const auto next = std::ranges::find(subcommands, words[i], &CLI::App::get_name);
    if (next == subcommands.end()) break;
    command = *next;
  }
  return {command, int(i)};
}

/// "lobelia farm status"
std::string full_name(const CLI::App& command) {
  const CLI::App* const parent = command.get_parent();
  return (parent ? full_name(*parent) + " " : "") + command.get_name();
}

/// A message about the first word that should be a subcommand and is not, or "". CLI11 would only
/// say that one is missing.
std::string unknown_subcommand(CLI::App& app, std::span<char*> words) {
  const auto [command, at] = named_command(app, words);
  if (std::size_t(at) >= words.size() || words[std::size_t(at)][0] == '-') return "";
  std::vector<std::string_view> names;
  for (const auto* sub : command->get_subcommands({}))
    if (!sub->get_group().empty()) names.push_back(sub->get_name());
  if (names.empty()) return "";
  const char* const word = words[std::size_t(at)];
  const std::string nearest = did_you_mean(word, names);
  // `farm GRID` and `farm status DIR`: a word that is no subcommand is a file.
  std::error_code error;
  if (command->get_require_subcommand_min() == 0 &&
      (nearest.empty() || std::filesystem::exists(word, error)))
    return "";
  return fmt::format("unknown subcommand '{}'{}; allowed: {}{}", printable(word),
                     command == &app ? "" : fmt::format(" of '{}'", full_name(*command)),
                     join(names), nearest);
}

/// A message about the first option that the command does not have, or "". CLI11 would ask for what is required first.
std::string unknown_option(CLI::App& app, std::span<char*> words) {
  const auto [command, at] = named_command(app, words);
  std::vector<std::string> known;
  for (const CLI::Option* option : command->get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    for (const std::string& name : option->get_snames()) known.push_back("-" + name);
  }
  const std::vector<std::string_view> names(known.begin(), known.end());
  for (std::size_t i = std::size_t(at); i < words.size(); ++i) {
    const std::string_view word = words[i];
    if (word == "--") break;
    const bool is_long = word.starts_with("--");
    // A single minus sign is stdout, and a number after one is a value.
    if (!word.starts_with("-") || word.size() < 2 || (!is_long && !std::isalpha(word[1]))) continue;
    const std::string name(is_long ? word.substr(0, word.find('=')) : word.substr(0, 2));
    if (const CLI::Option* const option = command->get_option_no_throw(name)) {
      // Its value may begin with a minus sign.
      if (option->get_items_expected_min() > 0 && word == name) ++i;
      continue;
    }
    std::string hint = is_long ? did_you_mean(name, names) : "";
    for (const OldOption& old : old_options())
      if (old.command == command->get_name() && old.option == name)
        hint = fmt::format("; use {}", old.hint);
    return fmt::format("'{}' has no option '{}'{} (see {} --help)", full_name(*command),
                       printable(name), hint, full_name(*command));
  }
  return "";
}

/// The message for a command line that does not parse: what is wrong, and what to type instead.
std::string parse_failure(CLI::App& app, std::span<char*> words, const CLI::ParseError& error) {
  if (std::string message = unknown_option(app, words); !message.empty()) return message;
  const CLI::App* const command = named_command(app, words).first;
  const bool lacks_value = dynamic_cast<const CLI::ArgumentMismatch*>(&error) &&
                           std::string_view(words.back()) == "--json";
  return fmt::format("{}{} (see {} --help)", error.what(),
                     lacks_value ? "; with --json - it goes to stdout" : "", full_name(*command));
}

/// The time and memory of this process, for --verbose.
void say_what_it_cost(std::string_view command, double seconds) {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto of = [](const timeval& time) {
    return double(time.tv_sec) + 1e-6 * double(time.tv_usec);
  };
  say("{}: {:.3f} s, {:.3f} s of processors, at most {}\n", command, seconds,
      of(usage.ru_utime) + of(usage.ru_stime), size_text(std::uint64_t(usage.ru_maxrss) << 10));
}

/// 'lobelia help render' as 'lobelia render --help', and 'lobelia version' as --version.
std::vector<char*> as_options(std::span<char*> words) {
  static char help[] = "--help", version[] = "--version";
  std::vector<char*> typed(words.begin(), words.end());
  if (typed.size() < 2) return typed;
  const std::string_view first = typed[1];
  if (first == "version") typed[1] = version;
  if (first != "help") return typed;
  typed.erase(typed.begin() + 1);
  typed.push_back(help);
  return typed;
}

int run(std::span<char*> typed) {
  std::vector<char*> as_typed = as_options(typed);
  const std::span<char*> words = as_typed;
  const std::string first = words.size() > 1 ? words[1] : "";
  if (words.size() == 2 && (first == "--version" || first == "-V")) {
    std::puts(kNameAndVersion);
    return flushed(ExitCode::kSuccess);
  }
  // A small picture is rendered without oneTBB; render() and run_render() call this where they need it.
  if (first != "render") keep_to_usual_threads();
  CLI::App app{
      "Lobelia renders specular highlights with all normalised models, renders the same\n"
      "scenes with POV-Ray and Blender Cycles, and says how far they are apart.",
      "lobelia"};
  app.set_version_flag("-V,--version", kNameAndVersion);
  app.require_subcommand(1);
  app.footer(kFooter);
  ExitCode exit_code = ExitCode::kSuccess;
  add_commands(app, exit_code, first);
  if (const std::string error = unknown_subcommand(app, words); !error.empty())
    return fail(ExitCode::kUsage, error);
  try {
    const double seconds = seconds_of([&] { app.parse(int(words.size()), words.data()); });
    if (verbosity().verbose) say_what_it_cost(full_name(*named_command(app, words).first), seconds);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // --help and --version
      app.exit(error);
      return flushed(ExitCode::kSuccess);
    }
    return fail(ExitCode::kUsage, parse_failure(app, words, error));
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

}  // namespace lobelia::cli

int main(int argc, char** argv) {
  using namespace lobelia;
  hold_standard_descriptors();
  // A closed pipe or a file over the size limit is an error of that write, not the end of the process.
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
  catch_interrupts();
  end_soon_when_interrupted();
  cli::command_line().assign(argv, argv + argc);
  if (argc > 0) cli::command_line()[0] = "lobelia";
  std::set_terminate(cli::end_for_want_of_memory);
  try {
    return cli::run(std::span(argv, std::size_t(argc)));
  } catch (const Error& error) {
    return cli::fail(error.code(), error.lines());
  } catch (const std::bad_alloc&) {
    write_message(cli::kOutOfMemory);
    return int(ExitCode::kNoResources);
  } catch (const std::exception& error) {
    // fmt::print throws where more than a buffer could not be written.
    if (std::ferror(stdout)) return cli::stdout_failed();
    const Error known = as_error(error);
    return cli::fail(known.code(), known.lines());
  }
}

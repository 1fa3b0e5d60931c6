#include "program/command/commands.hpp"

#include <algorithm>

#include "program/command/common_options.hpp"

namespace lobelia::cli {

namespace {

#define LOBELIA_NO_TASK(title)
#define LOBELIA_NAME(name) #name,
constexpr const char* kFunctions[] = {LOBELIA_COMMANDS(LOBELIA_NO_TASK, LOBELIA_NAME)};

/// add_scene_format() adds `lobelia scene-format`.
std::string typed_name(std::string function) {
  std::ranges::replace(function, '_', '-');
  return function;
}

}  // namespace

void add_commands(CLI::App& app, ExitCode& exit_code, const std::string& wanted) {
  // The manual is about all of them.
  const bool all = wanted == "manual" || std::ranges::count(kFunctions, wanted, typed_name) == 0;
  std::string task;
#define LOBELIA_TASK(title) task = title;
#define LOBELIA_ADD(name)                             \
  if (all || wanted == typed_name(#name)) {           \
    add_##name(app, exit_code);                       \
    app.get_subcommands(nullptr).back()->group(task); \
  }
  LOBELIA_COMMANDS(LOBELIA_TASK, LOBELIA_ADD)
  add_verbosity(app);
}

std::vector<std::string>& command_line() {
  static std::vector<std::string> words;
  return words;
}

}  // namespace lobelia::cli

// Options that mean the same in every command that has them.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/system/interrupt.hpp"
#include "base/system/threads.hpp"
#include "program/command/options.hpp"

namespace lobelia::cli {

struct CommonOption {
  std::string_view names;    ///< "-q,--quiet"
  std::string_view value;    ///< "FILE|-"; empty: a flag, or named by the command
  std::string_view meaning;  ///< each command's help begins with it
};

/// The table of them all.
std::span<const CommonOption> common_options();

const CommonOption& common_option(std::string_view name);

/// Adds an option of the table by one of its names. `more` ends its help; `value` is for those without one in the table.
template <class T>
CLI::Option* add_common(OptionGroup& group, std::string_view name, T& target,
                        const std::string& more = "", const std::string& value = "") {
  const CommonOption& option = common_option(name);
  return group.add(std::string(option.names), target,
                   option.value.empty() ? value : std::string(option.value),
                   std::string(option.meaning) + more);
}

/// --json FILE|- for records of these kinds.
CLI::Option* add_json(OptionGroup& group, std::string& target, const std::string& kinds);

/// --threads and --time-limit of a command whose work looks at neither.
class WorkLimits {
 public:
  /// This object has to live as long as `group`'s command.
  void add_to(OptionGroup& group);
  void add_time_limit_to(OptionGroup& group);
  /// After the time limit the process ends with ExitCode::kTimedOut.
  template <class Work>
  void run(Work&& work) const {
    if (time_limit_) end_after(*time_limit_);
    ThreadLimit(threads_).run(std::forward<Work>(work));
  }

 private:
  int threads_ = 0;
  std::optional<double> time_limit_;
};

/// -q and -v of the command that runs.
struct Verbosity {
  bool quiet = false, verbose = false;
};
const Verbosity& verbosity();

/// Adds -q and -v to every command of the program.
void add_verbosity(CLI::App& program);

/// An option that a command had once, and what to type now.
struct OldOption {
  std::string_view command, option, hint;
};
std::span<const OldOption> old_options();

}  // namespace lobelia::cli

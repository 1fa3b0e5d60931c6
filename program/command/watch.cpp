#include "program/command/watch.hpp"

#include <sys/stat.h>

#include <chrono>
#include <compare>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <thread>

#include "base/system/interrupt.hpp"
#include "base/system/standard_streams.hpp"
#include "base/words/text.hpp"

namespace lobelia::cli {
namespace {

/// Sooner than anybody switches from the editor, and no work for the processor. Shorter than the time after which Ctrl-C
/// ends the process by force.
constexpr std::chrono::milliseconds kBetweenLooks{150};

struct State {
  ino_t inode;
  off_t size;
  std::int64_t seconds, nanoseconds;  ///< of the last change
  bool operator==(const State&) const = default;
};

/// Nothing while there is no file: some editors remove it before they write it anew.
std::optional<State> state_of(const std::filesystem::path& file) {
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) return std::nullopt;
  return State{found.st_ino, found.st_size, found.st_mtim.tv_sec, found.st_mtim.tv_nsec};
}

/// Until the file is there, is not as it was, and stays so from one look to the next: it may be written in parts.
void wait_for_change(const std::filesystem::path& file, const State& old) {
  for (std::optional<State> before = old;;) {
    std::this_thread::sleep_for(kBetweenLooks);
    throw_if_interrupted();
    const std::optional<State> now = state_of(file);
    if (now && *now != old && now == before) return;
    before = now;
  }
}

}  // namespace

void run_at_changes(const std::filesystem::path& file, const std::function<void()>& run) {
  for (bool is_first = true;; is_first = false) {
    // From before the run: it does not miss a change while it runs.
    const std::optional<State> state = state_of(file);
    try {
      run();
    } catch (const Error& error) {
      const ExitCode code = error.code();
      // Options that were right at first may not fit to the changed shader, and a driver may fail because of it.
      const bool is_of_file = code == ExitCode::kInput ? !is_first || state
                                                       : !is_first && (code == ExitCode::kUsage ||
                                                                       code == ExitCode::kEngine);
      if (!is_of_file) throw;
      for (const std::string& line : error.lines()) say("lobelia: {}\n", printable(line, 2000));
    }
    if (std::fflush(stdout) != 0) throw Error(ExitCode::kOutput, "standard output: cannot write");
    wait_for_change(file, state.value_or(State{}));
  }
}

}  // namespace lobelia::cli

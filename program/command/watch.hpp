// Runs again whenever a file changes, for --watch.
#pragma once

#include <filesystem>
#include <functional>

namespace lobelia::cli {

/// Runs at once, and then after each change of the file, also by one that takes its name. Bad input is told, and the next
/// change is waited for; so are errors of usage and of engines, but for the first run's. Returns by an exception alone: of
/// an interruption, of any other error, or if the file is not there at first.
[[noreturn]] void run_at_changes(const std::filesystem::path& file,
                                 const std::function<void()>& run);

}  // namespace lobelia::cli

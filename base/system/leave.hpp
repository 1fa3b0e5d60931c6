// The gate for what files of others say: grids, descriptions of engines, and records of runs. It alone decides whether a
// program that they name may start, and whether a file that they name may be read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/files.hpp"

namespace lobelia {

/// The user's leave to do what files say. It is given on the command line for all of them. Otherwise it is there if each
/// file that has a say lies in a folder of $LOBELIA_ALLOW_COMMANDS_IN, a list of absolute paths with colons.
class Leave {
 public:
  Leave() = default;  ///< none
  /// `given`: by --allow-commands.
  static Leave of_user(bool given);
  /// The leave where another file has a say, too. `real_path` is its InputFile::real_path(), or the directory of that.
  Leave said_by(const std::filesystem::path& real_path) const;
  explicit operator bool() const { return state_ == State::kOfUser || state_ == State::kTrusted; }

 private:
  enum class State : std::uint8_t { kNone, kUntrusted, kTrusted, kOfUser };
  State state_ = State::kNone;
};

/// One sentence on doubtful folders of $LOBELIA_ALLOW_COMMANDS_IN: those that give no leave, because they are not there
/// or not absolute, and those that give leave but where every user may put files. Empty if there are none.
std::string doubts_of_trusted_folders();

/// Throws Error(kUsage): "this would start 'sh mine.sh' by engine mine; if you trust ...". `wishes` says what would be done.
[[noreturn]] void refuse_without_leave(const std::vector<std::string>& wishes);

/// Opens the file `name` that a file in `directory`, which has no links in its path, names for `reader`. Without leave it
/// has to lie there or below, with all links followed. Throws Error(kUsage) if it does not, and Error(kInput) as
/// InputFile.
InputFile open_named(const std::filesystem::path& name, const std::filesystem::path& directory,
                     const Leave& leave, std::string_view reader);

/// Throws Error(kInput) if a program that gets `value` as an argument could take it for an option. `what` is its name.
void require_no_option(std::string_view value, std::string_view what);

}  // namespace lobelia

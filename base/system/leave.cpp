#include "base/system/leave.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "base/system/error.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

bool lies_in_trusted_folder(const fs::path& real_path) {
  const char* list = std::getenv("LOBELIA_ALLOW_COMMANDS_IN");
  const std::vector<std::string> folders = split(list ? list : "", ":");
  return std::ranges::any_of(folders, [&](const std::string& folder) {
    std::error_code unknown;
    const fs::path real = fs::canonical(folder, unknown);
    return !unknown && fs::path(folder).is_absolute() && is_below(real_path, real);
  });
}

/// Whether every user may put files into a folder, or another folder in its place.
bool anyone_may_write(const fs::path& folder) {
  constexpr auto kSticky = fs::perms::sticky_bit, kOthers = fs::perms::others_write;
  std::error_code unknown;
  bool is_above = false;
  for (fs::path at = folder;; at = at.parent_path(), is_above = true) {
    const fs::perms may = fs::status(at, unknown).permissions();
    const bool writable = !unknown && (may & kOthers) != fs::perms::none;
    // Above it, nobody can rename what is another's where the folder is sticky.
    if (writable && !(is_above && (may & kSticky) != fs::perms::none)) return true;
    if (at == at.parent_path()) return false;
  }
}

}  // namespace

std::string doubts_of_trusted_folders() {
  const char* list = std::getenv("LOBELIA_ALLOW_COMMANDS_IN");
  std::vector<std::string> doubts;
  for (const std::string& folder : split(list ? list : "", ":")) {
    std::error_code error;
    const fs::path real = fs::canonical(folder, error);
    const std::string name = printable(folder, 1000);
    if (!fs::path(folder).is_absolute())
      doubts.push_back(fmt::format("'{}' is not absolute and gives no leave", name));
    else if (error)
      doubts.push_back(fmt::format("'{}' gives no leave: {}", name, error.message()));
    else if (anyone_may_write(real))
      doubts.push_back(fmt::format("any user may write into '{}', and so gets your leave", name));
  }
  if (doubts.empty()) return "";
  return fmt::format("$LOBELIA_ALLOW_COMMANDS_IN: {}", fmt::join(doubts, "; "));
}

Leave Leave::of_user(bool given) {
  Leave leave;
  if (given) leave.state_ = State::kOfUser;
  return leave;
}

Leave Leave::said_by(const fs::path& real_path) const {
  Leave leave = *this;
  if (state_ == State::kNone || state_ == State::kTrusted)
    leave.state_ = lies_in_trusted_folder(real_path) ? State::kTrusted : State::kUntrusted;
  return leave;
}

void refuse_without_leave(const std::vector<std::string>& wishes) {
  throw Error(ExitCode::kUsage,
              "this would {}; if you trust the files that say so, give --allow-commands "
              "or name their folders in $LOBELIA_ALLOW_COMMANDS_IN",
              fmt::join(wishes, ", "));
}

InputFile open_named(const fs::path& name, const fs::path& directory, const Leave& leave,
                     std::string_view reader) {
  InputFile file(directory / name);
  if (!leave && !is_below(file.real_path(), directory))
    refuse_without_leave({fmt::format("read '{}' for {}, outside of the directory that names it",
                                      printable(name.string(), 1000), reader)});
  return file;
}

void require_no_option(std::string_view value, std::string_view what) {
  if (value.starts_with('-'))
    throw Error(ExitCode::kInput,
                "{} '{}': a program could take a value that begins with '-' for an "
                "option; rename the file",
                what, printable(value));
}

}  // namespace lobelia

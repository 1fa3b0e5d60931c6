// Names of results in the making, which tell whether their maker lives.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lobelia {

/// A process among all that may share a cache.
struct ProcessIdentity {
  std::string host;  ///< at most 40 of [A-Za-z0-9_-], and a hash of the machine's own number
  std::string boot;  ///< 32 hexadecimal digits, other ones after each start of the machine
  std::uint64_t pid_namespace = 0;
  std::uint64_t pid = 0;
  std::uint64_t start = 0;  ///< in the system's ticks since the boot
  bool operator==(const ProcessIdentity&) const = default;
};

/// The calling process.
ProcessIdentity this_process();

/// "draft.HOST.BOOT.PIDNAMESPACE.PID.START.INODE.RANDOM", less than 200 characters.
struct DraftName {
  ProcessIdentity maker;
  std::uint64_t locks_inode = 0;  ///< of the file of locks that the maker holds open
  std::uint64_t random = 0;

  std::string text() const;
  /// Empty for what text() does not write.
  static std::optional<DraftName> parse(std::string_view name);
};

/// 16 hexadecimal digits, as drafts were named before.
bool is_old_draft_name(std::string_view name);

enum class Life { kAlive, kDead, kUnknown };
/// kUnknown: the process is of another machine or another namespace.
Life life_of(const ProcessIdentity& maker, const ProcessIdentity& self);

}  // namespace lobelia

#include "core/write_limit.hpp"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>

#include "core/no_resources.hpp"

namespace lobelia {
namespace {

constexpr std::uint64_t kTruncate = 1 << 14;  // in the headers from Linux 6.2 on

/// Everything that alters a file or a directory, as far as this kernel can forbid it.
std::uint64_t writing(long version) {
  std::uint64_t rights = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
                         LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
                         LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG |
                         LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO |
                         LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
  if (version >= 2) rights |= LANDLOCK_ACCESS_FS_REFER;  // renaming between directories
  if (version >= 3) rights |= kTruncate;
  return rights;
}

bool allow(int ruleset, const std::filesystem::path& path, std::uint64_t rights) {
  const int place = ::open(path.c_str(), O_PATH | O_CLOEXEC);
  if (place < 0) return false;
  const landlock_path_beneath_attr rule{rights, place};
  const long added =
      ::syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  const int error = errno;
  ::close(place);
  errno = error;
  return added == 0;
}

}  // namespace

WriteLimit::WriteLimit(const std::filesystem::path& directory) {
  const long version =
      ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return;
  landlock_ruleset_attr attributes{};
  attributes.handled_access_fs = writing(version);
  ruleset_ = int(::syscall(SYS_landlock_create_ruleset, &attributes, sizeof attributes, 0));
  if (ruleset_ < 0 || !allow(ruleset_, directory, attributes.handled_access_fs)) {
    const int error = errno;
    if (ruleset_ >= 0) ::close(ruleset_);
    // A kernel that can limit a program is not to start one without a limit.
    throw failure_of(directory.string() + ": no program can be held to it", error,
                     ExitCode::kEngine);
  }
  allow(ruleset_, "/dev/null",
        attributes.handled_access_fs & (LANDLOCK_ACCESS_FS_WRITE_FILE | kTruncate));
}

WriteLimit::~WriteLimit() {
  if (ruleset_ >= 0) ::close(ruleset_);
}

}  // namespace lobelia

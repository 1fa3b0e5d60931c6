#include "core/write_limit.hpp"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>

namespace lobelia {
namespace {

constexpr std::uint64_t kTruncate = 1 << 14;  // in the headers from Linux 6.2 on

/// A file descriptor that is closed when it goes.
struct Descriptor {
  int fd;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

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
  const Descriptor place{::open(path.c_str(), O_PATH | O_CLOEXEC)};
  const landlock_path_beneath_attr rule{rights, place.fd};
  return ::syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &rule, 0) == 0;
}

}  // namespace

bool limit_writes_to(const std::filesystem::path& directory) {
  const long version =
      ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return false;
  landlock_ruleset_attr attributes{};
  attributes.handled_access_fs = writing(version);
  const Descriptor ruleset{
      int(::syscall(SYS_landlock_create_ruleset, &attributes, sizeof attributes, 0))};
  if (ruleset.fd < 0 || !allow(ruleset.fd, directory, attributes.handled_access_fs)) return false;
  allow(ruleset.fd, "/dev/null",
        attributes.handled_access_fs & (LANDLOCK_ACCESS_FS_WRITE_FILE | kTruncate));
  // Without root's rights the kernel wants to be sure that no set-user-ID program is misled.
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         ::syscall(SYS_landlock_restrict_self, ruleset.fd, 0) == 0;
}

}  // namespace lobelia

#include "base/system/write_limit.hpp"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/syscall.h>

#include <cstdint>

#include "base/system/no_resources.hpp"

namespace lobelia {
namespace {

constexpr std::uint64_t kTruncate = 1 << 14;  // in the headers from Linux 6.2 on

/// Every right to change files or directories that this kernel can take away.
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

/// Returns 0 or an errno.
int allow(int ruleset, const std::filesystem::path& path, std::uint64_t rights) {
  const Descriptor place(::open(path.c_str(), O_PATH | O_CLOEXEC));
  if (!place) return errno;
  const landlock_path_beneath_attr rule{rights, place.get()};
  return ::syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &rule, 0) == 0
             ? 0
             : errno;
}

}  // namespace

WriteLimit::WriteLimit(const std::filesystem::path& directory) {
  const long version =
      ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return;
  landlock_ruleset_attr attributes{};
  attributes.handled_access_fs = writing(version);
  ruleset_ =
      Descriptor(int(::syscall(SYS_landlock_create_ruleset, &attributes, sizeof attributes, 0)));
  const int error = ruleset_ ? allow(ruleset(), directory, attributes.handled_access_fs) : errno;
  // Where the kernel can limit a program, none is started without a limit.
  if (error != 0)
    throw failure_of(directory.string() + ": no program can be held to it", error,
                     ExitCode::kEngine);
  allow(ruleset(), "/dev/null",
        attributes.handled_access_fs & (LANDLOCK_ACCESS_FS_WRITE_FILE | kTruncate));
}

}  // namespace lobelia

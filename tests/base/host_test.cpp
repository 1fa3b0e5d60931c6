#include "base/system/host.hpp"

#include <cerrno>
#include <system_error>

#include "base/system/no_resources.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

// In a library it is the library: tests/program/python/test_pictures.py.
TEST(Host, OwnFileIsTheProgramWhereTheCodeIsItsOwn) {
  EXPECT_EQ(own_file(), std::filesystem::read_symlink("/proc/self/exe"));
  EXPECT_EQ(build_id().size(), 40u) << "a SHA-1, as the linker makes it";
  EXPECT_EQ(build_id().find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST(Host, RefusesAThreadByAnyErrorWithoutBlameForUs) {
  // All that clone(2) lists, and a few more. std::thread throws no other words.
  for (const int error : {EAGAIN, ENOMEM, ENOSPC, EPERM, EINVAL, ENOSYS, EIO})
    EXPECT_EQ(as_error(std::system_error(error, std::generic_category())).code(),
              ExitCode::kNoResources)
        << error;
  const std::system_error waits_for_itself(EDEADLK, std::generic_category());
  EXPECT_EQ(as_error(waits_for_itself).code(), ExitCode::kInternal);
  EXPECT_EQ(as_error(std::runtime_error("No space left on device")).code(), ExitCode::kInternal);
}

}  // namespace
}  // namespace lobelia

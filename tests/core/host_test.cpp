#include "core/host.hpp"

#include <gtest/gtest.h>

namespace lobelia {
namespace {

// In a library it is the library: tests/python/test_pictures.py.
TEST(Host, OwnFileIsTheProgramWhereTheCodeIsItsOwn) {
  EXPECT_EQ(own_file(), std::filesystem::read_symlink("/proc/self/exe"));
  EXPECT_EQ(build_id().size(), 40u) << "a SHA-1, as the linker makes it";
  EXPECT_EQ(build_id().find_first_not_of("0123456789abcdef"), std::string::npos);
}

}  // namespace
}  // namespace lobelia

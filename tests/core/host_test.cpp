#include "core/host.hpp"

#include <gtest/gtest.h>

#include "core/interrupt.hpp"

namespace lobelia {
namespace {

// Of a library it is the library: tests/python/test_pictures.py.
TEST(Host, OwnFileIsTheProgramWhereTheCodeIsItsOwn) {
  EXPECT_EQ(own_file(), std::filesystem::read_symlink("/proc/self/exe"));
  EXPECT_EQ(build_id().size(), 40u) << "a SHA-1, as the linker makes it";
}

TEST(Interrupt, ARequestIsOneUntilItIsForgotten) {
  request_interrupt();
  EXPECT_TRUE(interrupted());
  EXPECT_THROW(throw_if_interrupted(), Error);
  forget_interrupt();
  EXPECT_FALSE(interrupted());
  EXPECT_NO_THROW(throw_if_interrupted());
}

}  // namespace
}  // namespace lobelia

// A power cut loses no finished file: content is flushed before a file gets its name and before anyone is told.
#include "base/system/files.hpp"
#include "tests/base/unflushed_names.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

TEST(FlushOrder, AFileIsFlushedBeforeItGetsItsName) {
  const TemporaryDirectory directory;
  const unflushed::Watch watch;
  write_file(directory.path() / "a", "a");
  EXPECT_THAT(unflushed::names, IsEmpty());
  EXPECT_EQ(unflushed::flushes, 1);
}

TEST(FlushOrder, FilesThatAreCommittedTogetherAreFlushedBefore) {
  const TemporaryDirectory directory;
  const unflushed::Watch watch;
  FilesTogether together;
  for (int i = 0; i < 40; ++i) write_file(directory.path() / std::to_string(i), "x");
  together.commit();
  EXPECT_THAT(unflushed::names, IsEmpty());
  EXPECT_EQ(std::distance(fs::directory_iterator(directory.path()), {}), 40);
}

}  // namespace
}  // namespace lobelia

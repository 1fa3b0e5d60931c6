// A power cut loses no finished file: content is flushed before a file gets its name and before anyone is told.
#include "base/system/files.hpp"
#include "base/system/group_flush.hpp"
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

TEST(FlushOrder, AGroupIsFlushedBeforeAnyoneIsToldOfIt) {
  const TemporaryDirectory directory;
  const unflushed::Watch watch;
  for (const int count : {1, 7, 8, 30}) {
    std::vector<fs::path> files;
    int told = 0;
    std::vector<std::string> lost;
    {
      GroupFlush flush({directory.path()}, [](const std::exception_ptr&) { ADD_FAILURE(); });
      if (!flush.later()) GTEST_SKIP() << "this file system's files are flushed one by one";
      for (int i = 0; i < count; ++i) {
        const auto later = flush.later();
        files.push_back(directory.path() / (std::to_string(count) + "-" + std::to_string(i)));
        write_file(files.back(), "x");
      }
      flush.add(files, [&] {
        ++told;
        const std::scoped_lock lock(unflushed::mutex);
        struct stat status {};
        for (const fs::path& file : files)
          if (::lstat(file.c_str(), &status) != 0 || !unflushed::is_flushed(status))
            lost.push_back(file.filename());
      });
    }
    EXPECT_EQ(told, 1) << count;
    EXPECT_THAT(lost, IsEmpty()) << count;
  }
}

}  // namespace
}  // namespace lobelia

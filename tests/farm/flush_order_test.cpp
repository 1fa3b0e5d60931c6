#include "farm/group_flush.hpp"
#include "farm_fixture.hpp"
#include "tests/base/unflushed_names.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

TEST_F(FarmTest, FlushesEachResultBeforeItsName) {
  const Grid some = grid("16, 32", "<engine name=\"analytic\"/>");
  const unflushed::Watch watch;
  EXPECT_EQ(run_farm(some, out(), {}).cells, 2u);
  EXPECT_GT(unflushed::flushes, 0);
  // Files in a draft may get their names early. The whole draft is flushed before it becomes a result.
  for (const std::string& name : unflushed::names)
    EXPECT_TRUE(name.ends_with(".part") && name.find("cell.json") == name.npos) << name;
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

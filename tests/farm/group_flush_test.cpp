#include "farm/group_flush.hpp"

#include <atomic>

#include "base/system/error.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

fs::path written(const GroupFlush& flush, const fs::path& path) {
  const auto later = flush.later();
  write_file(path, path.filename().string());
  return path;
}

TEST(GroupFlush, CallsEachOnceAfterAllItsFilesAreThere) {
  const TemporaryDirectory directory;
  constexpr int kThreads = 4, kEach = 200;  // together more than may wait at a time
  std::vector<std::atomic<int>> calls(kThreads * kEach);
  std::atomic<int> failures = 0;
  {
    GroupFlush flush({directory.path()}, [&](const std::exception_ptr&) { ++failures; });
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < kThreads; ++thread)
      threads.emplace_back([&, thread] {
        for (int i = thread; i < kThreads * kEach; i += kThreads) {
          const fs::path path = written(flush, directory.path() / std::to_string(i));
          flush.add({path}, [&calls, i, path] {
            if (read_file(path, 100) == std::to_string(i)) ++calls[std::size_t(i)];
          });
        }
      });
  }
  for (const auto& count : calls) EXPECT_EQ(count, 1);
  EXPECT_EQ(failures, 0);
}

TEST(GroupFlush, GoesOnAfterAFailure) {
  const TemporaryDirectory directory;
  fs::create_symlink("loop", directory.path() / "loop");
  std::atomic<int> failures = 0, calls = 0;
  const auto fails = [&](const std::exception_ptr&) { ++failures; };
  const auto is_called = [&] { ++calls; };
  GroupFlush flush({directory.path()}, fails);
  if (!flush.later()) GTEST_SKIP() << "this file system's files are flushed one by one";
  flush.add({directory.path() / "loop"}, is_called);
  flush.finish();
  EXPECT_EQ(calls, 0) << "its file could not be flushed";
  EXPECT_EQ(failures, 1);
  GroupFlush next({directory.path()}, fails);
  next.add({}, [] { throw Error(ExitCode::kOutput, "full"); });
  next.add({directory.path() / "gone"}, is_called);
  next.add({written(next, directory.path() / "a")}, is_called);
  next.finish();
  EXPECT_EQ(calls, 2) << "one that was removed is no failure of the disk";
  EXPECT_EQ(failures, 2);
}

TEST(GroupFlush, CallsAtOnceForAnotherFileSystem) {
  const std::thread::id here = std::this_thread::get_id();
  GroupFlush flush({"/proc/self"}, [](const std::exception_ptr&) {});
  EXPECT_FALSE(flush.later());
  std::thread::id caller;
  flush.add({}, [&] { caller = std::this_thread::get_id(); });
  EXPECT_EQ(caller, here);
}

}  // namespace
}  // namespace lobelia

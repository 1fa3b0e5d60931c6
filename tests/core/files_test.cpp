#include "core/files.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "core/error.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;

std::size_t entries(const fs::path& directory) {
  return std::size_t(std::distance(fs::directory_iterator(directory), fs::directory_iterator()));
}

ExitCode code_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.code();
  }
  return ExitCode::kSuccess;
}

TEST(TemporaryDirectory, OfAKilledProcessIsTakenAwayAndThoseOfTheLivingStay) {
  // A place of its own: in the system's, any farm that begins takes them away too.
  const TemporaryDirectory place;
  const char* const before = std::getenv("TMPDIR");
  const std::string system = before ? before : "";
  ::setenv("TMPDIR", place.path().c_str(), 1);
  const TemporaryDirectory ours;
  write_file(ours.path() / "a.txt", "x");
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const TemporaryDirectory theirs;
    write_file(theirs.path() / "a.txt", "x");
    const std::string& name = theirs.path().native();
    if (::write(ends[1], name.data(), name.size()) < 0) ::_exit(1);
    ::kill(::getpid(), SIGKILL);
  }
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  char name[4096] = {};
  ASSERT_GT(::read(ends[0], name, sizeof name - 1), 0);
  for (const int end : ends) ::close(end);
  ASSERT_TRUE(fs::exists(name));
  remove_abandoned_temporaries();
  EXPECT_FALSE(fs::exists(name));
  EXPECT_TRUE(fs::exists(ours.path() / "a.txt"));
  before ? ::setenv("TMPDIR", system.c_str(), 1) : ::unsetenv("TMPDIR");
}

TEST(WriteFile, ReplacesWhatWasThereAndLeavesNothingElse) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a.txt";
  write_file(path, "old");
  write_file(path, "new");
  EXPECT_EQ(read_file(path, 100), "new");
  EXPECT_EQ(entries(directory.path()), 1u);
}

TEST(WriteFile, IntoAMissingDirectoryIsAnOutputErrorThatNamesTheFile) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "no" / "a.txt";
  try {
    write_file(path, "x");
    FAIL() << "it was written";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kOutput);
    EXPECT_THAT(error.what(), testing::HasSubstr(path.string()));
  }
}

TEST(WriteFile, OverADirectoryIsAnOutputError) {
  const TemporaryDirectory directory;
  EXPECT_EQ(code_of([&] { write_file(directory.path(), "x"); }), ExitCode::kOutput);
}

TEST(WriteFile, ThroughALinkReplacesTheFileBehindIt) {
  const TemporaryDirectory directory;
  write_file(directory.path() / "real", "old");
  fs::create_symlink("real", directory.path() / "link");
  write_file(directory.path() / "link", "new");
  EXPECT_TRUE(fs::is_symlink(directory.path() / "link"));
  EXPECT_EQ(read_file(directory.path() / "real", 100), "new");
}

TEST(WriteFile, DoesNotReplaceAPipeOrADevice) {
  const TemporaryDirectory directory;
  const auto pipe = directory.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(code_of([&] { require_writable(pipe); }), ExitCode::kOutput);
  EXPECT_EQ(code_of([&] { write_file(pipe, "x"); }), ExitCode::kOutput);
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(WriteFile, WithANameThatNoSystemTakesIsAnOutputError) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / std::string(300, 'x');
  EXPECT_EQ(code_of([&] { write_file(path, "x"); }), ExitCode::kOutput);
  EXPECT_EQ(code_of([&] { require_writable(path); }), ExitCode::kOutput);
}

TEST(WriteFile, ThatDoesNotFitLeavesTheOldFileAndNoPart) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a.txt";
  write_file(path, "old");
  // In a child, because the limit cannot be raised again.
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const auto code = code_of([&] { write_file(path, std::string(5000, 'x')); });
    ::_exit(code == ExitCode::kOutput ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0) << "no output error";
  EXPECT_EQ(read_file(path, 100), "old");
  EXPECT_EQ(entries(directory.path()), 1u);
}

TEST(ReadFile, RefusesWhatIsMissingTooLongOrNoFile) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a.txt";
  write_file(path, "12345");
  EXPECT_EQ(code_of([&] { read_file(path, 4); }), ExitCode::kInput);
  EXPECT_EQ(code_of([&] { read_file(path, 5); }), ExitCode::kSuccess);
  EXPECT_EQ(code_of([&] { read_file(directory.path(), 5); }), ExitCode::kInput);
  EXPECT_EQ(code_of([&] { read_file(directory.path() / "b", 5); }), ExitCode::kInput);
}

TEST(ReadFile, DoesNotWaitForAPipe) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "pipe";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  EXPECT_EQ(code_of([&] { read_file(path, 5); }), ExitCode::kInput);
}

TEST(AbandonedFiles, GoIfTheirProcessIsGoneAndStayIfItLives) {
  const TemporaryDirectory directory;
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  int status = 0;
  ::waitpid(child, &status, 0);
  const auto dead = directory.path() / fmt::format(".a.exr.{}-0.part", child);
  const auto alive = directory.path() / fmt::format(".a.exr.{}-0.part", ::getpid());
  const auto foreign = directory.path() / ".notes.part";
  for (const auto& path : {dead, alive, foreign}) write_file(path, "x");
  remove_abandoned_files(directory.path());
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_TRUE(fs::exists(alive));
  EXPECT_TRUE(fs::exists(foreign));
}

TEST(TemporaryDirectories, GoWithEverythingInThem) {
  fs::path path;
  {
    const TemporaryDirectory directory;
    path = directory.path();
    write_file(path / "a", "x");
  }
  EXPECT_FALSE(fs::exists(path));
}

}  // namespace
}  // namespace lobelia

#include "base/system/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "base/system/error.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/removal.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

std::size_t entries(const fs::path& directory) {
  return std::size_t(std::distance(fs::directory_iterator(directory), fs::directory_iterator()));
}

ExitCode code_of(const std::function<void()>& action) { return thrown_by(action).code(); }

TEST(WriteFile, FailsWithTheNameWhereNoFileCanBe) {
  const TemporaryDirectory directory;
  const fs::path here = directory.path(), pipe = here / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const fs::path& wrong : {here / "no" / "a.txt", here, pipe, here / std::string(300, 'x')}) {
    EXPECT_EQ(code_of([&] { require_writable(wrong); }), ExitCode::kOutput) << wrong;
    EXPECT_THAT(error_words(ExitCode::kOutput, [&] { write_file(wrong, "x"); }),
                testing::HasSubstr(wrong.string()));
  }
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(entries(here), 1u);
}

TEST(WriteFile, ReplacesTheFileBehindALink) {
  const TemporaryDirectory directory;
  write_file(directory.path() / "real", "old");
  fs::create_symlink("real", directory.path() / "link");
  write_file(directory.path() / "link", "new");
  EXPECT_TRUE(fs::is_symlink(directory.path() / "link"));
  EXPECT_EQ(read_file(directory.path() / "real", 100), "new");
}

TEST(WriteFile, ReplacesALinkThatStandsInPlaceOfANameOfOurs) {
  const TemporaryDirectory directory, other;
  write_file(other.path() / "real", "old");
  for (const fs::path& target : {other.path() / "real", other.path(), fs::path("nowhere")}) {
    fs::create_symlink(target, directory.path() / "link");
    write_file(directory.path() / "link", "new", AtLink::kReplace);
    EXPECT_FALSE(fs::is_symlink(directory.path() / "link")) << target;
    EXPECT_EQ(read_file(directory.path() / "link", 100), "new") << target;
    fs::remove(directory.path() / "link");
  }
  EXPECT_EQ(read_file(other.path() / "real", 100), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(other.path()), {}), 1);
}

TEST(InputFile, KnowsWhereItLiesWhateverPathLedThere) {
  const TemporaryDirectory directory;
  const fs::path here = fs::canonical(directory.path());
  fs::create_directories(here / "a/b");
  write_file(here / "file", "x");
  write_file(here / "a/file", "y");
  fs::create_directory_symlink("a/b", here / "link");
  // By its text the path is that of the other file.
  EXPECT_EQ(InputFile(here / "link/../file").real_path(), here / "a/file");
  const InputFile open(here / "link/../file");
  write_file(here / "new", "z");
  fs::rename(here / "new", here / "a/file");
  EXPECT_EQ(code_of([&] { std::ignore = open.real_path(); }), ExitCode::kInput);
  EXPECT_EQ(read_file(open, 10), "y");
}

TEST(ReadFile, EndsAtAnInterruptionOnlyIfTheFileIsLarge) {
  const TemporaryDirectory directory;
  const fs::path small = directory.path() / "small", large = directory.path() / "large";
  for (const fs::path& file : {small, large}) write_file(file, "");
  fs::resize_file(small, kBytesBetweenLooks);
  fs::resize_file(large, kBytesBetweenLooks + 1);
  const auto read = [](const fs::path& file) { read_file(file, 2 * kBytesBetweenLooks); };
  request_interrupt();
  EXPECT_EQ(code_of([&] { read(small); }), ExitCode::kSuccess);
  EXPECT_EQ(code_of([&] { read(large); }), ExitCode::kInterrupted);
  {
    const Uninterrupted to_the_end;
    EXPECT_EQ(code_of([&] { read(large); }), ExitCode::kSuccess);
  }
  forget_interrupt();
}

TEST(RequireWritable, NeedsAnExistingWritableDirectory) {
  const TemporaryDirectory directory;
  const fs::path here = directory.path();
  require_writable(here / "new");
  EXPECT_EQ(entries(here), 0u);
  write_file(here / "old", "old");
  require_writable(here / "old");
  EXPECT_EQ(read_file(here / "old", 100), "old");
  EXPECT_EQ(entries(here), 1u);
  for (const fs::path& wrong : {here / "old" / "new", here / ""})
    EXPECT_EQ(code_of([&] { require_writable(wrong); }), ExitCode::kOutput) << wrong;
}

TEST(RequireWritable, RefusesARemovedCurrentDirectory) {
  const fs::path before = fs::current_path();
  for (const fs::path& parent : {fs::temp_directory_path(), fs::path("/dev/shm")}) {
    if (!fs::is_directory(parent)) continue;
    const TemporaryDirectory directory(parent);
    fs::create_directory(directory.path() / "here");
    fs::current_path(directory.path() / "here");
    fs::remove(directory.path() / "here");
    EXPECT_EQ(code_of([] { require_writable("new"); }), ExitCode::kOutput) << parent;
    fs::current_path(before);
  }
}

TEST(PartFile, HoldsContentWrittenInPiecesOfAnySize) {
  const TemporaryDirectory directory;
  std::mt19937 random;
  const auto up_to = [&](std::size_t most) { return random() % (most + 1); };
  // Small ones are written together, and large ones alone.
  const auto piece = [&](std::size_t most) {
    std::vector<std::uint8_t> bytes(up_to(most));
    for (std::uint8_t& byte : bytes) byte = std::uint8_t(random());
    return bytes;
  };
  for (int file = 0; file < 20; ++file) {
    std::string expected;
    PartFile part(directory.path() / "whole");
    for (int step = 0; step < 60; ++step) {
      if (const std::size_t what = up_to(9); what == 0) {
        EXPECT_EQ(read_file(part.part(), 10'000'000), expected);
      } else if (what <= 2) {
        const auto bytes = piece(std::min<std::size_t>(expected.size(), 40'000));
        const std::size_t at = up_to(expected.size() - bytes.size());
        part.write_at(at, bytes);
        std::ranges::copy(bytes, expected.begin() + std::ptrdiff_t(at));
      } else {
        const auto bytes = piece(what == 3 ? 40'000 : 300);
        part.append(bytes);
        expected.append(bytes.begin(), bytes.end());
      }
      EXPECT_EQ(part.size(), expected.size());
    }
    part.finish();
    EXPECT_EQ(read_file(directory.path() / "whole", 10'000'000), expected);
  }
}

TEST(PartFile, TakesTheContentOfAnotherFile) {
  const TemporaryDirectory directory;
  const std::string text(600'000, 'x');
  write_file(directory.path() / "from", text);
  PartFile part(directory.path() / "to");
  part.append("before ");
  part.append_file(directory.path() / "from");
  EXPECT_EQ(code_of([&] { part.append_file(directory.path() / "gone"); }), ExitCode::kInput);
  EXPECT_EQ(code_of([&] { part.append_file(directory.path()); }), ExitCode::kInput);
  part.append(" after");
  part.finish();
  EXPECT_EQ(read_file(directory.path() / "to", 1'000'000), "before " + text + " after");
}

TEST(WriteFile, KeepsTheOldFileIfTheNewOneDoesNotFit) {
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

TEST(ReadFile, RefusesMissingOrTooLongFiles) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a.txt", pipe = directory.path() / "pipe";
  write_file(path, "12345");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(code_of([&] { read_file(path, 4); }), ExitCode::kInput);
  EXPECT_EQ(code_of([&] { read_file(path, 5); }), ExitCode::kSuccess);
  EXPECT_EQ(code_of([&] { read_file(directory.path(), 5); }), ExitCode::kInput);
  EXPECT_EQ(code_of([&] { read_file(directory.path() / "b", 5); }), ExitCode::kInput);
  EXPECT_EQ(code_of([&] { read_file(pipe, 5); }), ExitCode::kInput);
}

TEST(AbandonedFiles, GoIfTheirProcessIsGoneAndStayIfItLives) {
  const TemporaryDirectory directory;
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  int status = 0;
  ::waitpid(child, &status, 0);
  const auto dead = directory.path() / fmt::format(".a.exr.{}-0.part", child);
  const auto earlier = directory.path() / fmt::format(".a.exr.{}-0.part", ::getpid());
  const auto reused = directory.path() / ".a.exr.1-0.part";
  const auto alive = part_path(directory.path() / "a.exr");
  const auto foreign = directory.path() / ".notes.part";
  for (const auto& path : {dead, earlier, reused, alive, foreign}) write_file(path, "x");
  const auto other = directory.path() / fmt::format(".b.a.exr.{}-0.part", child);
  write_file(other, "x");
  require_writable(directory.path() / "a.exr");
  EXPECT_FALSE(fs::exists(dead)) << "before the file is written again";
  EXPECT_FALSE(fs::exists(earlier)) << "of an earlier process with our PID, as in a container";
  EXPECT_FALSE(fs::exists(reused)) << "of an earlier process with a PID that another one has now";
  EXPECT_TRUE(fs::exists(other)) << "of another file";
  remove_abandoned_parts(HeldDirectory(directory.path()), {"b.exr", "a.exr"});
  EXPECT_TRUE(fs::exists(other)) << "of none of these files";
  remove_abandoned_parts(HeldDirectory(directory.path()));
  EXPECT_FALSE(fs::exists(other));
  EXPECT_TRUE(fs::exists(alive));
  EXPECT_TRUE(fs::exists(foreign));
}

TEST(AbandonedFiles, GoWhereNobodyAsksForTheProcessThatWasKilled) {
  const TemporaryDirectory directory;
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    PartFile half(directory.path() / "a.exr");
    const char byte = 0;
    ::_exit(::write(ready[1], &byte, 1) == 1 && ::pause() == 0 ? 0 : 1);
  }
  char byte = 1;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_EQ(entries(directory.path()), 1u);
  remove_abandoned_parts(HeldDirectory(directory.path()));
  EXPECT_EQ(entries(directory.path()), 1u) << "it lives";
  ::kill(child, SIGKILL);
  siginfo_t end;
  ASSERT_EQ(::waitid(P_PID, id_t(child), &end, WEXITED | WNOWAIT), 0);
  remove_abandoned_parts(HeldDirectory(directory.path()));
  EXPECT_EQ(entries(directory.path()), 0u);
  ::waitpid(child, nullptr, 0);
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST(FilesTogether, AreLockedUntilTheyHaveTheirNames) {
  const TemporaryDirectory directory;
  FilesTogether files;
  constexpr std::size_t kMany = 40;
  for (std::size_t i = 0; i < kMany; ++i)
    write_file(directory.path() / fmt::format("{}.exr", i), "new");
  std::size_t parts = 0;
  for (const auto& entry : fs::directory_iterator(directory.path())) {
    const Descriptor part(::open(entry.path().c_str(), O_RDONLY | O_CLOEXEC));
    EXPECT_NE(::flock(part.get(), LOCK_EX | LOCK_NB), 0)
        << entry.path() << ": a container that does not see this process would remove it";
    ++parts;
  }
  EXPECT_EQ(parts, kMany);
  files.commit();
}

TEST(FilesTogether, HaveTheirNamesOnceAllAreThereAndElseNone) {
  const TemporaryDirectory directory;
  write_file(directory.path() / "a", "old");
  {
    FilesTogether files;
    write_file(directory.path() / "a", "new");
    write_file(directory.path() / "b", "new");
    EXPECT_EQ(read_file(directory.path() / "a", 10), "old");
    EXPECT_FALSE(fs::exists(directory.path() / "b"));
  }
  EXPECT_EQ(entries(directory.path()), 1u) << "nothing was given its name";
  EXPECT_EQ(read_file(directory.path() / "a", 10), "old");
  FilesTogether files;
  write_file(directory.path() / "a", "new");
  write_file(directory.path() / "b", "new");
  files.commit();
  EXPECT_EQ(read_file(directory.path() / "a", 10), "new");
  EXPECT_EQ(read_file(directory.path() / "b", 10), "new");
  EXPECT_EQ(entries(directory.path()), 2u);
}

TEST(AProcessThatEndsSoonAfterASignal, LeavesNoTemporaryFileWhateverItIsDoing) {
  // Not a TemporaryDirectory: the child would know of it and remove it with its own.
  std::string name = fs::temp_directory_path() / "lobelia-signals-XXXXXX";
  ASSERT_NE(::mkdtemp(name.data()), nullptr);
  const fs::path place = name;
  std::mt19937 random(4);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGTERM, SIGINT, SIGHUP}) {
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      ::setenv("TMPDIR", place.c_str(), 1);
      ::dup2(::open("/dev/null", O_WRONLY), 2);  // not closed: a file would get its number
      catch_interrupts();
      end_soon_when_interrupted();
      const auto work = [&](int number) {
        try {
          for (;;) {
            const TemporaryDirectory inner;
            write_file(inner.path() / "x", "x");
            PartFile half(place / fmt::format("half{}", number));
            half.append(std::vector<std::uint8_t>(1000));
            require_writable(place / "asked");
          }
        } catch (const Error&) {
          for (;;) ::pause();  // its directory was removed under it: the end is near
        }
      };
      std::vector<std::thread> threads;
      for (int i = 0; i < 3; ++i) threads.emplace_back(work, i);
      if (::write(ready[1], "x", 1) < 0) ::_exit(1);
      for (std::thread& thread : threads) thread.join();
    }
    char byte = 0;
    ASSERT_EQ(::read(ready[0], &byte, 1), 1);
    for (const int end : ready) ::close(end);
    ::usleep(useconds_t(random() % 100'000));
    ::kill(child, signal);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status)) << "by signal " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 128 + signal);
    EXPECT_EQ(entries(place), 0u);
  }
  fs::remove_all(place);
}

}  // namespace
}  // namespace lobelia

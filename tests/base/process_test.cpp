#include "base/system/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <future>

#include "base/pictures/image_io_module.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/keeper_protocol.hpp"
#include "base/system/spawn.hpp"
#include "base/system/write_limit.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

using std::chrono::seconds;

std::vector<std::string> shell(const std::string& script) { return {"/bin/sh", "-c", script}; }

TEST(Process, ReportsItsExitCodeAndItsOutputLineByLine) {
  std::vector<std::string> lines;
  ProcessOptions options;
  options.on_line = [&](std::string_view line) { lines.emplace_back(line); };
  const auto result = run_process(shell("echo one; echo two >&2; printf three; exit 7"), options);
  EXPECT_EQ(result.exit_code, 7);
  EXPECT_EQ(lines, (std::vector<std::string>{"one", "two", "three"}));
  EXPECT_EQ(result.output_tail, "one\ntwo\nthree");
}

TEST(Process, IsKilledAfterItsTime) {
  ProcessOptions options;
  options.timeout = std::chrono::milliseconds(300);
  const auto result = run_process(shell("sleep 1000"), options);
  EXPECT_TRUE(result.timed_out);
  EXPECT_FALSE(result.no_progress);
}

TEST(Process, IsKilledEarlyWithoutAnySignOfProgress) {
  ProcessOptions options;
  options.no_progress_limit = seconds(5);  // enough to begin on a busy machine
  const auto silent = run_process(shell("echo begun; sleep 1000"), options);
  EXPECT_TRUE(silent.no_progress);
  EXPECT_FALSE(silent.timed_out);
  EXPECT_EQ(silent.output_tail, "begun\n");
}

TEST(Process, IsNotTakenForHangingWhileItTalksOrWrites) {
  // For longer than the limit in all; those that it must stop go on for ever.
  const std::string for_a_while = "for i in $(seq 12)", for_ever = "while :";
  const auto hangs = [](bool watched, const std::string& loop, const std::string& action) {
    return std::async(std::launch::async, [watched, loop, action] {
      const TemporaryDirectory directory;
      write_file(directory.path() / "old", "x");
      ProcessOptions options;
      options.working_directory = directory.path();
      options.no_progress_limit = seconds(8);
      if (watched) options.progress_directory = directory.path();
      return run_process(shell(fmt::format("{}; do sleep 0.8; {}; done", loop, action)), options)
          .no_progress;
    });
  };
  auto talks = hangs(false, for_a_while, "echo");
  auto unwatched = hangs(false, for_ever, "echo >> growing");
  auto grows = hangs(true, for_a_while, "echo >> growing");
  auto makes = hangs(true, for_a_while, "mkdir -p a/$i");
  // A clock that is set back must not look like rest: every time is another, though an earlier one.
  auto set_back = hangs(true, for_a_while, "touch -d \"2001-01-01 00:00:$((59 - i))\" old");
  auto reads = hangs(true, for_ever, "cat old > /dev/null");
  EXPECT_FALSE(talks.get());
  EXPECT_FALSE(grows.get());
  EXPECT_FALSE(makes.get());
  EXPECT_FALSE(set_back.get());
  EXPECT_TRUE(unwatched.get());
  EXPECT_TRUE(reads.get());
}

TEST(Process, CountsTheTimeOfItsChildren) {
  // Our peak is not theirs, though the kernel hands it on to each program that is started.
  ASSERT_NE(std::string(256 << 20, 'x'), "");
  const auto idle = run_process(shell("sleep 0.3"), {});
  EXPECT_LT(idle.cpu_seconds, idle.seconds);
  // 64 MiB held by a child of the shell, which works until it has used a second.
  const auto busy = run_process(
      shell(
          "(x=$(head -c 67108864 /dev/zero | tr '\\0' x); ulimit -t 1; while :; do :; done); exit 0"),
      {});
  EXPECT_EQ(busy.exit_code, 0);
  EXPECT_GT(busy.cpu_seconds, 0.5);
  EXPECT_GT(busy.peak_memory_bytes, 67108864u);
  EXPECT_LT(busy.peak_memory_bytes, std::uint64_t{1} << 32);
  EXPECT_LT(idle.peak_memory_bytes, 67108864u);
}

TEST(Process, ReadsOnlyItsGivenInput) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ASSERT_EQ(::write(ends[1], "words\n", 6), 6);
  ::close(ends[1]);
  ProcessOptions options;
  options.input = ends[0];
  EXPECT_EQ(run_process({"/bin/cat"}, options).output_tail, "words\n");
  ::close(ends[0]);
  EXPECT_EQ(run_process({"/bin/cat"}, {}).output_tail, "");
}

TEST(Process, IsKilledWhenItsCallerWantsItStopped) {
  std::atomic<bool> stop = false;
  ProcessOptions options;
  options.stop = &stop;
  options.on_line = [&](std::string_view) { stop = true; };
  const auto result = run_process(shell("echo go; sleep 60"), options);
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.exit_code, 128 + 9);
}

TEST(Process, SaysInAnEngineErrorWhyItCannotBeStarted) {
  const auto why = [](const std::string& program, const ProcessOptions& options) {
    return error_words(ExitCode::kEngine, [&] { run_process({program}, options); });
  };
  EXPECT_EQ(why("/no/such/program", {}),
            "/no/such/program: cannot be started: No such file or directory");
  EXPECT_EQ(why("/etc/passwd", {}), "/etc/passwd: cannot be started: Permission denied");
  ProcessOptions nowhere;
  nowhere.working_directory = "/etc/passwd";
  EXPECT_EQ(why("/bin/true", nowhere), "/bin/true: cannot be started: Not a directory");
}

/// A program's own words on its signals: the lines SigBlk and SigIgn of its status.
std::string signals_of(const ProcessOptions& options) {
  return run_process({"/bin/grep", "-E", "SigBlk|SigIgn", "/proc/self/status"}, options)
      .output_tail;
}

TEST(Process, IgnoresAndBlocksTheSignalsThatWeDo) {
  for (const int signal : {SIGINT, SIGQUIT})
    std::signal(signal, SIG_DFL);  // & of a shell ignores them
  EXPECT_EQ(signals_of({}), "SigBlk:\t0000000000000000\nSigIgn:\t0000000000000000\n");
  const auto handler = std::signal(SIGUSR1, [](int) {});
  const auto ignored = std::signal(SIGUSR2, SIG_IGN);
  sigset_t blocked, before;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &blocked, &before);
  EXPECT_EQ(signals_of({}), "SigBlk:\t0000000000004000\nSigIgn:\t0000000000000800\n");
  sigset_t now;
  pthread_sigmask(SIG_SETMASK, &before, &now);
  EXPECT_TRUE(sigismember(&now, SIGTERM));
  EXPECT_FALSE(sigismember(&now, SIGINT)) << "ours is as it was";
  struct sigaction ours {};
  sigaction(SIGUSR1, nullptr, &ours);
  EXPECT_NE(ours.sa_handler, SIG_DFL) << "so are our handlers";
  std::signal(SIGUSR1, handler);
  std::signal(SIGUSR2, ignored);
}

/// A program that wants to live on, in every way that is known to have worked.
constexpr char kClinging[] =
    "exec 3<&0\n"  // whatever lives has it open
    "sh -c 'sleep 1000; :' &\n"
    "(setsid sh -c 'sleep 1000 & sleep 1000 &' &)\n"
    "(trap '' TERM HUP INT; sleep 1000; :) &\n"
    "flee() { flee & }\n"
    "flee &\n"
    "echo begun\n";

enum class Rights { kOurs, kWithoutNamespace };

/// In a process of its own, whose status this returns, with what is left of the rights. It begins when we have closed
/// `theirs`.
int in_child(Rights rights, const std::function<void()>& work, int theirs = -1) {
  int begin[2];
  EXPECT_EQ(::pipe2(begin, O_CLOEXEC), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(begin[1]);
    char nothing;
    EXPECT_EQ(::read(begin[0], &nothing, 1), 0);
    if (rights == Rights::kWithoutNamespace) ::setenv("LOBELIA_NO_NAMESPACE", "1", 1);
    try {
      work();
    } catch (const std::exception& error) {
      fmt::print(stderr, "{}\n", error.what());
      ::_exit(98);
    }
    ::_exit(0);
  }
  if (theirs >= 0) ::close(theirs);
  for (const int end : begin) ::close(end);
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return status;
}

class Contained : public testing::TestWithParam<Rights> {
 protected:
  /// Whether nothing of the program is there once the process that has run it is gone, killed or not.
  static bool leaves_nothing(const std::string& script,
                             const std::function<void(ProcessOptions&)>& change) {
    int ends[2];
    EXPECT_EQ(::pipe2(ends, O_CLOEXEC), 0);
    const int status = in_child(
        GetParam(),
        [&] {
          ProcessOptions options;
          options.input = ends[0];
          change(options);
          try {
            run_process(shell(script), options);
          } catch (const Error&) {  // it was never there
            throw;
          } catch (const std::runtime_error&) {  // of on_line
          }
          // Not only soon: when run_process returns.
          ::close(ends[0]);
          pollfd writer{ends[1], 0, 0};
          if (::poll(&writer, 1, 0) != 1) ::_exit(1);
        },
        ends[0]);
    pollfd writer{ends[1], 0, 0};
    const bool ended = ::poll(&writer, 1, 600'000) == 1;
    ::close(ends[1]);
    return ended && (WIFSIGNALED(status) || WEXITSTATUS(status) == 0);
  }
};

TEST_P(Contained, LeavesNothingHoweverItEnds) {
  using Change = void (*)(ProcessOptions&);
  const std::tuple<const char*, std::string, Change> cases[] = {
      {"by itself", "", [](ProcessOptions&) {}},
      {"at a time-out", "sleep 1000",
       [](ProcessOptions& options) { options.timeout = std::chrono::milliseconds(300); }},
      {"when its reader throws", "sleep 1000",
       [](ProcessOptions& options) {
         options.on_line = [](std::string_view) { throw std::runtime_error("no more"); };
       }},
      {"at Ctrl-C", "sleep 1000",
       [](ProcessOptions& options) {
         catch_interrupts();
         options.on_line = [](std::string_view) { std::raise(SIGINT); };
       }},
      {"at a second Ctrl-C", "sleep 1000",
       [](ProcessOptions& options) {
         catch_interrupts();
         options.on_line = [](std::string_view) {
           std::raise(SIGINT);
           ::usleep(400'000);  // sooner it is taken for the same one
           std::raise(SIGINT);
         };
       }},
      {"when we are killed", "sleep 1000", [](ProcessOptions& options) {
         options.on_line = [](std::string_view) { ::kill(::getpid(), SIGKILL); };
       }}};
  for (const auto& [how, more, change] : cases)
    EXPECT_TRUE(leaves_nothing(kClinging + more, change)) << how;
}

TEST_P(Contained, EndsAsItDoesAloneWithAllThatItTook) {
  EXPECT_EQ(
      in_child(GetParam(),
               [] {
                 Containment contained = Containment::kNone;
                 ProcessOptions options;
                 options.on_start = [&](const ProcessLimits& limits) {
                   contained = limits.contained;
                 };
                 // The processor time of one that has left it counts as well. It ends after a second
                 // of that, and $() with it.
                 const auto busy = run_process(
                     shell("ended=$(setsid sh -c 'ulimit -t 1; while :; do :; done' &); exit 7"),
                     options);
                 EXPECT_EQ(busy.exit_code, 7);
                 EXPECT_GT(busy.cpu_seconds, 0.5);
                 EXPECT_NE(contained, Containment::kNone);
                 EXPECT_EQ(run_process(shell("kill -ALRM $$"), {}).exit_code, 128 + SIGALRM);
                 EXPECT_EQ(run_process({"/bin/cat", "/no/such"}, {}).exit_code, 1);
                 if (testing::Test::HasFailure()) ::_exit(1);
               }),
      0);
}

TEST_P(Contained, IsOverIfItKillsItsKeeper) {
  const int status = in_child(GetParam(), [] {
    const auto result = run_process(shell("kill -9 $PPID; exit 3"), {});
    ::_exit(result.exit_code);
  });
  // Process 1 of a namespace cannot be killed from inside.
  EXPECT_THAT(WEXITSTATUS(status), testing::AnyOf(3, 128 + SIGKILL));
}

INSTANTIATE_TEST_SUITE_P(Process, Contained,
                         testing::Values(Rights::kOurs, Rights::kWithoutNamespace));

TEST(Process, IsContainedForAUserWithoutAnyRights) {
  if (::geteuid() != 0) GTEST_SKIP() << "the other tests are those of such a user";
  // Runs copies: nobody may enter the directory of the build.
  const TemporaryDirectory directory;
  std::filesystem::permissions(directory.path(), std::filesystem::perms(0755));
  const auto test = std::filesystem::read_symlink("/proc/self/exe");
  for (const auto& file : {test, companion_file(kKeeperFile)})
    std::filesystem::copy(file, directory.path());
  ProcessOptions options;
  options.uninterruptible = true;  // without a keeper, which would be contained itself
  const auto result =
      run_process({find_program("setpriv"), "--reuid=65534", "--regid=65534", "--clear-groups",
                   directory.path() / test.filename(), "--gtest_filter=Process/Contained.*"},
                  options);
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_THAT(result.output_tail, testing::HasSubstr("[  PASSED  ] 6 tests"));
}

TEST(Process, GoesOnWithoutUsIfItMustNotBeCutInTwo) {
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  in_child(
      Rights::kOurs,
      [&] {
        ProcessOptions options;
        options.input = ends[0];
        options.uninterruptible = true;
        options.on_line = [](std::string_view) { ::kill(::getpid(), SIGKILL); };
        run_process(shell("echo begun; read end"), options);
      },
      ends[0]);
  pollfd writer{ends[1], 0, 0};
  EXPECT_EQ(::poll(&writer, 1, 300), 0) << "it is gone";
  ::close(ends[1]);
}

TEST(Process, WritesNowhereButWhereItMay) {
  const TemporaryDirectory own, other;
  write_file(other.path() / "there", "as it was");
  ProcessOptions options;
  options.working_directory = own.path();
  options.writable = own.path();
  bool limited = false;
  options.on_start = [&](const ProcessLimits& limits) { limited = limits.writes_limited; };
  options.environment = {"OTHER=" + other.path().string()};
  const auto result = run_process(
      shell(
          "echo mine > mine; mkdir d; mv mine d; cp d/mine d/copy; echo x > /dev/null && echo null is free; "
          "echo x > \"$OTHER/new\"; echo x >> \"$OTHER/there\"; rm -f \"$OTHER/there\"; "
          "mkdir \"$OTHER/d\"; mv d/copy \"$OTHER\"; ln -s x \"$OTHER/link\"; "
          "ln -s \"$OTHER/there\" way-out; (echo x > way-out); cat way-out"),
      options);
  EXPECT_EQ(read_file(own.path() / "d/mine", 100), "mine\n");
  EXPECT_THAT(result.output_tail, testing::HasSubstr("null is free\n"));
  const bool can_limit = WriteLimit(own.path()).ruleset() >= 0;
  EXPECT_EQ(limited, can_limit);
  if (!can_limit) GTEST_SKIP() << "this kernel has no Landlock to limit writing with";
  EXPECT_TRUE(result.output_tail.ends_with("as it was")) << "reading is free";
  EXPECT_EQ(read_file(other.path() / "there", 100), "as it was");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(other.path()), {}), 1);
  write_file(other.path() / "ours", "we are not limited ourselves");
}

TEST(Process, IsHeldToItsDirectoryWhateverNumberTheLimitHas) {
  const TemporaryDirectory own, other;
  if (WriteLimit(own.path()).ruleset() < 0)
    GTEST_SKIP() << "this kernel has no Landlock to limit writing with";
  // The number at which a keeper gets its line.
  constexpr int kLine = 3;
  const int before = ::fcntl(kLine, F_DUPFD_CLOEXEC, 10);
  ::close(kLine);
  {
    const WriteLimit limit(own.path());
    ASSERT_EQ(limit.ruleset(), kLine);
    const int null = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    const auto written = (other.path() / "new").string();
    const Spawned child = spawn({.arguments = {"/bin/sh", "-c", "echo x > \"$0\"", written},
                                 .environment = {},
                                 .working_directory = own.path(),
                                 .output = null,
                                 .limit = &limit,
                                 .keeper_line = null});
    ::waitpid(child.pid, nullptr, 0);
    ::close(null);
    EXPECT_TRUE(child.writes_limited);
    EXPECT_FALSE(std::filesystem::exists(written));
  }
  if (before >= 0) {
    ::dup2(before, kLine);
    ::close(before);
  }
}

TEST(Process, IsNotStartedWhereItCannotBeHeldToItsDirectory) {
  const TemporaryDirectory own;
  if (WriteLimit(own.path()).ruleset() < 0)
    GTEST_SKIP() << "this kernel has no Landlock to limit writing with";
  ProcessOptions options;
  options.writable = own.path() / "gone";
  EXPECT_THROW(run_process({"/bin/true"}, options), Error);
}

TEST(Process, ManyLinesAreAllSeenAndTheTailIsBounded) {
  std::size_t count = 0;
  ProcessOptions options;
  options.on_line = [&](std::string_view) { ++count; };
  const auto result = run_process(shell("seq 100000"), options);
  EXPECT_EQ(count, 100000u);
  EXPECT_LE(result.output_tail.size(), 4096u);
  EXPECT_TRUE(result.output_tail.ends_with("99999\n100000\n"));
}

TEST(Programs, AreFoundInThePathOrByTheirOwn) {
  EXPECT_FALSE(find_program("sh").empty());
  EXPECT_EQ(find_program("/bin/sh"), "/bin/sh");
  EXPECT_TRUE(find_program("no-such-program-anywhere").empty());
  EXPECT_TRUE(find_program("/etc/passwd").empty());
}

}  // namespace
}  // namespace lobelia

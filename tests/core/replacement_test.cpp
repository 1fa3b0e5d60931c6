// Replacing files of a folder: all or none, whatever fails or ends the process, and back again.
#include "core/replacement.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/replacement_journal.hpp"

// Stands between this program and the C library, and counts the calls that change files.
namespace lobelia::faults {

enum class Kind {
  kOnce,        ///< one call fails
  kFromThenOn,  ///< and all after it
  kKill,        ///< one ends the process
  kMeanwhile    ///< before one, but no rename, somebody else does something
};

inline Kind kind = Kind::kOnce;
inline int at = 0, calls = 0;  ///< the call that is meant, 0 for none; and how many there were
inline bool no_hard_links = false;
inline std::function<void()> meanwhile;

/// While it lives, the fault is there.
class Fault {
 public:
  Fault(Kind wanted, int call) {
    kind = wanted;
    calls = 0;
    at = call;
  }
  ~Fault() { at = 0; }
  Fault(const Fault&) = delete;
  Fault& operator=(const Fault&) = delete;
};

/// Whether this call fails.
inline bool strikes(bool is_rename = false) {
  if (at == 0 || (is_rename && kind == Kind::kMeanwhile)) return false;
  ++calls;
  if (kind == Kind::kFromThenOn ? calls < at : calls != at) return false;
  if (kind == Kind::kMeanwhile) {
    at = 0;
    meanwhile();
    return false;
  }
  while (kind == Kind::kKill) ::kill(::getpid(), SIGKILL);
  errno = EIO;
  return true;
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace lobelia::faults

extern "C" {
int renameat(int there, const char* from, int here, const char* to) noexcept {
  static const auto call =
      lobelia::faults::real<int(int, const char*, int, const char*)>("renameat");
  return lobelia::faults::strikes(true) ? -1 : call(there, from, here, to);
}
int linkat(int there, const char* from, int here, const char* to, int flags) noexcept {
  static const auto call =
      lobelia::faults::real<int(int, const char*, int, const char*, int)>("linkat");
  if (lobelia::faults::no_hard_links) errno = EPERM;
  return lobelia::faults::no_hard_links || lobelia::faults::strikes()
             ? -1
             : call(there, from, here, to, flags);
}
int unlinkat(int there, const char* name, int flags) noexcept {
  static const auto call = lobelia::faults::real<int(int, const char*, int)>("unlinkat");
  return lobelia::faults::strikes() ? -1 : call(there, name, flags);
}
int mkdirat(int there, const char* name, mode_t mode) noexcept {
  static const auto call = lobelia::faults::real<int(int, const char*, mode_t)>("mkdirat");
  return lobelia::faults::strikes() ? -1 : call(there, name, mode);
}
int fchmod(int file, mode_t mode) noexcept {
  static const auto call = lobelia::faults::real<int(int, mode_t)>("fchmod");
  return lobelia::faults::strikes() ? -1 : call(file, mode);
}
ssize_t write(int file, const void* bytes, size_t size) {
  static const auto call = lobelia::faults::real<ssize_t(int, const void*, size_t)>("write");
  return lobelia::faults::strikes() ? -1 : call(file, bytes, size);
}
int fsync(int) { return lobelia::faults::strikes() ? -1 : 0; }  // no test cuts the power
}

namespace lobelia {
namespace {

using faults::Fault;
using faults::Kind;
using testing::AnyOf;
using testing::Eq;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

using Texts = std::map<std::string, std::string>;  ///< by path

const Texts kOld{{"a.exr", "old a"}, {"sub/b.exr", "old b"}};
const Texts kNew{{"a.exr", "new a"}, {"made/here/c.exr", "new c"}, {"sub/b.exr", "new b"}};

/// No loop over the calls of a replacement is longer.
constexpr int kMostCalls = 300;

class ReplacementTest : public testing::Test {
 protected:
  ReplacementTest() {
    for (const char* letter : {"a", "b", "c"})
      put(fmt::format("mine/{}.exr", letter), fmt::format("new {}", letter));
    begin_anew();
  }
  ~ReplacementTest() override { faults::no_hard_links = false; }

  fs::path path(const std::string& name) const { return directory_.path() / name; }
  fs::path refs() const { return path("refs"); }
  fs::path ours(const std::string& name) const { return refs() / kReplacedName / name; }
  void put(const std::string& name, const std::string& text) const {
    fs::create_directories(path(name).parent_path());
    write_file(path(name), text);
  }
  void begin_anew() const {
    fs::remove_all(refs());
    for (const auto& [name, text] : kOld) put("refs/" + name, text);
    fs::permissions(refs() / "a.exr", fs::perms(0600));
  }
  Replacement replacement(const std::string& letter, const std::string& to,
                          const std::optional<std::string>& before) const {
    Replacement one{path("mine/" + letter + ".exr"), sha256("new " + letter), to, {}};
    if (before) one.before = sha256(*before);
    return one;
  }
  std::vector<Replacement> three() const {
    return {replacement("a", "a.exr", "old a"), replacement("b", "sub/b.exr", "old b"),
            replacement("c", "made/here/c.exr", std::nullopt)};
  }
  /// All files but ours.
  Texts texts() const {
    Texts found;
    for (fs::recursive_directory_iterator entry(refs()), end; entry != end; ++entry)
      if (entry->path().filename() == kReplacedName)
        entry.disable_recursion_pending();
      else if (entry->is_regular_file())
        found[entry->path().lexically_relative(refs()).string()] = read_file(entry->path(), 1000);
    return found;
  }
  unsigned mode(const std::string& name) const {
    struct stat status {};
    EXPECT_EQ(::lstat((refs() / name).c_str(), &status), 0);
    return status.st_mode & 07777u;
  }
  /// All are old or all are new, and no stage is left but the last one.
  void expect_all_or_none() const {
    EXPECT_THAT(texts(), AnyOf(Eq(kOld), Eq(kNew)));
    EXPECT_EQ(mode("a.exr"), 0600u);
    for (const char* stage : {"now", "back"}) EXPECT_FALSE(fs::exists(ours(stage))) << stage;
  }
  /// The same command again.
  void expect_replaced_by_the_next_try() const {
    if (texts() == kOld) replace(three());
    EXPECT_EQ(texts(), kNew);
    EXPECT_FALSE(fs::exists(ours("next")));
    undo_replacement(refs());
    EXPECT_EQ(texts(), kOld);
  }
  /// In a process of its own, which may be killed. Whether it ended by itself.
  template <class Work>
  static bool ends(int call, Work work) {
    const pid_t child = ::fork();
    if (child == 0) {
      const Fault fault(Kind::kKill, call);
      try {
        work();
      } catch (const Error&) {
        ::_exit(1);
      }
      ::_exit(0);
    }
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0);
    return WIFEXITED(status);
  }
  template <class Work>
  static Error error_of(Work work) {
    try {
      work();
    } catch (const Error& error) {
      return error;
    }
    return Error(ExitCode::kSuccess, "");
  }
  void replace(const std::vector<Replacement>& files) const { replace_files(refs(), files); }
  Error error_of_replacing(const std::vector<Replacement>& files) const {
    return error_of([&] { replace(files); });
  }

  TemporaryDirectory directory_;
};

TEST_F(ReplacementTest, AllFilesAreReplacedKeepTheirModeAndArePutBack) {
  for (const bool without_links : {false, true}) {
    SCOPED_TRACE(without_links ? "without hard links" : "with hard links");
    faults::no_hard_links = without_links;
    replace(three());
    EXPECT_EQ(texts(), kNew);
    EXPECT_EQ(mode("a.exr"), 0600u);
    ASSERT_TRUE(last_replacement(refs()).has_value());
    EXPECT_EQ(last_replacement(refs())->files.size(), 3u);
    const ReplacementOutcome done = undo_replacement(refs());
    EXPECT_EQ(done.files.size(), 3u);
    EXPECT_THAT(done.left, IsEmpty());
    expect_all_or_none();
    EXPECT_EQ(texts(), kOld);
    EXPECT_FALSE(fs::exists(refs() / "made"));
    EXPECT_EQ(error_of([&] { undo_replacement(refs()); }).code(), ExitCode::kInput);
  }
}

TEST_F(ReplacementTest, OnlyTheLastReplacementIsUndone) {
  replace({replacement("a", "a.exr", "old a")});
  replace({replacement("b", "sub/b.exr", "old b")});
  undo_replacement(refs());
  EXPECT_EQ(texts(), (Texts{{"a.exr", "new a"}, {"sub/b.exr", "old b"}}));
  EXPECT_FALSE(last_replacement(refs()).has_value());
}

TEST_F(ReplacementTest, AKillAtAnyCallLeavesAllFilesOldOrAllNew) {
  for (const bool without_links : {false, true}) {
    int call = 1;
    for (bool ended = false; !ended && call < kMostCalls && !HasFailure(); ++call) {
      SCOPED_TRACE(fmt::format("killed at call {}, links: {}", call, !without_links));
      begin_anew();
      faults::no_hard_links = without_links;
      ended = ends(call, [&] { replace(three()); });
      finish_replacement(refs());
      expect_all_or_none();
      EXPECT_TRUE(!ended || texts() == kNew);
      expect_replaced_by_the_next_try();
    }
    EXPECT_GT(call, 20) << "each of these is a moment at which it may be killed";
    EXPECT_LT(call, kMostCalls);
  }
}

TEST_F(ReplacementTest, ACallThatFailsLeavesAllFilesOldOrAllNew) {
  for (const Kind kind : {Kind::kOnce, Kind::kFromThenOn}) {
    int call = 1;
    for (bool failed = true; failed && call < kMostCalls && !HasFailure(); ++call) {
      SCOPED_TRACE(
          fmt::format("call {} fails{}", call, kind == Kind::kOnce ? "" : ", and all after"));
      begin_anew();
      ExitCode code = ExitCode::kSuccess;
      {
        const Fault fault(kind, call);
        code = error_of_replacing(three()).code();
        failed = faults::calls >= call;
      }
      // A disk that fails once is written to again, to put back what was replaced.
      if (kind == Kind::kFromThenOn) finish_replacement(refs());
      EXPECT_THAT(code, AnyOf(ExitCode::kSuccess, ExitCode::kOutput));
      EXPECT_TRUE(code != ExitCode::kSuccess || texts() == kNew);
      if (kind == Kind::kOnce) {
        EXPECT_THAT(texts(), AnyOf(Eq(kOld), Eq(kNew)));
        finish_replacement(refs());
      }
      expect_all_or_none();
      expect_replaced_by_the_next_try();
    }
    EXPECT_GT(call, 20);
    EXPECT_LT(call, kMostCalls);
  }
}

TEST_F(ReplacementTest, AnUndoThatIsKilledOrFailsIsFinishedByTheNextLook) {
  for (const Kind kind : {Kind::kKill, Kind::kOnce, Kind::kFromThenOn}) {
    int call = 1;
    for (bool reached = true; reached && call < kMostCalls && !HasFailure(); ++call) {
      SCOPED_TRACE(fmt::format("kind {}, call {}", int(kind), call));
      begin_anew();
      replace(three());
      if (kind == Kind::kKill) {
        reached = !ends(call, [&] { undo_replacement(refs()); });
      } else {
        const Fault fault(kind, call);
        EXPECT_THAT(error_of([&] { undo_replacement(refs()); }).code(),
                    AnyOf(ExitCode::kSuccess, ExitCode::kOutput));
        reached = faults::calls >= call;
      }
      finish_replacement(refs());
      expect_all_or_none();
      if (texts() == kNew) undo_replacement(refs());
      EXPECT_EQ(texts(), kOld);
    }
    EXPECT_GT(call, 8);
    EXPECT_LT(call, kMostCalls);
  }
}

TEST_F(ReplacementTest, NothingIsReplacedIfAFileIsNotWhatWasCompared) {
  const auto expect_refused = [&](const std::string& name) {
    SCOPED_TRACE(name);
    const Texts before = texts();
    const Error error = error_of_replacing(three());
    EXPECT_EQ(error.code(), ExitCode::kInput);
    EXPECT_THAT(error.lines().front(), HasSubstr(name));
    EXPECT_EQ(texts(), before);
    EXPECT_FALSE(fs::exists(ours("next")));
    begin_anew();
    for (const char* letter : {"a", "b", "c"})
      put(fmt::format("mine/{}.exr", letter), fmt::format("new {}", letter));
  };
  put("mine/b.exr", "garbage");
  expect_refused("mine/b.exr: was changed");
  fs::remove(path("mine/c.exr"));
  expect_refused("mine/c.exr: cannot read");
  put("refs/sub/b.exr", "theirs");
  expect_refused("refs/sub/b.exr: was changed");
  fs::remove(path("refs/a.exr"));
  expect_refused("refs/a.exr: is gone");
  put("refs/made/here/c.exr", "theirs");
  expect_refused("refs/made/here/c.exr: was made meanwhile");
}

TEST_F(ReplacementTest, WhatSomebodyElseWritesMeanwhileStays) {
  int call = 1;
  for (bool reached = true; reached && call < kMostCalls && !HasFailure(); ++call) {
    SCOPED_TRACE(fmt::format("before call {}", call));
    begin_anew();
    faults::meanwhile = [&] { put("refs/sub/b.exr", "theirs"); };
    ExitCode code = ExitCode::kSuccess;
    {
      const Fault fault(Kind::kMeanwhile, call);
      code = error_of_replacing(three()).code();
      reached = faults::calls >= call;
    }
    if (!reached) break;
    EXPECT_EQ(texts().at("sub/b.exr"), "theirs");
    EXPECT_EQ(texts().at("a.exr"), code == ExitCode::kSuccess ? "new a" : "old a");
    EXPECT_THAT(code, AnyOf(ExitCode::kSuccess, ExitCode::kInput));
    EXPECT_FALSE(fs::exists(ours("now")) || fs::exists(ours("back")));
  }
  EXPECT_GT(call, 10);
  EXPECT_LT(call, kMostCalls);
}

TEST_F(ReplacementTest, AnUndoIsRefusedIfAFileWasChangedSince) {
  replace(three());
  put("refs/a.exr", "theirs");
  const Error error = error_of([&] { undo_replacement(refs()); });
  EXPECT_EQ(error.code(), ExitCode::kInput);
  EXPECT_THAT(error.what(), HasSubstr("refs/a.exr: was changed after it was accepted"));
  EXPECT_EQ(texts().at("sub/b.exr"), "new b") << "none is put back";
  put("refs/a.exr", "new a");
  write_file(ours("last/old-1"), "damaged");
  EXPECT_THAT(error_of([&] { undo_replacement(refs()); }).what(),
              HasSubstr("refs/sub/b.exr: what was there before is damaged or gone"));
}

TEST_F(ReplacementTest, NoLinkOnTheWayIsFollowed) {
  put("outside/x.exr", "precious");
  fs::create_directory_symlink("../outside", refs() / "link");
  const auto expect_refused = [&](const std::string& to, ExitCode code) {
    const Error error = error_of_replacing({replacement("a", to, "precious")});
    EXPECT_EQ(error.code(), code) << to << ": " << error.what();
    EXPECT_EQ(read_file(path("outside/x.exr"), 100), "precious");
  };
  expect_refused("link/x.exr", ExitCode::kOutput);
  expect_refused("../outside/x.exr", ExitCode::kInput);
  expect_refused(path("outside/x.exr").string(), ExitCode::kInput);
  // A journal that somebody sends.
  for (const auto& [to, code] : {std::pair("link/x.exr", ExitCode::kOutput),
                                 {"../outside/x.exr", ExitCode::kInput},
                                 {"sub//../../outside/x.exr", ExitCode::kInput}}) {
    fs::create_directories(ours("now"));
    write_file(ours("now/new-0"), "evil");
    struct stat status {};
    ASSERT_EQ(::stat(ours("now").c_str(), &status), 0);
    write_file(ours("now/journal"),
               ReplacementJournal{{{to, sha256("evil"), std::nullopt}}, {}, status.st_ino}.text());
    EXPECT_EQ(error_of([&] { finish_replacement(refs()); }).code(), code) << to;
    EXPECT_EQ(read_file(path("outside/x.exr"), 100), "precious");
  }
}

TEST_F(ReplacementTest, ADamagedJournalIsNamed) {
  replace(three());
  const std::string journal = read_file(ours("last/journal"), 1000);
  ASSERT_TRUE(ReplacementJournal::read(journal).has_value());
  for (std::size_t size = 0; size < journal.size(); ++size)
    EXPECT_FALSE(ReplacementJournal::read(journal.substr(0, size)).has_value()) << size;
  write_file(ours("last/journal"), journal.substr(0, journal.size() / 2));
  const Error error = error_of([&] { undo_replacement(refs()); });
  EXPECT_EQ(error.code(), ExitCode::kInput);
  EXPECT_THAT(error.what(), HasSubstr("last/journal: is missing or damaged"));
  EXPECT_EQ(texts(), kNew);
}

TEST_F(ReplacementTest, ACopyOfAJournalIsNotActedUpon) {
  replace(three());
  fs::copy(ours("last"), ours("now"), fs::copy_options::recursive);
  const Error error = error_of([&] { finish_replacement(refs()); });
  EXPECT_EQ(error.code(), ExitCode::kInput) << "somebody may have sent it";
  EXPECT_THAT(error.what(), HasSubstr("now/journal: is a copy from another place"));
  EXPECT_EQ(texts(), kNew);
}

TEST_F(ReplacementTest, WhoMayChangeTheFolderMayChangeItsJournal) {
  fs::permissions(refs(), fs::perms(02775));
  replace(three());
  for (const char* made : {"", "last"})
    EXPECT_EQ(fs::status(ours(made)).permissions(), fs::perms(02775)) << made;
}

TEST_F(ReplacementTest, ALinkIsReplacedItselfAndPutBackAsOne) {
  put("archive/a.exr", "archived");
  fs::remove(refs() / "a.exr");
  fs::create_symlink("../archive/a.exr", refs() / "a.exr");
  replace({replacement("a", "a.exr", "archived")});
  EXPECT_EQ(texts().at("a.exr"), "new a");
  EXPECT_FALSE(fs::is_symlink(refs() / "a.exr"));
  undo_replacement(refs());
  EXPECT_TRUE(fs::is_symlink(refs() / "a.exr"));
  EXPECT_EQ(read_file(path("archive/a.exr"), 100), "archived");
}

TEST_F(ReplacementTest, AnotherUsersJournalDoesNotCountWhereEverybodyMayWrite) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a folder away";
  replace(three());
  fs::permissions(refs(), fs::perms(01777));
  EXPECT_TRUE(has_replacements(refs()));
  constexpr uid_t kSomebody = 12345;
  ASSERT_EQ(::lchown(ours("").parent_path().c_str(), kSomebody, gid_t(-1)), 0);
  EXPECT_FALSE(has_replacements(refs()));
  EXPECT_EQ(error_of([&] { undo_replacement(refs()); }).code(), ExitCode::kInput);
  EXPECT_EQ(error_of_replacing({replacement("a", "a.exr", "new a")}).code(), ExitCode::kOutput);
  fs::permissions(refs(), fs::perms(0777));
  EXPECT_TRUE(has_replacements(refs()))
      << "whoever may make entries here can also replace the files";
}

TEST_F(ReplacementTest, AFileThatChangesWhileItIsReadHasNoHash) {
  const SteadyFile steady(path("mine/a.exr")), changed(path("mine/b.exr")), gone(path("none.exr"));
  put("mine/b.exr", "other");
  EXPECT_EQ(steady.digest(), sha256("new a"));
  EXPECT_FALSE(changed.digest().has_value());
  EXPECT_FALSE(gone.digest().has_value());
}

}  // namespace
}  // namespace lobelia

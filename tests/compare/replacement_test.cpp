// Replacing files of a folder: all or none, whatever fails or ends the process, and back again.
#include "compare/accept/replacement.hpp"

#include "compare/accept/replacement_store.hpp"
#include "tests/compare/replacement_fixture.hpp"

namespace lobelia {
namespace {

using namespace fixtures;
using testing::AnyOf;
using testing::Eq;

class ReplacementTest : public Replacements {};

TEST_F(ReplacementTest, KeepsTheModesOfReplacedFiles) {
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
    EXPECT_THAT(done.problems, IsEmpty());
    expect_all_or_none();
    EXPECT_EQ(texts(), kOld);
    EXPECT_FALSE(fs::exists(refs() / "made"));
    EXPECT_EQ(thrown_by([&] { undo_replacement(refs()); }).code(), ExitCode::kInput);
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

TEST_F(ReplacementTest, LeavesAllFilesOldOrAllNewAfterAFailure) {
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

TEST_F(ReplacementTest, FinishesAnInterruptedUndoAtTheNextLook) {
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
        EXPECT_THAT(thrown_by([&] { undo_replacement(refs()); }).code(),
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

TEST_F(ReplacementTest, ReplacesNothingAfterAChangeOfAFile) {
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

TEST_F(ReplacementTest, AFileThatSomebodyElseWritesMeanwhileStays) {
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
  const Error error = thrown_by([&] { undo_replacement(refs()); });
  EXPECT_EQ(error.code(), ExitCode::kInput);
  EXPECT_THAT(error.what(), HasSubstr("refs/a.exr: was changed after it was accepted"));
  EXPECT_EQ(texts().at("sub/b.exr"), "new b") << "none is put back";
  put("refs/a.exr", "new a");
  write_file(ours("last/old-1"), "damaged");
  EXPECT_THAT(thrown_by([&] { undo_replacement(refs()); }).what(),
              HasSubstr("refs/sub/b.exr: what was there before is damaged or gone"));
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

TEST_F(ReplacementTest, AFileThatChangesWhileItIsReadHasNoHash) {
  const SteadyFile steady(path("mine/a.exr")), changed(path("mine/b.exr")), gone(path("none.exr"));
  put("mine/b.exr", "other");
  EXPECT_EQ(steady.digest(), sha256("new a"));
  EXPECT_FALSE(changed.digest().has_value());
  EXPECT_FALSE(gone.digest().has_value());
}

// A replacement trusts neither the files of a killed process, nor their directory, nor its journal, without a check.

using namespace fixtures;

class ReplacementTrust : public Replacements {};

TEST_F(ReplacementTrust, AFileThatIsDamagedAfterAKillGetsNoPlace) {
  interrupt({three()[0], three()[2], three()[1]});
  write_file(ours("now/new-2"), "garbage");
  const ReplacementOutcome done = finish_replacement(refs());
  EXPECT_EQ(done.way, ReplacementOutcome::Way::kPutBack);
  EXPECT_THAT(done.problems, ElementsAre(HasSubstr("now/new-2: is not what was accepted")));
  EXPECT_EQ(done.files.size(), 3u);
  EXPECT_EQ(texts(), kOld);
  expect_all_or_none();
}

TEST_F(ReplacementTrust, AReplacementIsPutBackIfAFileWasChangedAfterAKill) {
  for (const auto& [name, whose] :
       {std::pair("a.exr", "it had its new file"), {"sub/b.exr", "it had not"}}) {
    SCOPED_TRACE(whose);
    begin_anew();
    interrupt({three()[0], three()[2], three()[1]});
    put(std::string("refs/") + name, "theirs");
    const ReplacementOutcome done = finish_replacement(refs());
    EXPECT_EQ(done.way, ReplacementOutcome::Way::kPutBack);
    EXPECT_THAT(done.problems,
                ElementsAre(HasSubstr(name + std::string(": was changed since, and stays"))));
    Texts expected = kOld;
    expected[name] = "theirs";
    EXPECT_EQ(texts(), expected);
    EXPECT_FALSE(fs::exists(ours("now")) || fs::exists(ours("back")));
  }
}

TEST_F(ReplacementTrust, AnOldFileThatIsDamagedIsNotPutBack) {
  interrupt({three()[0], three()[1]});
  fs::rename(ours("now"), ours("back"));
  write_file(ours("back/old-0"), "garbage");
  const ReplacementOutcome done = finish_replacement(refs());
  EXPECT_THAT(done.problems,
              ElementsAre(HasSubstr("a.exr: what was there before is damaged or gone")));
  EXPECT_EQ(texts(), (Texts{{"a.exr", "new a"}, {"sub/b.exr", "old b"}}));
}

TEST_F(ReplacementTrust, ADirectoryThatSomebodyMakesInAPlaceStays) {
  for (const bool without_links : {false, true}) {
    bool ended = false;
    for (int call = 1; !ended && call < kMostCalls && !HasFailure(); ++call) {
      SCOPED_TRACE(fmt::format("killed at call {}, links: {}", call, !without_links));
      begin_anew();
      faults::no_hard_links = without_links;
      ended = ends(call, [&] { replace(three()); });
      if (ended) break;
      fs::remove(refs() / "sub/b.exr");
      put("refs/sub/b.exr/notes.txt", "theirs");
      ASSERT_EQ(thrown_by([&] { finish_replacement(refs()); }).what(), std::string());
      EXPECT_EQ(texts().at("sub/b.exr/notes.txt"), "theirs");
      replace({replacement("a", "a.exr", texts().at("a.exr"))});
      replace({replacement("a", "a.exr", "new a")});
      EXPECT_EQ(texts().at("sub/b.exr/notes.txt"), "theirs");
    }
  }
}

TEST_F(ReplacementTrust, OldFilesArePrivateWhereOneOfTheirFoldersIs) {
  fs::permissions(refs(), fs::perms(0755));
  const auto mode_of_last = [&](unsigned sub) {
    begin_anew();
    fs::permissions(refs() / "sub", fs::perms(sub));
    replace(three());
    EXPECT_EQ(mode("sub/b.exr"), 0644u) << "files keep their own";
    return mode(std::string(kReplacedName) + "/last");
  };
  EXPECT_EQ(mode_of_last(0755), 0755u);
  EXPECT_EQ(mode_of_last(0700), 0700u);
  EXPECT_EQ(mode_of_last(0750), 0750u);
  EXPECT_EQ(mode_of_last(0711), 0700u) << "who may not list it does not know the names in it";
}

TEST_F(ReplacementTrust, OthersMayNotChangeTheDirectoryWhereAllMayMakeEntries) {
  fs::permissions(refs(), fs::perms(01777));
  replace(three());
  EXPECT_EQ(mode(kReplacedName), 0755u);
  EXPECT_EQ(mode(std::string(kReplacedName) + "/last"), 0755u);
  EXPECT_EQ(mode(std::string(kReplacedName) + "/lock"), 0644u);
}

TEST_F(ReplacementTrust, AnotherGroupsFolderShowsNobodyMore) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a folder away";
  constexpr gid_t kSomeGroup = 12345;
  fs::permissions(refs() / "sub", fs::perms(0750));
  ASSERT_EQ(::lchown((refs() / "sub").c_str(), uid_t(-1), kSomeGroup), 0);
  replace(three());
  EXPECT_EQ(mode(std::string(kReplacedName) + "/last"), 0700u);
}

TEST_F(ReplacementTrust, ALockThatCannotBeOpenedStopsIt) {
  replace({replacement("a", "a.exr", "old a")});
  fs::remove(ours("lock"));
  fs::create_directory(ours("lock"));
  const Error error = error_of_replacing({replacement("b", "sub/b.exr", "old b")});
  EXPECT_EQ(error.code(), ExitCode::kOutput);
  EXPECT_THAT(error.what(), HasSubstr("lock cannot be opened"));
  EXPECT_EQ(thrown_by([&] { undo_replacement(refs()); }).code(), ExitCode::kOutput);
  EXPECT_EQ(texts(), (Texts{{"a.exr", "new a"}, {"sub/b.exr", "old b"}}));
}

TEST_F(ReplacementTrust, AnyoneWhoMayChangeTheFolderMayTakeItsLock) {
  fs::permissions(refs(), fs::perms(02775));
  replace(three());
  EXPECT_EQ(mode(std::string(kReplacedName) + "/lock"), 0664u);
}

TEST_F(ReplacementTrust, ADirectoryWithoutOurMarkIsLeftAlone) {
  for (const char* mark : {"", "*\n"}) {
    begin_anew();
    for (const char* stage : {"next", "last", "now"})
      put(fmt::format("refs/{}/{}/thesis.txt", kReplacedName, stage), "precious");
    if (*mark) write_file(ours(".gitignore"), mark);
    const Error error = error_of_replacing(three());
    EXPECT_EQ(error.code(), ExitCode::kOutput);
    EXPECT_THAT(error.what(), HasSubstr("is not that of lobelia compare --accept"));
    EXPECT_EQ(thrown_by([&] { finish_replacement(refs()); }).code(), ExitCode::kOutput);
    for (const char* stage : {"next", "last", "now"})
      EXPECT_EQ(read_file(ours(stage) / "thesis.txt", 100), "precious");
    EXPECT_EQ(fs::exists(ours(".gitignore")), *mark != '\0');
    EXPECT_EQ(texts(), kOld);
  }
  begin_anew();
  put(fmt::format("refs/{}/.gitignore", kReplacedName), "# What the last");
  EXPECT_EQ(error_of_replacing(three()).code(), ExitCode::kSuccess)
      << "the process that made it ended while it wrote the mark";
}

TEST_F(ReplacementTrust, NoLinkOnTheWayIsFollowed) {
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
    EXPECT_EQ(thrown_by([&] { finish_replacement(refs()); }).code(), code) << to;
    EXPECT_EQ(read_file(path("outside/x.exr"), 100), "precious");
  }
}

TEST_F(ReplacementTrust, ADamagedJournalIsNamed) {
  replace(three());
  const std::string journal = read_file(ours("last/journal"), 1000);
  ASSERT_TRUE(ReplacementJournal::read(journal).has_value());
  for (std::size_t size = 0; size < journal.size(); ++size)
    EXPECT_FALSE(ReplacementJournal::read(journal.substr(0, size)).has_value()) << size;
  write_file(ours("last/journal"), journal.substr(0, journal.size() / 2));
  const Error error = thrown_by([&] { undo_replacement(refs()); });
  EXPECT_EQ(error.code(), ExitCode::kInput);
  EXPECT_THAT(error.what(), HasSubstr("last/journal: is missing or damaged"));
  EXPECT_EQ(texts(), kNew);
}

TEST_F(ReplacementTrust, ACopyOfAJournalIsNotActedUpon) {
  replace(three());
  fs::copy(ours("last"), ours("now"), fs::copy_options::recursive);
  const Error error = thrown_by([&] { finish_replacement(refs()); });
  EXPECT_EQ(error.code(), ExitCode::kInput) << "somebody may have sent it";
  EXPECT_THAT(error.what(), HasSubstr("now/journal: is a copy from another place"));
  EXPECT_EQ(texts(), kNew);
}

TEST_F(ReplacementTrust, AnyoneWhoMayChangeTheFolderMayChangeItsJournal) {
  for (const fs::path& folder : {refs(), refs() / "sub"}) fs::permissions(folder, fs::perms(02775));
  replace(three());
  for (const char* made : {"", "last"})
    EXPECT_EQ(fs::status(ours(made)).permissions(), fs::perms(02775)) << made;
}

TEST_F(ReplacementTrust, AnotherUsersJournalDoesNotCountWhereEverybodyMayWrite) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a folder away";
  replace(three());
  fs::permissions(refs(), fs::perms(01777));
  EXPECT_TRUE(has_replacements(refs()));
  constexpr uid_t kSomebody = 12345;
  ASSERT_EQ(::lchown(ours("").parent_path().c_str(), kSomebody, gid_t(-1)), 0);
  EXPECT_FALSE(has_replacements(refs()));
  EXPECT_EQ(thrown_by([&] { undo_replacement(refs()); }).code(), ExitCode::kInput);
  EXPECT_EQ(error_of_replacing({replacement("a", "a.exr", "new a")}).code(), ExitCode::kOutput);
  fs::permissions(refs(), fs::perms(0777));
  EXPECT_TRUE(has_replacements(refs()))
      << "whoever may make entries here can also replace the files";
}

}  // namespace
}  // namespace lobelia

// Replacing files of a folder: all or none, whatever fails or ends the process, and back again.
#include "compare/accept/replacement.hpp"

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

}  // namespace
}  // namespace lobelia

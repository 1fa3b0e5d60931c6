// `lobelia compare --accept` at a terminal, and `lobelia accept --undo`.
#include <fmt/format.h>
#include <sys/stat.h>

#include <iterator>

#include "compare/accept/replacement.hpp"
#include "tests/program/compare_pictures_fixture.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

class CompareAccept : public ComparePictures {
 protected:
  /// In folders of these names.
  void differing_pair(const std::string& name) {
    flat("mine/" + name, 0.5f), flat("truth/" + name, 0.6f);
  }
  /// `lobelia compare OPTIONS --accept` at a terminal of its own. Once it asks, the shell does what comes `meanwhile`, and
  /// types the answer.
  std::string accept(const std::string& options, const std::string& answer = "yes",
                     const std::string& meanwhile = "", const std::string& environment = "") {
    return at_terminal(environment + " \"$LOBELIA\" compare " + options + " --accept", answer,
                       meanwhile);
  }
  std::string at_terminal(const std::string& command, const std::string& answer = "yes",
                          const std::string& meanwhile = "") {
    return run_shell(
               "export LOBELIA; unset CI JENKINS_URL TEAMCITY_VERSION TF_BUILD; trap '' PIPE\n"
               "rm -f keys typescript; mkfifo keys\n"
               "{ script -qefc '" +
                   command +
                   "; echo ended with $?' typescript < keys > /dev/null; echo ended >> typescript; } &\n"
                   "exec 3> keys\n"
                   "until grep -q 'Type yes\\|^ended' typescript 2> /dev/null; do sleep 0.01; done\n" +
                   meanwhile + "\necho " + answer + " >&3\nexec 3>&-\nwait\ncat typescript",
               directory_.path())
        .output_tail;
  }
  ProcessResult undo(const std::vector<std::string>& references = {"truth"}) {
    std::vector<std::string> arguments{"accept", "--undo"};
    arguments.insert(arguments.end(), references.begin(), references.end());
    return run_lobelia(arguments, directory_.path());
  }
  unsigned mode(const std::string& name) const {
    struct stat status {};
    EXPECT_EQ(::stat(path(name).c_str(), &status), 0);
    return status.st_mode & 07777u;
  }
};

constexpr char kMineAndTruth[] = "judged = [\"mine\"]\nreferences = [\"truth\"]\n";

TEST_F(CompareAccept, OnlyAPersonWhoSaysYesAccepts) {
  differing_pair("x.exr"), flat("mine/new.exr", 0.3f);
  file("lobelia.toml", kMineAndTruth);
  const std::string before = text("truth/x.exr");
  const ProcessResult unattended = compare({"--accept"});
  EXPECT_EQ(unattended.exit_code, 2);
  EXPECT_THAT(unattended.output_tail, HasSubstr("somebody has to look"));
  EXPECT_THAT(accept("", "no"), HasSubstr("nothing was changed"));
  EXPECT_EQ(text("truth/x.exr"), before);
  EXPECT_THAT(accept("", "yes", "", "CI=true"), HasSubstr("this is a CI job"));
  EXPECT_EQ(text("truth/x.exr"), before);
  const std::string accepted = accept("");
  EXPECT_THAT(accepted, HasSubstr("2 replaced"));
  EXPECT_THAT(accepted, HasSubstr("ended with 0"));
  EXPECT_EQ(text("truth/x.exr"), text("mine/x.exr"));
  EXPECT_EQ(text("truth/new.exr"), text("mine/new.exr"));
  const ProcessResult again = compare({});
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.output_tail, HasSubstr("2 pairs: 2 pass"));
  EXPECT_THAT(again.output_tail, Not(HasSubstr("are no pictures")))
      << "what was kept is no picture";
}

TEST_F(CompareAccept, AFailureThatIsLeftIsNoSuccess) {
  differing_pair("x.exr"), flat("truth/gone.exr", 0.3f);
  const std::string accepted = accept("mine truth");
  EXPECT_THAT(accepted, HasSubstr("1 replaced"));
  EXPECT_THAT(accepted, HasSubstr("ended with 1"));
}

TEST_F(CompareAccept, APairThatHasAWarningTooIsReplacedOnce) {
  differing_pair("x.exr");
  const std::string accepted = accept("mine truth --warn mae=1e-9");
  EXPECT_THAT(accepted, HasSubstr("1 replaced"));
  EXPECT_THAT(accepted, HasSubstr("ended with 0"));
}

TEST_F(CompareAccept, LeavesInvalidPicturesAlone) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  flat("mine/x.exr", kNaN), flat("truth/x.exr", 0.6f), flat("mine/new.exr", kNaN);
  file("mine/garbage.exr", "garbage");
  const std::string said = accept("mine truth");
  EXPECT_THAT(said, HasSubstr("left alone: mine/x.exr has values that are not finite"));
  EXPECT_THAT(said, HasSubstr("left alone: mine/new.exr has values that are not finite"));
  EXPECT_THAT(said, HasSubstr("left alone: mine/garbage.exr: not a readable picture"));
  EXPECT_THAT(said, HasSubstr("ended with 1"));
  EXPECT_EQ(files_in(path("truth")), 1u);
}

TEST_F(CompareAccept, NoLayerOfAReferenceMayBeNotFinite) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(),
                  kInfinity = std::numeric_limits<float>::infinity();
  flat("truth/x.exr", 0.6f), flat("mine/x.exr", 0.6f);
  flat("mine/alpha.exr", 0.5f, {channel("A", kNaN)});
  flat("mine/layer.exr", 0.5f,
       {channel("diffuse.R", 1), channel("diffuse.G", kInfinity), channel("diffuse.B", 1)});
  flat("mine/depth.exr", 0.5f, {channel("Z", kInfinity)});
  flat("mine/depth_nan.exr", 0.5f, {channel("Z", kNaN)});
  const auto part = [&](const char* name, float value) {
    const auto whole = window(0, 0, 32, 32);
    return ExrPart{
        name, whole, whole, {channel("R", value), channel("G", value), channel("B", value)}};
  };
  write_exr_parts(path("mine/parts.exr"), {part("beauty", 0.5f), part("second", kNaN)});
  // The same where a reference is there.
  flat("mine/judged_alpha.exr", 0.5f, {channel("A", kNaN)});
  flat("truth/judged_alpha.exr", 0.6f, {channel("A", 1)});
  flat("mine/judged_added.exr", 0.5f, {channel("mist", kNaN)}),
      flat("truth/judged_added.exr", 0.6f);
  flat("mine/judged_depth.exr", 0.5f, {channel("Z", kInfinity)});
  flat("truth/judged_depth.exr", 0.6f, {channel("Z", 1)});
  const std::string said = accept("mine truth --all-layers");
  for (const std::string name :
       {"alpha", "depth_nan", "layer", "parts", "judged_alpha", "judged_added"}) {
    EXPECT_THAT(said,
                HasSubstr(fmt::format(
                    "left alone: mine/{}.exr has values that are not finite in layer", name)));
    EXPECT_EQ(fs::exists(path("truth/" + name + ".exr")), name.starts_with("judged_")) << name;
  }
  EXPECT_THAT(said, HasSubstr("2 replaced"));
  for (const std::string name : {"depth.exr", "judged_depth.exr"})
    EXPECT_EQ(text("truth/" + name), text("mine/" + name)) << "infinity is far away";
}

TEST_F(CompareAccept, NothingIsWrittenThroughALinkToAFolder) {
  differing_pair("y.exr"), flat("mine/sub/x.exr", 0.5f), flat("mine/sub/new.exr", 0.5f);
  flat("outside/x.exr", 0.6f), flat("mine/lost/x.exr", 0.5f);
  fs::create_directory_symlink("../outside", path("truth/sub"));
  fs::create_directory_symlink("nowhere", path("truth/lost"));
  const std::string before = text("outside/x.exr");
  const std::string said = accept("mine truth");
  for (const char* name : {"sub/x.exr", "sub/new.exr"})
    EXPECT_THAT(said, HasSubstr(fmt::format("left alone: truth/{}: a link leads out", name)));
  EXPECT_THAT(said, HasSubstr("left alone: truth/lost/x.exr: "));
  EXPECT_THAT(said, HasSubstr("1 replaced"));
  EXPECT_THAT(said, HasSubstr("ended with 1"));
  EXPECT_EQ(text("outside/x.exr"), before);
  EXPECT_EQ(files_in(path("outside")), 1u);
  EXPECT_FALSE(fs::exists(path("truth/nowhere")));
  EXPECT_EQ(text("truth/y.exr"), text("mine/y.exr"));
}

TEST_F(CompareAccept, ATableLeadsThroughNoLinkOutOfAFolder) {
  for (const char* name : {"x.exr", "y.exr", "z.exr"}) flat(std::string("mine/") + name, 0.5f);
  flat("outside/x.exr", 0.6f), flat("truth/v3/y.exr", 0.6f), flat("truth/z.exr", 0.6f);
  fs::create_directory_symlink("../outside", path("truth/ln"));
  fs::create_directory_symlink("v3", path("truth/latest"));
  file("pairs.csv",
       "mine,truth\nmine/x.exr,truth/ln/x.exr\nmine/y.exr,truth/latest/y.exr\n"
       "mine/z.exr,truth/z.exr\n");
  file("lobelia.toml", "pairs = \"pairs.csv\"\n");
  const std::string before = text("outside/x.exr");
  for (const char* options : {"--pairs pairs.csv", "", "mine/x.exr truth/ln/x.exr"}) {
    const std::string said = accept(options, "no");
    EXPECT_THAT(said,
                HasSubstr("left alone: truth/ln/x.exr: truth/ln is a link that leads elsewhere"))
        << options;
  }
  EXPECT_THAT(accept("--pairs pairs.csv"), HasSubstr("2 replaced"));
  EXPECT_EQ(text("outside/x.exr"), before);
  EXPECT_EQ(text("truth/v3/y.exr"), text("mine/y.exr"));
}

TEST_F(CompareAccept, AFolderIsNamedAsItWasGiven) {
  flat("mine/sub/x.exr", 0.5f), flat("data/truth/sub/x.exr", 0.6f), flat("-b/x.exr", 0.6f);
  fs::create_directory_symlink("data/truth", path("known"));
  EXPECT_THAT(accept("mine/sub known/sub"), HasSubstr("'lobelia accept --undo known/sub' puts"));
  expect_one_line(
      undo({"known"}), 3,
      "known: no acceptance to undo in this folder, nor above it; there is one in known/sub");
  EXPECT_THAT(undo({"known/sub"}).output_tail, HasSubstr("known/sub/x.exr\n1 put back"));
  EXPECT_THAT(accept("mine/sub ./-b"), HasSubstr("'lobelia accept --undo ./-b' puts"));
}

TEST_F(CompareAccept, ANewPictureWhoseFolderIsAFileIsLeftAlone) {
  differing_pair("y.exr"), flat("mine/notes/x.exr", 0.5f), flat("mine/notes/deep/x.exr", 0.5f);
  file("truth/notes", "mine");
  const std::string said = accept("mine truth");
  for (const char* name : {"x.exr", "deep/x.exr"})
    EXPECT_THAT(said, HasSubstr(fmt::format("left alone: truth/notes/{}: ", name)));
  EXPECT_THAT(said, HasSubstr("1 replaced"));
  EXPECT_THAT(said, HasSubstr("ended with 1"));
  EXPECT_EQ(text("truth/notes"), "mine");
}

TEST_F(CompareAccept, ReferencesWithNoFolderInCommonAreLeftAlone) {
  if (*std::next(directory_.path().begin()) == "dev")
    GTEST_SKIP() << "the files of this test lie there, too";
  const TemporaryDirectory elsewhere("/dev/shm");
  differing_pair("x.exr"), flat("mine/y.exr", 0.5f);
  write_exr_channels(elsewhere.path() / "y.exr", 32, 32,
                     {channel("R", 0.6f), channel("G", 0.6f), channel("B", 0.6f)});
  file("pairs.csv", fmt::format("mine,truth\nmine/x.exr,truth/x.exr\nmine/y.exr,{}\n",
                                (elsewhere.path() / "y.exr").string()));
  const std::string before = text("truth/x.exr"), said = accept("--pairs pairs.csv");
  EXPECT_THAT(said, HasSubstr("left alone: truth/x.exr: has no folder but / in common"));
  EXPECT_THAT(said, HasSubstr("/y.exr: has no folder but / in common"));
  EXPECT_THAT(said, HasSubstr("no reference would change"));
  EXPECT_THAT(said, HasSubstr("ended with 1"));
  EXPECT_EQ(text("truth/x.exr"), before);
}

TEST_F(CompareAccept, AReferenceOnAnotherFileSystemIsLeftAlone) {
  fs::create_directories(path("truth/disk"));
  if (run_shell("unshare -rm mount -t tmpfs none truth/disk", directory_.path()).exit_code != 0)
    GTEST_SKIP() << "nothing may be mounted here";
  differing_pair("x.exr"), flat("mine/disk/x.exr", 0.5f), flat("there/x.exr", 0.6f);
  file(
      "script",
      "mount -t tmpfs none truth/disk && cp there/x.exr truth/disk && \"$LOBELIA\" compare mine truth "
      "--accept\n");
  const std::string said = at_terminal("unshare -rm sh script");
  EXPECT_THAT(said, HasSubstr("left alone: truth/disk/x.exr: truth/disk: another file system"));
  EXPECT_THAT(said, HasSubstr("1 replaced"));
}

TEST_F(CompareAccept, APictureThatIsThereIsNotCalledNew) {
  differing_pair("y.exr"), flat("mine/loop/y.exr", 0.7f);
  fs::create_directory_symlink(".", path("truth/loop"));
  const std::string said = accept("mine truth");
  EXPECT_THAT(said, HasSubstr("left alone: truth/loop/y.exr: is there, and was not compared"));
  EXPECT_EQ(text("truth/y.exr"), text("mine/y.exr"));
}

TEST_F(CompareAccept, APartOfAPictureDoesNotReplaceTheWhole) {
  const auto layer = [&](float value) {
    return std::vector{channel("diffuse.R", value), channel("diffuse.G", value),
                       channel("diffuse.B", value)};
  };
  std::vector<ExrChannel> whole = layer(0.6f);
  whole.push_back(channel("Z", 1.0f));
  exr("part.exr", 32, 32, layer(0.5f));
  flat("truth.exr", 0.6f, whole);
  const std::string before = text("truth.exr");
  const std::string said = accept("part.exr truth.exr --layer diffuse");
  EXPECT_THAT(said, HasSubstr("left alone: truth.exr: not compared: layers of the picture, 'Z'"));
  EXPECT_THAT(said, HasSubstr("ended with 1"));
  flat("mine.exr", 0.5f, whole);
  for (const auto& [options, why] : {std::pair("", "not compared: layers "),
                                     {"--crop 0,0,8,8", "(--crop)"},
                                     {"--all-layers --ignore rect:0,0,8,8", "(--ignore)"},
                                     {"--all-layers --mask rect:0,0,8,8", "(--mask or --scene)"}})
    EXPECT_THAT(accept(std::string("mine.exr truth.exr ") + options),
                AllOf(HasSubstr("left alone: truth.exr: "), HasSubstr(why)));
  EXPECT_EQ(text("truth.exr"), before);
  EXPECT_THAT(accept("mine.exr truth.exr --all-layers"), HasSubstr("ended with 0"));
  EXPECT_EQ(text("truth.exr"), text("mine.exr"));
}

TEST_F(CompareAccept, RefusesFilesThatChangeWhileTheQuestionIsOpen) {
  differing_pair("x.exr"), differing_pair("y.exr"), flat("theirs.exr", 0.9f);
  const std::string x = text("truth/x.exr"), y = text("truth/y.exr");
  std::string said = accept("mine truth", "yes", "printf garbage > mine/y.exr");
  EXPECT_THAT(said, HasSubstr("mine/y.exr: was changed after it was compared"));
  EXPECT_THAT(said, HasSubstr("ended with 3"));
  EXPECT_EQ(text("truth/x.exr"), x) << "all or none";
  EXPECT_EQ(text("truth/y.exr"), y);
  differing_pair("y.exr");
  said = accept("mine truth", "yes", "cp theirs.exr truth/y.exr");
  EXPECT_THAT(said, HasSubstr("truth/y.exr: was changed after it was compared"));
  EXPECT_THAT(said, HasSubstr("ended with 3"));
  EXPECT_EQ(text("truth/x.exr"), x);
  EXPECT_EQ(text("truth/y.exr"), text("theirs.exr"));
}

TEST_F(CompareAccept, IgnoresALinkMadeDuringTheQuestion) {
  flat("mine/x.exr", 0.5f), flat("mine/new.exr", 0.5f), flat("all/truth/x.exr", 0.6f);
  fs::create_directories(path("outside"));
  fs::copy_file(path("all/truth/x.exr"), path("outside/x.exr"));
  const std::string before = text("outside/x.exr");
  EXPECT_THAT(accept("mine all/truth", "yes", "mv all/truth all/moved; ln -s ../outside all/truth"),
              HasSubstr("all/truth: cannot write: it was moved meanwhile"));
  EXPECT_EQ(text("outside/x.exr"), before);
  EXPECT_EQ(files_in(path("outside")), 1u);
}

TEST_F(CompareAccept, AnAcceptanceKeepsModesAndIsUndone) {
  differing_pair("x.exr"), flat("mine/deep/new.exr", 0.3f);
  fs::permissions(path("truth/x.exr"), fs::perms(0600));
  const std::string before = text("truth/x.exr");
  EXPECT_THAT(accept("mine truth"), HasSubstr("'lobelia accept --undo truth' puts"));
  EXPECT_EQ(mode("truth/x.exr"), 0600u);
  EXPECT_EQ(text("truth/x.exr"), text("mine/x.exr"));
  const ProcessResult undone = undo();
  EXPECT_EQ(undone.exit_code, 0) << undone.output_tail;
  EXPECT_THAT(undone.output_tail, HasSubstr("truth/x.exr\n"));
  EXPECT_THAT(undone.output_tail, HasSubstr("2 put back"));
  EXPECT_EQ(text("truth/x.exr"), before);
  EXPECT_EQ(mode("truth/x.exr"), 0600u);
  EXPECT_FALSE(fs::exists(path("truth/deep")));
  expect_one_line(undo(), 3, "no acceptance to undo");
  expect_one_line(undo({"nowhere"}), 3, "nowhere: no such file or folder");
  EXPECT_EQ(run_lobelia({"accept", "truth"}, directory_.path()).exit_code, 2);
}

TEST_F(CompareAccept, AcceptancesOfFilesAndTablesAreUndoneToo) {
  differing_pair("x.exr"), flat("other/truth/y.exr", 0.6f), flat("mine/y.exr", 0.5f);
  const std::string x = text("truth/x.exr"), y = text("other/truth/y.exr");
  EXPECT_THAT(accept("mine/x.exr truth/x.exr"), HasSubstr("ended with 0"));
  EXPECT_EQ(text("truth/x.exr"), text("mine/x.exr"));
  EXPECT_EQ(undo({"truth/x.exr"}).exit_code, 0);
  EXPECT_EQ(text("truth/x.exr"), x);
  file("pairs.csv", "mine,truth\nmine/x.exr,truth/x.exr\nmine/y.exr,other/truth/y.exr\n");
  EXPECT_THAT(accept("--pairs pairs.csv"), HasSubstr("2 replaced"));
  EXPECT_EQ(undo({"truth"}).exit_code, 0) << "they lie in two folders, and are one acceptance";
  EXPECT_EQ(text("truth/x.exr"), x);
  EXPECT_EQ(text("other/truth/y.exr"), y);
}

TEST_F(CompareAccept, AnInterruptedAcceptanceIsFinishedByTheNextComparison) {
  differing_pair("x.exr"), differing_pair("y.exr");
  const auto of = [&](const std::string& name) {
    return Replacement{path("mine/" + name), sha256(text("mine/" + name)), name,
                       sha256(text("truth/" + name))};
  };
  const std::vector<Replacement> files{of("x.exr"), of("y.exr")};
  replace_files(HeldDirectory(path("truth")), files);
  // As if it was killed before the last file had its place.
  const fs::path kept = path("truth") / kReplacedName;
  fs::rename(kept / "last", kept / "now");
  fs::rename(path("truth/y.exr"), kept / "now/new-1");
  fs::create_hard_link(kept / "now/old-1", path("truth/y.exr"));
  const ProcessResult next = compare({"mine", "truth", "-q"});
  EXPECT_EQ(next.exit_code, 0);
  EXPECT_THAT(next.output_tail,
              HasSubstr("truth: an acceptance was interrupted; 2 references are replaced now"));
  EXPECT_EQ(text("truth/y.exr"), text("mine/y.exr"));
}

}  // namespace
}  // namespace lobelia

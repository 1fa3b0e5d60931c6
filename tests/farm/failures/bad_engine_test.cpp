// Engines that do whatever engines should not do.
#include <signal.h>

#include "base/pictures/image_io.hpp"
#include "failing_farm.hpp"
#include "farm/chunk.hpp"
#include "reference_scenes/failure.hpp"
#include "tests/json.hpp"

namespace lobelia {
namespace {

struct Misdeed {
  FailureClass failure;
  const char* shell;
};

constexpr Misdeed kMisdeeds[] = {
    {FailureClass::kNoProgress, "sleep 600"},
    {FailureClass::kTimedOut, "while :; do echo working; sleep 0.05; done"},
    {FailureClass::kTimedOut, "(while :; do echo a child; sleep 0.1; done) & sleep 600"},
    {FailureClass::kNoOutput, "exit 0"},
    {FailureClass::kBadOutput, "head -c 5000 /dev/urandom > $stem.exr; exit 0"},
    {FailureClass::kBadOutput, "head -c 900 $pictures/$name.exr > $stem.exr; exit 0"},
    {FailureClass::kBadOutput, "mkdir $stem.exr; exit 0"},
    {FailureClass::kBadOutput, "mkfifo $stem.exr; exit 0"},
    {FailureClass::kWrongSize, "cp $pictures/large.exr $stem.exr; exit 0"},
    {FailureClass::kNonFinite, "cp $pictures/nan.exr $stem.exr; exit 0"},
    {FailureClass::kExitCode, "echo Error: no memory; exit 3"},
    {FailureClass::kExitCode, "head -c 3000000 /dev/zero; exit 1"},
    {FailureClass::kCrash, "kill -SEGV $$"},
    {FailureClass::kDiskLimit, "truncate -s 20G $stem.exr || exit $?"},
    {FailureClass::kDiskLimit,
     "for i in 1 2 3 4 5 6 7 8; do head -c 4000000 /dev/zero > part$i; done; sleep 600"},
    // In a child, which nobody reads from: more than twice what is allowed, at once.
    {FailureClass::kOutOfMemory,
     "dd if=/dev/zero bs=300M count=1 2> /dev/null | sleep 600; exit 0"},
};

/// One cell for each misdeed, and one that is well.
class BadEngine : public FailingFarm {
 protected:
  BadEngine() {
    std::vector<std::string> exponents{"1000"};
    for (std::size_t i = 0; i < std::size(kMisdeeds); ++i)
      exponents.push_back(std::to_string(i + 1));
    grid(exponents);
    fs::create_directory(root() / "pictures");
    Image image(32, 32);
    image.values()[40] = std::numeric_limits<float>::quiet_NaN();
    write_exr(root() / "pictures" / "nan.exr", image, {});
    write_exr(root() / "pictures" / "large.exr", Image(33, 32), {});
  }
};

TEST_F(BadEngine, FailsEachTimeInItsOwnClass) {
  undisturbed();
  std::string misdeeds = "case $cell in\n";
  for (std::size_t i = 0; i < std::size(kMisdeeds); ++i)
    misdeeds += fmt::format("n{}) {};;\n", i + 1, kMisdeeds[i].shell);
  fake_povray(misdeeds + "esac");
  const FarmRun first = run({"--attempts", "2", "--no-progress-limit", "6", "--time-limit", "15",
                             "--give-up-after", "0", "--memory", "100M", "--disk", "20M"});
  EXPECT_EQ(first.exit_code, 4) << first.output;
  // A slow run has lines of progress before.
  EXPECT_EQ(first.output.find("lobelia: n10: povray: "), first.output.find("lobelia: "))
      << "failures come first: " << first.output;
  EXPECT_THAT(first.output,
              HasSubstr("17 cells: 16 failed, 0 differ, 1 pass; 18 pictures rendered"));
  for (std::size_t i = 0; i < std::size(kMisdeeds); ++i) {
    SCOPED_TRACE(kMisdeeds[i].shell);
    const std::string cell = fmt::format("n{}", i + 1);
    const Json failure = failure_of(cell);
    EXPECT_EQ(failure.value("failure", ""), failure_name(kMisdeeds[i].failure)) << failure;
    EXPECT_EQ(failure.value("attempts", 0), 2);
    EXPECT_TRUE(fs::exists(out() / "cells" / cell / "povray.log"));
    EXPECT_TRUE(fs::exists(out() / "cells" / cell / "lobelia.exr"));
    const std::string kept = fmt::format("failed/{}/reference-povray", cell);
    EXPECT_THAT(failure.value("message", ""), HasSubstr("; its input and log are in " + kept));
    for (const char* file :
         {"pass0.pov", "pass0.ini", "povray.sh", "again.sh", "scene.xml", "povray.log"})
      EXPECT_TRUE(fs::exists(out() / kept / file)) << file;
  }
  expect_nothing_half_written();

  fake_povray();
  expect_mended(run(), std::size(kMisdeeds));
  EXPECT_TRUE(fs::is_empty(out() / "failed")) << "what has succeeded needs no looking at";
}

using OddEngine = FailingFarm;

TEST_F(OddEngine, RecordsItsNumberOfTries) {
  undisturbed();
  fake_povray("if [ $cell = n16 ] && " + first_times("failures", 2) + "; then kill -SEGV $$; fi");
  const FarmRun only = run();
  expect_mended(only, pictures());
  EXPECT_EQ(read_json(result_of("n16", "reference-povray") / "result.json").at("attempts"), 3);
  EXPECT_EQ(read_json(result_of("n8", "reference-povray") / "result.json").at("attempts"), 1);
}

TEST_F(OddEngine, IsAskedForItsVersionAgainIfItWasKilled) {
  const std::string dies = "if " + first_times("failures", 1) + "; then kill -KILL $$; fi\n";
  const std::string well = read_file(fake_povray(), 1 << 20);
  script("povray", dies + well);
  const FarmRun asked = run();
  EXPECT_EQ(asked.exit_code, 0) << asked.output;
  EXPECT_EQ(asked.rendered, pictures()) << asked.output;
}

TEST_F(OddEngine, EndsAFarmAtItsFirstFailureIfThatIsWanted) {
  undisturbed();
  fake_povray("[ $cell != n8 ] || exit 3");
  const FarmRun first = run({"--fail-fast", "--threads", "1"});
  EXPECT_EQ(first.exit_code, 4) << first.output;
  EXPECT_THAT(first.output, HasSubstr("n8: povray: "));
  EXPECT_EQ(failure_of("n8").value("failure", ""), "exit code");
  const std::size_t there = cached_pictures();
  fake_povray();
  expect_mended(run(), pictures() - there);
}

TEST_F(OddEngine, StopsNothingElseIfThatIsWanted) {
  undisturbed();
  fake_povray("[ $cell = n8 ] || { echo Error: no licence; exit 3; }");
  const FarmRun first = run({"--keep-going"});
  EXPECT_EQ(first.exit_code, 4) << first.output;
  EXPECT_THAT(first.output, HasSubstr("3 failed, 0 differ, 1 pass; 5 pictures rendered"));
  EXPECT_EQ(read_json(out() / "cells" / "n16" / "cell.json").at("images").size(), 1u)
      << "our own picture is there all the same";
  EXPECT_THAT(read_file(out() / "cells" / "n16" / "povray.log", 1 << 16), HasSubstr("no licence"));
  EXPECT_EQ(run({"--keep-going", "--fail-fast"}).exit_code, 2);
  fake_povray();
  expect_mended(run(), 3);
}

TEST_F(OddEngine, MakesCellsThatDifferByAnotherPicture) {
  undisturbed();
  // The picture of another cell.
  fake_povray(
      "if [ $cell = n16 ]; then for other in $pictures/*.cell; do read id < $other\n"
      "if [ $id = n8 ]; then cp ${other%.cell}.exr $stem.exr; exit 0; fi; done; fi");
  const FarmRun first = run();
  EXPECT_EQ(first.exit_code, 1) << first.output;
  EXPECT_THAT(first.output, HasSubstr("4 cells: 0 failed, 1 differ, 3 pass"));
  EXPECT_EQ(run().rendered, 0u) << "an answer, and no failure";
}

TEST_F(OddEngine, IsInterruptedWithTheFarmAndLeavesNothing) {
  undisturbed();
  fake_povray("[ $cell = n8 ] || { echo waiting; sleep 600; }");
  RunningFarm farm(command(), root());
  std::vector<int> engines;
  while ((cached_pictures() < 5 || engines.empty()) && !farm.has_ended()) {
    ::usleep(10000);
    engines = farm.engines("povray");
  }
  farm.signal(SIGINT);
  EXPECT_EQ(farm.wait(), 130) << farm.output();
  EXPECT_THAT(farm.output(), HasSubstr("the same command goes on from there"));
  EXPECT_TRUE(end_soon(engines));
  EXPECT_EQ(cached_pictures(), 5u);
  EXPECT_EQ(read_json(out() / "farm.json").at("cells")[1].at("status"), "missing");
  EXPECT_TRUE(fs::exists(out() / "cells" / "n16" / "lobelia.exr"));
  expect_nothing_half_written();
  fake_povray();
  expect_mended(run(), 3);
}

TEST_F(OddEngine, NamesItsRemainingFiles) {
  fake_povray("[ $cell = n16 ] && echo \"Error: $PWD/$stem.pov is too red\" && exit 3");
  ASSERT_EQ(run({"--attempts", "1"}).exit_code, 4);
  const std::string message = failure_of("n16").value("message", "");
  EXPECT_THAT(message,
              HasSubstr("Error: failed/n16/reference-povray/pass0.pov is too red; its input"));
  EXPECT_THAT(message, testing::Not(HasSubstr("/tmp")));
  EXPECT_TRUE(fs::exists(out() / "failed/n16/reference-povray/pass0.pov"));
  EXPECT_THAT(read_file(out() / "failed/n16/reference-povray/again.sh", 1 << 20),
              HasSubstr("lobelia reference scene.xml --engine povray"));
  // A cell that is no longer of the grid takes it along.
  grid({"8"});
  ASSERT_EQ(run({"--attempts", "1"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(out() / "failed/n16"));
}

TEST_F(OddEngine, KeepsNothingByWayOfALink) {
  const fs::path elsewhere = root() / "elsewhere";
  for (const char* directory :
       {"n16/reference-povray", "n64/reference-povray", "old/reference-povray"}) {
    fs::create_directories(elsewhere / directory);
    write_file(elsewhere / directory / "theirs", "x");
  }
  fs::create_directories(out());
  const auto expect_untouched = [&] {
    for (const char* directory : {"n16", "n64", "old"}) {
      EXPECT_EQ(read_file(elsewhere / directory / "reference-povray/theirs", 10), "x");
      EXPECT_EQ(
          std::distance(fs::directory_iterator(elsewhere / directory / "reference-povray"), {}), 1);
    }
  };
  fake_povray("[ $cell = n16 ] && exit 3");
  fs::create_directory_symlink(elsewhere, out() / "failed");
  EXPECT_EQ(run({"--attempts", "1"}).exit_code, 4);
  expect_untouched();
  EXPECT_THAT(failure_of("n16").value("message", ""), testing::Not(HasSubstr("input and log")));
  fs::remove(out() / "failed");
  fs::create_directories(out() / "failed/n64");
  fs::create_directory_symlink(elsewhere / "n16", out() / "failed/n16");
  fs::create_directory_symlink(elsewhere / "n64/reference-povray",
                               out() / "failed/n64/reference-povray");
  EXPECT_EQ(run({"--attempts", "1"}).exit_code, 4);
  fake_povray();
  EXPECT_EQ(run({"--attempts", "1"}).exit_code, 0);
  expect_untouched();
}

TEST_F(OddEngine, GetsTwiceTheMemoryOnce) {
  undisturbed();
  fake_povray(
      "[ $cell = n16 ] && { head -c 60000000 /dev/zero; sleep 3; } | tail -c 60000000 > "
      "/dev/null");
  const FarmRun done = run({"--memory", "50M"});
  expect_mended(done, pictures());
  EXPECT_EQ(read_json(result_of("n16", "reference-povray") / "result.json").at("attempts"), 2);
}

TEST_F(OddEngine, IsNotNeededForAPictureOfOursThatIsTooLarge) {
  grid({"8"}, "", 512);
  EXPECT_EQ(run({"--memory", "2M"}).exit_code, 4);
  EXPECT_EQ(failure_of("n8").value("failure", ""), "out of memory");
  EXPECT_EQ(failure_of("n8").value("message", ""),
            "its picture of 512 x 512 needs 6.0 MiB of memory; allowed: 2.0 MiB");
  EXPECT_EQ(run({"--memory", "7M"}).exit_code, 0);
}

TEST_F(OddEngine, IsGivenUpUntilTheNextRunIfItAlwaysFails) {
  std::vector<std::string> exponents;
  for (int i = 1; i <= 60; ++i) exponents.push_back(std::to_string(i));
  grid(exponents);
  undisturbed();
  fake_povray("echo Error: no licence; exit 3");
  const FarmRun first = run({"--attempts", "2"});
  EXPECT_EQ(first.exit_code, 4) << first.output;
  std::map<std::string, int> classes;
  std::string given_up;
  for (const auto& exponent : exponents) {
    const Json failure = failure_of("n" + exponent);
    ++classes[failure.value("failure", "")];
    if (failure.value("failure", "") == "engine given up") given_up = failure.value("message", "");
  }
  EXPECT_THAT(given_up, testing::AllOf(HasSubstr("pictures in a row, at every attempt"),
                                       HasSubstr("no licence")));
  EXPECT_GE(classes["exit code"], 5);
  EXPECT_GT(classes["engine given up"], 0);
  EXPECT_EQ(classes["exit code"] + classes["engine given up"], 60);
  fake_povray();
  expect_mended(run(), 60);
}

TEST_F(OddEngine, LeavesTheRestToAnotherNodeIfItAlwaysFailsOnOne) {
  std::vector<std::string> exponents;
  for (int i = 1; i <= 60; ++i) exponents.push_back(std::to_string(i));
  const Grid read = read_grid(grid(exponents));
  FarmOptions options;
  options.programs["povray"] = fake_povray("exit 3");
  options.attempts = 1;
  FarmWork work(read, options);
  const ResultCache results(cache());
  std::vector<JobIndex> jobs;
  for (JobIndex job = 0; job < work.graph.size(); ++job)
    if (work.graph[job].exists) jobs.push_back(job);
  records::write_record(root() / "chunk.json", chunk_record(work, results, options, jobs));
  const ChunkSummary first = exec_chunk(root() / "chunk.json", 1, Leave::of_user(true));
  EXPECT_GE(first.failed, 5u);
  EXPECT_GT(first.undone, 0u);
  EXPECT_EQ(first.work.undone, 60 - first.failed);
  ASSERT_EQ(first.work.engines_given_up.size(), 1u);
  EXPECT_THAT(first.work.engines_given_up[0].why, HasSubstr("POV-Ray is not tried any more on "));
  std::size_t kept = 0;
  for (const JobIndex job : jobs)
    if (results.failure(work.graph[job].key)) ++kept;
  EXPECT_EQ(kept, first.failed) << "what was not tried has not failed";
}

// An engine that is not there, or is there and does not work.

class AbsentEngine : public FailingFarm {
 protected:
  /// POV-Ray is looked for in $PATH, and whatever else a shell needs is there.
  FarmRun run_with_path(const std::vector<std::string>& more = {}) const {
    return run_command(command(more),
                       {"PATH=" + (root() / "bin").string() + ":" + without_povray()});
  }
  /// The programs that the fake needs, and no POV-Ray.
  std::string without_povray() const {
    const fs::path tools = root() / "tools";
    if (!fs::exists(tools)) {
      fs::create_directory(tools);
      for (const char* tool : {"sh", "cp", "sha256sum"})
        fs::create_symlink(fs::path("/usr/bin") / tool, tools / tool);
    }
    return tools.string();
  }
  void install(const fs::path& program) const {
    fs::create_directories(root() / "bin");
    fs::rename(program, root() / "bin" / "povray");
  }
  void uninstall() const { fs::remove(root() / "bin" / "povray"); }
  Json engine() const { return read_json(out() / "farm.json").at("engines")[1]; }
};

TEST_F(AbsentEngine, KeepsItsEarlierPictures) {
  install(fake_povray());
  ASSERT_EQ(run_with_path().exit_code, 0);
  const Json before = engine();
  const auto cells = everything_in(out() / "cells");
  ASSERT_TRUE(cells.contains("n16/povray.exr"));
  uninstall();
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"--again", "--filter", "*reference*"}}) {
    const FarmRun without = run_with_path(more);
    EXPECT_EQ(without.exit_code, 0) << without.output;
    EXPECT_THAT(without.output, HasSubstr("POV-Ray is absent: no program 'povray' in $PATH; what "
                                          "it made before is kept"));
    EXPECT_THAT(without.output, HasSubstr("4 cells: 0 failed, 0 differ, 4 pass"));
    EXPECT_EQ(without.rendered, 0u);
    EXPECT_THAT(differences(cells, everything_in(out() / "cells")), IsEmpty());
    EXPECT_EQ(engine().at("state"), "absent");
    EXPECT_EQ(engine().at("available"), false);
    EXPECT_EQ(engine().at("install"), "sudo apt-get install povray");
    EXPECT_EQ(engine().at("version"), before.at("version"));
  }
  EXPECT_THAT(run_with_path({"--dry-run"}).output, HasSubstr("16 jobs: 0 to be done"));
  install(fake_povray());
  EXPECT_EQ(run_with_path().rendered, 0u);
  EXPECT_EQ(engine(), before);
}

TEST_F(AbsentEngine, MakesNothingNewAndTheCellSaysSo) {
  grid({"8", "16"});
  install(fake_povray());
  ASSERT_EQ(run_with_path().exit_code, 0);
  uninstall();
  grid({"8", "16", "24"});
  EXPECT_THAT(
      run_with_path({"--dry-run"}).output,
      HasSubstr("n24/render: missing\nn24/profile: missing\n3 cells, 10 jobs: 2 to be done"));
  const FarmRun wider = run_with_path();
  EXPECT_EQ(wider.exit_code, 0) << wider.output;
  EXPECT_THAT(wider.output, HasSubstr("0 differ, 2 pass, 1 not compared; 1 pictures rendered"));
  const auto cell = [&](const std::string& id) {
    return read_json(out() / "cells" / id / "cell.json");
  };
  EXPECT_EQ(cell("n24").at("missingEngines"), Json::array({"povray"}));
  EXPECT_FALSE(cell("n16").contains("missingEngines"));
  EXPECT_EQ(cell("n16").at("status"), "pass");
}

TEST_F(AbsentEngine, KeepsItsFilesThoughTheCacheIsLost) {
  install(fake_povray());
  ASSERT_EQ(run_with_path().exit_code, 0);
  uninstall();
  fs::remove_all(cache());
  const FarmRun without = run_with_path();
  EXPECT_EQ(without.exit_code, 0) << without.output;
  for (const char* file : {"povray.exr", "povray.json", "povray.png", "lobelia-povray.json"})
    EXPECT_TRUE(fs::exists(out() / "cells" / "n16" / file)) << file;
}

TEST_F(AbsentEngine, IsAnErrorUpFrontIfRequired) {
  const FarmRun required = run_with_path({"--require-engines"});
  EXPECT_EQ(required.exit_code, 5) << required.output;
  EXPECT_EQ(required.output,
            "lobelia: POV-Ray is absent: no program 'povray' in $PATH; to get it: sudo apt-get "
            "install povray\n");
  const FarmRun given = run_with_path({"--povray", "/no/such/povray"});
  EXPECT_EQ(given.exit_code, 5) << given.output;
  EXPECT_THAT(given.output, HasSubstr("/no/such/povray"));
  EXPECT_FALSE(fs::exists(out()));
  EXPECT_FALSE(fs::exists(cache()));
  EXPECT_EQ(run_with_path().exit_code, 0);
}

TEST_F(AbsentEngine, EndsTheFarmInOneLineIfBroken) {
  install(fake_povray());
  ASSERT_EQ(run_with_path().exit_code, 0);
  const auto before = everything_in(out()), cached = everything_in(cache());
  const std::map<std::string, std::string> broken{
      {"exit 1", "ended with exit code 1"},
      {"echo 'POV-Ray 3.7.0.10'; exit 1", "ended with exit code 1"},
      {"kill -SEGV $$", "ended with signal 11"},
      {"echo hello", "does not answer --version as POV-Ray does"},
      {"echo 'POV-Ray 3.6.1'", "what can be driven is 3.7 or 3.8"},
      {"exec /no/such/program", "ended with exit code 127"}};
  for (const auto& [shell, why] : broken) {
    install(script("broken", shell + "\n"));
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{}, {"--dry-run"}, {"--again", "--gallery", "site"}}) {
      const FarmRun run = run_with_path(more);
      EXPECT_EQ(run.exit_code, 5) << shell << run.output;
      EXPECT_THAT(run.output, testing::StartsWith("lobelia: POV-Ray is broken: "));
      EXPECT_THAT(run.output, HasSubstr(why));
      EXPECT_EQ(run.output.find('\n'), run.output.size() - 1) << "one line";
    }
  }
  EXPECT_THAT(differences(before, everything_in(out())), IsEmpty());
  EXPECT_THAT(differences(cached, everything_in(cache())), IsEmpty());
  EXPECT_FALSE(fs::exists(root() / "site"));
}

}  // namespace
}  // namespace lobelia

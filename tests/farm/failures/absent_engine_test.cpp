// An engine that is not there, or is there and does not work.
#include "failing_farm.hpp"
#include "tests/json.hpp"

namespace lobelia {
namespace {

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

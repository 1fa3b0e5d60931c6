// The farm on a real Slurm of this machine: whatever happens to the cluster, its results are the local farm's.
#include <thread>

#include "base/words/text.hpp"
#include "tests/farm/failures/failing_farm.hpp"
#include "tests/farm/slurm/test_cluster.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

constexpr std::size_t kFarmPictures = 24;

/// Twelve cells with pictures of ours and of an engine that takes two seconds for each.
class FarmOnCluster : public FailingFarm {
 protected:
  void SetUp() override {
    if (const std::string why = TestCluster::why_not(); !why.empty()) GTEST_SKIP() << why;
    grid({"8", "10", "12", "14", "16", "18", "20", "22", "24", "26", "28", "30"});
    fake_povray();
    run_locally();
    fake_povray("sleep 2");
    bring_up();
  }
  void run_locally(const std::vector<std::string>& more = {"-q"}) {
    local_ = run(more);
    ASSERT_EQ(local_.exit_code, 0) << local_.output;
    local_results_ = results_of(out());
    fs::rename(out(), root() / "local-out");
    fs::rename(cache(), root() / "local-cache");
  }
  virtual void bring_up() { cluster_.up(); }
  std::vector<std::string> on_slurm() const {
    return command(
        {"--executor", "slurm", "--poll-seconds", "0.2", "--chunk-seconds", "0.5", "-q"});
  }
  bool eventually(const std::function<bool()>& condition) const {
    for (int i = 0; i < 6000; ++i, std::this_thread::sleep_for(std::chrono::milliseconds(100)))
      if (condition()) return true;
    return false;
  }
  void expect_local_results(const std::string& output) {
    // The last element of a run may still be at work beside its client.
    ASSERT_TRUE(eventually([&] { return cluster_.slurm({"squeue", "-h"}).empty(); })) << output;
    EXPECT_THAT(differences(local_results_, results_of(out())), IsEmpty()) << output;
    EXPECT_EQ(cached_pictures(), kFarmPictures);
    EXPECT_TRUE(fs::is_empty(cache() / "making"));
  }

  TestCluster cluster_;
  FarmRun local_;
  Results local_results_;
};

TEST_F(FarmOnCluster, SurvivesAnAbsenceOfItsController) {
  RunningFarm farm(on_slurm(), root());
  ASSERT_TRUE(eventually([&] { return cached_pictures() >= 3; })) << farm.output();
  cluster_.stop_controller();
  std::this_thread::sleep_for(std::chrono::seconds(3));
  cluster_.start_controller();
  EXPECT_EQ(farm.wait(), 0) << farm.output();
  expect_local_results(farm.output());

  const FarmRun again = run_command(on_slurm());
  EXPECT_EQ(again.exit_code, 0) << again.output;
  EXPECT_EQ(again.output.find("Round"), std::string::npos)
      << "nothing is submitted: " << again.output;
  EXPECT_EQ(again.kept, kFarmPictures);
}

TEST_F(FarmOnCluster, LosesNothingWithAWholeNode) {
  RunningFarm farm(on_slurm(), root());
  ASSERT_TRUE(eventually([&] {
    return cached_pictures() >= 3 &&
           !cluster_.slurm({"squeue", "-h", "-t", "running", "-w", "n2"}).empty();
  })) << farm.output();
  cluster_.kill_node("n2");
  EXPECT_EQ(farm.wait(), 0) << farm.output();
  expect_local_results(farm.output());
}

TEST_F(FarmOnCluster, IsFollowedAgainAfterItsClientWasKilled) {
  {
    RunningFarm farm(on_slurm(), root());
    ASSERT_TRUE(eventually([&] { return cached_pictures() >= 3; })) << farm.output();
    farm.signal(SIGKILL);
    farm.wait();
  }
  const FarmRun status = run_command({"farm", "status", "out"});
  EXPECT_THAT(status.output, HasSubstr("farm status --attach out"));
  const FarmRun refused = run_command({"farm", "status", "out", "--attach"});
  EXPECT_EQ(refused.exit_code, 2) << refused.output;
  EXPECT_THAT(refused.output, HasSubstr("--allow-commands"));
  const FarmRun attached = run_command({"farm", "status", "out", "--attach", "--allow-commands"});
  EXPECT_EQ(attached.exit_code, 0) << attached.output;
  EXPECT_THAT(attached.output, HasSubstr("12 cells: 12 pass"));
  expect_local_results(attached.output);
}

TEST_F(FarmOnCluster, EndsWithItsGalleryThoughNobodyWaits) {
  fake_povray();
  std::vector<std::string> words = on_slurm();
  words.insert(words.end(), {"--detach", "--gallery", "site"});
  const FarmRun detached = run_command(words);
  EXPECT_EQ(detached.exit_code, 0) << detached.output;
  EXPECT_THAT(detached.output, HasSubstr("submitted"));
  const fs::path page = root() / "site" / "cells" / "n30" / "index.html";
  ASSERT_TRUE(eventually([&] { return cluster_.slurm({"squeue", "-h"}).empty(); }));
  EXPECT_THAT(read_file(page, 1 << 20), HasSubstr("✓ pass"));
  EXPECT_TRUE(fs::exists(root() / "site" / "index.html"));
  expect_local_results(detached.output);
}

/// A program of the user's own is an engine there, too: its description is in the chunks, its script on the shared disk.
class FarmOnClusterOfMyEngine : public FarmOnCluster {
 protected:
  void SetUp() override {
    if (const std::string why = TestCluster::why_not(); !why.empty()) GTEST_SKIP() << why;
    script("mine.sh", fmt::format("exec {} render \"$1\" --threads 1 -o \"$2\"\n",
                                  shell_quote(LOBELIA_PROGRAM)));
    grid({"8", "10", "12"},
         "<engine name=\"mine\" command=\"sh mine.sh {scene} {out}\" version-command=\"echo 1\"/>");
    run_locally({"-q", "--allow-commands"});
    bring_up();
  }
};

TEST_F(FarmOnClusterOfMyEngine, MatchesTheLocalFarm) {
  const FarmRun refused = run_command(on_slurm());
  EXPECT_EQ(refused.exit_code, 2) << refused.output;
  std::vector<std::string> words = on_slurm();
  words.push_back("--allow-commands");
  const FarmRun farm = run_command(words);
  EXPECT_EQ(farm.exit_code, 0) << farm.output;
  EXPECT_THAT(differences(local_results_, results_of(out())), IsEmpty()) << farm.output;
  EXPECT_EQ(cached_pictures(), pictures());
  const FarmRun again = run_command(words);
  EXPECT_EQ(again.exit_code, 0) << again.output;
  EXPECT_EQ(again.kept, pictures());
}

/// Where Slurm kills what uses more memory than it asked for.
class FarmOnClusterWithLimits : public FarmOnCluster {
 protected:
  void bring_up() override { cluster_.up_with_memory_limits(); }
};

TEST_F(FarmOnClusterWithLimits, RepeatsKilledJobsWithMoreMemory) {
  // 700 MB that tail keeps until Slurm ends it all.
  fake_povray("case $cell in n20) if " + first_times("hungry", 1) +
              "; then { head -c 700000000 /dev/zero; sleep 3600; } | tail -c 700000000 > "
              "/dev/null; fi;; esac");
  std::vector<std::string> words = on_slurm();
  words.push_back("--sbatch=--mem=512M");
  const FarmRun farm = run_command(words);
  EXPECT_EQ(farm.exit_code, 0) << farm.output;
  EXPECT_THAT(farm.output, HasSubstr("1 element: more memory used than asked for; the next round "
                                     "asks for 1G instead of 512M."));
  expect_local_results(farm.output);
}

}  // namespace
}  // namespace lobelia

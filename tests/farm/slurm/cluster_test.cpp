// Runs on a real Slurm of this machine, with the faults that a cluster has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "farm/chunk.hpp"
#include "farm/slurm/doctor.hpp"
#include "tests/farm/slurm/test_cluster.hpp"
#include "tests/farm/slurm/toy_work.hpp"

namespace lobelia {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class SlurmCluster : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = TestCluster::why_not(); !why.empty()) {
      if (std::getenv("LOBELIA_REQUIRE_SLURM")) FAIL() << why;
      GTEST_SKIP() << why;
    }
    bring_up();
    options.chunks.target_seconds = 2;
    options.chunks.chunks_per_slot = 1;
  }
  virtual void bring_up() { cluster.up(); }
  bool eventually_done(const ToyWork& toy, std::size_t jobs) {
    return eventually([&] { return toy.results().size() >= jobs; });
  }
  std::string living(const ToyWork& toy) {
    const auto status = slurm_status(toy.run_directory());
    EXPECT_EQ(status.problem, "");
    std::string all;
    for (const auto& job : status.living) all += fmt::format("{} {};", job.id, job.state_name);
    return all;
  }

  TestCluster cluster;
  TemporaryDirectory directory;
  std::string said;
  SlurmRunOptions options = quick(said);
};

TEST_F(SlurmCluster, MakesEverythingOnceAndASecondRunSubmitsNothing) {
  ToyWork toy(directory.path(), 30, 0.1);
  toy.add({"compared", 1, 0.1, "compare"});
  auto outcome = run_on_slurm(toy.work(), options);
  EXPECT_THAT(outcome.missing, IsEmpty());
  EXPECT_EQ(outcome.rounds, 1);
  EXPECT_EQ(toy.results(), toy.wanted());
  EXPECT_THAT(toy.started(), SizeIs(31));
  EXPECT_EQ(toy.started().back(), "compared");  // it waited for the pictures
  EXPECT_TRUE(eventually([&] { return toy.finished() == "31\n"; }));
  outcome = run_on_slurm(toy.work(), options);
  EXPECT_EQ(outcome.rounds, 0);
  EXPECT_THAT(toy.started(), SizeIs(31));
}

TEST_F(SlurmCluster, KeepsTheRestWhereOneJobFails) {
  ToyWork toy(directory.path(), 10, 0.05);
  toy.add({"broken", 0, 0.05, "toy"});
  options.rounds = 2;
  const auto outcome = run_on_slurm(toy.work(), options);
  EXPECT_EQ(outcome.missing, std::vector<std::string>{"broken"});
  EXPECT_THAT(toy.results(), SizeIs(10));
  EXPECT_THAT(said, HasSubstr("FAILED (NonZeroExitCode)"));
}

TEST_F(SlurmCluster, LosesNothingWithANodeThatDies) {
  ToyWork toy(directory.path(), 24, 2);  // what n2 is at must last until it is killed
  options.chunks.target_seconds = 8;
  ClientProcess client(toy.work(), options, directory.path() / "log");
  ASSERT_TRUE(eventually_done(toy, 4));
  ASSERT_NE(cluster.slurm({"squeue", "-h", "-t", "running", "-w", "n2"}), "");
  cluster.kill_node("n2");
  EXPECT_EQ(client.wait(), 0);
  // Who is killed between writing and publishing cannot remove the unfinished file: two jobs ran there.
  auto results = toy.results();
  EXPECT_LE(
      std::erase_if(results, [](const auto& file) { return file.first.starts_with(".part."); }),
      2u);
  EXPECT_EQ(results, toy.wanted());
  // What it had begun was begun again elsewhere, what it had finished was not.
  EXPECT_GT(toy.started().size(), 24u);
  EXPECT_LE(toy.started().size(), 26u);
}

TEST_F(SlurmCluster, IsFoundAgainByAClientAfterTheFirstWasKilled) {
  ToyWork toy(directory.path(), 12, 2);  // must last until the second client looks
  options.chunks.target_seconds = 8;
  {
    ClientProcess client(toy.work(), options, directory.path() / "log");
    ASSERT_TRUE(eventually_done(toy, 2));
    client.signal(SIGKILL);
    EXPECT_EQ(client.wait(), 128 + SIGKILL);
  }
  EXPECT_NE(living(toy), "");
  const auto outcome = run_on_slurm(toy.work(), options);
  EXPECT_TRUE(outcome.attached);
  EXPECT_EQ(outcome.rounds, 0);
  EXPECT_EQ(toy.results(), toy.wanted());
  EXPECT_THAT(toy.started(), SizeIs(12));
}

TEST_F(SlurmCluster, GoesOnWithoutItsControllerForAWhile) {
  ToyWork toy(directory.path(), 36, 1);  // must last until the controller is gone
  options.chunks.target_seconds = 5;
  ClientProcess client(toy.work(), options, directory.path() / "log");
  ASSERT_TRUE(eventually_done(toy, 4));
  cluster.stop_controller();
  // Until the client has missed it, or has ended.
  const auto log = [&] { return read_file(directory.path() / "log", 1 << 20); };
  ASSERT_TRUE(eventually([&] {
    return log().find("does not answer") != std::string::npos ||
           log().find("missing: ") != std::string::npos;
  }));
  cluster.start_controller();
  EXPECT_EQ(client.wait(), 0);
  EXPECT_EQ(toy.results(), toy.wanted());
  EXPECT_THAT(toy.started(), SizeIs(36));
  EXPECT_THAT(log(), HasSubstr("does not answer"));
}

TEST_F(SlurmCluster, IsEmptyAfterCtrlCAndTheNextRunMakesOnlyWhatIsMissing) {
  ToyWork toy(directory.path(), 36, 0.5);
  options.chunks.target_seconds = 3;
  ClientProcess client(toy.work(), options, directory.path() / "log");
  ASSERT_TRUE(eventually_done(toy, 4));
  client.signal(SIGINT);
  EXPECT_EQ(client.wait(), int(ExitCode::kInterrupted));
  EXPECT_EQ(living(toy), "");
  const auto before = toy.started().size();
  for (const auto& [name, text] : toy.results()) EXPECT_EQ(name.find('.'), name.npos) << name;
  const auto done = toy.results().size();
  ASSERT_LT(done, 36u) << read_file(directory.path() / "log", 1 << 20);
  const auto outcome = run_on_slurm(toy.work(), options);
  EXPECT_FALSE(outcome.attached);
  EXPECT_EQ(toy.results(), toy.wanted());
  EXPECT_EQ(toy.started().size(), before + 36 - done);
}

TEST_F(SlurmCluster, IsFoundFitByTheDoctor) {
  DoctorOptions checked;
  checked.directory = directory.path();
  checked.program = LOBELIA_DOCTOR_NODE;
  checked.poll = std::chrono::milliseconds(100);
  const auto checks = doctor(checked);
  EXPECT_EQ(checks.size(), 12u);
  for (const auto& check : checks)  // KillWait is short here
    EXPECT_TRUE(check.verdict == DoctorCheck::Verdict::kOk || check.name == "KillWait")
        << doctor_text(checks);
}

TEST_F(SlurmCluster, ThatIsDrainedIsReportedAndNotWaitedFor) {
  ToyWork toy(directory.path(), 4, 0.1);
  cluster.drain("n[1-3]");
  options.stall = std::chrono::seconds(1);
  try {
    run_on_slurm(toy.work(), options);
    ADD_FAILURE() << "it ended without an error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kEngine);
    EXPECT_THAT(error.what(), AllOf(HasSubstr("3 drain"), HasSubstr("State=RESUME")));
  }
  cluster.resume("n[1-3]");
  const auto outcome = run_on_slurm(toy.work(), options);  // what it left in the queue
  EXPECT_TRUE(outcome.attached);
  EXPECT_EQ(toy.results(), toy.wanted());
}

TEST_F(SlurmCluster, GivesNoMoreToANodeThatHandsItsWorkBack) {
  ToyWork toy(directory.path(), 6, 0.1);
  toy.add({"picky", 0, 0.1, "toy"});
  options.rounds = 9;
  const auto outcome = run_on_slurm(toy.work(), options);  // only n3 does it
  EXPECT_THAT(outcome.missing, IsEmpty());
  EXPECT_LE(outcome.rounds, 3);
  EXPECT_EQ(toy.results(), toy.wanted());
  for (const char* number : {"n1", "n2"})
    if (said.find(std::string(number) + " (picky)") != said.npos) return;
  EXPECT_EQ(outcome.rounds, 1) << said;
}

TEST_F(SlurmCluster, GivesUpWhatNoNodeIsLeftFor) {
  ToyWork toy(directory.path(), 1, 0.1);
  std::size_t next = 0;
  SlurmWork work = toy.work();
  work.write_chunk = [&](std::size_t number, std::span<const std::size_t>) {
    ::setenv("SLURMD_NODENAME", fmt::format("n{}", ++next).c_str(), 1);
    const LeftUndone left{"toy", "it broke"};
    write_chunk_report(work.run_directory, number, {&left, 1});
  };
  options.rounds = 9;
  const auto outcome = run_on_slurm(work, options);
  ::unsetenv("SLURMD_NODENAME");
  EXPECT_EQ(outcome.rounds, 3) << said;
  EXPECT_EQ(outcome.given_up, std::vector<std::string>{"job000"});
  EXPECT_THAT(toy.given_up().at("job000"), HasSubstr("n3 handed it back (it broke)"));
  // The user's own list leaves none besides ours: Slurm itself says so.
  ToyWork other(directory.path() / "other", 1, 0.1);
  work = other.work();
  next = 0;
  work.write_chunk = [&](std::size_t number, std::span<const std::size_t>) {
    ::setenv("SLURMD_NODENAME", "n3", 1);
    const LeftUndone left{"toy", "it broke"};
    write_chunk_report(work.run_directory, number, {&left, 1});
  };
  options.slurm.raw = {"--exclude=n[1-2]"};
  EXPECT_EQ(run_on_slurm(work, options).given_up, std::vector<std::string>{"job000"});
  ::unsetenv("SLURMD_NODENAME");
  EXPECT_THAT(other.given_up().at("job000"), HasSubstr("not available"));
}

/// Where Slurm kills what takes too much.
class SlurmClusterWithLimits : public SlurmCluster {
 protected:
  void bring_up() override { cluster.up_with_memory_limits(); }
};

TEST_F(SlurmClusterWithLimits, GivesTwiceTheTimeAndTheMemoryToWhatWasKilledForIt) {
  ToyWork toy(directory.path(), 6, 0.1);
  toy.add({"hungry", 0, 2, "toy"});
  toy.add({"slow", 0, 2, "toy"});
  options.chunks.target_seconds = 1;
  options.slurm.time = "1";
  options.slurm.memory = "100M";
  ClientProcess client(toy.work(), options, directory.path() / "log");
  const auto began = [&](const char* name) {
    const auto started = toy.started();
    return std::count(started.begin(), started.end(), name) > 0;
  };
  ASSERT_TRUE(eventually([&] { return began("slow") && began("hungry"); }));
  // Only the slow one is in the queue once the other is killed; a minute's limit is over in a second then. Slurm looks at
  // limits every 30 s.
  std::string left;
  ASSERT_TRUE(eventually([&] {
    left = cluster.slurm({"squeue", "-h", "-r", "-t", "running", "-o", "%i"});
    return split(left, "\n").size() == 1;
  }));
  cluster.slurm({"scontrol", "update", "JobId=" + split(left, "\n").front(), "EndTime=now+1"});
  EXPECT_EQ(client.wait(), 0);
  const std::string log = read_file(directory.path() / "log", 1 << 20);
  EXPECT_EQ(toy.results(), toy.wanted()) << log;
  EXPECT_EQ(toy.started().size(), 10u) << "what was published stays: " << log;
  EXPECT_THAT(log, AllOf(HasSubstr("1 element: time limit reached; the next round asks for 0:02:00 "
                                   "instead of 1."),
                         HasSubstr("1 element: more memory used than asked for; the next round "
                                   "asks for 200M instead of 100M.")));
}

}  // namespace
}  // namespace lobelia

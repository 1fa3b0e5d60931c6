// Runs on a real Slurm of this machine, with the faults that a cluster has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
    cluster.up();
    options.chunks.target_seconds = 2;
    options.chunks.chunks_per_slot = 1;
  }
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
  ToyWork toy(directory.path(), 24, 0.5);
  ClientProcess client(toy.work(), options, directory.path() / "log");
  ASSERT_TRUE(eventually_done(toy, 4));
  ASSERT_NE(cluster.slurm({"squeue", "-h", "-t", "running", "-w", "n2"}), "");
  cluster.kill_node("n2");
  EXPECT_EQ(client.wait(), 0);
  EXPECT_EQ(toy.results(), toy.wanted());
  // What it had begun was begun again elsewhere, what it had finished was not.
  EXPECT_GT(toy.started().size(), 24u);
  EXPECT_LE(toy.started().size(), 26u);
}

TEST_F(SlurmCluster, IsFoundAgainByAClientAfterTheFirstWasKilled) {
  ToyWork toy(directory.path(), 12, 0.5);
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
  ToyWork toy(directory.path(), 36, 0.4);
  ClientProcess client(toy.work(), options, directory.path() / "log");
  ASSERT_TRUE(eventually_done(toy, 4));
  cluster.stop_controller();
  std::this_thread::sleep_for(std::chrono::seconds(3));
  cluster.start_controller();
  EXPECT_EQ(client.wait(), 0);
  EXPECT_EQ(toy.results(), toy.wanted());
  EXPECT_THAT(toy.started(), SizeIs(36));
  EXPECT_THAT(read_file(directory.path() / "log", 1 << 20), HasSubstr("does not answer"));
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

}  // namespace
}  // namespace lobelia

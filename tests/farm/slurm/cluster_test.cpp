// Runs on a real Slurm of this machine: what it says and does itself. farm_cluster_test.cpp has its faults.
#include "farm/chunk.hpp"
#include "farm/slurm/doctor.hpp"
#include "tests/farm/slurm/test_cluster.hpp"
#include "tests/farm/slurm/toy_work.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

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

  TestCluster cluster;
  TemporaryDirectory directory;
  std::string said;
  SlurmRunOptions options = quick(said);
};

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

TEST_F(SlurmCluster, IsReportedAndNotWaitedForWhenDrained) {
  ToyWork toy(directory.path(), 4, 0.1);
  cluster.drain("n[1-3]");
  options.stall = std::chrono::seconds(1);
  EXPECT_THAT(error_words(ExitCode::kEngine, [&] { run_on_slurm(toy.work(), options); }),
              AllOf(HasSubstr("n1 is drain"), HasSubstr("State=RESUME")));
  cluster.resume("n[1-3]");
  const auto outcome = run_on_slurm(toy.work(), options);  // what it left in the queue
  EXPECT_TRUE(outcome.attached);
  EXPECT_EQ(toy.results(), toy.wanted());
}

TEST_F(SlurmCluster, SaysItselfThatNoNodeIsLeft) {
  ToyWork toy(directory.path(), 1, 0.1);
  SlurmWork work = toy.work();
  work.write_chunk = [&](std::size_t number, std::span<const std::size_t>) {
    ::setenv("SLURMD_NODENAME", "n3", 1);
    const LeftUndone left{"toy", "it broke"};
    write_chunk_report(work.run_directory, number, {&left, 1});
    write_file(work.run_directory / "chunks" / std::to_string(number), "");
    return sha256("");
  };
  options.rounds = 9;
  options.slurm.raw = {"--exclude=n[1-2]"};
  EXPECT_EQ(run_on_slurm(work, options).given_up, std::vector<std::string>{"job000"});
  ::unsetenv("SLURMD_NODENAME");
  EXPECT_THAT(toy.given_up().at("job000"), HasSubstr("not available"));
}

}  // namespace
}  // namespace lobelia

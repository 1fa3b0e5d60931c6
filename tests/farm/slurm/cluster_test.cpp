// Runs on a real Slurm of this machine: what it says and does itself. farm_cluster_test.cpp has its faults.
#include "farm/chunk.hpp"
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

TEST_F(SlurmCluster, GivesKilledJobsTwiceTheTime) {
  ToyWork toy(directory.path(), 6, 0.1);
  toy.add({"slow", 0, 2, "toy"});
  options.chunks.target_seconds = 1;
  options.slurm.time = "1";
  ClientProcess client(toy.work(), options, directory.path() / "log");
  ASSERT_TRUE(eventually([&] {
    const auto started = toy.started();
    return std::find(started.begin(), started.end(), "slow") != started.end();
  }));
  // Only the slow one is in the queue then; a minute's limit is over in a second. Slurm looks at limits every 30 s.
  std::string left;
  ASSERT_TRUE(eventually([&] {
    left = cluster.slurm({"squeue", "-h", "-r", "-t", "running", "-o", "%i"});
    return split(left, "\n").size() == 1;
  }));
  cluster.slurm({"scontrol", "update", "JobId=" + split(left, "\n").front(), "EndTime=now+1"});
  EXPECT_EQ(client.wait(), 0);
  const std::string log = read_file(directory.path() / "log", 1 << 20);
  EXPECT_EQ(toy.results(), toy.wanted()) << log;
  EXPECT_EQ(toy.started().size(), 8u) << "what was published stays: " << log;
  EXPECT_THAT(log, HasSubstr("1 element: time limit reached; the next round asks for 0:02:00 "
                             "instead of 1."));
}

}  // namespace
}  // namespace lobelia

// The programs of `make bench` and `make bench-compare`, without a word on how fast anything is.
#include <fmt/format.h>

#include "base/records/bench.hpp"
#include "base/records/record.hpp"
#include "base/words/text.hpp"
#include "tests/cli/run_lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

class BenchTools : public ::testing::Test {
 protected:
  ProcessResult run(std::vector<std::string> command) {
    ProcessOptions options;
    options.working_directory = directory_.path();
    return run_process(command, options);
  }
  const TemporaryDirectory directory_;
};

TEST_F(BenchTools, KeepEachRunInTheRecordAfterThoseBefore) {
  const auto record = directory_.path() / "kept" / "bench.json";
  for (const char* commit : {"abc1", "abc2"}) {
    const ProcessResult result =
        run({LOBELIA_BENCH_GOALS, LOBELIA_PROGRAM, "--quick", "--rounds", "2", "--only",
             "start.version", "--commit", commit, "--keep", record});
    ASSERT_EQ(result.exit_code, 0) << result.output_tail;
    EXPECT_THAT(result.output_tail, HasSubstr("1 goals"));
  }
  const auto kept = records::read_record<records::Bench>(record);
  ASSERT_EQ(kept.runs.size(), 2u);
  EXPECT_EQ(kept.runs[0].commit, "abc1");
  const records::BenchRun& last = kept.runs[1];
  EXPECT_EQ(last.commit, "abc2");
  ASSERT_EQ(last.goals.size(), 1u);
  EXPECT_EQ(last.goals[0].ratio.rounds, 2);
  EXPECT_GT(last.goals[0].ours.least, 0);
}

TEST_F(BenchTools, LeaveARecordAloneThatIsNone) {
  write_file(directory_.path() / "notes.txt", "mine");
  const ProcessResult result = run({LOBELIA_BENCH_GOALS, LOBELIA_PROGRAM, "--quick", "--rounds",
                                    "1", "--only", "start.version", "--keep", "notes.txt"});
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.output_tail, HasSubstr("notes.txt"));
  EXPECT_EQ(read_file(directory_.path() / "notes.txt", 100), "mine");
}

TEST_F(BenchTools, NameTheCommandWithASlowdown) {
  const auto slow = directory_.path() / "slow";
  write_file(slow, fmt::format("#!/bin/sh\n[ \"$1\" = --version ] && sleep 1\nexec {} \"$@\"\n",
                               shell_quote(LOBELIA_PROGRAM)));
  std::filesystem::permissions(slow, std::filesystem::perms::owner_all);
  // Two of 18 pairs may be disturbed.
  const auto pair = [&](const std::string& a, const std::string& b) {
    return run({LOBELIA_BENCH_PAIRED, a, b, "--rounds", "18", "--only", "start"});
  };
  const ProcessResult slower = pair(LOBELIA_PROGRAM, slow), faster = pair(slow, LOBELIA_PROGRAM);
  EXPECT_EQ(slower.exit_code, 1) << slower.output_tail;
  EXPECT_THAT(slower.output_tail, HasSubstr(" slower\n"));
  EXPECT_EQ(faster.exit_code, 0) << faster.output_tail;
  EXPECT_THAT(faster.output_tail, HasSubstr(" faster\n"));
}

}  // namespace
}  // namespace lobelia

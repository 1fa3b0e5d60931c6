// Elements that Slurm ends and work that nodes hand back, with programs that only pretend.
#include "farm/chunk.hpp"
#include "tests/farm/slurm/fake_slurm.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using testing::SizeIs;

class FakeSlurmEndings : public FakeSlurm {
 protected:
  FakeSlurmEndings() { jobs(1); }
  ~FakeSlurmEndings() override { ::unsetenv("SLURMD_NODENAME"); }
  void partition(const std::string& limits) {
    fake("scontrol", fmt::format("case \"$*\" in *partition*) echo 'PartitionName=render {}';; "
                                 "*) echo 'MaxArraySize = 1001';; esac",
                                 limits));
  }
  /// The run, in which chunk 0, 1, ... is handed back by the node of that place.
  SlurmOutcome run_with_reports(const std::vector<std::string>& nodes, const std::string& engine) {
    SlurmWork work = toy.work();
    work.write_chunk = [&, write = work.write_chunk](std::size_t number, auto places) {
      const Sha256Digest planned = write(number, places);
      if (number >= nodes.size()) return planned;
      ::setenv("SLURMD_NODENAME", nodes[number].c_str(), 1);
      const LeftUndone left{engine, "it broke"};
      write_chunk_report(work.run_directory, number, {&left, 1});
      return planned;
    };
    return run_on_slurm(work, options);
  }
};

// ---- time and memory

TEST_F(FakeSlurmEndings, GetTwiceTheTimeAfterATimeLimit) {
  options.slurm.time = "1:00:00";
  elements_end("0|TIMEOUT|TimeLimit|n1", "--time=2:00:00");
  const auto outcome = run_on_slurm(toy.work(), options);
  EXPECT_THAT(outcome.missing, IsEmpty());
  EXPECT_EQ(outcome.rounds, 2);
  EXPECT_THAT(said, AllOf(HasSubstr("ended as TIMEOUT (TimeLimit): time limit reached"),
                          HasSubstr("1 element: time limit reached; the next round asks for "
                                    "2:00:00 instead of 1:00:00.\n")));
  ASSERT_THAT(arrays(), SizeIs(2));
  EXPECT_THAT(lines("submitted").back(), HasSubstr("--time=1:00:00")) << "the last has no more";
  const Json record = read_json(toy.run_directory() / "slurm.json");
  EXPECT_EQ(record["arrays"][2]["time"], "2:00:00");
}

TEST_F(FakeSlurmEndings, GetNoMoreTimeThanThePartitionHas) {
  options.slurm.time = "60";
  partition("MaxTime=01:30:00 MaxMemPerNode=UNLIMITED");
  elements_end("0|TIMEOUT|TimeLimit|n1", "never");
  const auto outcome = run_on_slurm(toy.work(), options);
  EXPECT_THAT(outcome.missing, ElementsAre("job000"));
  ASSERT_THAT(arrays(), SizeIs(3));
  EXPECT_THAT(arrays()[1], HasSubstr("--time=1:30:00"));
  EXPECT_THAT(arrays()[2], HasSubstr("--time=1:30:00"));
  EXPECT_THAT(said, AllOf(HasSubstr("1:30:00 is the most that can be had"),
                          HasSubstr("1 element of the last round: time limit reached (1:30:00); "
                                    "give elements more with --time, or less to do with "
                                    "--chunk-seconds.\n")));
}

TEST_F(FakeSlurmEndings, GetTwiceTheMemoryUpToThatOfANode) {
  options.slurm.memory = "3G";
  elements_end("0|OUT_OF_MEMORY|OutOfMemory|n1", "--mem=8000M");
  EXPECT_THAT(run_on_slurm(toy.work(), options).missing, IsEmpty());
  ASSERT_THAT(arrays(), SizeIs(3));
  EXPECT_THAT(arrays()[1], HasSubstr("--mem=6G"));
  EXPECT_THAT(said, HasSubstr("1 element: more memory used than asked for; the next round asks "
                              "for 8000M instead of 6G.\n"));
}

TEST_F(FakeSlurmEndings, GetTwiceTheMemoryIfOnlyTheLogSaysSo) {
  options.slurm.memory = "1G";
  options.rounds = 2;
  fs::create_directories(toy.run_directory() / "log");
  const fs::path log = toy.run_directory() / "log" / "100_0.log";
  elements_end("0|FAILED|JobLaunchFailure|n1", "never");
  write_file(log, "engine: exceeded memory limit\n");
  run_on_slurm(toy.work(), options);
  EXPECT_THAT(arrays().back(), HasSubstr("--mem=1G")) << "these were not slurmstepd's words";
  fs::remove(in("id"));
  write_file(log,
             "chunk 0\nslurmstepd-n1: error: StepId=1.batch exceeded memory limit (309383168 "
             "> 104857600), being killed\n");
  run_on_slurm(toy.work(), options);
  EXPECT_THAT(arrays().back(), HasSubstr("--mem=2G"));
  EXPECT_THAT(said, HasSubstr("FAILED (JobLaunchFailure): more memory used than asked for"));
  fs::remove(in("id"));
  fs::rename(log, in("elsewhere"));
  fs::create_symlink(in("elsewhere"), log);
  run_on_slurm(toy.work(), options);
  EXPECT_THAT(arrays().back(), HasSubstr("--mem=1G")) << "a link is not followed";
}

TEST_F(FakeSlurmEndings, DoubleTheLimitsOfAnEarlierClient) {
  options.slurm.time = "1:00:00";
  options.rounds = 2;
  elements_end("0|TIMEOUT|TimeLimit|n1", "--time=4:00:00");
  run_on_slurm(toy.work(), options);  // 1 h, 2 h
  fake("squeue", R"(
case "$*" in *--me*) [ -e "$d/asked" ] || echo '102|RUNNING|lobelia 2-1'; exit 0;; esac
touch "$d/asked"; cat "$d/ended-$6" 2>/dev/null; exit 0)");
  options.slurm.time = "";  // as 'farm status --attach' has it
  const auto outcome = run_on_slurm(toy.work(), options);
  EXPECT_TRUE(outcome.attached);
  EXPECT_THAT(outcome.missing, IsEmpty());
  EXPECT_THAT(arrays().back(), HasSubstr("--time=4:00:00"));
}

// ---- other ends

TEST_F(FakeSlurmEndings, AreTriedAgainIfTheyAreNobodysFault) {
  options.slurm.time = "60";
  options.slurm.memory = "1G";
  for (const char* state : {"NODE_FAIL|NodeDown", "PREEMPTED|None", "BOOT_FAIL|None",
                            "REVOKED|None", "FAILED|NonZeroExitCode"}) {
    said.clear();
    for (const char* name : {"submitted", "id"}) fs::remove(in(name));
    fs::remove_all(in("toy"));
    toy = ToyWork(in("toy"), 1, 0);
    elements_end(fmt::format("0|{}|n1", state), "--comment=lobelia 2-");
    const auto outcome = run_on_slurm(toy.work(), options);
    EXPECT_THAT(outcome.missing, IsEmpty()) << state;
    ASSERT_THAT(arrays(), SizeIs(2)) << state;
    EXPECT_THAT(arrays()[1], AllOf(HasSubstr("--time=60"), HasSubstr("--mem=1G"))) << state;
    EXPECT_THAT(said, HasSubstr("ended as " + split(state, "|").front() + " ("));
  }
}

TEST_F(FakeSlurmEndings, AreNotSubmittedAgainAfterACancellation) {
  for (const char* state : {"CANCELLED|None", "DEADLINE|DeadLine"}) {
    said.clear();
    fs::remove(in("submitted"));
    elements_end(fmt::format("0|{}|n1", state), "never");
    const auto outcome = run_on_slurm(toy.work(), options);
    EXPECT_EQ(outcome.rounds, 1) << state;
    EXPECT_THAT(outcome.missing, ElementsAre("job000"));
    EXPECT_THAT(arrays(), SizeIs(1));
    EXPECT_THAT(said, HasSubstr("Nothing more is submitted: 1 element: "));
  }
  EXPECT_THAT(said, HasSubstr("deadline missed (--deadline)"));
}

// ---- nodes

TEST_F(FakeSlurmEndings, KeepAnEngineFromTheNodeThatHandedItBack) {
  toy.add({"other", 0, 0, "other"});
  options.chunks.target_seconds = 1e-3;
  options.slurm.raw = {"--exclude=m[1-2]"};
  elements_end("0|COMPLETED|None|n1", "--comment=lobelia 2-");
  const auto outcome = run_with_reports({"n1"}, "toy");
  EXPECT_THAT(outcome.missing, IsEmpty());
  EXPECT_EQ(outcome.rounds, 2);
  const auto submitted = arrays();
  ASSERT_THAT(submitted, SizeIs(3));
  EXPECT_THAT(submitted[0], AllOf(HasSubstr("--exclude=m[1-2] "), HasSubstr("--array=0-1 ")));
  EXPECT_THAT(submitted[1], AllOf(HasSubstr("--exclude=m[1-2] "), HasSubstr("--array=0-0 ")));
  EXPECT_THAT(submitted[2],
              AllOf(HasSubstr("--exclude=m[1-2],n1 "), Not(HasSubstr("--dependency"))));
  EXPECT_THAT(said,
              HasSubstr("No more jobs of toy for nodes that handed them back: n1 (it broke).\n"));
  EXPECT_EQ(said.find("No more jobs"), said.rfind("No more jobs"));
}

TEST_F(FakeSlurmEndings, KeepAllJobsOfAChunkFromTheNodeThatHandedItBack) {
  toy.add({"other", 0, 0, "other"});
  toy.add({"compared", 1, 0, "compare"});
  elements_end("0|COMPLETED|None|n1", "--exclude=n1");
  const auto outcome = run_with_reports({"n1"}, "");
  EXPECT_THAT(outcome.missing, IsEmpty());
  ASSERT_THAT(arrays(), SizeIs(4));
  EXPECT_THAT(arrays()[3], AllOf(HasSubstr("--exclude=n1"), HasSubstr("afterany:")));
}

TEST_F(FakeSlurmEndings, TryEveryNodeInANewRun) {
  options.rounds = 1;
  elements_end("0|COMPLETED|None|n1", "never");
  run_with_reports({"n1"}, "");
  run_on_slurm(toy.work(), options);
  ASSERT_THAT(arrays(), SizeIs(2));
  EXPECT_THAT(arrays()[1], Not(HasSubstr("--exclude")));
}

TEST_F(FakeSlurmEndings, GiveUpWithTheReasonWhereNoNodeIsLeft) {
  toy.add({"second", 0, 0, "toy"});
  toy.add({"other", 0, 0, "other"});
  options.chunks.target_seconds = 1e-3;
  options.rounds = 9;
  elements_end("0|COMPLETED|None|n1", "--comment=lobelia 2-");
  const auto outcome = run_with_reports({"n1", "n2"}, "toy");
  EXPECT_THAT(outcome.missing, IsEmpty());
  EXPECT_THAT(outcome.given_up, ElementsAre("job000", "second"));
  EXPECT_EQ(outcome.rounds, 2);
  EXPECT_THAT(arrays(), SizeIs(2));
  EXPECT_EQ(toy.given_up().at("second"),
            "no node is left for it: n1 handed it back (it broke), n2 handed it back (it broke)");
  EXPECT_THAT(said, HasSubstr("2 jobs of toy given up: no node is left for it: n1"));
}

TEST_F(FakeSlurmEndings, GiveUpWhereOnlyNodesOutOfUseAreLeft) {
  fake("sinfo", "echo 'n1|render*|up|idle|1|0/2/0/2'; echo 'n2|render*|up|drain|1|0/0/2/2'");
  elements_end("0|COMPLETED|None|n1", "never");
  EXPECT_THAT(run_with_reports({"n1"}, "toy").given_up, ElementsAre("job000"));
  EXPECT_THAT(toy.given_up().at("job000"), HasSubstr("(it broke); the others: n2 is drain"));
}

TEST_F(FakeSlurmEndings, GiveUpInSlurmsWordsWhereItHasNoOtherNode) {
  elements_end("0|COMPLETED|None|n1", "never");
  fs::rename(bin() / "sbatch", bin() / "sbatch.one");
  fake("sbatch", R"(
case "$*" in *--exclude=*) echo 'sbatch: error: Batch job submission failed: Requested node configuration is not available' >&2; exit 1;; esac
exec "$d/bin/sbatch.one" "$@")");
  const auto outcome = run_with_reports({"n1"}, "toy");
  EXPECT_THAT(outcome.given_up, ElementsAre("job000"));
  EXPECT_THAT(outcome.missing, IsEmpty());
  EXPECT_THAT(toy.given_up().at("job000"), HasSubstr("Requested node configuration is not"));
}

TEST_F(FakeSlurmEndings, ExcludeNoNodeThatSlurmDoesNotHave) {
  elements_end("0|COMPLETED|None|n1", "--comment=lobelia 2-");
  toy.add({"second", 0, 0, "other"});
  options.chunks.target_seconds = 1e-3;
  fs::create_directories(toy.run_directory() / "reports");
  write_file(toy.run_directory() / "reports" / "1.json",
             R"({"schemaVersion": 1, "kind": "farm-chunk-report", "node": "--wrap=reboot",
                 "left": [{"engine": "", "why": ""}]})");
  const auto outcome = run_with_reports({"unknown"}, "toy");
  EXPECT_THAT(outcome.missing, IsEmpty());
  for (const std::string& array : arrays())
    EXPECT_THAT(array, AllOf(Not(HasSubstr("--exclude")), Not(HasSubstr("--wrap"))));
  EXPECT_THAT(said, AllOf(HasSubstr("handed back by 'unknown', and Slurm has no such node"),
                          HasSubstr("'--wrap=reboot' is no name of a node")));
}

TEST_F(FakeSlurmEndings, RefuseAFileOfExcludedNodes) {
  options.slurm.raw = {"--exclude=./nodes"};
  const auto [code, message] = failure();
  EXPECT_EQ(code, ExitCode::kUsage);
  EXPECT_THAT(message, HasSubstr("name the nodes"));
}

}  // namespace
}  // namespace lobelia

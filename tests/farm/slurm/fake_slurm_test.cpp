// The client of Slurm against programs that only pretend, for answers that no real cluster gives on demand.
#include "tests/farm/slurm/fake_slurm.hpp"
#include "base/records/cluster.hpp"
#include "base/records/record.hpp"
#include "farm/slurm/slurm_client.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

// ---- single calls

TEST_F(FakeSlurm, SeesACleanEnvironment) {
  ::setenv("SBATCH_PARTITION", "secret", 1);
  ::setenv("LOBELIA_TEST_SLURM", "kept", 1);
  fake("sbatch", "env > \"$d/environment\"; echo 7");
  EXPECT_EQ(SlurmClient().submit({}, "/dev/null").job, 7u);
  ::unsetenv("SBATCH_PARTITION");
  ::unsetenv("LOBELIA_TEST_SLURM");
  const std::string environment = read_file(in("environment"), 1 << 20);
  EXPECT_THAT(environment, AllOf(HasSubstr("LOBELIA_TEST_SLURM=kept"), HasSubstr("PATH=")));
  EXPECT_THAT(environment, AllOf(Not(HasSubstr("SBATCH")), Not(HasSubstr("DIR="))));
}

TEST_F(FakeSlurm, IsLeftAfterItsTimeLimitIfItHangs) {
  for (const char* name : {"sbatch", "squeue", "scancel", "scontrol", "sinfo"})
    fake(name, "sleep 60");
  const SlurmClient client(std::chrono::milliseconds(300));
  const auto submission = client.submit({}, "/dev/null");
  EXPECT_FALSE(submission.job);
  EXPECT_TRUE(submission.unclear);
  for (const std::string& why :
       {submission.why, client.elements(1, "x").why, client.living_jobs("x").why,
        client.cancel("x"), client.ping(), client.config().why, client.node_list("").why})
    EXPECT_THAT(why, HasSubstr("gave no answer in 0.3 s"));
}

TEST_F(FakeSlurm, GivesNoAnswerWithOddWords) {
  const SlurmClient client;
  for (const char* odd :
       {"echo 'slurm_load_jobs error: Socket timed out on send/recv operation' >&2; exit 1",
        "exit 1", "kill -9 $$", "echo '3|RUNN'", "echo '<html>'",
        "printf '1|RUNNING|None|n1\\n2|RUN'", "printf '\\377\\000\\n'",
        "yes '1|RUNNING|None|n1' | head -c 20000000"}) {
    fake("squeue", odd);
    EXPECT_FALSE(client.elements(7, "x")) << odd;
    EXPECT_FALSE(client.elements(7, "x").why.empty()) << odd;
  }
  for (const char* odd :
       {"echo", "echo Submitted batch job 7", "echo 7; echo 8", "echo 0", "true"}) {
    fake("sbatch", odd);
    EXPECT_FALSE(client.submit({}, "/dev/null").job) << odd;
  }
}

// ---- whole runs

TEST_F(FakeSlurm, IsAskedOnceForPicturesThenComparisonsThenTheEnd) {
  jobs(6);
  toy.add({"compared", 1, 0, "compare"});
  options.slurm.partition = "render";
  options.slurm.throttle = 3;
  options.chunks.target_seconds = 1e-3;  // a job each
  const auto outcome = run_on_slurm(toy.work(), options);
  EXPECT_THAT(outcome.missing, IsEmpty());
  EXPECT_EQ(outcome.rounds, 1);
  EXPECT_EQ(toy.results(), toy.wanted());
  EXPECT_EQ(toy.finished(), "7\n");
  const auto submitted = lines("submitted");
  ASSERT_EQ(submitted.size(), 3u);
  EXPECT_THAT(submitted[0], AllOf(HasSubstr("--array=0-5%3 "), HasSubstr("--requeue"),
                                  HasSubstr("--partition=render"), Not(HasSubstr("--dependency"))));
  EXPECT_THAT(submitted[1],
              AllOf(HasSubstr("--array=0-0%3 "), HasSubstr("--dependency=afterany:100 ")));
  EXPECT_THAT(submitted[2],
              AllOf(Not(HasSubstr("--array")), HasSubstr("--dependency=afterany:100:101 ")));
  const Json record = read_json(toy.run_directory() / "slurm.json");
  EXPECT_EQ(record["nextChunk"], 7);
  ASSERT_EQ(record["arrays"].size(), 3u);
  EXPECT_EQ(record["arrays"][1]["job"], 101);
  EXPECT_EQ(run_on_slurm(toy.work(), options).rounds, 0);
  EXPECT_EQ(lines("submitted").size(), 3u);
}

TEST_F(FakeSlurm, GetsMissingJobsAgainForThreeRounds) {
  jobs(2);
  toy.add({"broken", 0, 0, "toy"});
  auto outcome = run_on_slurm(toy.work(), options);
  EXPECT_EQ(outcome.rounds, 3);
  EXPECT_THAT(outcome.missing, ElementsAre("broken"));
  EXPECT_THAT(lines("started"), IsEmpty());
  EXPECT_EQ(toy.started().size(), 2u);  // what is there is not made again
  options.finish = false;
  outcome = run_on_slurm(toy.work(), options);  // the toy fails where a number comes twice
  EXPECT_EQ(outcome.rounds, 3);
  EXPECT_EQ(lines("submitted").size(), 9u);
}

TEST_F(FakeSlurm, IsQuotedAndNotAskedAgainAfterARefusal) {
  jobs(1);
  fake(
      "sbatch",
      "echo x >> \"$d/tries\"; "
      "echo 'sbatch: error: Batch job submission failed: Invalid partition name specified' >&2; exit 1");
  const auto [code, message] = failure();
  EXPECT_EQ(code, ExitCode::kEngine);
  EXPECT_THAT(message, HasSubstr("Invalid partition name specified"));
  EXPECT_EQ(lines("tries").size(), 1u);
}

TEST_F(FakeSlurm, GetsNoJobTwiceThatItTookInSilence) {
  jobs(1);
  options.finish = false;
  fs::rename(bin() / "sbatch", bin() / "sbatch.good");
  fake("sbatch", R"("$d/bin/sbatch.good" "$@" > /dev/null
echo 'sbatch: error: Batch job submission failed: Socket timed out on send/recv operation' >&2; exit 1)");
  fake("squeue", R"(
case "$*" in *--me*) [ -e "$d/submitted" ] && echo '100|PENDING|lobelia 1-0'; exit 0;; esac
echo '0|COMPLETED|None|n1')");
  const auto outcome = run_on_slurm(toy.work(), options);
  EXPECT_THAT(outcome.jobs, ElementsAre(100u));
  EXPECT_EQ(lines("submitted").size(), 1u);
}

TEST_F(FakeSlurm, IsWaitedForWhenSilentWhichIsSaidOnce) {
  jobs(1);
  fs::rename(bin() / "squeue", bin() / "squeue.good");
  fake("squeue", R"(
case "$*" in *--me*) exit 0;; esac
n=$(cat "$d/asked" 2>/dev/null || echo 0); echo $((n + 1)) > "$d/asked"
[ $n -lt 4 ] && { echo 'slurm_load_jobs error: Unable to contact slurm controller' >&2; exit 1; }
exec "$d/bin/squeue.good" "$@")");
  run_on_slurm(toy.work(), options);
  EXPECT_EQ(toy.results(), toy.wanted());
  const auto first = said.find("does not answer");
  EXPECT_NE(first, said.npos);
  EXPECT_EQ(said.find("does not answer", first + 1), said.npos);
  EXPECT_THAT(said, HasSubstr("answers again"));
}

TEST_F(FakeSlurm, IsAnErrorIfItDoesNotAnswerAtTheStart) {
  jobs(1);
  fake("squeue", "echo 'slurm_load_jobs error: Unable to contact slurm controller' >&2; exit 1");
  const auto [code, message] = failure();
  EXPECT_EQ(code, ExitCode::kEngine);
  EXPECT_THAT(message, HasSubstr("Unable to contact slurm controller"));
  EXPECT_THAT(lines("submitted"), IsEmpty());
}

TEST_F(FakeSlurm, IsNamedIfItIsNotThere) {
  jobs(1);
  ::setenv("PATH", in("empty").c_str(), 1);
  const auto [code, message] = failure();
  EXPECT_EQ(code, ExitCode::kEngine);
  EXPECT_THAT(message, AllOf(HasSubstr("sbatch"), HasSubstr("sinfo"), HasSubstr("$PATH")));
}

TEST_F(FakeSlurm, GetsNothingNewWhileTheRunLives) {
  jobs(1);
  fake("squeue", R"(
case "$*" in *--me*) [ -e "$d/done" ] || echo '55|RUNNING|lobelia 1-0'; exit 0;; esac
touch "$d/done"; echo 'result of job000' > "$d/toy/results/job000"
case "$*" in *'-j 55'*) echo '0|COMPLETED|None|n1';; *) exit 1;; esac)");
  const auto outcome = run_on_slurm(toy.work(), options);
  EXPECT_TRUE(outcome.attached);
  EXPECT_EQ(outcome.rounds, 0);
  EXPECT_THAT(lines("submitted"), IsEmpty());
}

TEST_F(FakeSlurm, HasOneClientForARun) {
  jobs(1);
  std::pair<ExitCode, std::string> second;
  SlurmWork work = toy.work();
  work.missing = [&, missing = work.missing] {
    if (second.second.empty()) second = failure();
    return missing();
  };
  run_on_slurm(work, options);
  EXPECT_EQ(second.first, ExitCode::kOutput);
  EXPECT_THAT(second.second,
              AllOf(HasSubstr("another client"), HasSubstr(std::to_string(::getpid()))));
}

TEST_F(FakeSlurm, EndsTheRunWithCommandsToTypeWhereAllIsHeld) {
  jobs(1);
  options.stall = std::chrono::milliseconds(500);
  fake("squeue", R"(
case "$*" in *--me*) exit 0;; esac
echo '0|PENDING|launch failed requeued held|'; echo '1|REQUEUE_HOLD|job_requeued_in_held_state|')");
  const auto [code, message] = failure();
  EXPECT_EQ(code, ExitCode::kEngine);
  EXPECT_THAT(message,
              AllOf(HasSubstr("launch failed requeued held"), HasSubstr("scontrol release 100"),
                    HasSubstr("scancel --me --name=lobelia-")));
  EXPECT_THAT(lines("cancelled"), IsEmpty());
}

TEST_F(FakeSlurm, EndsTheRunWithTheStatesOfNodesOutOfUse) {
  jobs(1);
  options.stall = std::chrono::milliseconds(500);
  fake("squeue", "case \"$*\" in *--me*) exit 0;; esac; echo '0|PENDING|Resources|'");
  fake("sinfo",
       "for n in n1 n2; do echo \"$n|render*|up|drain|1|0/0/2/2\"; done; "
       "echo 'n3|render*|down|idle|1|0/2/0/2'; echo 'n4|other|up|idle|1|0/2/0/2'");
  const auto [code, message] = failure();
  EXPECT_EQ(code, ExitCode::kEngine);
  EXPECT_THAT(message, AllOf(HasSubstr("(n1 is drain, n2 is drain, n3 is idle in a partition that "
                                       "is down): "),
                             HasSubstr("sinfo -R"), HasSubstr("State=RESUME")));
}

TEST_F(FakeSlurm, IsWaitedForWhileSomethingCanStillRun) {
  jobs(1);
  options.stall = std::chrono::milliseconds(200);
  // Held, but one runs; then none runs, but a node is of use; then it is gone.
  fake("squeue", R"(
case "$*" in *--me*) exit 0;; esac
n=$(cat "$d/asked" 2>/dev/null || echo 0); echo $((n + 1)) > "$d/asked"
if [ $n -lt 5 ]; then echo '0|PENDING|JobHeldUser|'; echo '1|RUNNING|None|n1'
elif [ $n -lt 10 ]; then echo '0|PENDING|JobHeldUser|'; echo '1|PENDING|ReqNodeNotAvail, UnavailableNodes:n2|'; fi)");
  EXPECT_THAT(run_on_slurm(toy.work(), options).missing, IsEmpty());
}

TEST_F(FakeSlurm, HasNotStalledWhileItRunsSomethingNowAndThen) {
  jobs(1);
  options.first_poll = options.last_poll = std::chrono::milliseconds(20);
  options.stall = std::chrono::seconds(4);
  // Held at every other answer, for longer than the limit in all.
  fake("squeue", R"(
case "$*" in *--me*) exit 0;; esac
now=$(date +%s%N); [ -e "$d/began" ] || echo $now > "$d/began"
[ $((now - $(cat "$d/began"))) -gt 5000000000 ] && exit 0
if [ -e "$d/odd" ]; then rm "$d/odd"; echo '0|RUNNING|None|n1'; else touch "$d/odd"; echo '0|PENDING|JobHeldUser|'; fi)");
  EXPECT_THAT(run_on_slurm(toy.work(), options).missing, IsEmpty());
}

TEST_F(FakeSlurm, IsToldToCancelByNameOnCtrlCUnlessTheUserLeavesTheJobs) {
  jobs(1);
  fs::remove(bin() / "sbatch");
  fake("sbatch", "echo 100");
  fake("squeue", R"(
[ -e "$d/cancelled" ] && exit 0
case "$*" in *--me*) [ -e "$d/waits" ] && echo '100|RUNNING|lobelia 1-0'; exit 0;; esac
touch "$d/waits"; echo '0|RUNNING|None|n1')");
  for (const bool leave : {true, false}) {
    fs::remove(in("waits"));
    options.cancel_on_interrupt = [&] { return !leave; };
    ClientProcess client(toy.work(), options, in("log"));
    ASSERT_TRUE(eventually([&] { return fs::exists(in("waits")); }));
    client.signal(SIGINT);
    EXPECT_EQ(client.wait(), int(ExitCode::kInterrupted));
    const std::string log = read_file(in("log"), 1 << 20);
    EXPECT_THAT(log, HasSubstr(leave ? "left running: job 100" : "cancelled job 100"));
    EXPECT_EQ(lines("cancelled").empty(), leave);
    if (leave) continue;
    EXPECT_THAT(lines("cancelled").front(), HasSubstr("--me --name=lobelia-"));
  }
}

TEST_F(FakeSlurm, IsLeftByASecondCtrlCThatNamesTheJobs) {
  jobs(1);
  fake("sbatch", "echo 100");
  fake("squeue",
       "touch \"$d/waits\"; case \"$*\" in *--me*) exit 0;; esac; echo '0|RUNNING|None|n1'");
  options.finish = false;
  options.cancel_on_interrupt = [&] {
    write_file(in("asked"), "");
    std::this_thread::sleep_for(std::chrono::seconds(60));
    return true;
  };
  const int saved = ::dup(2);
  FILE* words = std::fopen(in("words").c_str(), "w");
  ::dup2(::fileno(words), 2);
  ClientProcess client(toy.work(), options, in("log"));
  ::dup2(saved, 2);
  ::close(saved);
  std::fclose(words);
  ASSERT_TRUE(eventually([&] { return fs::exists(in("waits")) && lines("log").size() == 1; }));
  client.signal(SIGINT);
  ASSERT_TRUE(eventually([&] { return fs::exists(in("asked")); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(400));  // sooner it counts as the same wish
  client.signal(SIGINT);
  EXPECT_EQ(client.wait(), 128 + SIGINT);
  EXPECT_THAT(read_file(in("words"), 1000),
              HasSubstr("left running: job 100 (scancel --me --name=lobelia-"));
}

TEST_F(FakeSlurm, IsGivenNoPathWithABackslash) {
  ToyWork odd(in("50% of it's"), 1, 0);
  run_on_slurm(odd.work(), options);
  EXPECT_EQ(odd.results(), odd.wanted());
  EXPECT_THAT(lines("submitted").front(), HasSubstr("50%% of it's/run/log/%A_%a.log"));
  ToyWork refused(in("back\\slash"), 1, 0);
  EXPECT_THROW(run_on_slurm(refused.work(), options), Error);
}

TEST_F(FakeSlurm, RunsNoChunkThatWasChangedAfterItWasSubmitted) {
  jobs(1);
  options.rounds = 1;
  fs::rename(bin() / "sbatch", bin() / "sbatch.good");
  fake("sbatch", R"(echo 'evil 0' > "$d/toy/run/chunks/0"; exec "$d/bin/sbatch.good" "$@")");
  EXPECT_THAT(run_on_slurm(toy.work(), options).missing, ElementsAre("job000"));
  EXPECT_THAT(toy.started(), IsEmpty());
}

TEST_F(FakeSlurm, GetsNoForeignScript) {
  jobs(1);
  fs::rename(bin() / "sbatch", bin() / "sbatch.good");
  fake("sbatch", R"(for s in "$d"/toy/run/submit/*.sh; do echo ": > '$d/evil'" > "$s"; done
exec "$d/bin/sbatch.good" "$@")");
  EXPECT_THAT(run_on_slurm(toy.work(), options).missing, IsEmpty());
  EXPECT_FALSE(fs::exists(in("evil")));
  EXPECT_EQ(toy.finished(), "1\n");
}

TEST_F(FakeSlurm, NeverHearsTheNameOfAnotherRunsJobsFromAForgedRecord) {
  jobs(1);
  records::SlurmRun forged;
  forged.round = 7;
  forged.next_chunk = 5;
  forged.arrays = {{41, 0, 1, 0, 1, "7-0", "900G"}};
  for (const std::string name : {"lobelia-0123456789abcdef", "lobelia-", "mine", "x,y"}) {
    forged.name = name;
    records::write_record(toy.run_directory() / "slurm.json", forged);
    fake("squeue", "echo \"$*\" >> \"$d/asked\"");
    const SlurmStatus status = slurm_status(toy.run_directory());
    EXPECT_THAT(status.foreign, AllOf(HasSubstr("slurm.json"), HasSubstr("'" + name + "'"),
                                      HasSubstr("'" + status.name + "'")));
    EXPECT_THAT(lines("asked"), ElementsAre(HasSubstr("--name=" + status.name)));
    fs::remove(in("asked"));
  }
  // A run goes on with its own name, and gives away no number of a chunk twice.
  said.clear();
  EXPECT_THAT(run_on_slurm(toy.work(), options).missing, IsEmpty());
  EXPECT_THAT(said, HasSubstr("names jobs 'x,y', which are left alone"));
  for (const std::string& line : lines("asked")) EXPECT_THAT(line, Not(HasSubstr("x,y")));
  EXPECT_THAT(arrays(), ElementsAre(AllOf(HasSubstr("--job-name=lobelia-"), Not(HasSubstr("x,y")),
                                          HasSubstr("--comment=lobelia 8-5"))));
  EXPECT_EQ(slurm_status(toy.run_directory()).foreign, "");
}

TEST_F(FakeSlurm, FindsARunByAnyPathOfItsDirectory) {
  jobs(1);
  options.detach = true;
  const fs::path link = in("link");
  fs::create_directory_symlink(directory_.path() / "toy", link);
  run_on_slurm(toy.work(), options);
  const std::string name = slurm_status(toy.run_directory()).name;
  for (const fs::path& path : {link / "run", toy.run_directory() / ".", in("toy/results/../run")}) {
    const SlurmStatus status = slurm_status(path);
    EXPECT_EQ(status.name, name) << path;
    EXPECT_EQ(status.foreign, "") << path;
  }
  records::SlurmRun earlier;
  earlier.name = "lobelia-" + hex(sha256((link / "run").string())).substr(0, 16);
  records::write_record(toy.run_directory() / "slurm.json", earlier);
  EXPECT_EQ(slurm_status(link / "run").name, earlier.name);
  EXPECT_EQ(slurm_status(link / "run").foreign, "");
  EXPECT_NE(slurm_status(toy.run_directory()).foreign, "");
}

TEST_F(FakeSlurm, ReportsTheStateOfADetachedRun) {
  jobs(1);
  EXPECT_EQ(slurm_status(toy.run_directory()).name, "");
  options.detach = true;
  fake("squeue", "case \"$*\" in *--me*) exit 0;; esac; echo '0|PENDING|Resources|'");
  const auto outcome = run_on_slurm(toy.work(), options);
  EXPECT_TRUE(outcome.detached);
  EXPECT_THAT(outcome.jobs, ElementsAre(100u, 101u));
  EXPECT_THAT(lines("cancelled"), IsEmpty());
  fake("squeue", R"(
case "$*" in *--me*) echo '100|RUNNING|lobelia 1-0'; exit 0;; esac
echo '0|COMPLETED|None|n1'; echo '1|RUNNING|None|n1'; echo '[2-5]|PENDING|Priority|')");
  const SlurmStatus status = slurm_status(toy.run_directory());
  EXPECT_EQ(status.round, 1);
  ASSERT_EQ(status.living.size(), 1u);
  EXPECT_EQ(status.elements.pending, 4u);
  EXPECT_EQ(status.elements.running, 1u);
  EXPECT_EQ(status.elements.ended, 1u);
  EXPECT_EQ(status.elements.reason, "Priority");
  fake("squeue", "exit 1");
  EXPECT_NE(slurm_status(toy.run_directory()).problem, "");
}

}  // namespace
}  // namespace lobelia

#include "farm/slurm/slurm_answers.hpp"

#include "base/system/error.hpp"
#include "farm/slurm/slurm_options.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

using Lines = std::vector<std::string>;
using State = SlurmElement::State;

TEST(SlurmAnswers, CountTheElementsOfAnArrayInEveryForm) {
  const std::pair<const char*, std::size_t> forms[] = {{"0", 1},
                                                       {"N/A", 1},
                                                       {"3-9", 7},
                                                       {"[3-9]", 7},
                                                       {"[3-9%2]", 7},
                                                       {"3-9%2", 7},
                                                       {"1,3,5-7", 5},
                                                       {"0-9:3", 4},
                                                       {"[1,4-5%1]", 3},
                                                       {"1-2,...", 2},
                                                       {"0-3999999", 4000000}};
  for (const auto& [text, count] : forms) EXPECT_EQ(count_of_array_tasks(text), count) << text;
  for (const char* text : {"",          "[",
                           "]",         "[3-9",
                           "3-9]",      "9-3",
                           "-",         "3-",
                           "-3",        "a",
                           "1,,2",      ",",
                           "1,",        "...",
                           "1-9:0",     "1-9:",
                           "3%",        "3%x",
                           "1 2",       "0x3",
                           "+3",        "99999999999999999999",
                           "0-4000001", "0-3999999,0-3999999",
                           "n/a"})
    EXPECT_FALSE(count_of_array_tasks(text)) << text;
}

TEST(SlurmAnswers, NameElementsWithStateReasonAndNodesFromSqueue) {
  const auto elements = parse_elements(Lines{
      "0|RUNNING|None|n1", "7|PENDING|Resources|", "[8-9%2]|PENDING|launch failed requeued held|",
      "squeue: warning: something", "3|COMPLETED|None|n2", "4|NODE_FAIL|None|n[1-2]",
      "5|BRAND_NEW|None|n1", "6|PENDING|odd | reason|", "1|REQUEUED|None|"});
  ASSERT_TRUE(elements);
  ASSERT_EQ(elements->size(), 8u);
  EXPECT_EQ(elements->at(0).state, State::kRunning);
  EXPECT_EQ(elements->at(0).nodes, "n1");
  EXPECT_EQ(elements->at(1).reason, "Resources");
  EXPECT_EQ(elements->at(2).count, 2u);
  EXPECT_EQ(elements->at(2).reason, "launch failed requeued held");
  EXPECT_EQ(elements->at(3).state, State::kEnded);
  EXPECT_EQ(elements->at(4).state, State::kEnded);
  EXPECT_EQ(elements->at(5).state, State::kRunning);  // unknown: it goes on
  EXPECT_EQ(elements->at(6).reason, "odd | reason");
  EXPECT_EQ(elements->at(7).state, State::kPending);
  EXPECT_TRUE(parse_elements({})->empty());
}

TEST(SlurmAnswers, AreNoneIfTheyAreCutOrOdd) {
  for (const char* line : {"3|RUNN", "3|RUNNING|None", "3", "|RUNNING|None|n1", "3||None|n1",
                           "x|RUNNING|None|n1", "3|running|None|n1", "<html>", "3 RUNNING None n1",
                           "slurm_load_jobs error: Socket timed out on send/recv operation"})
    EXPECT_FALSE(parse_elements(Lines{"1|RUNNING|None|n1", line})) << line;
  for (const char* line :
       {"3|RUNN", "3", "0|RUNNING|x", "|RUNNING|x", "3_1|RUNNING|x", "3|Running|x",
        "4294967290|RUNNING|x", "slurm_load_jobs error: Invalid user id"})
    EXPECT_FALSE(parse_living_jobs(Lines{"1|RUNNING|a", line})) << line;
  for (const char* line :
       {"n1|render*|up|idle|1|0/6/0", "n1|render*|up|idle|x|0/6/0/6", "n1|render*|up||1|0/6/0/6",
        "n1||up|idle|1|0/6/0/6", "-|render*|up|idle|1|0/6/0/6", "n1|render*|up|idle|1|0/6/0/6/1",
        "n1|render*|up|idle|1|0/6//6", "n1|render*|up|idle|1"})
    EXPECT_FALSE(parse_node_list(Lines{line})) << line;
  EXPECT_FALSE(parse_config(Lines{"nothing here"}));
}

TEST(SlurmAnswers, AreOneNumberAmongWarningsFromSbatch) {
  EXPECT_EQ(parse_submission(Lines{"12"}), 12u);
  EXPECT_EQ(parse_submission(Lines{"sbatch: warning: x", "12;cluster"}), 12u);
  for (const Lines& lines : {Lines{}, Lines{"0"}, Lines{"-1"}, Lines{"Submitted batch job 12"},
                             Lines{"12", "13"}, Lines{"12 "}, Lines{"4294967295"}, Lines{"12x"}})
    EXPECT_FALSE(parse_submission(lines)) << testing::PrintToString(lines);
}

TEST(SlurmAnswers, NameALivingJobOnce) {
  const auto jobs =
      parse_living_jobs(Lines{"8|PENDING|lobelia 1-0", "8|RUNNING|lobelia 1-0", "9|PENDING|(null)",
                              "7|COMPLETED|x", "6|COMPLETING|y|z"});
  ASSERT_TRUE(jobs);
  ASSERT_EQ(jobs->size(), 3u);
  EXPECT_EQ(jobs->at(0).comment, "y|z");
  EXPECT_EQ(jobs->at(1).id, 8u);
}

TEST(SlurmAnswers, SayWhichNodesAreOfUse) {
  const auto nodes =
      parse_node_list(Lines{"n1|render*|up|idle|8000|0/6/0/6", "n2|render*|up|idle*|1|0/2/0/2",
                            "n3|render*|up|idle~|1|0/2/0/2", "n4|render*|up|mix|8000+|1/1/0/2",
                            "n5|render*|up|down*|1|0/0/2/2", "n6|render*|up|drain|1|0/0/2/2",
                            "n7|render*|up|drng|1|2/0/0/2", "n8|old|down|idle|1|0/2/0/2"});
  ASSERT_TRUE(nodes);
  std::vector<bool> usable;
  for (const SlurmNode& node : *nodes) usable.push_back(node.usable);
  EXPECT_EQ(usable, (std::vector<bool>{true, false, true, true, false, false, false, false}));
  EXPECT_EQ(nodes->at(0).processors, 6u);
  EXPECT_TRUE(nodes->at(0).is_default);
  EXPECT_EQ(nodes->at(0).partition, "render");
  EXPECT_EQ(nodes->at(3).mebibytes, 8000);
  EXPECT_EQ(nodes->at(3).processors, 2u);
  EXPECT_EQ(nodes->at(7).state, "idle in a partition that is down");
}

TEST(SlurmAnswers, AreKeysAndValuesOfTheConfiguration) {
  const auto config =
      parse_config(Lines{"Configuration data as of 2026-11-21", "KillWait                = 30 sec",
                         "MaxArraySize            = 1001", "Slurmctld(primary) at vm is UP"});
  ASSERT_TRUE(config);
  EXPECT_EQ(config->at("KillWait"), "30 sec");
  EXPECT_EQ(config->at("MaxArraySize"), "1001");
}

TEST(SlurmAnswers, AreReadOrRefusedFromRandomBytes) {
  std::mt19937 random(1);
  const std::string alphabet = "0123456789|[]-,%:;*/ =ADEGINPRU_\n\t\x01\xff";
  for (int i = 0; i < 50000; ++i) {
    Lines lines(1 + random() % 3);
    for (auto& line : lines)
      for (auto n = random() % 30; n > 0; --n) line += alphabet[random() % alphabet.size()];
    for (const auto& element : parse_elements(lines).value_or(std::vector<SlurmElement>()))
      ASSERT_GE(element.count, 1u);
    ASSERT_GT(parse_submission(lines).value_or(1), 0u);
    parse_living_jobs(lines);
    parse_node_list(lines);
    parse_config(lines);
  }
}

TEST(SlurmAnswers, TellBlockedJobsFromQueuedOnes) {
  for (const char* reason :
       {"JobHeldUser", "JobHeldAdmin", "launch failed requeued held", "PartitionDown",
        "job requeued in held state held", "DependencyNeverSatisfied"})
    EXPECT_TRUE(waits_for_somebody(reason)) << reason;
  for (const char* reason :
       {"None", "Resources", "Priority", "Dependency", "BeginTime", "JobArrayTaskLimit",
        "QOSMaxCpuPerUserLimit", "ReqNodeNotAvail, UnavailableNodes:n2", "Licenses"})
    EXPECT_FALSE(waits_for_somebody(reason)) << reason;
}

TEST(SlurmOptions, BecomeArgumentsOfSbatch) {
  SlurmOptions options;
  options.partition = "render";
  options.time = "1:00:00";
  options.memory = "4G";
  options.account = "lab";
  options.qos = "low";
  options.constraint = "avx2&fast";
  options.exclusive = true;
  options.processors = 4;
  options.raw = {"--nice=100", "--exclude=n7"};
  EXPECT_EQ(sbatch_arguments(options),
            (Lines{"--partition=render", "--time=1:00:00", "--mem=4G", "--account=lab", "--qos=low",
                   "--constraint=avx2&fast", "--exclusive", "--cpus-per-task=4", "--nice=100",
                   "--exclude=n7"}));
  EXPECT_EQ(sbatch_arguments({}), Lines{"--cpus-per-task=1"});
}

TEST(SlurmOptions, AskForMemoryForAllProcessors) {
  EXPECT_EQ(memory_of_element(std::uint64_t{4} << 30, 1), "4608M");
  EXPECT_EQ(memory_of_element((std::uint64_t{1} << 30) + 1, 4), "4612M");
  EXPECT_EQ(memory_of_element(0, 4), "") << "any amount is not asked for";
}

TEST(SlurmOptions, AreRefusedIfTheyWouldBreakTheRun) {
  const auto refused = [](auto change) {
    SlurmOptions options;
    change(options);
    return thrown_by([&] { sbatch_arguments(options); }).code() == ExitCode::kUsage;
  };
  for (const char* raw : {"-n4", "script.sh", "--", "", "--x\n--y", "--array=0-3", "--job-name=a",
                          "--wrap=id", "--output=x", "--dependency=singleton", "--depend=x",
                          "--arr=1", "--export=NONE", "--no-requeue", "--wait"})
    EXPECT_TRUE(refused([raw](SlurmOptions& o) { o.raw = {raw}; })) << raw;
  for (const char* raw :
       {"--nice", "--exclude=n7", "--gres=gpu:1", "--mail-type=END", "--reservation=x"})
    EXPECT_FALSE(refused([&](SlurmOptions& o) { o.raw = {raw}; })) << raw;
  EXPECT_TRUE(refused([](SlurmOptions& o) { o.partition = "a\nb"; }));
  EXPECT_TRUE(refused([](SlurmOptions& o) { o.time = std::string(2000, '1'); }));
  EXPECT_TRUE(refused([](SlurmOptions& o) { o.processors = 0; }));
  EXPECT_TRUE(refused([](SlurmOptions& o) { o.throttle = -1; }));
}

TEST(SlurmLimits, ReadTimesAsSbatchDoes) {
  const std::pair<const char*, long long> times[] = {
      {"90", 5400},     {"90:30", 5430},     {"1:30:00", 5400},    {"01:30:00", 5400},
      {"2-12", 216000}, {"2-12:30", 217800}, {"1-00:00:01", 86401}};
  for (const auto& [text, seconds] : times) EXPECT_EQ(parse_slurm_time(text), seconds) << text;
  for (const char* none : {"", "0", "UNLIMITED", "INFINITE", "-1", "1:2:3:4", "1-", "-", ":", "1:",
                           "ten", "1e3", "99999999999999999999", "999999999-00", "1--2", " 1"})
    EXPECT_EQ(parse_slurm_time(none), std::nullopt) << none;
}

TEST(SlurmLimits, ReadMemoryAsSbatchDoes) {
  const std::pair<const char*, long long> sizes[] = {
      {"4000", 4000}, {"4000M", 4000}, {"4G", 4096}, {"4g", 4096},
      {"4GB", 4096},  {"1T", 1048576}, {"512K", 1}};
  for (const auto& [text, size] : sizes) EXPECT_EQ(parse_slurm_memory(text), size) << text;
  for (const char* none : {"", "0", "G", "-4G", "4X", "4.5G", "999999999T", "4G --wrap=x"})
    EXPECT_EQ(parse_slurm_memory(none), std::nullopt) << none;
}

TEST(SlurmLimits, AreWrittenSoThatTheyReadBack) {
  for (const long long seconds : {60LL, 5400LL, 86400LL, 217801LL})
    EXPECT_EQ(parse_slurm_time(slurm_time_text(seconds)), seconds);
  for (const long long size : {1LL, 1500LL, 4096LL})
    EXPECT_EQ(parse_slurm_memory(slurm_memory_text(size)), size);
  EXPECT_EQ(slurm_time_text(5400), "1:30:00");
  EXPECT_EQ(slurm_time_text(217800), "2-12:30:00");
  EXPECT_EQ(slurm_memory_text(4096), "4G");
  EXPECT_EQ(slurm_memory_text(1500), "1500M");
}

TEST(SlurmLimits, AreDoubledUpToTheMaximum) {
  EXPECT_EQ(twice_at_most(60, {}), 120);
  EXPECT_EQ(twice_at_most(60, 100), 100);
  EXPECT_EQ(twice_at_most(60, 60), std::nullopt);
  EXPECT_EQ(twice_at_most(60, 10), std::nullopt);
  EXPECT_EQ(twice_at_most(900'000'000, {}), std::nullopt);
}

TEST(SlurmLimits, GivenAsRawOptionsMoveIntoTheirOwnFields) {
  SlurmOptions options;
  options.time = "10";
  options.raw = {"--time=20",        "--exclude=n1", "--mem=4G",  "--mem-per-cpu=1G",
                 "--exclude=m[1-2]", "--exclusive",  "--exclud=k"};
  const SlurmOptions own = with_own_fields(options);
  EXPECT_EQ(own.time, "20");
  EXPECT_EQ(own.memory, "4G");
  EXPECT_EQ(own.exclude, "n1,m[1-2],k");
  EXPECT_THAT(own.raw, testing::ElementsAre("--mem-per-cpu=1G", "--exclusive"));
}

}  // namespace
}  // namespace lobelia

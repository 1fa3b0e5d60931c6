#include "farm/slurm/slurm_options.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

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

// Laws of make_chunks over many random sets of jobs.
#include "farm/slurm/slurm_run.hpp"

#include "tests/more_samples.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

struct Case {
  std::vector<SlurmJob> jobs;
  ChunkRule rule;
  std::vector<std::vector<std::size_t>> chunks;
  double total = 0;
  double cost(std::size_t chunk) const { return cost_of(jobs, chunks[chunk]); }
};

/// Costs over six decades, one to forty batches, clusters of one to three hundred slots.
Case random_case(unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  Case result;
  const auto count = std::size_t(std::exp(uniform(0, std::log(3000.0))));
  const auto batches = int(std::exp(uniform(0, std::log(40.0))));
  const double middle = uniform(-2, 2), spread = uniform(0, 2);
  for (std::size_t i = 0; i < count; ++i)
    result.jobs.push_back({std::to_string(i), 0, std::pow(10.0, middle + uniform(-spread, spread)),
                           std::to_string(int(uniform(0, batches)))});
  result.rule.slots = std::size_t(std::exp(uniform(0, std::log(300.0))));
  result.rule.most_chunks = std::size_t(std::exp(uniform(0, std::log(1000.0))));
  result.rule.target_seconds = uniform(10, 120);
  result.chunks = make_chunks(result.jobs, result.rule);
  for (std::size_t i = 0; i < result.chunks.size(); ++i) result.total += result.cost(i);
  return result;
}

const unsigned kCases = 1500u * unsigned(more_samples());

TEST(Chunks, HoldEachJobOnceWithinTheirBounds) {
  bool bound_was_reached = false;
  int several = 0;
  for (unsigned seed = 0; seed < kCases; ++seed) {
    const Case made = random_case(seed);
    std::vector<std::size_t> all;
    for (const auto& chunk : made.chunks) {
      ASSERT_FALSE(chunk.empty()) << seed;
      ASSERT_TRUE(std::is_sorted(chunk.begin(), chunk.end())) << seed;
      all.insert(all.end(), chunk.begin(), chunk.end());
    }
    std::sort(all.begin(), all.end());
    std::vector<std::size_t> wanted(made.jobs.size());
    std::iota(wanted.begin(), wanted.end(), 0);
    ASSERT_EQ(all, wanted) << seed;
    ASSERT_LE(made.chunks.size(), made.rule.most_chunks) << seed;
    bound_was_reached |= made.chunks.size() == made.rule.most_chunks && made.rule.most_chunks > 9;
    if (made.chunks.size() == 1) continue;
    ++several;
    for (std::size_t i = 0; i < made.chunks.size(); ++i) {
      ASSERT_GE(made.cost(i), made.rule.least_seconds) << seed;
      // The costliest comes first.
      ASSERT_TRUE(i == 0 || made.cost(i - 1) >= made.cost(i) * (1 - 1e-12)) << seed;
    }
  }
  EXPECT_TRUE(bound_was_reached);
  EXPECT_GT(several, int(kCases) / 4);
  EXPECT_TRUE(make_chunks({}, {}).empty());
}

TEST(Chunks, SpreadABatchOverNoMoreThanItsCostFills) {
  for (unsigned seed = 0; seed < kCases; ++seed) {
    const Case made = random_case(seed);
    std::map<std::string, std::set<std::size_t>> where;
    std::map<std::string, double> seconds;
    for (std::size_t i = 0; i < made.chunks.size(); ++i)
      for (const std::size_t job : made.chunks[i]) {
        where[made.jobs[job].batch].insert(i);
        seconds[made.jobs[job].batch] += cost_of(made.jobs, {{job}});
      }
    const double size =
        std::max(made.rule.least_seconds,
                 std::min(made.rule.target_seconds, made.total / double(4 * made.rule.slots)));
    for (const auto& [batch, chunks] : where)
      ASSERT_LE(double(chunks.size()), std::max(1.0, seconds[batch] / size + 1e-6)) << seed;
  }
}

/// Graham's bound for longest first: nobody is above the mean by more than one job.
TEST(Chunks, ExceedTheMeanOfTheirBatchByAtMostOneJob) {
  int several = 0;
  for (unsigned seed = 0; seed < kCases; ++seed) {
    Case made = random_case(seed);
    double longest = 0;
    for (auto& job : made.jobs) {
      job.batch = "one";
      longest = std::max(longest, cost_of({&job, 1}, {{0}}));
    }
    made.rule.least_seconds = 0;  // no chunk is merged for being light
    made.chunks = make_chunks(made.jobs, made.rule);
    const double mean = made.total / double(made.chunks.size());
    several += made.chunks.size() > 1;
    for (std::size_t i = 0; i < made.chunks.size(); ++i)
      ASSERT_LE(made.cost(i), (mean + longest) * (1 + 1e-9)) << seed;
  }
  EXPECT_GT(several, int(kCases) / 4);
}

TEST(Chunks, AreFourForASlotWhereWorkAllows) {
  const std::vector<SlurmJob> jobs(2000, {"job", 0, 1, "one"});
  EXPECT_EQ(make_chunks(jobs, {.slots = 10}).size(), 40u);
  EXPECT_EQ(make_chunks(jobs, {.slots = 1}).size(), 33u);     // 60 s each
  EXPECT_EQ(make_chunks(jobs, {.slots = 100}).size(), 200u);  // 10 s each, no less
  EXPECT_EQ(make_chunks(jobs, {.slots = 100, .most_chunks = 50}).size(), 50u);
}

TEST(Chunks, TakeAnyNumberForACost) {
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<SlurmJob> jobs;
  for (const double seconds : {std::nan(""), infinity, -infinity, -1.0, 0.0, 1e300, 20.0})
    jobs.push_back({"job", 0, seconds, "one"});
  std::size_t count = 0;
  for (const auto& chunk : make_chunks(jobs, {.slots = 3})) count += chunk.size();
  EXPECT_EQ(count, jobs.size());
}

}  // namespace
}  // namespace lobelia

// Laws of make_chunks over many random sets of jobs.
#include "farm/slurm/slurm_run.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "farm/chunk.hpp"
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

using testing::SizeIs;

class ChunkReportFiles : public testing::Test {
 protected:
  ChunkReportFiles() { ::setenv("SLURMD_NODENAME", "n2", 1); }
  ~ChunkReportFiles() override { ::unsetenv("SLURMD_NODENAME"); }
  fs::path run() const { return directory_.path() / "run"; }
  fs::path file(const std::string& name) const { return run() / "reports" / name; }
  void report(std::size_t number, const std::string& engine) const {
    const LeftUndone left{engine, "it failed 5 times in a row"};
    write_chunk_report(run(), number, {&left, 1});
  }
  /// A report but for what is put in.
  static std::string text(const std::string& node, const std::string& left) {
    return fmt::format(
        R"({{"schemaVersion": 1, "kind": "farm-chunk-report", "node": {}, "left": {}}})", node,
        left);
  }
  TemporaryDirectory directory_;
};

TEST_F(ChunkReportFiles, AreReadAsTheyWereWritten) {
  EXPECT_THAT(read_chunk_reports(run()).reports, IsEmpty());
  write_chunk_report(run(), 3, {});
  EXPECT_FALSE(fs::exists(run())) << "there is nothing to tell";
  report(12, "povray");
  report(3, "");
  report(3, "blender");  // a second time over the first
  const ChunkReports found = read_chunk_reports(run());
  EXPECT_THAT(found.problems, IsEmpty());
  ASSERT_THAT(found.reports, SizeIs(2));
  EXPECT_EQ(found.reports[0].number, 3u);
  EXPECT_EQ(found.reports[0].node, "n2");
  ASSERT_THAT(found.reports[0].left, SizeIs(1));
  EXPECT_EQ(found.reports[0].left[0].engine, "blender");
  EXPECT_EQ(found.reports[1].left[0].why, "it failed 5 times in a row");
  EXPECT_THAT(read_chunk_reports(run(), 4, 12).reports, IsEmpty());
  EXPECT_THAT(read_chunk_reports(run(), 4, 13).reports, SizeIs(1));
}

TEST_F(ChunkReportFiles, NameTheHostWhereSlurmNamesNoNode) {
  for (const char* name : {"--wrap=reboot", "n1,n2", "n[1-3]", "", "a/b"}) {
    ::setenv("SLURMD_NODENAME", name, 1);
    EXPECT_NE(own_node_name(), name);
  }
  ::setenv("SLURMD_NODENAME", "rack-7.node_3", 1);
  EXPECT_EQ(own_node_name(), "rack-7.node_3");
}

TEST_F(ChunkReportFiles, AreBoundedForAnyEngine) {
  std::vector<LeftUndone> left(300, {"povray", std::string(10000, 'x') + "\n\x1b[2J"});
  write_chunk_report(run(), 1, left);
  EXPECT_LT(fs::file_size(file("1.json")), 64u << 10);
  EXPECT_THAT(read_chunk_reports(run()).reports, SizeIs(1));
}

TEST_F(ChunkReportFiles, AreNotWrittenThroughALink) {
  const fs::path elsewhere = directory_.path() / "elsewhere";
  fs::create_directories(elsewhere);
  write_file(elsewhere / "1.json", "precious");
  fs::create_directories(run());
  fs::create_directory_symlink(elsewhere, run() / "reports");
  EXPECT_THROW(report(1, "povray"), Error);
  fs::remove(run() / "reports");
  fs::create_directories(run() / "reports");
  fs::create_symlink(elsewhere / "1.json", file("1.json"));
  EXPECT_THROW(report(1, "povray"), Error);
  EXPECT_EQ(read_file(elsewhere / "1.json", 100), "precious");
}

TEST_F(ChunkReportFiles, AreProblemsAndNothingElseIfTheyAreInvalid) {
  const std::string left = R"([{"engine": "povray", "why": "w"}])";
  report(0, "povray");
  fs::rename(file("0.json"), directory_.path() / "good.json");
  const std::pair<const char*, std::string> broken[] = {
      {"no record", ""},
      {"no record", std::string(60000, '[')},
      {"another kind", R"({"schemaVersion": 1, "kind": "farm-chunk"})"},
      {"a node that is an option", text("\"--wrap=reboot\"", left)},
      {"a node that is a list", text("\"n1,n2\"", left)},
      {"a node that is a number", text("7", left)},
      {"a node of many bytes", text("\"" + std::string(1000, 'n') + "\"", left)},
      {"an engine that is none", text("\"n1\"", R"([{"engine": "../x", "why": "w"}])")}};
  for (const auto& [what, content] : broken) {
    write_file(file("0.json"), content);
    const ChunkReports found = read_chunk_reports(run());
    EXPECT_THAT(found.reports, IsEmpty()) << what;
    ASSERT_THAT(found.problems, SizeIs(1)) << what;
    EXPECT_THAT(found.problems[0], HasSubstr("0.json: not taken for a report: ")) << what;
  }
  write_file(file("0.json"), text("\"n1\"", left));
  EXPECT_THAT(read_chunk_reports(run()).reports, SizeIs(1)) << "this one is none of them";

  fs::resize_file(file("0.json"), 20ull << 30);  // a hole
  EXPECT_THAT(read_chunk_reports(run()).problems[0], HasSubstr("over 65536 bytes"));
  fs::remove(file("0.json"));
  fs::create_symlink(directory_.path() / "good.json", file("0.json"));
  EXPECT_THAT(read_chunk_reports(run()).problems[0], HasSubstr("a link"));
  fs::remove(file("0.json"));
  ASSERT_EQ(::mkfifo(file("0.json").c_str(), 0600), 0);
  EXPECT_THAT(read_chunk_reports(run()).problems[0], HasSubstr("not a regular file"));
  fs::remove(file("0.json"));
  fs::create_directory(file("0.json"));
  EXPECT_THAT(read_chunk_reports(run()).problems[0], HasSubstr("not a regular file"));
  for (const char* other : {"00.json", "-1.json", "x.json", "1.json.part", ".1.json.7-1.part",
                            "99999999999999999999999.json"})
    write_file(file(other), text("\"n1\"", left));
  EXPECT_THAT(read_chunk_reports(run(), 1).reports, IsEmpty());
  for (int i = 0; i < 30; ++i) write_file(file(fmt::format("{}.json", i + 1)), "x");
  EXPECT_THAT(read_chunk_reports(run()).problems, SizeIs(10));

  fs::remove_all(run() / "reports");
  fs::create_directory_symlink(directory_.path(), run() / "reports");
  EXPECT_THAT(read_chunk_reports(run()).problems, SizeIs(1));
}

}  // namespace
}  // namespace lobelia

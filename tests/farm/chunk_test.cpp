#include "farm/chunk.hpp"

#include "farm_fixture.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

const Leave kLeave = Leave::of_user(true);
constexpr char kPictures[] = "*render:*reference*", kTheRest[] = "*compare*:*profile";

class ChunkTest : public FarmTest {
 protected:
  /// Writes a chunk of the jobs whose names a filter picks; returns its file.
  fs::path chunk(const Grid& grid, const std::string& patterns,
                 const FarmOptions& options = {}) const {
    FarmWork work(grid, options);
    const ResultCache cache(out() / "cache");
    std::vector<JobIndex> jobs;
    for (JobIndex job = 0; job < work.graph.size(); ++job)
      if (work.graph[job].exists && JobFilter(patterns).picks(work.graph.name(job)))
        jobs.push_back(job);
    const fs::path file = directory_.path() / "chunk.json";
    records::write_record(file, chunk_record(work, cache, options, jobs));
    return file;
  }
  Grid two() { return grid("16, 32", "<engine name=\"analytic\"/>"); }
};

TEST_F(ChunkTest, MakesTheVeryResultsThatTheFarmWouldMake) {
  const Grid small = two();
  for (const char* part : {kPictures, kTheRest}) {
    const fs::path file = chunk(small, part);
    const ChunkSummary done = exec_chunk(file, 1, kLeave), again = exec_chunk(file, 2, kLeave);
    EXPECT_EQ(done.jobs, 4u) << part;
    EXPECT_EQ(done.done, 4u) << part;
    EXPECT_EQ(done.work.made, 4u) << part;
    EXPECT_EQ(again.done, 4u) << part;
    EXPECT_EQ(again.work.made, 0u) << part;
  }
  const FarmSummary farm = run_farm(small, out(), {});
  EXPECT_EQ(farm.work.made, 0u) << "everything was there, under the same keys";
  EXPECT_EQ(farm.pass, 2u);
}

TEST_F(ChunkTest, SkipsJobsWithoutInputs) {
  const ChunkSummary done = exec_chunk(chunk(two(), kTheRest), 1, kLeave);
  EXPECT_EQ(done.jobs, 4u);
  EXPECT_EQ(done.done, 0u);
  EXPECT_EQ(done.failed, 0u) << "the next round has it";
}

TEST_F(ChunkTest, ComparesTheRemainingPictures) {
  const Grid small = grid("16", "<engine name=\"analytic\"/><engine name=\"povray\"/>");
  FarmOptions options;
  options.attempts = 1;
  options.programs = {{"povray", failing_povray()}};
  ChunkSummary done = exec_chunk(chunk(small, kPictures, options), 1, kLeave);
  EXPECT_EQ(done.done, 2u);
  EXPECT_EQ(done.failed, 1u);
  done = exec_chunk(chunk(small, kTheRest, options), 1, kLeave);
  EXPECT_EQ(done.done, 2u) << "one comparison, and a profile without POV-Ray";
}

TEST_F(ChunkTest, HandsBackTheChunkOfAnotherMachineUndone) {
  const fs::path file = chunk(two(), "*");
  const Json record = read_json(file);
  const auto because = [&](const std::function<void(Json&)>& change) {
    Json other = record;
    change(other);
    write_json(file, other);
    const ChunkSummary summary = exec_chunk(file, 1, kLeave);
    EXPECT_EQ(summary.jobs, 8u);
    EXPECT_EQ(summary.done + summary.failed + summary.work.made, 0u);
    const ResultCache cache(out() / "cache");
    EXPECT_TRUE(cache.list().empty() && fs::is_empty(cache.directory() / "failures"));
    std::vector<std::string> why;
    for (const auto& left : summary.left) why.push_back(left.why);
    return why;
  };
  using testing::ElementsAre;
  using testing::StartsWith;
  EXPECT_THAT(because([](Json& plan) { plan["program"] = "lobelia 9.9.9 abc"; }),
              ElementsAre(testing::EndsWith("here, lobelia 9.9.9 abc in the plan")));
  EXPECT_THAT(because([](Json& plan) { plan["libraries"] = "x"; }),
              ElementsAre("libraries: other files"));
  EXPECT_THAT(because([](Json& plan) { plan["arithmetic"]["libm"] = "x"; }),
              ElementsAre("libm: other results"));
  EXPECT_THAT(because([](Json& plan) { plan["arithmetic"]["kernels"] = "none"; }),
              ElementsAre(StartsWith("kernels: ")));
  EXPECT_THAT(because([](Json& plan) { plan["arithmetic"]["processor"] = "sse2"; }),
              ElementsAre(StartsWith("processor: ")));
  write_json(file, record);
  EXPECT_EQ(exec_chunk(file, 1, kLeave).done, 8u);
}

TEST_F(ChunkTest, HandsBackJobsOfAnotherEngine) {
  const Grid small = grid("16", "<engine name=\"analytic\"/><engine name=\"povray\"/>");
  FarmOptions options;
  options.programs = {{"povray", failing_povray()}};
  const fs::path file = chunk(small, kPictures, options);
  const Json record = read_json(file);
  const auto exec = [&](const Json& plan) {
    fs::remove_all(out() / "cache");
    write_json(file, plan);
    const ChunkSummary summary = exec_chunk(file, 1, kLeave);
    EXPECT_EQ(summary.done, 2u) << "ours, and the formula's";
    EXPECT_EQ(summary.failed, 0u);
    std::vector<std::string> why;
    for (const auto& left : summary.left) why.push_back(left.why);
    return why;
  };
  using testing::ElementsAre;
  Json other = record;
  other["engines"][1]["content"] = std::string(64, '0');
  EXPECT_THAT(exec(other),
              ElementsAre("POV-Ray: engine content: other files under the same version 3.7.0.10"));
  other = record;
  other["engines"][1]["version"] = "3.8.0";
  EXPECT_THAT(exec(other),
              ElementsAre("POV-Ray: engine version: 3.7.0.10 here, 3.8.0 in the plan"));
  fs::remove(options.programs.at("povray"));
  EXPECT_THAT(exec(record), ElementsAre(testing::HasSubstr("is not a program")));
}

}  // namespace
}  // namespace lobelia

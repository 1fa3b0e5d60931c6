#include "farm/job_graph.hpp"

#include "farm/chunk.hpp"
#include "farm/job_board.hpp"
#include "farm_fixture.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

TEST(JobFilter, PicksAsGoogleTestDoes) {
  const std::string name = "phong_rdf-n16/compare-blender";
  for (const char* patterns :
       {"", "*", "phong*", "nothing:phong*", "*/compare-*", "phong_rdf-n16/compare-blender",
        "phong_rdf-n1?/*", "-*povray", "phong*:-*povray", "*****b*r", "*blender*"})
    EXPECT_TRUE(JobFilter(patterns).picks(name)) << patterns;
  for (const char* patterns : {"phong", "*povray", "-*blender", "phong*:-*blender",
                               "-phong*:nothing", "phong_rdf-n?/*", "x*:y*", "-*", ":"})
    EXPECT_FALSE(JobFilter(patterns).picks(name)) << patterns;
}

TEST(JobFilter, TakesNoTimeOverPatternsThatAreMadeToTakeIt) {
  std::string pattern;
  for (int i = 0; i < 200; ++i) pattern += "*a";
  EXPECT_FALSE(JobFilter(pattern + "b").picks(std::string(5000, 'a')));
}

class JobGraphTest : public FarmTest {
 protected:
  struct Planned {
    explicit Planned(const Grid& g)
        : grid(g),
          cells{cells_of(grid), [this](std::size_t i) { return scene_of(grid, cells.cells[i]); },
                grid.truth, grid.ours},
          engines(find_engines(grid.engines, {{}, false, {}, false, grid.outside})),
          graph(cells, engines, std::chrono::minutes(10)) {}
    Planned(const Planned&) = delete;
    Grid grid;
    FarmCells cells;
    std::vector<FarmEngine> engines;
    JobGraph graph;
    std::set<ResultKey> keys() const {
      std::set<ResultKey> found;
      for (JobIndex job = 0; job < graph.size(); ++job)
        if (graph[job].exists) found.insert(graph[job].key);
      return found;
    }
  };
};

TEST_F(JobGraphTest, EveryJobOfEveryCellHasAKeyOfItsOwn) {
  const Planned planned(grid("16, 32, 64", "<engine name=\"analytic\"/>"));
  EXPECT_EQ(planned.keys().size(), 12u);
  const Planned same(grid("16, 32, 64", "<engine name=\"analytic\"/>"));
  EXPECT_EQ(planned.keys(), same.keys());
}

TEST_F(JobGraphTest, EveryChangeOfTheSceneChangesAllItsKeys) {
  const Planned planned(grid("16", "<engine name=\"analytic\"/>"));
  const auto changes = std::vector<void (*)(Scene&)>{
      [](Scene& s) { s.film.width += 1; },
      [](Scene& s) { s.spheres[0].radius *= 1 + 1e-15; },
      [](Scene& s) { s.materials[0].highlight.lobe = *find_lobe("cs16"); },
      [](Scene& s) { s.lights.push_back(s.lights[0]); },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Grid other = grid("16", "<engine name=\"analytic\"/>");
    changes[i](other.scene);
    const Planned changed(other);
    for (const ResultKey& key : changed.keys()) EXPECT_FALSE(planned.keys().contains(key)) << i;
  }
}

TEST_F(JobGraphTest, AJobWaitsForThoseThatMakeItsInputs) {
  const Planned planned(grid("16", "<engine name=\"analytic\"/>"));
  const JobGraph& graph = planned.graph;
  EXPECT_EQ(graph.name(graph.compare(0, 0)), "n16/compare-analytic");
  EXPECT_EQ(graph.inputs(graph.compare(0, 0)),
            (std::vector<JobIndex>{graph.render(0), graph.reference(0, 0)}));
  EXPECT_EQ(graph.inputs(graph.render(0)), std::vector<JobIndex>());
  for (JobIndex job = 0; job < graph.size(); ++job)
    for (const JobIndex input : graph.inputs(job)) {
      const auto dependents = graph.dependents(input);
      EXPECT_NE(std::find(dependents.begin(), dependents.end(), job), dependents.end())
          << graph.name(job) << " waits for " << graph.name(input);
    }
}

TEST_F(JobGraphTest, ACellWithoutItsReferenceHasNoComparison) {
  write_file(directory_.path() / "x.exr", "");
  Grid compared =
      grid("16", "<engine name=\"analytic\"/><pictures name=\"theirs\" files=\"x.exr\"/>");
  compared.truth = "analytic";
  Planned planned(compared);
  JobGraph& graph = planned.graph;
  ASSERT_TRUE(graph[graph.compare(0, 1)].exists);
  graph.leave_out(0, 0);
  EXPECT_TRUE(graph[graph.reference(0, 1)].exists);
  EXPECT_FALSE(graph[graph.compare(0, 1)].exists);
}

TEST_F(JobGraphTest, NoJobWaitsForAPictureThatWasLost) {
  const Planned planned(grid("16", "<engine name=\"analytic\"/>"));
  const JobGraph& graph = planned.graph;
  std::vector<JobState> states(graph.size(), JobState::kWaiting);
  const JobRunOptions options;
  JobBoard board(graph, options, states, [](std::size_t) {});
  board.plan({0});
  board.settle(graph.render(0), JobState::kDone);
  ASSERT_TRUE(graph.may_lack(graph.profile(0), graph.reference(0, 0)));
  board.settle(graph.reference(0, 0), JobState::kBlocked);
  EXPECT_EQ(board.state(graph.compare(0, 0)), JobState::kBlocked);
  EXPECT_EQ(board.state(graph.profile(0)), JobState::kBlocked) << "the farm would never end";
}

TEST_F(JobGraphTest, AnyPartOfTheOrderIsSpreadOverTheWholeGrid) {
  Grid fine = grid("16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31");
  const std::vector<Cell> cells = cells_of(fine);
  const auto order = coarse_to_fine(cells);
  EXPECT_EQ(std::set<std::size_t>(order.begin(), order.end()).size(), cells.size());
  // Whatever number of cells is done: the longest stretch without one is at most about twice as long as it must be.
  for (std::size_t done = 1; done <= order.size(); ++done) {
    std::set<std::size_t> made(order.begin(), order.begin() + std::ptrdiff_t(done));
    std::size_t longest = 0, since = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      since = made.contains(i) ? 0 : since + 1;
      longest = std::max(longest, since);
    }
    EXPECT_LE(longest, 2 * cells.size() / done) << done;
  }
}

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

#include "base/system/error.hpp"
#include "base/system/sha256.hpp"
#include "base/words/text.hpp"
#include "farm/failed_jobs.hpp"
#include "farm/result_cache.hpp"
#include "farm/upkeep.hpp"
#include "farm_fixture.hpp"
#include "lobelia_paths.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

/// An empty $PATH, for as long as it lives.
class WithoutPrograms {
 public:
  WithoutPrograms() { ::setenv("PATH", "/nonexistent", 1); }
  ~WithoutPrograms() { ::setenv("PATH", path_.c_str(), 1); }

 private:
  std::string path_ = std::getenv("PATH");
};

TEST_F(FarmTest, SealsEveryCellWithTheHashesOfItsFiles) {
  const Grid one = grid("16", "<engine name=\"analytic\"/>");
  run_farm(one, out(), {});
  const std::string sealed = read_file(in_cell("n16", "cell.json"), 1 << 20);
  const Json farm = read_json(out() / "farm.json");
  EXPECT_EQ(farm["title"], "A small grid");
  EXPECT_EQ(farm["cells"][0]["status"], "pass");
  const Json record = cell_record("n16");
  EXPECT_EQ(record["seal"], records::seal_of(record));
  std::set<std::string> listed{"cell.json"}, there;
  for (const auto& file : record["files"]) {
    const std::string name = file["name"];
    listed.insert(name);
    EXPECT_EQ(file["sha256"], hex(sha256_of_file(in_cell("n16", name)))) << name;
  }
  for (const auto& entry : fs::directory_iterator(in_cell("n16", "")))
    there.insert(entry.path().filename().string());
  EXPECT_EQ(listed, there);
  EXPECT_EQ(record["images"].size(), 2u);
  for (const auto& image : record["images"])
    for (const char* key : {"exr", "png", "record"})
      EXPECT_TRUE(there.contains(image[key].get<std::string>())) << image[key];
  for (const char* key : {"files", "seal", "status"}) {
    Json other = record;
    other.erase(key);
    write_json(in_cell("n16", "cell.json"), other);
    EXPECT_EQ(run_farm(one, out(), {}).work.made, 0u);
    EXPECT_EQ(read_file(in_cell("n16", "cell.json"), 1 << 20), sealed) << key;
  }
}

TEST_F(FarmTest, HoldsEveryCellToTheFormulasPerPixelWithoutAnyProgram) {
  const WithoutPrograms none;
  const FarmSummary summary = run_farm(grid("16, 1e6", "<engine name=\"analytic\"/>"), out(), {});
  EXPECT_EQ(summary.pass, 2u);
  const Json profile = read_json(in_cell("n16", "profile.json"));
  EXPECT_EQ(profile["curve"].size(), 4u) << "the formula's curve stands there once";
  EXPECT_EQ(read_json(in_cell("n16", "analytic.json"))["witness"], "analytic");
}

TEST_F(FarmTest, ExplainsCellsBeyondAnEngine) {
  // Beside the grid, for a file's name on an axis ends at a blank.
  for (const char* scene : {"mirrors.xml", "area_light.xml"})
    fs::copy_file(fs::path(LOBELIA_SOURCE_DIR) / "reference_scenes" / "scenes" / "effects" / scene,
                  directory_.path() / scene);
  const auto file = directory_.path() / "effects.xml";
  write_file(file,
             "<grid version=\"1\" title=\"Effects\">"
             "<scene file=\"mirrors.xml\"/><film width=\"16\" height=\"16\"/>"
             "<axis name=\"light\" values=\"mirrors.xml, area_light.xml\"/>"
             "<engine name=\"analytic\"/></grid>");
  const FarmSummary summary = run_farm(read_grid(file), out(), {});
  EXPECT_EQ(summary.problems, std::vector<std::string>());
  EXPECT_EQ(summary.pass, 0u);
  EXPECT_EQ(summary.unchecked, 1u);
  EXPECT_EQ(summary.undecided, 1u);
  const Json sized = cell_record("area_light"), mirrors = cell_record("mirrors");
  ASSERT_EQ(sized["notComparable"].size(), 1u);
  EXPECT_EQ(sized["notComparable"][0]["engine"], "analytic");
  EXPECT_THAT(sized["notComparable"][0]["because"].get<std::string>(),
              testing::HasSubstr("lamps cannot be seen"));
  EXPECT_EQ(mirrors["notComparable"].size(), 0u);
  EXPECT_EQ(mirrors["status"], "undecided") << "at 16 x 16 pixels every one has an edge in it";
  const Json compared = read_json(in_cell("mirrors", "lobelia-analytic.json"));
  EXPECT_EQ(compared["verdict"], "undecided");
  EXPECT_EQ(compared["uncertainty"]["b"]["shared"], true);
  EXPECT_EQ(compared["metrics"]["z.beyond"], 0);
  for (const char* engine : {"lobelia", "analytic"}) {
    const Json made = read_json(in_cell("mirrors", std::string(engine) + ".json"));
    EXPECT_TRUE(fs::exists(in_cell("mirrors", made["standardError"]))) << engine;
  }
  EXPECT_EQ(mirrors["images"].size(), 2u) << "it is shown all the same";
}

TEST_F(FarmTest, ACellsSceneRendersToTheCellsPicture) {
  if (!fs::exists(LOBELIA_PROGRAM)) GTEST_SKIP() << "make sanitize-short builds no program";
  run_farm(grid("16"), out(), {});
  const int status = std::system(fmt::format("cd {} && {} render scene.xml -q -o again.exr",
                                             shell_quote(in_cell("n16", "").string()),
                                             shell_quote(LOBELIA_PROGRAM))
                                     .c_str());
  ASSERT_EQ(status, 0);
  EXPECT_EQ(read_file(in_cell("n16", "again.exr"), 1 << 24),
            read_file(in_cell("n16", "lobelia.exr"), 1 << 24));
}

TEST_F(FarmTest, MakesOnlyMissingResultsInASecondRun) {
  run_farm(grid("16, 32"), out(), {});
  const auto before = fs::last_write_time(in_cell("n16", "lobelia.exr"));
  FarmSummary summary = run_farm(grid("16, 32"), out(), {});
  EXPECT_EQ(summary.rendered, 0u);
  EXPECT_EQ(summary.kept, 2u);
  EXPECT_EQ(summary.cached_cells, 2u);
  summary = run_farm(grid("16, 32, 64"), out(), {});
  EXPECT_EQ(summary.rendered, 1u);
  EXPECT_EQ(summary.foreign, 0u);
  EXPECT_EQ(run_farm(grid("16"), out(), {}).foreign, 2u);
  EXPECT_EQ(summary.unchecked, 3u);
  // Files that are gone from the directory come back from the cache.
  for (const char* file :
       {"lobelia.exr", "lobelia.png", "scene.xml", "profile.json", "cell.json"}) {
    fs::remove(in_cell("n32", file));
    EXPECT_EQ(run_farm(grid("16, 32"), out(), {}).work.made, 0u) << file;
    EXPECT_TRUE(fs::exists(in_cell("n32", file))) << file;
  }
  fs::remove_all(out() / "cells");
  EXPECT_EQ(run_farm(grid("16, 32"), out(), {}).work.made, 0u);
  EXPECT_EQ(fs::last_write_time(in_cell("n16", "lobelia.exr")), before);
}

TEST_F(FarmTest, MakesNothingTwiceAcrossGrids) {
  FarmOptions options;
  options.cache = directory_.path() / "cache";
  run_farm(grid("16, 32"), out(), options);
  FarmSummary summary = run_farm(grid("32, 64"), directory_.path() / "other", options);
  EXPECT_EQ(summary.rendered, 1u);
  EXPECT_EQ(summary.kept, 1u);
  EXPECT_FALSE(fs::exists(out() / "cache"));
  EXPECT_TRUE(fs::equivalent(directory_.path() / "other" / "cells" / "n32" / "lobelia.exr",
                             in_cell("n32", "lobelia.exr")))
      << "one file under two names";
}

TEST_F(FarmTest, TwoCellsOfOneSceneHaveOneResult) {
  Grid twice = grid("16, 32");
  for (auto& value : twice.axes[0].values) value.apply = [](Scene&) {};
  const FarmSummary summary = run_farm(twice, out(), {});
  EXPECT_EQ(summary.rendered, 1u);
  EXPECT_EQ(summary.unchecked, 2u);
}

TEST_F(FarmTest, FilesThatNobodyMadeForACellAreTakenOutOfIt) {
  run_farm(grid("16", "<engine name=\"analytic\"/>"), out(), {});
  ASSERT_TRUE(fs::exists(in_cell("n16", "analytic.exr")));
  run_farm(grid("16"), out(), {});
  EXPECT_FALSE(fs::exists(in_cell("n16", "analytic.exr")));
  EXPECT_FALSE(fs::exists(in_cell("n16", "lobelia-analytic.json")));
}

TEST_F(FarmTest, DoesOnlyTheJobsThatAFilterPicks) {
  FarmOptions options;
  options.filter = JobFilter("n16*:-*analytic");
  const Grid two = grid("16, 32", "<engine name=\"analytic\"/>");
  FarmSummary summary = run_farm(two, out(), options);
  EXPECT_EQ(summary.rendered, 1u);
  EXPECT_EQ(summary.missing, 2u) << "one has only a part of its results, and one none";
  EXPECT_TRUE(fs::exists(in_cell("n16", "lobelia.exr")));
  EXPECT_EQ(cell_record("n16")["status"], "missing");
  EXPECT_EQ(run_farm(two, out(), {}).pass, 2u);
}

TEST_F(FarmTest, WarnsOnlyOfAFilterWithoutJobs) {
  const Grid two = grid("16, 32", "<engine name=\"analytic\"/>");
  FarmOptions options;
  options.filter = JobFilter("n99*");
  const std::string warning =
      "--filter 'n99*' picks no job of this grid; the first is named 'n16/render'";
  EXPECT_EQ(plan_farm(two, out(), options, [](auto&&...) {}).warning, warning);
  EXPECT_THAT(run_farm(two, out(), options).warnings, testing::Contains(warning));
  // The last job of all; and again, when there is nothing to be done for it.
  for (const char* filter : {"n32/profile", "n32/profile", "", "*"}) {
    options.filter = JobFilter(filter);
    EXPECT_EQ(plan_farm(two, out(), options, [](auto&&...) {}).warning, "") << filter;
    EXPECT_THAT(run_farm(two, out(), options).warnings, testing::IsEmpty()) << filter;
  }
}

TEST_F(FarmTest, PlansEveryJobWithItsReason) {
  const Grid two = grid("16, 32", "<engine name=\"analytic\"/>");
  std::map<std::string, std::string> jobs;
  const auto plan = [&](const Grid& g, const FarmOptions& options = {}) {
    jobs.clear();
    return plan_farm(g, out(), options, [&](const std::string& name, const std::string& reason) {
      EXPECT_TRUE(jobs.emplace(name, reason).second) << name;
    });
  };
  EXPECT_EQ(plan(two).wanted, 8u);
  EXPECT_EQ(jobs.at("n16/reference-analytic"), "missing");
  EXPECT_FALSE(fs::exists(out())) << "a plan writes nothing";
  EXPECT_EQ(run_farm(two, out(), {}).work.made, 8u);
  EXPECT_EQ(plan(two).wanted, 0u);
  fs::remove_all(fs::path(out() / "cache" / "results"));
  EXPECT_EQ(plan(two).wanted, 8u);
  EXPECT_EQ(jobs.at("n32/profile"), "lost from the cache");
  Grid other = two;
  other.scene.film.width = 50;
  plan(other);
  EXPECT_EQ(jobs.at("n16/render"), "scene changed");
  FarmOptions options;
  options.filter = JobFilter("*render");
  EXPECT_EQ(plan(two, options).wanted, 2u);
}

TEST_F(FarmTest, MakesCellsOfEmptyOrAlmostBlackScenes) {
  Grid empty = grid("16");
  empty.scene.spheres.clear();
  empty.scene.materials.clear();
  EXPECT_EQ(run_farm(empty, out(), {}).unchecked, 1u);
  Grid dark = grid("16");
  std::get<DirectionalLight>(dark.scene.lights[0]).irradiance = {1e-38, 1e-38, 1e-38};
  EXPECT_EQ(run_farm(dark, out(), {}).unchecked, 1u);
  EXPECT_EQ(cell_record("n16")["exposureStops"], 100);
}

TEST_F(FarmTest, ACellWithMoreThanASingleRayTellsHasNoProfile) {
  Grid mirror = grid("16");
  mirror.scene.materials[0].mirror_reflectance = {0.5, 0.5, 0.5};
  EXPECT_EQ(run_farm(mirror, out(), {}).unchecked, 1u);
  EXPECT_FALSE(cell_record("n16").contains("profile"));
  EXPECT_FALSE(fs::exists(in_cell("n16", "profile.json")));
}

TEST_F(FarmTest, AgainMakesEverythingAgain) {
  run_farm(grid("16"), out(), {});
  FarmOptions options;
  options.again = true;
  EXPECT_EQ(run_farm(grid("16"), out(), options).rendered, 1u);
}

TEST_F(FarmTest, ReportsAReadOnlyDirectoryUpFront) {
  write_file(directory_.path() / "file", "x");
  const auto run = [&] { run_farm(grid("16"), directory_.path() / "file" / "out", {}); };
  EXPECT_EQ(thrown_by(run).code(), ExitCode::kOutput);
}

TEST_F(FarmTest, ReportsEveryStep) {
  std::size_t last = 0, total = 0;
  FarmOptions options;
  options.threads = 1;
  options.on_progress = [&](const FarmProgress& progress) {
    EXPECT_EQ(progress.done, last + 1);
    last = progress.done;
    total = progress.total;
  };
  run_farm(grid("16, 32, 64"), out(), options);
  EXPECT_EQ(last, 6u) << "three pictures, three profiles";
  EXPECT_EQ(total, 6u);
}

class UpkeepTest : public FarmTest {
 protected:
  UpkeepTest() { run_farm(grid("16, 32", "<engine name=\"analytic\"/>"), out(), {}); }
  fs::path cache() const { return out() / "cache"; }
};

TEST_F(UpkeepTest, OpensFilesWithASoundHash) {
  // As a program that publishes rubbish would leave it.
  const ResultCache results(cache());
  ResultDraft draft = results.draft();
  write_file(draft.file("a.exr"), "no picture");
  write_file(draft.file("b.json"), "{");
  records::Result rubbish;
  rubbish.job = "render";
  results.publish(draft, result_key({"rubbish"}), rubbish);
  const VerifyReport report = verify_cache(cache(), false, {});
  ASSERT_EQ(report.damaged.size(), 1u);
  EXPECT_THAT(report.damaged[0], HasSubstr("is not JSON"));
}

TEST_F(UpkeepTest, GarbageGoesFromTheLeastUsedUntilTheRestFits) {
  const ResultCache results(cache());
  const auto keys = results.list();
  const auto old = fs::last_write_time(cache()) - std::chrono::hours(1000);
  for (const auto& key : keys)
    if (key != keys[3]) fs::last_write_time(results.result_directory(key), old);
  const GcReport all = collect_garbage(cache(), std::nullopt);
  EXPECT_EQ(all.kept, 8u);
  EXPECT_EQ(all.removed, 0u);
  const GcReport half = collect_garbage(cache(), all.kept_bytes / 2);
  EXPECT_LE(half.kept_bytes, all.kept_bytes / 2);
  EXPECT_EQ(half.kept + half.removed, 8u);
  EXPECT_EQ(half.kept_bytes + half.removed_bytes, all.kept_bytes);
  EXPECT_TRUE(results.has(keys[3])) << "it was used last";
  EXPECT_EQ(collect_garbage(cache(), 0).kept, 0u);
  EXPECT_TRUE(fs::exists(in_cell("n16", "lobelia.exr")))
      << "a farm's own directory keeps its files";
  EXPECT_EQ(run_farm(grid("16, 32", "<engine name=\"analytic\"/>"), out(), {}).work.made, 8u);
}

TEST_F(UpkeepTest, MarksResultsAsUsedByAFarm) {
  const ResultCache results(cache());
  const auto old = fs::last_write_time(cache()) - std::chrono::hours(1000);
  for (const auto& key : results.list()) fs::last_write_time(results.result_directory(key), old);
  run_farm(grid("16", "<engine name=\"analytic\"/>"), out(), {});
  std::size_t used = 0;
  for (const auto& key : results.list())
    used += fs::last_write_time(results.result_directory(key)) != old;
  EXPECT_EQ(used, 4u);
}

TEST_F(UpkeepTest, CleansFilesOfFailedJobs) {
  const fs::path failed = out() / FailedJobs::kName;
  FarmOptions options;
  options.attempts = 1;
  options.failed_directory = failed;
  options.programs = {{"povray", failing_povray()}};
  run_farm(grid("16, 32", "<engine name=\"povray\"/>"), out(), options);
  ASSERT_TRUE(fs::exists(failed / "n16") && fs::exists(failed / "n32"));
  run_farm(grid("16", "<engine name=\"povray\"/>"), out(), options);
  clean_farm(out(), false);
  EXPECT_TRUE(fs::exists(failed / "n16"));
  EXPECT_FALSE(fs::exists(failed / "n32"));
  write_file(failed / "mine", "a user's");
  const CleanReport report = clean_farm(out(), true);
  EXPECT_FALSE(fs::exists(failed / "n16"));
  EXPECT_TRUE(fs::exists(failed / "mine"));
  EXPECT_THAT(report.stays, testing::Contains(testing::HasSubstr("failed")));
}

TEST_F(UpkeepTest, PrintsTheStatusOfEachCell) {
  Json status = as_json(farm_status(out()));
  EXPECT_EQ(status.at("cells"), 2);
  EXPECT_EQ(status.at("status").at("pass"), 2);
  EXPECT_EQ(status.at("atWork"), false);
  EXPECT_TRUE(status.at("failures").empty());
  FarmOptions options;
  options.attempts = 2;
  options.programs = {{"povray", failing_povray()}};
  run_farm(grid("16", "<engine name=\"povray\"/>"), out(), options);
  status = as_json(farm_status(out()));
  EXPECT_EQ(status.at("status").at("failed"), 1);
  ASSERT_EQ(status.at("failures").size(), 1u);
  EXPECT_EQ(status.at("failures")[0].at("failure"), "exit code");
  EXPECT_EQ(status.at("failures")[0].at("attempts"), 2);
}

TEST(ParseSize, ReadsPowersOf1024AndRefusesTheRest) {
  EXPECT_EQ(parse_size("0"), 0u);
  EXPECT_THROW(parse_size("17"), Error);
  EXPECT_EQ(parse_size("17B"), 17u);
  EXPECT_EQ(parse_size("2K"), 2048u);
  EXPECT_EQ(parse_size("1.5 GB"), 1610612736u);
  EXPECT_EQ(parse_size("3t"), std::uint64_t{3} << 40);
  for (const char* bad : {"", "G", "-1", "1X", "1GG", "nan", "inf", "1e30", "1 0"})
    EXPECT_THROW(parse_size(bad), Error) << bad;
}

}  // namespace
}  // namespace lobelia

// `lobelia reference` as a user meets it.
#include "base/system/files.hpp"
#include "base/system/process.hpp"
#include "lobelia_paths.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

class ReferenceCommand : public testing::Test {
 protected:
  ProcessResult run(const std::vector<std::string>& options) {
    std::vector<std::string> arguments{LOBELIA_PROGRAM, "reference", scene_.string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    ProcessOptions process;
    process.working_directory = directory_.path();
    return run_process(arguments, process);
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(directory_.path()))
      names.push_back(entry.path().filename().string());
    return names;
  }

  const fs::path scene_ = fs::path(LOBELIA_SOURCE_DIR) / "reference_scenes/scenes/two_lights.xml";
  TemporaryDirectory directory_;
};

TEST_F(ReferenceCommand, ExplainsEachRefusalWithAnExitCode) {
  struct {
    std::vector<std::string> options;
    int exit_code;
    const char* said;
  } const cases[] = {
      {{"--engine", "povray", "--precision", "double", "-o", "a.exr"}, 2, "allowed: half, float"},
      {{"--engine", "blender", "--precision", "float", "--shading", "native", "--model",
        "modified_phong", "-o", "a.exr"},
       3,
       "not comparable, because"},
      {{"--engine", "povray", "-o", "nowhere/a.exr"}, 4, "nowhere/a.exr"},
  };
  for (const auto& [options, exit_code, said] : cases) {
    const auto result = run(options);
    EXPECT_EQ(result.exit_code, exit_code) << said;
    EXPECT_THAT(result.output_tail, HasSubstr(said));
  }
}

TEST_F(ReferenceCommand, KeepsTheInputOfTheEngine) {
  const fs::path kept = directory_.path() / "kept";
  // The engine itself may be missing: what it would be given is written first.
  for (const std::string engine : {"povray", "blender"})
    run({"--engine", engine, "--" + engine, "/nowhere/" + engine, "-o", "a.exr", "--model",
         "modified_phong", "--keep-input", "kept"});
  for (const char* file :
       {"lobelia_scene.inc", "lobelia_modified_phong_cosine.inc", "pass0.pov", "pass1.pov",
        "pass0.ini", "pass1.ini", "povray.sh", "render_scenes.py", "job.json", "blender.sh"})
    EXPECT_TRUE(fs::exists(kept / file)) << file;
}

TEST_F(ReferenceCommand, FormulasPerPixelNeedNoProgramAndTakeNone) {
  EXPECT_EQ(run({"--engine", "analytic", "--program", "/bin/true", "-o", "a.exr"}).exit_code, 2);
  EXPECT_THAT(files(), IsEmpty());
  ASSERT_EQ(run({"--engine", "analytic", "-o", "picture.exr"}).exit_code, 0);
  const Json record = read_json(directory_.path() / "picture.json");
  EXPECT_EQ(record.at("witness"), "analytic");
  EXPECT_EQ(record.at("engineCommands").size(), 0u);
}

}  // namespace
}  // namespace lobelia

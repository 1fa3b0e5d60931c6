// `lobelia reference` as a user meets it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/files.hpp"
#include "core/process.hpp"
#include "lobelia_paths.hpp"
#include "reference_scenes/engine.hpp"
#include "tests/json.hpp"
#include "tests/reference_scenes/require_engine.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

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

TEST_F(ReferenceCommand, WhatItCannotDoHasItsExitCodeAndReason) {
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

TEST_F(ReferenceCommand, KeepsWhatTheEngineIsGiven) {
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

class RealReferenceCommand : public ReferenceCommand,
                             public testing::WithParamInterface<std::string> {
 protected:
  void SetUp() override { require_engine(*make_engine(GetParam(), {})); }
};

TEST_P(RealReferenceCommand, WritesTheSameFileEveryTimeAndARecordBesideIt) {
  std::string bytes[2];
  for (std::string& one : bytes) {
    const auto result = run({"--engine", GetParam(), "-o", "picture.exr", "--width", "32",
                             "--height", "32", "--model", "modified_phong"});
    ASSERT_EQ(result.exit_code, 0) << result.output_tail;
    one = read_file(directory_.path() / "picture.exr", 1 << 20);
  }
  EXPECT_TRUE(bytes[0] == bytes[1]);  // not EXPECT_EQ, which would print both
  const Json record = read_json(directory_.path() / "picture.json");
  EXPECT_EQ(record.at("witness"), "expressed");
  EXPECT_EQ(record.at("passes"), 2);
  EXPECT_EQ(record.at("engineCommands").size(), GetParam() == "povray" ? 2u : 1u);
  EXPECT_EQ(record.at("image").at("file"), "picture.exr");
  EXPECT_GT(record.at("seconds").at("total").get<double>(), 0);
  EXPECT_THAT(record.dump(), testing::Not(HasSubstr(fs::temp_directory_path() / "lobelia-")));
}

INSTANTIATE_TEST_SUITE_P(Engines, RealReferenceCommand, testing::Values("povray", "blender"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace lobelia

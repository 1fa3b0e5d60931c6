// `lobelia reference` as a user meets it.
#include "base/system/files.hpp"
#include "base/system/process.hpp"
#include "lobelia_paths.hpp"
#include "reference_scenes/engine.hpp"
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

// `lobelia engines` as a user meets it, with engines played by shell scripts.

class EnginesCommand : public testing::Test {
 protected:
  /// With nothing in $PATH. Its output in full.
  ProcessResult run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {LOBELIA_PROGRAM, "engines"});
    ProcessOptions process;
    process.working_directory = directory_.path();
    process.environment = {"PATH=" + (directory_.path() / "empty").string()};
    process.log = directory_.path() / "output";
    ProcessResult result = run_process(arguments, process);
    result.output_tail = read_file(process.log, 1 << 20);
    return result;
  }
  std::string path_of(std::string_view name) const { return directory_.path() / name; }
  /// Options that name a program for every engine: the given one, or path_of() its name.
  std::vector<std::string> programs(const std::map<std::string, std::string>& given) const {
    std::vector<std::string> options;
    for (const EngineInfo& engine : engine_infos()) {
      if (!engine.is_program) continue;
      const std::string name(engine.name);
      const auto found = given.find(name);
      options.push_back("--" + name);
      options.push_back(found != given.end() ? found->second : path_of(name));
    }
    return options;
  }
  /// All engines, played by scripts that say the right things.
  std::map<std::string, std::string> played() {
    return {{"povray", program("povray", "POV-Ray 3.7.0.10.unofficial")},
            {"blender", program("blender", "Blender 4.2.1 LTS")},
            {"tachyon", program("tachyon", "Tachyon 0.98")},
            {"sunflow", program("sunflow", "Sunflow 0.07.3")},
            {"three", program("three", "three.js 0.187.0")},
            {"babylon", program("babylon", "Babylon.js 9.1.0")},
            {"opengl", program("opengl", "OpenGL 4.6 (Compatibility Profile) Mesa")}};
  }
  std::string program(const std::string& name, const std::string& version) {
    const fs::path path = directory_.path() / name;
    write_file(path, "#!/bin/sh\necho '" + version + "'\n");
    fs::permissions(path, fs::perms::owner_all);
    return path.string();
  }
  TemporaryDirectory directory_;
};

TEST_F(EnginesCommand, ExplainsHowToGetEachMissingEngine) {
  const auto result = run(programs({}));
  EXPECT_EQ(result.exit_code, 5);
  for (const EngineInfo& engine : engine_infos()) {
    for (const auto text : {engine.title, engine.shading, engine.precision, engine.effects})
      EXPECT_THAT(result.output_tail, HasSubstr(std::string(text)));
    if (!engine.is_program) continue;
    for (const auto text : {engine.install_hint, engine.supported_versions})
      EXPECT_THAT(result.output_tail, HasSubstr(std::string(text)));
    EXPECT_THAT(result.output_tail,
                HasSubstr("lobelia: " + std::string(engine.title) + ": absent: '" +
                          path_of(engine.name) + "' is not a program\n"));
  }
  const auto nowhere = run({});
  for (const std::string needed : {"povray", "blender", "java", "chromium"})
    EXPECT_THAT(nowhere.output_tail, HasSubstr(": absent: no program '" + needed + "' in $PATH\n"));
}

TEST_F(EnginesCommand, PrintsARecordToo) {
  auto found = played();
  found["blender"] = program("bl", "Blender 5.0.0");
  std::vector<std::string> arguments = programs(found);
  arguments.insert(arguments.begin(), {"--json", "-"});
  const auto result = run(arguments);
  EXPECT_EQ(result.exit_code, 5);
  const std::string& text = result.output_tail;  // with the error behind it
  const Json record = Json::parse(text.substr(0, text.find("\n}\n") + 3));
  EXPECT_EQ(record.at("kind"), "engines");
  const Json& engines = record.at("engines");
  ASSERT_EQ(engines.size(), engine_infos().size());
  EXPECT_EQ(engines[0].at("available"), true);
  EXPECT_EQ(engines[0].at("version"), "3.7.0.10");
  EXPECT_EQ(engines[0].at("state"), "ready");
  EXPECT_EQ(engines[1].at("available"), false);
  EXPECT_EQ(engines[1].at("state"), "broken");
  EXPECT_THAT(engines[1].at("why").get<std::string>(),
              HasSubstr("is Blender Cycles 5.0.0; what can be driven is 3.4 to 4.x"));
}

TEST_F(EnginesCommand, PrintsTheTableOfModelsThatThePageHas) {
  const auto result = run({"--models"});
  EXPECT_EQ(result.exit_code, 0);
  const std::string page =
      read_file(fs::path(LOBELIA_SOURCE_DIR) / "docs/normalised_engines.md", 1 << 20);
  EXPECT_THAT(page, HasSubstr("```text\n" + result.output_tail + "```\n"));
}

}  // namespace
}  // namespace lobelia

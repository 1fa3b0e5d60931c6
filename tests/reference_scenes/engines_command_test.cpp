// `lobelia engines` as a user meets it, with engines played by shell scripts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/files.hpp"
#include "core/process.hpp"
#include "lobelia_paths.hpp"
#include "reference_scenes/engine.hpp"
#include "tests/json.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class EnginesCommand : public testing::Test {
 protected:
  /// With nothing in $PATH. Its output in full.
  ProcessResult run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {LOBELIA_PROGRAM, "engines"});
    ProcessOptions process;
    process.working_directory = directory_.path();
    process.environment = {"PATH=" + (directory_.path() / "empty").string()};
    return run_process(arguments, process);
  }
  std::string program(const std::string& name, const std::string& version) {
    const fs::path path = directory_.path() / name;
    write_file(path, "#!/bin/sh\necho '" + version + "'\n");
    fs::permissions(path, fs::perms::owner_all);
    return path.string();
  }
  TemporaryDirectory directory_;
};

TEST_F(EnginesCommand, SaysOfEveryMissingEngineHowToGetItAndEndsWithExitCode5) {
  const auto result = run({});
  EXPECT_EQ(result.exit_code, 5);
  for (const EngineInfo& engine : engine_infos()) {
    for (const auto text : {engine.title, engine.shading, engine.precision, engine.effects})
      EXPECT_THAT(result.output_tail, HasSubstr(std::string(text)));
    if (!engine.is_program) continue;
    for (const auto text : {engine.install_hint, engine.supported_versions})
      EXPECT_THAT(result.output_tail, HasSubstr(std::string(text)));
    EXPECT_THAT(result.output_tail, HasSubstr("lobelia: " + std::string(engine.title) +
                                              ": absent: no program '" + std::string(engine.name)));
  }
}

TEST_F(EnginesCommand, SaysOfEveryFoundEngineWhereItIsAndItsVersion) {
  const auto povray = program("pov", "POV-Ray 3.8.0-beta.2");
  const auto blender = program("bl", "Blender 4.2.1 LTS");
  const auto result = run({"--povray", povray, "--blender", blender});
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  for (const auto& text : {povray, blender, std::string("3.8.0"), std::string("4.2.1")})
    EXPECT_THAT(result.output_tail, HasSubstr(text));
  EXPECT_THAT(result.output_tail, Not(HasSubstr("apt-get")));
}

TEST_F(EnginesCommand, RefusesAProgramThatIsNoSuchEngine) {
  const auto result = run({"--povray", program("pov", "POV-Ray 3.7.0.10"), "--blender",
                           program("grep", "GNU grep 3.8")});
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_THAT(result.output_tail,
              HasSubstr("/grep' does not answer --version as Blender Cycles does\n"));
  EXPECT_THAT(result.output_tail, Not(HasSubstr("lobelia: POV-Ray")));
}

TEST_F(EnginesCommand, TellsABrokenEngineFromAnAbsentOne) {
  const fs::path dead = directory_.path() / "dead", unstartable = directory_.path() / "unstartable";
  write_file(dead, "#!/bin/sh\necho 'POV-Ray 3.7.0.10'; exit 1\n");
  write_file(unstartable, "#!/no/such/interpreter\n");
  for (const fs::path& path : {dead, unstartable}) fs::permissions(path, fs::perms::owner_all);
  const auto result = run({"--povray", dead.string(), "--blender", unstartable.string()});
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_THAT(result.output_tail, HasSubstr("lobelia: POV-Ray: broken: '" + dead.string() +
                                            "' --version ended with exit code 1\n"));
  EXPECT_THAT(result.output_tail, HasSubstr("lobelia: Blender Cycles: broken: "));
  EXPECT_THAT(result.output_tail, Not(HasSubstr("absent")));
  write_file(directory_.path() / "data", "no program");
  EXPECT_THAT(run({"--povray", (directory_.path() / "data").string()}).output_tail,
              HasSubstr("lobelia: POV-Ray: broken: '"));
}

TEST_F(EnginesCommand, PrintsARecordToo) {
  const auto result = run({"--json", "--povray", program("pov", "POV-Ray 3.7.0.10"), "--blender",
                           program("bl", "Blender 5.0.0")});
  EXPECT_EQ(result.exit_code, 5);
  const std::string& text = result.output_tail;  // with the error before or behind it
  const auto begin = text.find('{');
  const Json record = Json::parse(text.substr(begin, text.rfind('}') + 1 - begin));
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

}  // namespace
}  // namespace lobelia

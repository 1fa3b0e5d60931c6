// Engines that are missing, crash, hang or lie, played by shell scripts.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <future>
#include <map>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/write_limit.hpp"
#include "reference_scenes/engine.hpp"
#include "tests/reference_scenes/test_scenes.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class FakeEngine : public testing::TestWithParam<std::string> {
 protected:
  /// A program that answers --version as the engine does and otherwise runs `body`.
  fs::path program(const std::string& body, std::string version = "") {
    if (version.empty())
      version = GetParam() == "povray" ? "POV-Ray 3.7.0.10.unofficial" : "Blender 3.4.1";
    const fs::path path = directory_.path() / "engine";
    write_file(path,
               fmt::format("#!/bin/sh\n[ \"$1\" = --version ] && echo '{}' >&2 && exit 0\n{}\n",
                           version, body));
    fs::permissions(path, fs::perms::owner_all);
    return path;
  }

  std::map<std::size_t, std::string> errors_of(const std::string& body, int scenes = 1,
                                               double limit = 20) {
    const auto engine = make_engine(GetParam(), program(body));
    const std::vector<Scene> all(
        std::size_t(scenes),
        sphere_scene({"modified_phong", "cosine", "exact", 16}, {point_light()}, 16));
    ReferenceOptions options;
    options.time_limit = std::chrono::duration<double>(limit);
    options.log_directory = directory_.path();
    std::map<std::size_t, std::string> errors;
    engine->render(all, options, [&](std::size_t index, ReferenceResult result) {
      EXPECT_FALSE(errors.contains(index)) << "told twice";
      EXPECT_EQ(result.image.pixel_count(), 0u);
      errors[index] = result.error;
    });
    EXPECT_EQ(errors.size(), std::size_t(scenes)) << "every scene has its result";
    return errors;
  }

  std::string unavailable_because(const fs::path& path) {
    const auto engine = make_engine(GetParam(), path);
    EXPECT_FALSE(engine->status().available);
    try {
      engine->render({}, {}, [](std::size_t, ReferenceResult) {});
      ADD_FAILURE() << "an engine that is not available rendered";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kEngine);
      EXPECT_THAT(error.what(), HasSubstr(engine->status().why));
      EXPECT_THAT(error.what(), HasSubstr("sudo apt-get install"));
    }
    return engine->status().why;
  }

  /// Both engines' part played to the end: every scene gets a picture of 16 x 16, but for the
  /// second, where `bad` is run instead; $picture is where its picture should go.
  std::string second_scene(const std::string& bad) {
    const std::string good = (directory_.path() / "good.exr").string();
    write_exr(good, Image(16, 16), {});
    const std::string play = fmt::format(
        "case $name in scene1*) echo of the second; {} ;; *) cp '{}' \"$picture\" ;; esac\n", bad,
        good);
    if (GetParam() == "povray") return "name=${1%.ini}\npicture=$name.exr\n" + play;
    return R"(for job; do :; done
              for name in $(grep -o 'scene[0-9]*"' "$job" | tr -d '"'); do
                echo "lobelia: begin $name"
                picture=${job%job.json}$name-0.exr
                )" +
           play + R"(echo "lobelia: done $name 1"
              done)";
  }

  /// The script's first scene, as the real one tells it.
  static constexpr char kBeginFirst[] =
      R"(for job; do :; done
         name=$(grep -o 'scene[0-9]*"' "$job" 2>/dev/null | head -1 | tr -d '"')
         echo "lobelia: begin $name")";

  TemporaryDirectory directory_;
};

TEST_P(FakeEngine, MissingIsSaidWithHowToInstall) {
  EXPECT_THAT(unavailable_because(directory_.path() / "nothing"), HasSubstr("is not a program"));
}

TEST_P(FakeEngine, AnotherProgramIsNotTakenForIt) {
  EXPECT_THAT(unavailable_because(program("", "GNU grep 3.8")),
              HasSubstr("does not answer --version"));
}

TEST_P(FakeEngine, OfAVersionThatCannotBeDrivenIsRefusedWithThatAndTheOnesThatCan) {
  const bool povray = GetParam() == "povray";
  const std::string answer = povray ? "POV-Ray " : "Blender ";
  for (const std::string version :
       povray ? std::vector{"3.6.1", "3.9.0", "4.0.0"} : std::vector{"2.83.0", "3.3.21", "5.0.0"}) {
    const std::string why = unavailable_because(program("", answer + version));
    EXPECT_THAT(why, HasSubstr((povray ? " is POV-Ray " : " is Blender Cycles ") + version));
    EXPECT_THAT(why, HasSubstr(povray ? "what can be driven is 3.7 or 3.8"
                                      : "what can be driven is 3.4 to 4.x"));
  }
  for (const std::string version :
       povray ? std::vector{"3.7.0", "3.8.0-beta.2"} : std::vector{"3.4.0", "4.5.2 LTS"})
    EXPECT_TRUE(make_engine(GetParam(), program("", answer + version))->status().available)
        << version;
}

TEST_P(FakeEngine, VersionIsRead) {
  const auto engine = make_engine(GetParam(), program("exit 1"));
  EXPECT_TRUE(engine->status().available) << engine->status().why;
  EXPECT_EQ(engine->status().version, GetParam() == "povray" ? "3.7.0.10" : "3.4.1");
}

TEST_P(FakeEngine, ComplaintIsInTheErrorInOneLineAndInTheLog) {
  const auto errors = errors_of("echo chatter; echo 'Parse Error: no such thing'; exit 7");
  EXPECT_THAT(errors.at(0), HasSubstr("stopped with exit code 7: Parse Error: no such thing"));
  EXPECT_EQ(errors.at(0).find('\n'), std::string::npos);
  const fs::path log = directory_.path() / (GetParam() + "-0.log");
  EXPECT_THAT(read_file(log, 1 << 20), HasSubstr("chatter"));
}

TEST_P(FakeEngine, CrashIsThatScenesResult) {
  for (const auto& [scene, error] : errors_of(std::string(kBeginFirst) + "\nkill -SEGV $$", 3))
    EXPECT_THAT(error, HasSubstr("was ended by signal 11")) << scene;
}

TEST_P(FakeEngine, HangIsEndedAtTheTimeLimit) {
  for (const auto& [scene, error] : errors_of(std::string(kBeginFirst) + "\nsleep 60", 2, 0.4))
    EXPECT_THAT(error, HasSubstr("was stopped after 0.4 s")) << scene;
}

TEST_P(FakeEngine, NoPictureIsAnError) {
  EXPECT_THAT(errors_of("exit 0").at(0),
              testing::AnyOf(HasSubstr("wrote no picture"), HasSubstr("rendered nothing")));
}

TEST_P(FakeEngine, TextInPlaceOfAPictureIsAnError) {
  const std::string pov = R"(echo text > "${1%.ini}.exr")";
  const std::string blender = std::string(kBeginFirst) + R"(
    echo text > "${job%job.json}$name-0.exr"
    echo "lobelia: done $name 1")";
  EXPECT_THAT(errors_of(GetParam() == "povray" ? pov : blender).at(0),
              HasSubstr("picture cannot be used"));
}

TEST_P(FakeEngine, FailureIsTheResultOfItsSceneWithItsLogAndNothingElses) {
  const std::string large = (directory_.path() / "large.exr").string();
  write_exr(large, Image(16, 17), {});
  const bool povray = GetParam() == "povray";
  const std::pair<std::string, std::string> failures[] = {
      {"kill -SEGV $$", "was ended by signal 11"},
      {"sleep 60", "was stopped after 2 s"},
      {"exit 3", "stopped with exit code 3"},
      {"exit 0", povray ? "wrote no picture" : "stopped with exit code 0"},
      {":", povray ? "wrote no picture" : "picture cannot be used"},
      {"head -c 9999 /dev/urandom > \"$picture\"", "picture cannot be used"},
      {fmt::format("head -c 400 '{}' > \"$picture\"", large), "picture cannot be used"},
      {fmt::format("cp '{}' \"$picture\"", large), "another size"}};
  for (const auto& [bad, error] : failures) {
    SCOPED_TRACE(bad);
    const auto engine = make_engine(GetParam(), program(second_scene(bad)));
    const std::vector<Scene> scenes(
        3, sphere_scene({"modified_phong", "cosine", "exact", 16}, {point_light()}, 16));
    ReferenceOptions options;
    options.time_limit = std::chrono::seconds(2);
    options.log_directory = directory_.path();
    std::map<std::size_t, ReferenceResult> results;
    engine->render(scenes, options, [&](std::size_t index, ReferenceResult result) {
      results[index] = std::move(result);
    });
    ASSERT_EQ(results.size(), 3u);
    for (const std::size_t good : {0, 2}) {
      EXPECT_EQ(results[good].error, "");
      EXPECT_EQ(results[good].image.pixel_count(), 256u);
    }
    EXPECT_THAT(results[1].error, HasSubstr(error));
    EXPECT_EQ(results[1].image.pixel_count(), 0u);
    for (const int scene : {0, 1, 2}) {
      const fs::path log = directory_.path() / fmt::format("{}-{}.log", GetParam(), scene);
      EXPECT_EQ(read_file(log, 1 << 20).find("of the second") != std::string::npos, scene == 1);
      fs::remove(log);
    }
  }
}

TEST_P(FakeEngine, WritesNothingOutsideItsOwnDirectory) {
  const fs::path outside = directory_.path() / "outside";
  const auto engine = make_engine(
      GetParam(), program(fmt::format("echo x > '{}'\n", outside.string()) + second_scene(":")));
  const Scene scene = sphere_scene({"modified_phong", "cosine", "exact", 16}, {point_light()}, 16);
  bool limited = false;
  engine->render(std::span(&scene, 1), {}, [&](std::size_t, ReferenceResult result) {
    ASSERT_EQ(result.error, "") << "its own directory is free";
    limited = result.record.at("writesLimited");
  });
  const bool can_limit = std::async(std::launch::async, limit_writes_to, directory_.path()).get();
  EXPECT_EQ(limited, can_limit) << "what the record says";
  if (!can_limit) GTEST_SKIP() << "this kernel has no Landlock to limit writing with";
  EXPECT_FALSE(fs::exists(outside));
}

TEST_P(FakeEngine, FindsNoSettingsButOurs) {
  errors_of(
      "echo \"[$HOME] [$TMPDIR] [$XDG_CONFIG_HOME]\"; pwd; cat \"$POVINI\" .povray/*/*; exit 1");
  const std::string log = read_file(directory_.path() / (GetParam() + "-0.log"), 1 << 20);
  const auto begin = log.find('[') + 1;
  const std::string own = log.substr(begin, log.find(']') - begin);
  EXPECT_THAT(log, HasSubstr(fmt::format("[{0}] [{0}] [{0}]\n{0}\n", own)));
  if (GetParam() != "povray") return;
  EXPECT_THAT(log, HasSubstr("In place of the system's and the user's"));
  EXPECT_THAT(log, HasSubstr("[File I/O Security]\nrestricted\n[Shellout Security]\nforbidden\n"));
}

TEST_P(FakeEngine, FailureOfTheReceiverEndsTheWork) {
  const auto engine = make_engine(GetParam(), program("exit 1"));
  const std::vector<Scene> scenes(
      3, sphere_scene({"modified_phong", "cosine", "exact", 16}, {point_light()}, 16));
  EXPECT_THROW(engine->render(scenes, {},
                              [](std::size_t, ReferenceResult) {
                                throw Error(ExitCode::kOutput, "disk full");
                              }),
               Error);
}

INSTANTIATE_TEST_SUITE_P(Engines, FakeEngine, testing::Values("povray", "blender"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace lobelia

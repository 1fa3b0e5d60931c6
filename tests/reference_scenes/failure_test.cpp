// Engines that are missing, crash, hang or lie, played by shell scripts.
#include <fmt/format.h>

#include <future>

#include "base/pictures/image_io.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/write_limit.hpp"
#include "reference_scenes/engine.hpp"
#include "reference_scenes/engine_program.hpp"
#include "tests/reference_scenes/render_all.hpp"
#include "tests/reference_scenes/test_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

class FakeEngine : public testing::TestWithParam<std::string> {
 protected:
  /// A program that answers --version as the engine does and otherwise runs `body`.
  fs::path program(const std::string& body, std::string version = "",
                   const std::string& file = "engine") {
    if (version.empty())
      version = GetParam() == "povray" ? "POV-Ray 3.7.0.10.unofficial" : "Blender 3.4.1";
    const fs::path path = directory_.path() / file;
    write_file(path,
               fmt::format("#!/bin/sh\n[ \"$1\" = --version ] && echo '{}' >&2 && exit 0\n{}\n",
                           version, body));
    fs::permissions(path, fs::perms::owner_all);
    return path;
  }

  static std::vector<Scene> plain_scenes(int count) {
    return std::vector<Scene>(
        std::size_t(count),
        sphere_scene({"modified_phong", "cosine", "exact", 16}, {point_light()}, 16));
  }

  /// The result of one scene, rendered by a program that does `body` and makes no picture.
  ReferenceResult failed(const std::string& body) {
    const auto engine = make_engine(GetParam(), program(body));
    ReferenceResult result = Session(*engine, {}).render(plain_scenes(1)[0]);
    EXPECT_EQ(result.image.pixel_count(), 0u);
    return result;
  }

  std::string unavailable_because(const fs::path& path) {
    const auto engine = make_engine(GetParam(), path);
    EXPECT_FALSE(engine->status().available());
    try {
      Session(*engine, {});
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
    if (GetParam() == "povray") return "name=${PWD##*/}\npicture=${1%.ini}.exr\n" + play;
    return R"(for job; do :; done
              for name in $(grep -o 'scene[0-9]*"' "$job" | tr -d '"'); do
                echo "lobelia: begin $name"
                picture=${job%job.json}$name-0.exr
                )" +
           play + R"(echo "lobelia: done $name 1"
              done)";
  }

  TemporaryDirectory directory_;
};

TEST_P(FakeEngine, ReportsAMissingOrWrongProgram) {
  EXPECT_THAT(unavailable_because(directory_.path() / "nothing"), HasSubstr("is not a program"));
  EXPECT_THAT(unavailable_because(program("", "GNU grep 3.8")),
              HasSubstr("does not answer --version"));
}

TEST_P(FakeEngine, IsRefusedWithTheSupportedVersions) {
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
    EXPECT_TRUE(make_engine(GetParam(), program("", answer + version))->status().available())
        << version;
}

TEST_P(FakeEngine, ComplaintIsInTheErrorInOneLineAndInTheLog) {
  const ReferenceResult result = failed("echo chatter; echo 'Parse Error: no such thing'; exit 7");
  EXPECT_THAT(result.error, HasSubstr("stopped with exit code 7: Parse Error: no such thing"));
  EXPECT_EQ(result.error.find('\n'), std::string::npos);
  EXPECT_THAT(result.log, HasSubstr("chatter"));
  EXPECT_THAT(failed("exit 0").error,
              HasSubstr(GetParam() == "povray" ? "wrote no picture" : "rendered nothing"));
}

TEST_P(FakeEngine, IsStartedAgainIfItsThreadsWereTooSlowToStart) {
  if (GetParam() != "povray") GTEST_SKIP() << "POV-Ray alone gives up on itself";
  const ReferenceResult third = failed(
      "echo >> starts; if [ $(wc -l < starts) -lt 3 ]; then\n"
      "echo 'Timed out waiting for worker thread startup' >&2; exit 1; fi\n"
      "echo 'Parse Error: the third start' >&2; exit 7");
  EXPECT_THAT(third.error, HasSubstr("stopped with exit code 7: Parse Error: the third start"));
  EXPECT_THAT(failed("echo 'Timed out waiting for worker thread startup' >&2; exit 1").error,
              HasSubstr("stopped with exit code 1: Timed out waiting"));
}

TEST_P(FakeEngine, FailureBelongsToItsSceneAlone) {
  const auto picture = [&](const std::string& name, int height, float first) {
    Image image(16, height);
    // Noise, which no compression makes so small that a part of the file has it all.
    std::minstd_rand random;
    for (float& value : image.values())
      value = std::bit_cast<float>(0x3f000000u | std::uint32_t(random() >> 8));
    image.values()[5] = first;
    write_exr(directory_.path() / name, image, {});
    return (directory_.path() / name).string();
  };
  const std::string tall = picture("tall.exr", 17, 1), whole = picture("whole.exr", 16, 1);
  const std::string nan = picture("nan.exr", 16, NAN), infinite = picture("inf.exr", 16, -INFINITY);
  const bool povray = GetParam() == "povray";
  struct Case {
    std::string bad, error;
    FailureClass failure;
    double limit = 3600, no_progress_limit = 0;
  };
  using enum FailureClass;
  const Case cases[] = {
      {"kill -SEGV $$", "was ended by signal 11", kCrash},
      {"kill -KILL $$", "was ended by signal 9", kCrash},
      {"sleep 600", "was stopped after 8 s", kTimedOut, 8},
      {"while :; do echo still; sleep 0.2; done", "was stopped after 8 s", kTimedOut, 8, 6},
      {"echo x > half; sleep 600", "was stopped after 8 s without a sign of progress", kNoProgress,
       600, 8},
      {"exit 3", "stopped with exit code 3", kExitCode},
      {"exit 255", "stopped with exit code 255", kExitCode},
      {"exit 0", povray ? "wrote no picture" : "stopped with exit code 0", kNoOutput},
      {":", "wrote no picture", kNoOutput},
      {": > \"$picture\"", "picture cannot be used", kBadOutput},
      {"head -c 9999 /dev/urandom > \"$picture\"", "picture cannot be used", kBadOutput},
      {fmt::format("head -c 1500 '{}' > \"$picture\"", whole), "picture cannot be used",
       kBadOutput},
      {fmt::format("cp '{}' \"$picture\"", nan), "not finite", kNonFinite},
      {fmt::format("cp '{}' \"$picture\"", infinite), "not finite", kNonFinite},
      {fmt::format("cp '{}' \"$picture\"", tall), "another size", kWrongSize}};
  const auto try_out = [&](const Case& c, const fs::path& path) {
    SCOPED_TRACE(c.bad);
    const auto engine = make_engine(GetParam(), path);
    ReferenceOptions options;
    options.time_limit = std::chrono::duration<double>(c.limit);
    options.no_progress_limit = std::chrono::duration<double>(c.no_progress_limit);
    std::map<std::size_t, ReferenceResult> results;
    render_all(*engine, plain_scenes(3), options, [&](std::size_t index, ReferenceResult result) {
      EXPECT_FALSE(results.contains(index)) << "told twice";
      results[index] = std::move(result);
    });
    ASSERT_EQ(results.size(), 3u);
    int failed = 0;  // whichever came second
    for (const auto& [scene, result] : results) {
      const bool second = result.log.find("of the second") != std::string::npos;
      failed += second;
      EXPECT_THAT(result.error, HasSubstr(second ? c.error : ""));
      EXPECT_EQ(result.error.empty(), !second) << result.error;
      EXPECT_EQ(failure_name(result.failure), failure_name(second ? c.failure : kNone));
      EXPECT_EQ(result.image.pixel_count(), second ? 0u : 256u);
    }
    EXPECT_EQ(failed, 1);
  };
  // All are written before any is started: one that is open for writing in a child cannot be.
  std::vector<std::future<void>> all;
  std::vector<fs::path> programs;
  for (const Case& c : cases)
    programs.push_back(program(second_scene(c.bad), "", fmt::format("engine{}", programs.size())));
  for (std::size_t i = 0; i < programs.size(); ++i)
    all.push_back(std::async(std::launch::async, [&, i] { try_out(cases[i], programs[i]); }));
  for (auto& one : all) one.get();
}

TEST_P(FakeEngine, IsMissingIfItIsTakenAwayMeanwhile) {
  const fs::path path = program(second_scene(":"));
  const auto engine = make_engine(GetParam(), path);
  ASSERT_TRUE(engine->status().available());
  fs::remove(path);
  std::size_t count = 0;
  render_all(*engine, plain_scenes(9), {}, [&](std::size_t, ReferenceResult result) {
    ++count;
    EXPECT_EQ(result.failure, FailureClass::kEngineMissing) << result.error;
    EXPECT_FALSE(worth_retrying(result.failure));
  });
  EXPECT_EQ(count, 9u);
}

TEST_P(FakeEngine, FloodOfWordsIsCutInTheLog) {
  const auto size = failed("head -c 20000000 /dev/zero | tr '\\0' x | fold; exit 1").log.size();
  EXPECT_GT(size, 1u << 20);
  EXPECT_LT(size, 3u << 20);
}

TEST_P(FakeEngine, RunsInNoMoreProcessesThanItMay) {
  for (const int processes : {1, 2}) {
    ReferenceOptions options;
    options.processes = processes;
    options.threads = 4;
    std::set<int> threads;
    const auto engine = make_engine(GetParam(), program("sleep 0.2\n" + second_scene(":")));
    std::size_t count = 0;
    const auto began = std::chrono::steady_clock::now();
    render_all(*engine, plain_scenes(6), options, [&](std::size_t, ReferenceResult result) {
      ++count;
      if (result.record.threads) threads.insert(*result.record.threads);
    });
    EXPECT_EQ(count, 6u);
    // That many sleeps, one after the other, cannot take less.
    EXPECT_GE(std::chrono::steady_clock::now() - began,
              std::chrono::milliseconds(1200 / processes));
    if (GetParam() == "povray") {
      EXPECT_THAT(threads, testing::ElementsAre(4 / processes));
    }
  }
}

TEST_P(FakeEngine, WritesNothingOutsideItsOwnDirectory) {
  const fs::path outside = directory_.path() / "outside";
  const auto engine = make_engine(
      GetParam(), program(fmt::format("echo x > '{}'\n", outside.string()) + second_scene(":")));
  const Scene scene = sphere_scene({"modified_phong", "cosine", "exact", 16}, {point_light()}, 16);
  bool limited = false;
  render_all(*engine, std::span(&scene, 1), {}, [&](std::size_t, ReferenceResult result) {
    ASSERT_EQ(result.error, "") << "its own directory is free";
    limited = *result.record.writes_limited;
  });
  const bool can_limit = WriteLimit(directory_.path()).ruleset() >= 0;
  EXPECT_EQ(limited, can_limit) << "what the record says";
  if (!can_limit) GTEST_SKIP() << "this kernel has no Landlock to limit writing with";
  EXPECT_FALSE(fs::exists(outside));
}

TEST_P(FakeEngine, FindsNoSettingsButOurs) {
  const std::string log =
      failed(
          "echo \"[$HOME] [$TMPDIR] [$XDG_CONFIG_HOME]\"; pwd; cat \"$POVINI\" .povray/*/*; exit 1")
          .log;
  const auto begin = log.find('[') + 1;
  const std::string own = log.substr(begin, log.find(']') - begin);
  EXPECT_THAT(log, HasSubstr(fmt::format("[{0}] [{0}] [{0}]\n{0}\n", own)));
  if (GetParam() != "povray") return;
  EXPECT_THAT(log, HasSubstr("In place of the system's and the user's"));
  EXPECT_THAT(log, HasSubstr("[File I/O Security]\nrestricted\n[Shellout Security]\nforbidden\n"));
}

TEST_P(FakeEngine, FailureOfTheReceiverEndsTheWork) {
  const auto engine = make_engine(GetParam(), program("exit 1"));
  const std::vector<Scene> scenes = plain_scenes(3);
  EXPECT_THROW(
      render_all(*engine, scenes, {},
                 [](std::size_t, ReferenceResult) { throw Error(ExitCode::kOutput, "disk full"); }),
      Error);
}

/// A Blender that takes one scene after the other, as ours does: it is told of each in a file.
class FakeBlender : public FakeEngine {
 protected:
  /// `play` is run for each scene, whose number is $number, $count the scenes of this process so far.
  fs::path goes_on(const std::string& play) {
    write_exr(directory_.path() / "good.exr", Image(16, 16), {});
    return program(fmt::format(R"sh(for job; do :; done
here=${{job%job.json}}; file=$job; count=0
while [ -n "$file" ]; do
  name=$(grep -o 'scene[0-9]*"' "$file" | tr -d '"')
  number=${{name#scene}}; count=$((count + 1))
  echo "lobelia: begin $name"
  {}
  cp '{}' "$here$name-0.exr"
  echo "lobelia: done $name 1 $((count * 3)).5 $((count * 1000))"
  echo "lobelia: more"
  read file || exit 0
  file=$here$file
done)sh",
                               play, (directory_.path() / "good.exr").string()));
  }
  std::map<std::size_t, ReferenceResult> results_of(const fs::path& path, int scenes) {
    ReferenceOptions options;
    options.processes = 2;
    std::map<std::size_t, ReferenceResult> results;
    const auto engine = make_engine("blender", path);
    render_all(
        *engine, plain_scenes(scenes), options,
        [&](std::size_t index, ReferenceResult result) { results[index] = std::move(result); });
    EXPECT_EQ(results.size(), std::size_t(scenes));
    return results;
  }
};

TEST_P(FakeBlender, RendersManyScenesInFewProcesses) {
  auto results = results_of(goes_on("sleep 0.02"), 40);
  std::size_t first_ones = 0;
  for (const auto& [scene, result] : results) {
    ASSERT_EQ(result.error, "") << scene;
    const double cpu = *result.record.cpu_seconds, peak = double(*result.record.peak_memory_bytes);
    if (cpu == 3.5)
      ++first_ones;  // with what it took to start
    else
      EXPECT_EQ(cpu, 3) << scene;
    EXPECT_EQ(peak == 1000, cpu == 3.5);
    EXPECT_EQ(result.record.threads, std::max(1, threads_of({}) / 2));
    EXPECT_THAT(result.log, HasSubstr("begin scene"));
    EXPECT_EQ(result.log.find("begin"), result.log.rfind("begin"))
        << "its own lines alone: " << result.log;
  }
  EXPECT_THAT(first_ones, testing::AllOf(testing::Ge(1u), testing::Le(2u)));
}

TEST_P(FakeBlender, CostsOneSceneWhenItDies) {
  // In the middle of a scene; and between two, when the next is in nobody's hands.
  std::map<FailureClass, int> ends;
  for (const auto& [scene, result] :
       results_of(goes_on("[ $number = 5 ] && kill -SEGV $$\n[ $number = 12 ] && kill -ALRM $$\n"
                          "[ $number = 20 ] && "
                          "{ echo 'lobelia: failed scene20 Python no'; kill -SEGV $$; }"),
                  30))
    ++ends[result.failure];
  using enum FailureClass;
  using testing::Pair;
  EXPECT_THAT(ends, testing::UnorderedElementsAre(Pair(kNone, 27), Pair(kCrash, 1),
                                                  Pair(kTimedOut, 1), Pair(kExitCode, 1)));
}

TEST_P(FakeBlender, FailsNoSceneIfItDiesBetweenTwo) {
  // It asks for more, and is gone when that comes.
  const fs::path path = goes_on("trap 'kill -SEGV $$' EXIT; [ $count = 2 ] && exec 0</dev/null");
  for (const auto& [scene, result] : results_of(path, 20)) EXPECT_EQ(result.error, "") << scene;
}

TEST_P(FakeBlender, IsNotStartedForEachSceneIfItReachesNone) {
  int starts = 0;
  for (const auto& [scene, result] : results_of(program("echo started; kill -SEGV $$"), 60)) {
    EXPECT_EQ(result.failure, FailureClass::kCrash) << scene;
    starts += result.log.find("\nstarted") != std::string::npos;
  }
  EXPECT_THAT(starts, testing::AllOf(testing::Ge(3), testing::Le(5)));
}

INSTANTIATE_TEST_SUITE_P(GoingOn, FakeBlender, testing::Values("blender"));

INSTANTIATE_TEST_SUITE_P(Engines, FakeEngine, testing::Values("povray", "blender"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace lobelia

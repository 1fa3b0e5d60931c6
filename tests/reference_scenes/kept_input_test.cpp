// What is kept of an engine's input, given to the real engine by the kept command alone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/process.hpp"
#include "reference_scenes/engine.hpp"
#include "reference_scenes/engines/povray/povray_input.hpp"
#include "reference_scenes/preparation.hpp"
#include "tests/reference_scenes/require_engine.hpp"
#include "tests/reference_scenes/test_scenes.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;

class KeptInput : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    engine_ = make_engine(GetParam(), {});
    require_engine(*engine_);
  }

  /// The pictures that the kept command left behind, added up.
  Image kept_picture(const Scene& scene, const fs::path& directory) const {
    std::vector<Image> passes;
    if (GetParam() == "povray") {
      const PovrayInput input = povray_input(in_engine_units(scene));
      for (std::size_t p = 0; p < input.passes.size(); ++p) {
        passes.push_back(read_image(directory / fmt::format("pass{}.exr", p)));
        for (float& value : passes.back().values()) value = float(value / input.passes[p].gain);
      }
    } else {
      for (std::size_t p = 0; p < scene.lights.size(); ++p)
        passes.push_back(read_image(directory / fmt::format("scene0-{}.exr", p)));
    }
    return sum_of(passes);
  }

  std::unique_ptr<Engine> engine_;
};

TEST_P(KeptInput, RendersToOurOwnRunsPictureBitForBit) {
  for (const HighlightChoice& choice : {HighlightChoice{"phong_rdf", "cosine", "exact", 64},
                                        {"modified_phong", "cs16", "paper", 64}}) {
    SCOPED_TRACE(choice.model);
    const Scene scene = sphere_scene(choice, {directional_at(45), point_light()}, 64);
    const ReferenceResult ours = Session(*engine_, {}).render(scene);
    ASSERT_EQ(ours.error, "");
    const TemporaryDirectory directory;
    keep_engine_input(GetParam(), scene, {}, directory.path());
    ProcessOptions options;
    options.working_directory = directory.path();
    // Through cd, because Blender believes $PWD.
    const auto ended = run_process(
        {"/bin/sh", "-c", "cd \"$1\" && sh " + GetParam() + ".sh", "sh", directory.path().string()},
        options);
    ASSERT_EQ(ended.exit_code, 0) << ended.output_tail;
    const Image kept = kept_picture(scene, directory.path());
    EXPECT_GT(*std::ranges::max_element(kept.values()), 0);
    EXPECT_TRUE(std::ranges::equal(kept.values(), ours.image.values()));
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, KeptInput, testing::Values("povray", "blender"),
                         [](const auto& test) { return test.param; });

/// Its own restrictions do not see to that: povray_input.hpp.
TEST(PovrayInItsDirectory, CannotWriteElsewhereThoughAFileAsksForIt) {
  const auto engine = make_engine("povray", {});
  require_engine(*engine);
  if (!engine->status().available()) return;
  const TemporaryDirectory own, other;
  ProcessOptions options;
  options.working_directory = options.writable = own.path();
  options.environment = povray_home(own.path(), engine->status().version);
  bool limited = false;
  options.on_start = [&](const ProcessLimits& limits) { limited = limits.writes_limited; };
  const fs::path inside = own.path() / "inside", outside = other.path() / "outside";
  for (const fs::path& target : {inside, outside}) {
    const std::string stem = target.filename().string() + "-scene";
    write_file(own.path() / (stem + ".pov"),
               "#version 3.7;\n#fopen F \"" + target.string() + "\" write\n#write (F, 1)\n");
    write_povray_ini(own.path(), stem, 1, povray_options({8, 8}, 1));
    run_process({engine->status().program.string(), stem + ".ini"}, options);
  }
  EXPECT_TRUE(fs::exists(inside));
  if (!limited) GTEST_SKIP() << "this kernel has no Landlock to limit writing with";
  EXPECT_FALSE(fs::exists(outside));
}

}  // namespace
}  // namespace lobelia

// The kept input of an engine, given to the real engine by the kept command alone.
#include <fmt/format.h>

#include "base/pictures/image_io.hpp"
#include "base/system/files.hpp"
#include "base/system/process.hpp"
#include "base/words/text.hpp"
#include "reference_scenes/engine.hpp"
#include "reference_scenes/preparation.hpp"
#include "tests/reference_scenes/require_engine.hpp"
#include "tests/reference_scenes/test_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

class KeptInput : public WithRealEngine {
 protected:
  /// The pictures that the kept command left behind, added up.
  Image kept_picture(const Scene& scene, const fs::path& directory) const {
    std::vector<Image> passes;
    if (GetParam() == "povray") {
      for (std::size_t p = 0; fs::exists(directory / fmt::format("pass{}.ini", p)); ++p) {
        passes.push_back(read_image(directory / fmt::format("pass{}.exr", p)));
        // "; 4096 times too bright, ..."
        double gain = 0;
        const std::string ini = read_file(directory / fmt::format("pass{}.ini", p), 1 << 16);
        EXPECT_TRUE(parse_number(ini.substr(2, ini.find(" times") - 2), gain));
        for (float& value : passes.back().values()) value = float(value / gain);
      }
    } else {
      for (std::size_t p = 0; p < scene.lights.size(); ++p)
        passes.push_back(read_image(directory / fmt::format("scene0-{}.exr", p)));
    }
    return sum_of(passes);
  }
};

TEST_P(KeptInput, RendersToOurOwnRunsPictureBitForBit) {
  for (const HighlightChoice& choice : {HighlightChoice{"phong_rdf", "cosine", "exact", 64},
                                        {"modified_phong", "cs16", "paper", 64}}) {
    SCOPED_TRACE(choice.model);
    const Scene scene = sphere_scene(choice, {directional_at(45), point_light()}, 64);
    const ReferenceResult ours = Session(*engine_, {}).render(scene);
    ASSERT_EQ(ours.error, "");
    if (choice.model == "modified_phong") {
      EXPECT_EQ(ours.record.shading, "expressed");
      EXPECT_EQ(ours.record.passes, 2u);
    }
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

}  // namespace
}  // namespace lobelia

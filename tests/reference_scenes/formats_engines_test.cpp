// Scenes for other programs, given to the real ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/process.hpp"
#include "core/text.hpp"
#include "reference_scenes/engine.hpp"
#include "reference_scenes/formats/catalogue.hpp"
#include "reference_scenes/preparation.hpp"
#include "renderer/render.hpp"
#include "tests/canonical_scene.hpp"
#include "tests/reference_scenes/require_engine.hpp"
#include "tests/reference_scenes/test_scenes.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;

class WrittenFor : public testing::Test {
 protected:
  /// Whether the test goes on.
  bool start(const char* engine, std::string_view format, const Scene& scene) {
    engine_ = make_engine(engine, {});
    require_engine(*engine_);
    if (!engine_->status().available()) return false;
    EXPECT_EQ(scene_format(format).why_not(scene), "");
    for (const auto& [file, text] : scene_format(format).write(scene))
      write_file(directory_.path() / file, text);
    return true;
  }
  ProcessResult run(const std::string& script) {
    ProcessOptions options;
    options.working_directory = directory_.path();
    return run_process(
        {"/bin/sh", "-c", "cd \"$1\" && " + script, "sh", directory_.path().string()}, options);
  }
  std::unique_ptr<Engine> engine_;
  const TemporaryDirectory directory_;
};

class WrittenForPovray : public WrittenFor {
 protected:
  void expect_our_picture(const Scene& scene, std::size_t passes) {
    if (!start("povray", "povray", scene)) return;
    const auto ended = run("sh povray.sh");
    ASSERT_EQ(ended.exit_code, 0) << ended.output_tail;
    std::vector<Image> pictures;
    for (std::size_t p = 0; fs::exists(directory_.path() / fmt::format("pass{}.exr", p)); ++p) {
      pictures.push_back(read_image(directory_.path() / fmt::format("pass{}.exr", p)));
      // "; 4096 times too bright, ..."
      double gain = 0;
      const std::string ini = read_file(directory_.path() / fmt::format("pass{}.ini", p), 1 << 16);
      ASSERT_TRUE(parse_number(ini.substr(2, ini.find(" times") - 2), gain));
      for (float& value : pictures.back().values()) value = float(value / gain);
    }
    ASSERT_EQ(pictures.size(), passes);
    const Difference found = difference(sum_of(pictures), render(scene, {}).image, 6e-4, 1e-8);
    EXPECT_TRUE(found.finite);
    EXPECT_LE(found.outliers, 3) << found.worst;
  }
};

TEST_F(WrittenForPovray, ANativeHighlightIsOurPictureToHalfFloats) {
  Scene scene = canonical_scene("oblique_45");
  scene.film.width = scene.film.height = 64;
  expect_our_picture(scene, 1);
}

TEST_F(WrittenForPovray, AModelThatItLacksIsOurPictureAsASumOverLights) {
  Scene scene = canonical_scene("two_lights");
  scene.film.width = scene.film.height = 64;
  for (Material& material : scene.materials)
    material.highlight = highlight_of({"modified_blinn_phong", "cs16", "exact", 100});
  expect_our_picture(scene, scene.lights.size());
}

class WrittenForBlender : public WrittenFor {
 protected:
  Image picture() {
    const auto ended = run(
        shell_quote(engine_->status().program.string()) +
        " -b --factory-startup -noaudio -P scene.py -o //picture -f 1 && mv picture0001.exr picture.exr");
    EXPECT_EQ(ended.exit_code, 0) << ended.output_tail;
    EXPECT_THAT(ended.output_tail, testing::Not(testing::HasSubstr("Traceback")));
    return ended.exit_code == 0 ? read_image(directory_.path() / "picture.exr") : Image(1, 1);
  }
};

double sum_of_values(const Image& image) {
  double sum = 0;
  for (const float value : image.values()) sum += value;
  return sum;
}

/// Cycles' closure differs from Blinn-Phong (NDF) by 1 / ((V.H) max(N.L, N.V)), which is nearly 1 where light, eye and normal are
/// nearly one. The spheres are meshes, and Blender filters pixels: measured are 1.6 % of the peak and 2 % of the sum.
TEST_F(WrittenForBlender, AHighlightLitFromTheCameraIsNearlyOurs) {
  Scene scene = canonical_scene("head_on");
  scene.film.width = scene.film.height = 64;
  scene.materials[0].highlight = highlight_of({"blinn_phong_ndf", "cosine", "exact", 64});
  if (!start("blender", "blender-python", scene)) return;
  const Image theirs = picture(), ours = render(scene, {}).image;
  ASSERT_EQ(theirs.width(), ours.width());
  const double peak = *std::ranges::max_element(ours.values());
  EXPECT_NEAR(*std::ranges::max_element(theirs.values()), peak, 0.05 * peak);
  EXPECT_NEAR(sum_of_values(theirs), sum_of_values(ours), 0.05 * sum_of_values(ours));
}

/// A diffuse ball under every kind of lamp: nothing but its silhouette differs.
TEST_F(WrittenForBlender, EveryLampIsAsBrightAsOurs) {
  const Light lights[] = {directional_at(40, {1, 2, 3}), point_light({10, 5, 5}),
                          SphereLight{{2, 2, 4}, 0.3, {20, 20, 10}},
                          RectangleLight{{2, 1, 3}, {0.5, 0, 0}, {0, 0, 0.5}, {10, 10, 20}},
                          ConstantLight{{1, 0.5, 2}}};
  for (const Light& light : lights) {
    SCOPED_TRACE(info(light).type);
    Scene scene = sphere_scene({"phong_rdf", "cosine", "exact", 64}, {light}, 32);
    scene.sampler.sample_count = 256;
    scene.materials[0].specular_reflectance = {};
    scene.materials[0].diffuse_reflectance = {0.8, 0.4, 0.2};
    if (!start("blender", "blender-python", scene)) return;
    const Image theirs = picture(), ours = render(scene, {}).image;
    ASSERT_GT(sum_of_values(ours), 0);
    EXPECT_NEAR(sum_of_values(theirs), sum_of_values(ours), 0.03 * sum_of_values(ours));
  }
}

}  // namespace
}  // namespace lobelia

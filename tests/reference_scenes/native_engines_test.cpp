// Engines with highlights of their own against the formulas: each within its floor, so that the convention of each is
// pinned, and near enough to find a thousandth in a coefficient.
#include <fmt/format.h>

#include "base/system/files.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "tests/more_samples.hpp"
#include "tests/reference_scenes/render_all.hpp"
#include "tests/reference_scenes/require_engine.hpp"
#include "tests/reference_scenes/test_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

constexpr int kSize = 96;
constexpr double kAngles[] = {0, 45, 80, 120};

/// One for each highlight that an engine may have.
std::vector<Scene> highlights(const std::vector<double>& exponents) {
  std::vector<Scene> scenes;
  for (const ModelInfo& model : models())
    for (const char* lobe : {"cosine", "schlick", "cs16", "ggx"})
      for (const double exponent : exponents)
        for (const double angle : kAngles)
          scenes.push_back(
              sphere_scene({model.name, lobe, "exact", exponent}, {directional_at(angle)}, kSize));
  return scenes;
}

/// How far the picture is from the formulas, in floors: at most 1 in every pixel off the ring.
double floors_apart(const Scene& scene, const Image& image, const EngineFloor& floor) {
  const std::vector<Rgb> truth = truth::evaluate(scene, truth::Digits::kDouble);
  PixelFlags ring = truth::edge_ring(scene);
  truth::mark_grazing(scene, floor.least_cosine, ring);
  double peak = 0, apart = 0;
  for (const Rgb& value : truth) peak = std::max({peak, value.r, value.g, value.b});
  const double of_peak = floor.of_peak_in(scene) * peak;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (ring[i] != 0) continue;
    const double values[] = {truth[i].r, truth[i].g, truth[i].b};
    for (std::size_t c = 0; c < 3; ++c)
      apart = std::max(apart, std::abs(image.values()[3 * i + c] - values[c]) /
                                  (floor.of_value * values[c] + of_peak));
  }
  return peak > 0 ? apart : kInfinity;
}

class NativeEngine : public WithRealEngine {
 protected:
  /// Those that it shows natively.
  std::vector<Scene> shown(std::vector<Scene> scenes) const {
    std::erase_if(scenes,
                  [&](const Scene& scene) { return !engine_->why_not(scene, options_).empty(); });
    return scenes;
  }
  std::string name(const Scene& scene) const {
    const Highlight& h = scene.materials[0].highlight;
    return fmt::format("{}, {}, n = {}", info(h.model).name, info(h.lobe).name, h.exponent);
  }
  void expect_within_floor(const std::vector<Scene>& scenes) {
    ASSERT_GE(scenes.size(), 1u);
    render_all(*engine_, scenes, options_, [&](std::size_t i, ReferenceResult result) {
      SCOPED_TRACE(name(scenes[i]));
      ASSERT_EQ(result.error, "");
      EXPECT_LE(floors_apart(scenes[i], result.image, engine_->info().floor), 1);
    });
  }
  ReferenceOptions options_{.shading = Shading::kNative};
};

TEST_P(NativeEngine, IsWithinItsFloorOfTheFormulas) {
  const std::vector<Scene> all = shown(highlights({10, 100, 1000}));
  ASSERT_GE(all.size(), 6u);
  // In steps of 5, from each scene to the next the exponent and the angle are other ones.
  const std::vector<Scene> scenes = some_of(all, 5);
  const EngineFloor floor = engine_->info().floor;
  render_all(*engine_, scenes, options_, [&](std::size_t i, ReferenceResult result) {
    SCOPED_TRACE(name(scenes[i]));
    ASSERT_EQ(result.error, "");
    EXPECT_EQ(result.record.shading, "native");
    EXPECT_LE(floors_apart(scenes[i], result.image, floor), 1);
    Scene wrong = scenes[i];
    for (Light& light : wrong.lights) {
      Lamp lamp = lamp_of(light);
      lamp.strength = 1.001 * lamp.strength;
      light = light_of(lamp);
    }
    EXPECT_GT(floors_apart(wrong, result.image, floor), 1) << "a thousandth is not found";
  });
}

TEST_P(NativeEngine, ShowsColouredLightsOverADiffuseBase) {
  std::vector<Scene> scenes;
  for (Scene scene : highlights({30})) {
    scene.lights = {DirectionalLight{normalize({-1, -1, -2}), {3, 2, 1}},
                    DirectionalLight{normalize({1, -2, -3}), {0.2, 0.5, 1}}};
    scene.film.height = kSize / 2;
    // Every other picture is tall: in one shape alone two units of an offset may be the same.
    if (scenes.size() % 2 == 1) std::swap(scene.film.width, scene.film.height);
    scene.camera.principal_point_offset_x = 0.1;
    scene.camera.principal_point_offset_y = -0.05;
    scene.materials[0].specular_reflectance = {0.5, 0.5, 0.5};
    scene.materials[0].diffuse_reflectance = {0.2, 0.4, 0.8};
    scenes.push_back(scene);
  }
  expect_within_floor(shown(scenes));
}

TEST_P(NativeEngine, ShowsSurfacesJustBeforeTheCamera) {
  std::vector<Scene> scenes = shown(highlights({100}));
  ASSERT_GE(scenes.size(), 2u);
  for (Scene& scene : scenes) {
    scene.camera.origin = {0, 0, 1.25};
    scene.camera.fov_degrees = 50;
  }
  scenes = shown(scenes);
  std::erase_if(scenes, [](const Scene& scene) {
    return std::ranges::all_of(truth::evaluate(scene, truth::Digits::kDouble), is_black);
  });
  expect_within_floor(scenes);
}

/// Babylon.js has neither.
TEST_P(NativeEngine, ShowsPointLightsOrShadows) {
  if (GetParam() == "babylon") return;
  std::vector<Scene> scenes;
  for (const ModelInfo& model : models()) {
    const HighlightChoice choice{model.name, "cosine", "exact", 40};
    scenes.push_back(sphere_scene(choice, {point_light()}, kSize));
    scenes.push_back(shadow_scene(choice, {directional_at(45)}, kSize));
    for (Material& material : scenes.back().materials) {
      material.highlight = scenes.back().materials[0].highlight;
      material.specular_reflectance = 0.6 * kWhite;
    }
  }
  expect_within_floor(shown(scenes));
}

TEST_P(NativeEngine, SaysInASentenceWhyItCannotShowAScene) {
  Scene scene = shown(highlights({10}))[0];
  const auto why = [&](const auto& change) {
    Scene changed = scene;
    change(changed);
    return engine_->why_not(changed, options_);
  };
  const std::string title(engine_->info().title);
  for (const std::string& reason :
       {why([](Scene& s) { s.materials[0].fresnel = Fresnel::kSchlick; }), why([](Scene& s) {
          s.materials[0].specular_reflectance = {1, 0.5, 0.5};
        }),
        why([](Scene& s) { s.materials[0].highlight.lobe = *find_lobe("gauss"); }),
        why([](Scene& s) {
          s.materials[0].highlight.model = *find_model("modified_blinn_phong");
        })})
    EXPECT_THAT(reason, HasSubstr(title));
}

INSTANTIATE_TEST_SUITE_P(Engines, NativeEngine,
                         testing::Values("tachyon", "sunflow", "three", "babylon", "opengl"),
                         [](const auto& test) { return test.param; });

/// A program in place of an engine's own.
class FakeNativeEngine : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Engine> engine(const std::string& script) {
    const std::filesystem::path file = directory_.path() / "engine";
    write_file(file, "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return make_engine(GetParam(), file);
  }
  /// The first word of the engine's answer to --version.
  static std::string name() {
    const std::map<std::string, std::string> names = {{"tachyon", "Tachyon"},
                                                      {"sunflow", "Sunflow"},
                                                      {"three", "three.js"},
                                                      {"babylon", "Babylon.js"},
                                                      {"opengl", "OpenGL"}};
    return names.at(GetParam());
  }
  TemporaryDirectory directory_;
};

TEST_P(FakeNativeEngine, ReportsAMissingOrDifferentVersion) {
  EXPECT_EQ(engine("echo Nothing; exit 69")->status().state, EngineState::kAbsent);
  EXPECT_EQ(engine("exit 3")->status().state, EngineState::kBroken);
  const auto other = engine(fmt::format("echo '{} 77.1'", name()));
  EXPECT_EQ(other->status().state, EngineState::kBroken);
  EXPECT_THAT(other->status().why, HasSubstr("77.1"));
}

INSTANTIATE_TEST_SUITE_P(Engines, FakeNativeEngine,
                         testing::Values("tachyon", "sunflow", "three", "babylon", "opengl"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace lobelia

#include "farm/profile_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "renderer/lobe_properties.hpp"
#include "renderer/render.hpp"

namespace lobelia {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// One unit sphere lit from 45 degrees.
Scene scene_with(std::string_view model, double exponent) {
  Scene scene;
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 28};
  scene.film = {160, 120};
  scene.lights.push_back(DirectionalLight{normalize({-1, 0, -1}), {2, 2, 2}});
  Material material;
  material.highlight.model = find_model(model).value();
  material.highlight.lobe = find_lobe("cosine").value();
  material.highlight.exponent = exponent;
  material.specular_reflectance = {0.5, 0.5, 0.5};
  scene.materials.push_back(material);
  scene.spheres.push_back({{0, 0, 0}, 1, 0});
  return scene;
}

TEST(LobeAngle, IsWhereTheLobeHasFallenToTheValue) {
  const Scene scene = scene_with("phong_rdf", 16);
  const Highlight& highlight = scene.materials[0].highlight;
  EXPECT_NEAR(lobe_angle_at(prepare(highlight.lobe, highlight.exponent), 0.5),
              std::acos(std::pow(0.5, 1.0 / 16)), 1e-12);
  EXPECT_NEAR(lobe_angle_at(prepare(highlight.lobe, highlight.exponent), 1e-3),
              std::acos(std::pow(1e-3, 1.0 / 16)), 1e-12);
}

TEST(LobeAngle, OfALobeThatNeverFallsSoFarIsItsWidest) {
  Scene scene = scene_with("blinn_phong_ndf", 16);
  Highlight highlight = scene.materials[0].highlight;
  highlight.exponent = 1e-3;
  EXPECT_LE(lobe_angle_at(prepare(highlight.lobe, highlight.exponent), 1e-3), std::numbers::pi / 2);
  EXPECT_GT(lobe_angle_at(prepare(highlight.lobe, highlight.exponent), 1e-3),
            std::numbers::pi / 2 - 0.01);
}

TEST(ProfileScene, OfEveryModelHasTheRenderersHighlightOnTheFormula) {
  ASSERT_FALSE(models().empty());
  for (const ModelInfo& model : models()) {
    Scene scene = scene_with(model.name, 64);
    scene.materials[0].diffuse_reflectance = {0.1, 0.2, 0.3};
    scene.materials[0].fresnel = Fresnel::kSchlick;
    const RenderResult rendered = render(scene, RenderOptions{});
    const Json record = profile_scene(scene, 0, 0, {{"lobelia", &rendered.image}});
    const Json& difference = record["differences"]["lobelia-analytic"];
    for (const char* zone : {"epicentre", "blooming"}) {
      // The picture is float32; its kernels are allowed a few of its roundings.
      EXPECT_LT(difference[zone]["maxRelPeak"].get<double>(), 2e-6) << model.name << ' ' << zone;
      EXPECT_GT(difference[zone]["pixels"].get<int>(), 20) << model.name << ' ' << zone;
    }
    EXPECT_EQ(record["angle"],
              model.angle == LobeAngle::kReflection ? "reflection" : "half_vector");
  }
}

TEST(ProfileScene, MeasuresTheHalfWidthOfTheLobe) {
  const Scene scene = scene_with("phong_rdf", 32);
  const Image analytic = analytic_image(scene, 0);
  const Json record = profile_scene(scene, 0, 0, {{"a", &analytic}});
  const double expected = std::acos(std::pow(0.5, 1.0 / 32)) / kDegree;
  EXPECT_NEAR(record["images"]["a"]["halfWidthDegrees"].get<double>(), expected, 0.02 * expected);
  EXPECT_NEAR(record["zones"]["epicentreDegrees"][1].get<double>(), expected, 1e-9);
  // 2 W/m^2 times a reflectance of a half: the peak is the coefficient, but for the sampling.
  const double peak = radiance_coefficient(scene.materials[0].highlight);
  EXPECT_NEAR(record["images"]["a"]["peak"].get<double>(), peak, 0.01 * peak);
}

TEST(ProfileScene, ComparesTheFirstPictureWithTheOthersAndAllWithTheFormula) {
  const Scene scene = scene_with("modified_phong", 16);
  const Image image = analytic_image(scene, 0);
  const Json record =
      profile_scene(scene, 0, 0, {{"lobelia", &image}, {"povray", &image}, {"blender", &image}});
  std::vector<std::string> names;
  for (const auto& [name, difference] : record["differences"].items()) names.push_back(name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"lobelia-povray", "lobelia-blender", "lobelia-analytic",
                                      "povray-analytic", "blender-analytic"}));
}

TEST(ProfileScene, OfTwoLightsHasBothInTheFormula) {
  Scene scene = scene_with("phong_rdf", 16);
  scene.lights.push_back(PointLight{{-4, 3, 4}, {20, 20, 20}});
  const RenderResult rendered = render(scene, RenderOptions{});
  for (const int light : {0, 1}) {
    const Json record = profile_scene(scene, light, 0, {{"lobelia", &rendered.image}});
    EXPECT_LT(record["differences"]["lobelia-analytic"]["epicentre"]["maxRelPeak"].get<double>(),
              2e-6)
        << "light " << light;
  }
}

TEST(ProfileScene, RefusesWhatTheSceneDoesNotHave) {
  const Scene scene = scene_with("phong_rdf", 16);
  const Image image = analytic_image(scene, 0), small(3, 3), turned(120, 160);
  const auto code = [&](int light, int sphere, const Image& picture) {
    try {
      profile_scene(scene, light, sphere, {{"a", &picture}});
    } catch (const Error& error) {
      return error.code();
    }
    return ExitCode::kSuccess;
  };
  EXPECT_EQ(code(0, 0, image), ExitCode::kSuccess);
  EXPECT_EQ(code(1, 0, image), ExitCode::kInput);
  EXPECT_EQ(code(0, -1, image), ExitCode::kInput);
  EXPECT_EQ(code(0, 0, small), ExitCode::kInput);
  EXPECT_EQ(code(0, 0, turned), ExitCode::kInput) << "as many pixels, another shape";
}

TEST(ProfileScene, SaysWhichScenesHaveNoProfile) {
  const Scene scene = scene_with("phong_rdf", 16);
  const Image image = analytic_image(scene, 0);
  const auto message = [&](const Scene& changed, int light) -> std::string {
    try {
      profile_scene(changed, light, 0, {{"a", &image}});
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kInput);
      return error.what();
    }
    return "";
  };
  Scene area = scene;
  area.lights.push_back(SphereLight{});
  EXPECT_EQ(message(area, 1),
            "light 1 is an area or an environment; a highlight's profile is of a directional or a "
            "point light");
  EXPECT_EQ(message(area, 0),
            "a highlight's profile can be told of a scene of up to 1024 spheres under directional "
            "and point lights; this one has more: an area light");
  Scene crowd = scene;
  crowd.spheres.resize(1025, crowd.spheres.front());
  EXPECT_EQ(message(crowd, 0),
            "a highlight's profile can be told of a scene of up to 1024 spheres under directional "
            "and point lights; this one has more: over 1024 spheres");
}

TEST(ProfileScene, OfOneLightDoesNotSeeTheHighlightOfTheOther) {
  Scene alone = scene_with("phong_rdf", 64), both = alone;
  both.lights.push_back(DirectionalLight{normalize({0.6, -0.3, -1}), {7, 7, 7}});
  const Image one = render(alone, RenderOptions{}).image, two = render(both, RenderOptions{}).image;
  const Json expected = profile_scene(alone, 0, 0, {{"lobelia", &one}})["images"];
  const Json measured = profile_scene(both, 0, 0, {{"lobelia", &two}})["images"];
  for (const char* picture : {"analytic", "lobelia"})
    for (const char* figure : {"peak", "halfWidthDegrees", "energy"})
      EXPECT_NEAR(measured[picture][figure].get<double>(), expected[picture][figure].get<double>(),
                  1e-5 * expected[picture][figure].get<double>())
          << picture << " " << figure;
}

}  // namespace
}  // namespace lobelia

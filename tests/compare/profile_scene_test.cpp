#include "farm/profile_scene.hpp"

#include <fmt/format.h>

#include "base/system/error.hpp"
#include "renderer/render.hpp"
#include "tests/compare/profiled_scene.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TEST(ProfileScene, HasTheRenderersHighlightOnTheFormulaForEveryModel) {
  ASSERT_FALSE(models().empty());
  for (const ModelInfo& model : models()) {
    Scene scene = scene_with(model.name, 64);
    scene.materials[0].diffuse_reflectance = {0.1, 0.2, 0.3};
    scene.materials[0].fresnel = Fresnel::kSchlick;
    const RenderResult rendered = render(scene, RenderOptions{});
    const Json record = as_json(profile_scene(scene, 0, 0, {{"lobelia", &rendered.image}}));
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

TEST(ProfileScene, MeasuresHalfWidthsToBothSides) {
  const Scene scene = scene_with("phong_rdf", 32);
  const Image analytic = analytic_image(scene, 0);
  const Json record = as_json(profile_scene(scene, 0, 0, {{"a", &analytic}}));
  const Json& a = record["images"]["a"];
  const double expected = std::acos(std::pow(0.5, 1.0 / 32)) / kDegree;
  EXPECT_NEAR(a["halfWidthDegrees"].get<double>(), expected, 0.02 * expected);
  EXPECT_NEAR(record["zones"]["epicentreDegrees"][1].get<double>(), expected, 1e-9);
  // 2 W/m^2 times a reflectance of a half: the peak is the coefficient, but for the sampling.
  const double peak = radiance_coefficient(scene.materials[0].highlight);
  EXPECT_NEAR(a["peak"].get<double>(), peak, 0.01 * peak);
  const Json &along = a["highlight"]["halfWidthAlong"], &across = a["highlight"]["halfWidthAcross"];
  EXPECT_NEAR(along["degrees"].get<double>(), expected, 0.01);
  EXPECT_NEAR(across["degrees"].get<double>(), expected, 0.01);
  // Along the plane of incidence the sphere turns away: the same angle takes fewer pixels.
  EXPECT_LT(along["pixels"].get<double>(), 0.95 * across["pixels"].get<double>());
}

TEST(ProfileScene, RefusesPartsMissingFromTheScene) {
  const Scene scene = scene_with("phong_rdf", 16);
  const Image image = analytic_image(scene, 0), small(3, 3), turned(120, 160);
  Scene area = scene, crowd = scene;
  area.lights.push_back(SphereLight{});
  crowd.spheres.resize(1025, crowd.spheres.front());
  const std::string size = "the scene's film 160 x 120";
  const std::string too_much =
      "a highlight's profile can be told of a scene of up to 1024 spheres under directional and "
      "point lights; this one has more: ";
  const struct {
    const Scene& of;
    int light, sphere;
    const Image& picture;
    std::string message;
  } mistakes[] = {
      {scene, 1, 0, image, "no light 1"},
      {scene, 0, -1, image, "no sphere -1"},
      {scene, 0, 0, small, size},
      {scene, 0, 0, turned, size},  // as many pixels, another shape
      {area, 1, 0, image,
       "light 1 is an area or an environment; a highlight's profile is of a directional or a point "
       "light"},
      {area, 0, 0, image, too_much + "an area light"},
      {crowd, 0, 0, image, too_much + "over 1024 spheres"},
  };
  for (const auto& [of, light, sphere, picture, message] : mistakes) {
    const std::string said = error_words(ExitCode::kInput, [&] {
      profile_scene(of, light, sphere, {{"a", &picture}});
    });
    EXPECT_THAT(said, HasSubstr(message));
  }
}

Json highlight_in(const Scene& scene, const Image& picture, int light = 0, int sphere = 0) {
  return as_json(
      profile_scene(scene, light, sphere, {{"a", &picture}}))["images"]["a"]["highlight"];
}

TEST(HighlightOfAScene, IsACosineLobeOfItsExponentForEveryModel) {
  for (const ModelInfo& model : models())
    for (const double n : {8.0, 64.0, 512.0}) {
      Scene scene = scene_with(model.name, n);
      scene.materials[0].diffuse_reflectance = {0.1, 0.2, 0.3};
      scene.materials[0].fresnel = Fresnel::kSchlick;
      scene.film = {320, 240};
      scene.lights[0] = PointLight{{4, 1, 3}, {60, 50, 40}};
      const Json h = highlight_in(scene, render(scene, RenderOptions{}).image);
      const Json& fit = h["cosineLobe"];
      const double exponent = fit["exponent"].get<double>();
      // The kernels' float32 is no noise: its errors are alike in neighbouring pixels.
      EXPECT_NEAR(exponent, n, 1e-6 * n) << model.name;
      EXPECT_LT(fit["standardError"].get<double>(), 1e-6 * n) << model.name;
      EXPECT_NEAR(fit["coefficient"].get<double>(),
                  radiance_coefficient(scene.materials[0].highlight), 1e-5 * n)
          << model.name;
    }
}

TEST(HighlightOfAScene, KnowsItsPlaneOfIncidence) {
  Scene scene = scene_with("phong_rdf", 32);
  const auto plane = [&] {
    const Image image = analytic_image(scene, 0);
    return profile_scene(scene, 0, 0, {{"a", &image}});
  };
  EXPECT_NEAR(plane().plane_of_incidence->x, 1, 1e-12) << "lit from the right";
  EXPECT_NEAR(plane().plane_of_incidence->y, 0, 1e-12);
  scene.lights[0] = DirectionalLight{normalize({3, -4, -1}), {2, 2, 2}};
  EXPECT_NEAR(plane().plane_of_incidence->x, -0.6, 1e-12);
  EXPECT_NEAR(plane().plane_of_incidence->y, -0.8, 1e-12) << "from above: y is down";
  // Measured on the picture: from the sphere's middle the highlight lies that way.
  const records::Profile seen = plane();
  const records::Peak& place = records::find(seen.images, "a")->highlight->peak;
  EXPECT_NEAR((place.y - 60) / (place.x - 80), 4.0 / 3, 0.01);
  scene.lights[0] = DirectionalLight{{0, 0, -1}, {2, 2, 2}};
  EXPECT_FALSE(plane().plane_of_incidence) << "light from behind the camera";
}

TEST(HighlightOfAScene, BesideOneOfAnotherLightIsToldApart) {
  Scene scene = scene_with("phong_rdf", 64);
  // 14 degrees apart: each lies in the other's flank.
  scene.lights.push_back(DirectionalLight{normalize({-1, 0.2, -0.8}), {5, 5, 5}});
  const Image image = render(scene, RenderOptions{}).image;
  for (const int light : {0, 1}) {
    const Json profile = as_json(profile_scene(scene, light, 0, {{"a", &image}}));
    const Json& h = profile["images"]["a"]["highlight"];
    EXPECT_NEAR(h["cosineLobe"]["exponent"].get<double>(), 64, 1e-4) << light;
    EXPECT_GT(profile["subtracted"]["otherLightsOfPeak"].get<double>(), 0.3) << light;
  }
  EXPECT_EQ(highlights_of(scene), (std::vector<std::pair<int, int>>{{0, 0}, {0, 1}}));
}

TEST(HighlightOfAScene, LeavesOutTheShadowOfAnotherSphere) {
  Scene scene = scene_with("phong_rdf", 16);
  // Between the light and the left half of the highlight, and beside the view of it.
  scene.spheres.push_back({{2.2, 0, 2.5}, 0.3, 0});
  const Image image = render(scene, RenderOptions{}).image;
  const Json profile = as_json(profile_scene(scene, 0, 0, {{"a", &image}}));
  EXPECT_NEAR(profile["images"]["a"]["highlight"]["cosineLobe"]["exponent"].get<double>(), 16,
              1e-4);
  EXPECT_LT(profile["differences"]["a-analytic"]["flank"]["maxRelPeak"].get<double>(), 2e-6);
  Scene without = scene;
  without.spheres.pop_back();
  const auto pixels = [&](const Scene& s) {
    return as_json(profile_scene(
        s, 0, 0, {{"a", &image}}))["images"]["a"]["highlight"]["cosineLobe"]["pixels"]
        .get<int>();
  };
  EXPECT_LT(pixels(scene), pixels(without) - 50) << "the scene has such a shadow";
}

TEST(HighlightOfAScene, IsNotShadedByASphereBehindItsLight) {
  Scene scene = scene_with("phong_rdf", 16);
  scene.lights[0] = PointLight{{2, 0, 2}, {20, 20, 20}};
  scene.spheres.push_back({{4, 0, 4}, 1, 0});
  const Image image = render(scene, RenderOptions{}).image;
  const Json record = as_json(profile_scene(scene, 0, 0, {{"a", &image}}));
  EXPECT_LT(record["differences"]["a-analytic"]["epicentre"]["maxRelPeak"].get<double>(), 2e-6);
  EXPECT_GT(record["differences"]["a-analytic"]["epicentre"]["pixels"].get<int>(), 100);
}

TEST(HighlightOfAScene, SaysWhyItIsNotThere) {
  const Scene good = scene_with("phong_rdf", 64);
  const auto because = [&](auto change) {
    Scene scene = good;
    change(scene);
    const Json h = highlight_in(scene, render(scene, RenderOptions{}).image);
    EXPECT_TRUE(h["cosineLobe"].contains("because")) << h;
    return h["because"].get<std::string>();
  };
  const std::string unlit = "no pixel sees a part of the sphere that the light reaches";
  const std::string no_lobe =
      "no pixel's centre lies in the lobe: the highlight is hidden, outside of the picture or smaller "
      "than a pixel";
  EXPECT_EQ(because([](Scene& s) { s.spheres[0].center = {100, 0, 0}; }), unlit);
  EXPECT_EQ(because([](Scene& s) { s.spheres[0].center = {0, 0, 20}; }), unlit) << "behind the eye";
  EXPECT_EQ(because([](Scene& s) { s.lights[0] = DirectionalLight{{0, 0, 1}, {1, 1, 1}}; }), unlit);
  EXPECT_EQ(because([](Scene& s) { s.film = {1, 1}; }), no_lobe);
  EXPECT_EQ(because([](Scene& s) { s.materials[0].highlight.exponent = 1e8; }), no_lobe);
  // Before the highlight, and lit from elsewhere than that it could shade the rest.
  EXPECT_EQ(because([](Scene& s) { s.spheres.push_back({{0.28, 0, 2}, 0.35, 0}); }), no_lobe);
  EXPECT_EQ(because([](Scene& s) {
              s.lights[0] = DirectionalLight{normalize({-1, 0, -1}), {}};
            }),
            "it is black");
  EXPECT_TRUE(because([](Scene& s) {
                s.materials[0].highlight.exponent = 1e4;
              }).starts_with("not resolved: "));
}

records::LobeExplanation explained(const Scene& scene, const Image& picture,
                                   const std::string& family,
                                   std::optional<PixelsShow> shown = {}) {
  const records::Profile profile = profile_scene(scene, 0, 0, {{"a", &picture}}, true, {}, shown);
  const auto& all = records::find(profile.images, "a")->highlight->explanations;
  return *std::ranges::find(all, family, &records::LobeExplanation::family);
}

TEST(HighlightOfAScene, IsItsOwnLobeInPicturesAveragedWithEveryFilter) {
  for (const std::string_view filter : filter_names()) {
    Scene scene = scene_with("phong_rdf", 64);
    scene.film = {128, 128, find_filter(filter).value()};
    scene.sampler.sample_count = 256;
    const Image image = render(scene, RenderOptions{}).image;
    const records::LobeExplanation lobe = explained(scene, image, "phong");
    EXPECT_FALSE(lobe.times_n_dot_l) << filter;
    // At the pixels' centres the fit is off by 0.3 to 1 %.
    EXPECT_NEAR(lobe.exponent.value(), 64, 0.02) << filter;
    EXPECT_GT(
        std::abs(explained(scene, image, "phong", PixelsShow::kCentres).exponent.value() - 64),
        0.05)
        << filter;
    const Json record = as_json(profile_scene(scene, 0, 0, {{"a", &image}}));
    EXPECT_NEAR(record["images"]["a"]["highlight"]["cosineLobe"]["exponent"].get<double>(), 64,
                0.02)
        << filter;
    EXPECT_LT(record["differences"]["a-analytic"]["flank"]["maxRelPeak"].get<double>(), 2e-3)
        << filter;
  }
}

TEST(HighlightOfAScene, TellsMeansFromCentresWhenTheSceneDoesNot) {
  const Scene scene = scene_with("phong_rdf", 64);
  Scene several = scene;
  several.sampler.sample_count = 256;
  for (const bool means : {false, true}) {
    const Image image = render(means ? several : scene, RenderOptions{}).image;
    const records::Profile profile = profile_scene(scene, 0, 0, {{"a", &image}}, true);
    const auto& figures = *records::find(profile.images, "a")->highlight;
    EXPECT_EQ(figures.pixels_show, means ? "means" : "centres");
    EXPECT_NEAR(figures.explanations.front().exponent.value(), 64, 0.02);
    EXPECT_EQ(figures.explanations.front().family, "phong");
    EXPECT_NEAR(figures.cosine_lobe.exponent.value(), 64, 0.02);
  }
}

TEST(HighlightOfAScene, IsNotFittedWhereItLiesElsewhereInThePicture) {
  const Scene scene = scene_with("phong_rdf", 64);
  for (const double degrees : {0.0, 8.0, 15.0, 30.0}) {
    Scene turned = scene;
    const double angle = (45 + degrees) * kDegree;
    turned.lights[0] = DirectionalLight{{-std::sin(angle), 0, -std::cos(angle)}, {2, 2, 2}};
    const Image image = render(turned, RenderOptions{}).image;
    const records::LobeExplanation lobe = explained(scene, image, "phong");
    if (degrees == 0) {
      EXPECT_EQ(lobe.because, "");
      continue;
    }
    EXPECT_TRUE(
        lobe.because.starts_with("the highlight is not where the scene has it: its peak is " +
                                 fmt::format("{:.2g} degrees off", degrees)))
        << lobe.because;
    EXPECT_FALSE(lobe.exponent.has_value());
  }
}

TEST(HighlightOfAScene, IsNoneForADullMaterial) {
  Scene scene = scene_with("phong_rdf", 64);
  scene.materials[0].specular_reflectance = {};
  const Image image = render(scene, RenderOptions{}).image;
  EXPECT_TRUE(highlights_of(scene).empty());
  const Json profile = as_json(profile_scene(scene, 0, 0, {{"a", &image}}));
  EXPECT_FALSE(profile.contains("lobe"));
  EXPECT_FALSE(profile["images"]["a"].contains("highlight"));
}

}  // namespace
}  // namespace lobelia

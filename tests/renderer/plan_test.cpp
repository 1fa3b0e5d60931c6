#include "renderer/plan/plan.hpp"

#include <fmt/format.h>

#include "base/system/error.hpp"
#include "base/words/constants.hpp"
#include "renderer/pixel_ray.hpp"
#include "renderer/plan/effects/catalogue.hpp"
#include "renderer/render.hpp"
#include "renderer/render_record.hpp"
#include "tests/canonical_scene.hpp"
#include "tests/renderer/simple_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

TEST(Plan, GivesAReasonForEveryEffect) {
  for (const char* name : {"head_on", "two_lights", "two_spheres"})
    for (const auto& decision :
         make_plan(canonical_scene(name), EffectPolicy::kAsCalledFor).effects)
      EXPECT_FALSE(decision.reason.empty()) << decision.name;
}

Precision chosen(std::string_view model, double exponent) {
  Scene scene = canonical_scene("head_on");
  scene.materials[0].highlight = {*find_model(model), *find_lobe("cosine"), {}, exponent};
  const Plan plan = make_plan(scene, EffectPolicy::kAsCalledFor);
  EXPECT_EQ(plan.precision.size(), scene.lights.size());
  return plan.precision.at(0).at(0);
}

TEST(Plan, UsesMoreDigitsForSharperHighlights) {
  for (const ModelInfo& model : models()) {
    EXPECT_EQ(chosen(model.name, 8), Precision::kFloat32) << model.name;
    EXPECT_EQ(chosen(model.name, 1e6), Precision::kMixed) << model.name;
    Precision previous = Precision::kFloat32;
    for (double n = 2; n < 1e8; n *= 2) {
      const Precision precision = chosen(model.name, n);
      EXPECT_GE(precision, previous) << model.name << " n = " << n;
      previous = precision;
    }
  }
}

TEST(Plan, UsesFloat64ForLobesWithASteepEnd) {
  // cos^0.1 falls with a vertical tangent there: no rounding of the angle is harmless.
  EXPECT_EQ(chosen("phong_rdf", 0.1), Precision::kFloat64);
}

TEST(ErrorBoundOfShading, GrowsToThePeakAsHalfVectorsShrink) {
  std::vector<LobeId> lobes(all_lobes().begin(), all_lobes().end());
  for (const char* name : {"cs12", "cs1024"}) lobes.push_back(*find_lobe(name));
  for (const ModelId model : all_models())
    for (const LobeId& lobe : lobes)
      for (const double n : {1.0, 19.744142321879362, 1e4, 1e9})
        for (const Precision precision :
             {Precision::kFloat32, Precision::kMixed, Precision::kFloat64}) {
          const Highlight highlight{model, lobe, Normalisation::kExact, n};
          SCOPED_TRACE(
              fmt::format("{} {} {} {}", info(model).name, info(lobe).name, n, name(precision)));
          double narrower = 0;
          for (const double length : {2.0, 1.0, 1e-2, 1e-5, 1e-10, 1e-15, 0.0}) {
            const double bound = shading_error_bound(precision, highlight, length);
            EXPECT_GE(bound, narrower * (1 - 1e-9)) << length;
            EXPECT_LT(bound, 10) << length;
            narrower = bound;
          }
          const bool vanishes = info(model).angle == LobeAngle::kHalfVector;
          EXPECT_GE(narrower, vanishes ? 0.9 : 0);
        }
}

TEST(Plan, TakesTheRequestedPrecision) {
  for (const Precision precision : {Precision::kFloat32, Precision::kMixed, Precision::kFloat64}) {
    const Plan plan = make_plan(canonical_scene("two_spheres"), EffectPolicy::kAll, precision);
    for (const auto& row : plan.precision)
      for (const Precision here : row) EXPECT_EQ(here, precision);
    EXPECT_EQ(plan.precision_reason, std::string(name(precision)) + " was asked for");
  }
  EXPECT_NE(make_plan(canonical_scene("head_on"), EffectPolicy::kAll).precision_reason, "");
}

TEST(Plan, UsesHalfFloatsOnlyOnRequest) {
  const Plan plan =
      make_plan(canonical_scene("oblique_45"), EffectPolicy::kAsCalledFor, Precision::kFloat16);
  EXPECT_NE(plan.precision_reason.find("float16 was asked for, and is emulated"),
            std::string::npos);
  EXPECT_NE(plan.kernel.find("waves"), std::string::npos) << "no fused kernel has half floats";
  for (const LobeId& lobe : all_lobes())
    EXPECT_NE(sufficient_precision({{}, lobe, Normalisation::kExact, 1e-3}, 2),
              Precision::kFloat16);
}

TEST(Plan, RefusesHalfFloatsForAnExponentThatTheyDoNotHave) {
  Scene scene = canonical_scene("oblique_45");
  const auto plan_for = [&](double n) {
    scene.materials[0].highlight.exponent = n;
    make_plan(scene, EffectPolicy::kAsCalledFor, Precision::kFloat16);
  };
  EXPECT_NO_THROW(plan_for(65504));
  EXPECT_THROW(plan_for(65505), Error);
}

TEST(Plan, NeedsNoShadowsWhereNoSphereIsBetween) {
  Scene beside = canonical_scene("two_spheres"), dark = beside,
        behind = canonical_scene("point_light");
  beside.spheres[1].center = {2, -2, 0};
  std::get<DirectionalLight>(dark.lights[0]).irradiance = {};
  behind.spheres.push_back({3 * std::get<PointLight>(behind.lights[0]).position, 0.5, 0});
  for (const Scene& scene : {canonical_scene("grazing_80"), beside, dark, behind}) {
    const Plan plan = make_plan(scene, EffectPolicy::kAsCalledFor);
    EXPECT_FALSE(plan.on<effects::Shadows>()) << scene_to_xml(scene);
    EXPECT_EQ(plan.max_shadow_rays, 0u) << scene_to_xml(scene);
  }
}

TEST(Plan, OnlyTheSphereInTheWayOfTheLightOccludes) {
  const Plan plan = make_plan(canonical_scene("two_spheres"), EffectPolicy::kAsCalledFor);
  EXPECT_TRUE(plan.on<effects::Shadows>());
  ASSERT_EQ(plan.occluders.size(), 1u);
  EXPECT_EQ(plan.occluders[0][0].spheres,
            std::vector<int>{1});             // the small one shades the large one
  EXPECT_TRUE(plan.occluders[0][1].empty());  // and not the other way round
}

TEST(MinHalfLengths, AreCloseLowerBoundsForAllVisibleLitPoints) {
  for (const char* name : {"head_on", "oblique_45", "grazing_80", "point_light"}) {
    const Scene scene = canonical_scene(name);
    double least = 2;
    for (int i = 0; i <= 200; ++i)
      for (int j = 0; j < 200; ++j) {
        const double z = 1 - i / 100.0, angle = 2 * std::numbers::pi * j / 200;
        const double flat = std::sqrt(std::max(0.0, 1 - z * z));
        const Vec3 normal{flat * std::cos(angle), flat * std::sin(angle), z};
        const Vec3 to_eye = normalize(scene.camera.origin - normal);
        const Vec3 to_light = illuminate(scene.lights[0], normal).to_light;
        if (dot(normal, to_eye) > 0 && dot(normal, to_light) > 0)
          least = std::min(least, length(to_light + to_eye));
      }
    const double bound = min_half_lengths(scene).at(0);
    EXPECT_LE(bound, least) << name;
    EXPECT_GE(bound, 0.8 * least) << name;
  }
}

TEST(MinHalfLengths, AreUnknownWhereAnyDirectionCounts) {
  Scene scene = canonical_scene("head_on");
  EXPECT_GT(min_half_lengths(scene).at(0), 1);
  Scene lens = scene, mirror = scene, glossy = scene, plane = scene, soft = scene;
  lens.camera.aperture_radius = 0.1;
  mirror.depth.mirror = 1;
  glossy.depth.glossy = 1;
  plane.planes.push_back({{0, -1, 0}, {0, 1, 0}, 0, 0, 1});
  soft.lights[0] = SphereLight{{0, 0, 9}, 1, {1, 1, 1}};
  for (const Scene& any : {lens, mirror, glossy, plane, soft})
    EXPECT_EQ(min_half_lengths(any).at(0), 0);
}

// Each effect against itself with everything forced.

TEST(Effects, ForcedGiveTheSamePictureBitForBitWhereNothingIsRandom) {
  Scene ground = on_the_ground(), mirrors = ground;
  mirrors.materials[0].mirror_reflectance = {0.5, 0.6, 0.7};
  mirrors.materials[0].fresnel = Fresnel::kSchlick;
  mirrors.depth.mirror = 4;
  Scene crowd = canonical_scene("head_on");
  crowd.film = {40, 40};
  crowd.materials[0].mirror_reflectance = {0.3, 0.3, 0.3};
  crowd.depth.mirror = 2;
  crowd.spheres.clear();
  for (int i = 0; i < 1200; ++i)
    crowd.spheres.push_back(
        {{(i % 12 - 5.5) * 0.1, (i / 12 % 10 - 4.5) * 0.1, i / 120 * -0.1}, 0.04});
  for (const Scene& scene : {ground, mirrors, crowd}) {
    const RenderResult planned = render(scene, {}), all = with_all(scene);
    EXPECT_TRUE(same(planned.image, all.image)) << scene.spheres.size();
    EXPECT_GT(all.work.scattered_rays, planned.work.scattered_rays) << scene.spheres.size();
    EXPECT_GT(mean(planned.image), 1e-4) << scene.spheres.size();
  }
}

TEST(TheRaysOfARecord, CountMirrorRaysApart) {
  Scene scene = on_the_ground();
  scene.materials[0].mirror_reflectance = {0.5, 0.5, 0.5};
  scene.depth.mirror = 1;
  const records::Rays rays = rays_record(render(scene, {}).work);
  EXPECT_GT(rays.mirror, 0u);
  EXPECT_EQ(rays.scattered, 0u);
}

TEST(TheInsideOfASphere, IsDarkWhicheverWayALightIsLookedFor) {
  // A camera in the sphere does not see it, but sees the half of another that it holds.
  for (const bool mirror : {false, true}) {
    Material material = shiny(16);
    if (mirror) material.mirror_reflectance = {0.5, 0.5, 0.5};
    Scene scene = one_sphere(material);
    scene.spheres.push_back({scene.camera.origin, 4.5, 0});
    scene.depth.mirror = 2;
    scene.sampler.sample_count = 4;
    scene.lights = {ConstantLight{{1, 1, 1}}, DirectionalLight{{0, 0, -1}, {1, 1, 1}},
                    SphereLight{{0, 3, 3}, 0.5, {1, 1, 1}}};
    for (const EffectPolicy policy : {EffectPolicy::kAsCalledFor, EffectPolicy::kAll}) {
      RenderOptions options;
      options.effects = policy;
      const Image image = render(scene, options).image;
      for (const float v : image.values()) ASSERT_EQ(v, 0);
    }
    EXPECT_FALSE(light_at(scene, 1, {0, {0, 0, 1}, {0, 0, 1}}));
    scene.spheres.pop_back();
    EXPECT_TRUE(light_at(scene, 1, {0, {0, 0, 1}, {0, 0, 1}}));
    EXPECT_GT(mean(render(scene, {}).image), 0.1);
  }
}

// Single effects, held to what is known of them: irradiance in closed form, the white furnace, lenses and mirrors.

TEST(SphereLightOnAPlane, GivesTheIrradianceOfItsProjectedSolidAngle) {
  // E = pi L (r/d)^2 cos(theta) where all of it is above the horizon (Lambert).
  for (const Vec3 center : {Vec3{0, 2, 0}, {3, 2, 0}, {1, 5, -2}}) {
    Scene scene = one_plane(matt(0.8));
    scene.sampler.sample_count = 256;
    scene.lights = {SphereLight{center, 0.5, {3, 3, 3}}};
    const double d2 = dot(center, center), cosine = center.y / std::sqrt(d2);
    const double expected = 0.8 * 3 * 0.25 / d2 * cosine;
    // The light itself hides the plane from a camera above it.
    scene.camera.origin = {0, 0.5, 0};
    EXPECT_NEAR(mean(render(scene, {}).image) / expected, 1, 2e-3);
    EXPECT_NEAR(mean(with_all(scene).image) / expected, 1, 2e-2);
  }
}

TEST(RectangleLightOverAPlane, GivesTheIrradianceOfTheClosedForm) {
  // A point below the middle of a parallel rectangle: four times the factor of a corner (Modest 2013,
  // configuration 11).
  for (const double height : {0.1, 1.0, 4.0}) {
    Scene scene = one_plane(matt(0.5));
    scene.sampler.sample_count = 256;
    scene.camera.origin = {0, 0.05, 0};
    scene.lights = {RectangleLight{{0, height, 0}, {1.5, 0, 0}, {0, 0, 0.5}, {2, 2, 2}}};
    const double a = 1.5 / height, b = 0.5 / height;
    const double factor = 4 / (2 * kPi) *
                          (a / std::hypot(1, a) * std::atan(b / std::hypot(1, a)) +
                           b / std::hypot(1, b) * std::atan(a / std::hypot(1, b)));
    EXPECT_NEAR(mean(render(scene, {}).image) / (0.5 * 2 * factor), 1, 2e-3) << height;
  }
}

TEST(ATinyDistantSphereLight, IsAPointLight) {
  for (const double exponent : {8.0, 512.0}) {
    Scene scene = one_sphere(shiny(exponent));
    scene.camera.fov_degrees = 28;
    scene.film = {64, 64};
    scene.lights = {PointLight{{300, 200, 400}, {1e5, 1e5, 1e5}}};
    const Image point = render(scene, {}).image;
    const double radiance = 1e5 / (kPi * 0.1 * 0.1);
    scene.lights = {SphereLight{{300, 200, 400}, 0.1, {radiance, radiance, radiance}}};
    scene.sampler.sample_count = 1;
    const Image ball = render(scene, {}).image;
    const float peak = *std::max_element(point.values().begin(), point.values().end());
    for (std::size_t i = 0; i < point.values().size(); ++i)
      EXPECT_NEAR(ball.values()[i], point.values()[i], 2e-3 * peak);
  }
}

// ---- light from everywhere

TEST(WhiteFurnace, AMattSphereUnderAnEvenSkyIsItsAlbedoTimesTheSky) {
  Scene scene = one_sphere(matt(0.7));
  scene.lights = {ConstantLight{{2, 2, 2}}};
  for (const int samples : {1, 16}) {
    scene.sampler.sample_count = samples;
    const Image image = render(scene, {}).image;
    for (const float v : image.values()) EXPECT_NEAR(v, 1.4, 1e-5);
  }
  scene.sampler.sample_count = 256;
  EXPECT_NEAR(mean(with_all(scene).image), 1.4, 1e-2);
}

TEST(WhiteFurnace, IsWhiteBetweenWhiteSpheresWithInterReflection) {
  Scene scene = one_sphere(matt(1));
  scene.spheres.push_back({{1.5, 0.5, 1}, 1, 0});
  scene.spheres.push_back({{-1.5, 0, 1}, 1, 0});
  scene.planes = {{{0, -1, 0}, {0, 1, 0}}};
  scene.lights = {ConstantLight{{1, 1, 1}}};
  scene.sampler.sample_count = 64;
  scene.depth.glossy = 64;
  EXPECT_NEAR(mean(render(scene, {}).image), 1, 5e-3);
  // And darker, the fewer times light may go between them.
  double last = 1;
  for (const int depth : {8, 2, 1, 0}) {
    scene.depth.glossy = depth;
    const double here = mean(render(scene, {}).image);
    EXPECT_LT(here, last + 5e-3) << depth;
    last = here;
  }
  EXPECT_LT(last, 0.9);
}

TEST(AWedgeOfTwoGreyPlanes, IsAsBrightUnderAnEvenSkyAsInClosedFormThoughMostPathsEndEarly) {
  // At every distance from the edge, F = (1 + cos(angle)) / 2 of what a plane receives is from the other one. So both are
  // evenly bright: L = a (F L + 1 - F). Half of that has come after more than four reflections, where the roulette acts.
  constexpr double kAlbedo = 0.9, kAngle = kPi / 6;
  const double sine = std::sin(kAngle / 2), cosine = std::cos(kAngle / 2);
  Scene scene;
  scene.camera = {{1, 0, 0}, {0, 0, 0}, {0, 1, 0}, 10};
  scene.film = {16, 16};
  scene.sampler.sample_count = 64;
  scene.materials = {matt(kAlbedo)};
  scene.planes = {{{0, 0, 0}, {sine, cosine, 0}}, {{0, 0, 0}, {sine, -cosine, 0}}};
  scene.lights = {ConstantLight{{1, 1, 1}}};
  scene.depth.glossy = 64;
  const double other = (1 + std::cos(kAngle)) / 2;
  const double expected = kAlbedo * (1 - other) / (1 - kAlbedo * other);
  // A path brings between 0 and 1, so its variance is at most this.
  const double variance = expected * (1 - expected);
  EXPECT_NEAR(mean(render(scene, {}).image), expected, 5 * std::sqrt(variance / (16 * 16 * 64)));
}

TEST(Environment, IsSeenBesideTheSphereAndInAMirror) {
  Scene scene = one_sphere(matt(0));
  scene.camera.fov_degrees = 40;
  scene.lights = {ConstantLight{{0.25, 0.5, 1}}};
  Image image = render(scene, {}).image;
  EXPECT_EQ(image.pixel(0, 0)[1], 0.5f);
  EXPECT_EQ(image.pixel(8, 8)[1], 0.0f);
  scene.materials[0].mirror_reflectance = {0.5, 0.5, 0.5};
  image = render(scene, {}).image;
  EXPECT_EQ(image.pixel(8, 8)[2], 0.5f);
}

TEST(Environment, IsADirectionalLightWithASmallSun) {
  // One bright pixel around the direction to the sun; what is interpolated beside it adds to its size.
  Scene scene = one_sphere(matt(0.5));
  scene.camera.fov_degrees = 28;
  scene.film = {32, 32};
  const double turn = 2 * kPi * (40.5 / 64 - 0.5), down = kPi * 10.5 / 32;
  const Vec3 to_sun{std::sin(down) * std::sin(turn), std::cos(down),
                    -std::sin(down) * std::cos(turn)};
  scene.lights = {EnvmapLight{
      {1, 1, 1}, sky([](int x, int y) { return x == 40 && y == 10 ? 100.f : 0.f; }), ""}};
  scene.camera.origin = 5 * to_sun;
  scene.sampler.sample_count = 256;
  const double lit = mean(render(scene, {}).image);
  const double solid_angle = 2 * kPi / 64 * (std::cos(kPi * 10 / 32) - std::cos(kPi * 11 / 32));
  scene.lights = {DirectionalLight{-to_sun, 100 * solid_angle * Rgb{1, 1, 1}}};
  EXPECT_NEAR(lit / mean(render(scene, {}).image), 1, 0.01);
}

// ---- planes, mirrors, lenses

TEST(Mirror, FallsAsAPowerOfTheReflectanceOverReflections) {
  // Between two parallel mirrors a ray that goes straight at one meets a lamp after n reflections.
  Scene scene;
  scene.camera = {{0, 0, 0}, {0, 0.05, -1}, {0, 1, 0}, 0.01};
  scene.film = {1, 1};
  Material mirror = matt(0);
  mirror.mirror_reflectance = {0.9, 0.9, 0.9};
  scene.materials = {mirror};
  scene.planes = {{{0, 0, -1}, {0, 0, 1}}, {{0, 0, 1}, {0, 0, 1}}};
  // Above all, shining down: the ray climbs 0.05 a unit of length.
  scene.lights = {RectangleLight{{0, 1, 0}, {5, 0, 0}, {0, 0, 0.99}, {1, 1, 1}}};
  scene.depth.mirror = 64;
  // It reaches y = 1 after a way of 20 along z, from -1 to 1 and back: ten reflections.
  EXPECT_NEAR(render(scene, {}).image.pixel(0, 0)[0], std::pow(0.9, 10), 1e-4);
  scene.depth.mirror = 9;
  EXPECT_NEAR(render(scene, {}).image.pixel(0, 0)[0], std::pow(0.9, 10), 1e-4);
  scene.depth.mirror = 8;
  EXPECT_EQ(render(scene, {}).image.pixel(0, 0)[0], 0);
}

TEST(DepthOfField, LeavesThePlaneOfFocusSharp) {
  Scene scene = one_plane(matt(0));
  scene.camera = {{0, 10, 1e-3}, {0, 0, 0}, {0, 1, 0}, 40};
  scene.materials = {matt(0.2), matt(0.8)};
  scene.film = {32, 32};
  scene.planes[0] = {{0, 0, 0}, {0, 1, 0}, 0, 1, 1};
  scene.lights = {DirectionalLight{{0, -1, 0}, {kPi, kPi, kPi}}};
  const Image pinhole = render(scene, {}).image;
  scene.camera.aperture_radius = 1;
  scene.camera.focus_distance = 10;
  const Image sharp = render(scene, {}).image;
  int different = 0;
  for (std::size_t i = 0; i < sharp.values().size(); ++i)
    different += std::abs(sharp.values()[i] - pinhole.values()[i]) > 1e-5f;
  EXPECT_LT(different, 3 * 32);  // the camera looks a hair aslant
}

TEST(DepthOfField, SpreadsAPointOverADiscOfTheKnownSize) {
  // A distant lamp seen through a lens of radius a focused at f, at distance d: the disc's radius
  // in the plane of focus is a (d - f) / d, and the lamp's own size there.
  Scene scene;
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 2 * std::atan(0.1) * 180 / kPi, 0.3, 4};
  scene.film = {101, 101};
  scene.sampler.sample_count = 256;
  scene.materials = {matt(0)};
  scene.lights = {SphereLight{{0, 0, -40}, 1, {1, 1, 1}}};
  const Image image = render(scene, {}).image;
  int lit = 0;
  for (int y = 0; y < 101; ++y)
    for (int x = 0; x < 101; ++x) lit += image.pixel(x, y)[0] > 0;
  const double pixel = 2 * 0.1 * 4 / 101;  // in the plane of focus
  const double radius = (0.3 * 36 / 40 + 1 * 4.0 / 40) / pixel;
  EXPECT_NEAR(lit / (kPi * radius * radius), 1, 0.08);
}

TEST(Antialiasing, SpendsItsSamplesOnEdges) {
  Scene scene = canonical_scene("two_spheres");
  scene.sampler.sample_count = 128;
  EXPECT_LT(render(scene, {}).work.camera_rays, with_all(scene).work.camera_rays / 2);
}

TEST(Antialiasing, SpendsThemEverywhereWhereTheHighlightIsSmallerThanAPixel) {
  Scene scene = canonical_scene("head_on");
  scene.film = {32, 32};
  scene.sampler.sample_count = 64;
  scene.materials[0].highlight.exponent = 1e6;
  const RenderResult result = render(scene, {});
  EXPECT_EQ(result.work.camera_rays, result.plan.camera_rays);
  EXPECT_NE(result.plan.sample_reason.find("pixels across"), std::string::npos)
      << result.plan.sample_reason;
}

}  // namespace
}  // namespace lobelia

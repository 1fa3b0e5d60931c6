// Each effect against what is known of it, and against itself with everything forced.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "renderer/pixel_ray.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/scene_io.hpp"
#include "tests/canonical_scene.hpp"

namespace lobelia {
namespace {

constexpr double kPi = std::numbers::pi;

Material matt(double albedo) {
  Material m;
  m.highlight = {*find_model("phong_rdf"), *find_lobe("cosine"), {}, 32};
  m.specular_reflectance = {};
  m.diffuse_reflectance = {albedo, albedo, albedo};
  return m;
}
Material shiny(double exponent) {
  Material m = matt(0.2);
  m.highlight.exponent = exponent;
  m.specular_reflectance = {0.5, 0.5, 0.5};
  return m;
}

/// A unit sphere that fills the picture, so that every pixel sees it.
Scene one_sphere(const Material& material) {
  Scene scene;
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 10};
  scene.film = {16, 16};
  scene.materials = {material};
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  return scene;
}

/// A horizontal plane seen straight from above, its origin in the middle of the picture.
Scene one_plane(const Material& material) {
  Scene scene;
  scene.camera = {{0, 10, 0}, {0, 0, 0}, {0, 0, -1}, 1};
  scene.film = {4, 4};
  scene.materials = {material};
  scene.planes = {{{0, 0, 0}, {0, 1, 0}}};
  return scene;
}

double mean(const Image& image) {
  double sum = 0;
  for (const float v : image.values()) sum += v;
  return sum / double(image.values().size());
}

bool same(const Image& a, const Image& b) {
  return std::equal(a.values().begin(), a.values().end(), b.values().begin(), b.values().end());
}

RenderResult with_all(const Scene& scene) {
  RenderOptions options;
  options.effects = EffectPolicy::kAll;
  return render(scene, options);
}

std::shared_ptr<const Image> sky(const std::function<float(int, int)>& value) {
  auto image = std::make_shared<Image>(64, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x)
      for (float& c : image->pixel(x, y)) c = value(x, y);
  return image;
}

/// One of each kind, for laws that hold of every scene.
struct Named {
  std::string name;
  Scene scene;
  bool random;
};

Scene on_the_ground() {
  Scene scene;
  scene.camera = {{0, 2, 6}, {0, 0.8, 0}, {0, 1, 0}, 40};
  scene.film = {48, 36};
  scene.lights = {DirectionalLight{normalize({-1, -2, -1}), {2, 2, 2}}};
  scene.materials = {shiny(64), matt(0.6), matt(0.1)};
  scene.spheres = {{{-1, 1, 0}, 1, 0}, {{1.2, 0.7, 0.5}, 0.7, 0}};
  scene.planes = {{{0, 0, 0}, {0, 1, 0}, 1, 2, 0.5}};
  return scene;
}

std::vector<Named> scenes() {
  std::vector<Named> all;
  for (const char* name : {"head_on", "oblique_45", "point_light", "two_lights", "two_spheres"}) {
    Scene scene = canonical_scene(name);
    scene.film = {61, 43};
    all.push_back({name, scene, false});
  }
  const Scene ground = on_the_ground();
  all.push_back({"ground", ground, false});
  Scene scene = ground;
  scene.materials[0].mirror_reflectance = {0.5, 0.6, 0.7};
  scene.depth.mirror = 4;
  all.push_back({"mirrors", scene, false});
  scene.materials[0].fresnel = Fresnel::kSchlick;
  all.push_back({"mirrors with fresnel", scene, false});
  Scene crowd = canonical_scene("head_on");
  crowd.film = {40, 40};
  crowd.materials[0].mirror_reflectance = {0.3, 0.3, 0.3};
  crowd.depth.mirror = 2;
  crowd.spheres.clear();
  for (int i = 0; i < 1200; ++i)
    crowd.spheres.push_back(
        {{(i % 12 - 5.5) * 0.1, (i / 12 % 10 - 4.5) * 0.1, i / 120 * -0.1}, 0.04});
  all.push_back({"crowd", crowd, false});
  crowd.spheres.resize(200);
  all.push_back({"small crowd", crowd, false});

  scene = ground;
  scene.sampler = {16, 3};
  all.push_back({"antialiased", scene, true});
  scene = ground;
  scene.sampler = {64, 3};
  scene.lights = {SphereLight{{2, 4, 2}, 0.7, {20, 20, 20}}};
  all.push_back({"sphere light", scene, true});
  scene.lights = {RectangleLight{{0, 4, 2}, {1, 0, 0}, {0, 0, 1}, {5, 5, 5}}};
  all.push_back({"rectangle light", scene, true});
  scene.lights = {ConstantLight{{0.5, 0.6, 0.7}}};
  all.push_back({"environment", scene, true});
  scene.lights = {EnvmapLight{
      {1, 1, 1},
      sky([](int x, int y) { return x > 40 && x < 44 && y > 8 && y < 11 ? 50.f : 0.1f; }),
      ""}};
  all.push_back({"environment image", scene, true});
  scene.lights = ground.lights;
  scene.depth.glossy = 2;
  all.push_back({"glossy", scene, true});
  scene.depth.glossy = 0;
  scene.camera.aperture_radius = 0.1;
  scene.camera.focus_distance = 6;
  all.push_back({"depth of field", scene, true});
  return all;
}

// ---- laws of the plan

TEST(Effects, WhatIsOffDidNothing) {
  int off = 0;
  for (const Named& s : scenes()) {
    RenderResult result = render(s.scene, {});
    ASSERT_EQ(result.plan.effects.size(), Effects::kSize);
    for (std::size_t i = 0; i < Effects::kSize; ++i) {
      if (result.plan.effects[i].on) continue;
      ++off;
      EXPECT_EQ(result.work.of_effect[i], 0u) << s.name << ": " << result.plan.effects[i].name;
    }
    EXPECT_EQ(result.work.shadow_rays, result.work.of<effects::Shadows>()) << s.name;
    EXPECT_EQ(result.work.mirror_rays, result.work.of<effects::Mirror>()) << s.name;
  }
  EXPECT_GT(off, 50);
}

TEST(Effects, EachIsOnSomewhereAndDoesSomethingThere) {
  std::array<bool, Effects::kSize> worked{}, was_off{};
  for (const Named& s : scenes()) {
    const RenderResult result = render(s.scene, {});
    for (std::size_t i = 0; i < Effects::kSize; ++i) {
      worked[i] |= result.work.of_effect[i] > 0;
      was_off[i] |= !result.plan.effects[i].on;
    }
  }
  const Plan plan = make_plan(scenes()[0].scene, EffectPolicy::kAsCalledFor);
  for (std::size_t i = 0; i < Effects::kSize; ++i) {
    EXPECT_TRUE(worked[i]) << plan.effects[i].name;
    EXPECT_TRUE(was_off[i]) << plan.effects[i].name;
  }
}

TEST(Effects, NoMoreRaysAreTracedThanThePlanExpects) {
  for (const Named& s : scenes())
    for (const EffectPolicy policy : {EffectPolicy::kAsCalledFor, EffectPolicy::kAll}) {
      RenderOptions options;
      options.effects = policy;
      const RenderResult r = render(s.scene, options);
      EXPECT_LE(r.work.camera_rays, r.plan.camera_rays) << s.name;
      EXPECT_LE(r.work.shadow_rays, r.plan.max_shadow_rays) << s.name;
      EXPECT_LE(r.work.mirror_rays, r.plan.max_mirror_rays) << s.name;
      EXPECT_LE(r.work.scattered_rays, r.plan.max_scattered_rays) << s.name;
    }
}

TEST(Effects, ForcedGiveTheSamePictureBitForBitWhereNothingIsRandom) {
  int checked = 0;
  for (const Named& s : scenes()) {
    if (s.random) continue;
    const RenderResult planned = render(s.scene, {}), all = with_all(s.scene);
    EXPECT_TRUE(same(planned.image, all.image)) << s.name;
    EXPECT_GT(all.work.scattered_rays, planned.work.scattered_rays) << s.name;
    EXPECT_GT(mean(planned.image), 1e-4) << s.name;
    ++checked;
  }
  EXPECT_GE(checked, 10);
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

TEST(Effects, ForcedGiveTheSamePictureWithinTheNoiseWhereSomethingIs) {
  int checked = 0;
  for (const Named& s : scenes()) {
    if (!s.random) continue;
    // Means over blocks of four pixels in eight pictures each: their difference by its own spread.
    constexpr int kSeeds = 8;
    std::vector<std::vector<double>> of[2];
    for (int seed = 0; seed < kSeeds; ++seed) {
      Scene scene = s.scene;
      scene.sampler.seed = std::uint64_t(100 + seed);
      for (int policy = 0; policy < 2; ++policy) {
        if (policy == 1) scene.sampler.seed += 1000;  // independent of the planned one
        const Image image = policy == 0 ? render(scene, {}).image : with_all(scene).image;
        std::vector<double> blocks(12 * 9);
        for (int y = 0; y < 36; ++y)
          for (int x = 0; x < 48; ++x)
            blocks[std::size_t(y / 4 * 12 + x / 4)] += image.pixel(x, y)[1] / 16.0;
        of[policy].push_back(blocks);
      }
    }
    double worst = 0, bright = 0, chi_squared = 0;
    int blocks = 0;
    for (std::size_t b = 0; b < 12 * 9; ++b) {
      double m[2]{}, v[2]{};
      for (int p = 0; p < 2; ++p) {
        for (const auto& image : of[p]) m[p] += image[b] / kSeeds;
        for (const auto& image : of[p]) v[p] += std::pow(image[b] - m[p], 2) / (kSeeds - 1);
      }
      bright = std::max(bright, m[0]);
      // Below float32's own roundings nothing is noise.
      const double spread = std::sqrt((v[0] + v[1]) / kSeeds) + 1e-6 * (m[0] + m[1]) + 1e-9;
      const double t = std::abs(m[0] - m[1]) / spread;
      worst = std::max(worst, t);
      chi_squared += t * t;
      ++blocks;
    }
    EXPECT_GT(bright, 0.01) << s.name;
    // Student's t of 14 degrees of freedom: beyond 7 once in 1e5 over all blocks and scenes; its square
    // has a mean of 14/12 and, over 108 blocks, strays from it by more than 1 once in 1e4.
    EXPECT_LT(worst, 7) << s.name;
    EXPECT_LT(chi_squared / blocks, 2.2) << s.name;
    ++checked;
  }
  EXPECT_GE(checked, 7);
}

TEST(Effects, AreTheSameBitForBitWhateverTheNumberOfThreads) {
  for (const Named& s : scenes()) {
    RenderOptions one, many;
    one.threads = 1;
    many.threads = 5;
    EXPECT_TRUE(same(render(s.scene, one).image, render(s.scene, many).image)) << s.name;
  }
}

TEST(Effects, AreTheSameBitForBitInRowsAsInOnePiece) {
  for (const Named& s : scenes()) {
    Image rows(s.scene.film.width, s.scene.film.height);
    int next = 0;
    render(s.scene, {}, [&](int y, int count, const float* rgb) {
      EXPECT_EQ(y, next);
      next = y + count;
      std::copy_n(rgb, 3 * count * rows.width(), rows.values().data() + 3 * y * rows.width());
    });
    EXPECT_EQ(next, rows.height());
    EXPECT_TRUE(same(rows, render(s.scene, {}).image)) << s.name;
  }
}

// ---- lights with a size

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

TEST(RectangleLightOverAPlane, FacingAwayLeavesItDark) {
  Scene scene = one_plane(matt(0.5));
  scene.sampler.sample_count = 16;
  scene.camera.origin = {0, 0.05, 0};
  scene.lights = {RectangleLight{{0, 1, 0}, {0, 0, 0.5}, {1.5, 0, 0}, {2, 2, 2}}};
  EXPECT_EQ(mean(render(scene, {}).image), 0);
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

TEST(SoftShadows, AreDarkInTheMiddleAndFadeOutwards) {
  Scene scene = one_plane(matt(1));
  scene.film = {201, 1};
  scene.sampler.sample_count = 256;
  scene.spheres = {{{0, 1, 0}, 0.5, 0}};
  scene.materials.push_back(matt(0));
  scene.spheres[0].material = 1;
  scene.lights = {SphereLight{{0, 4, 0}, 0.3, {10, 10, 10}}};
  scene.camera = {{0, 12, 12}, {0, 0, 0}, {0, 1, 0}, 20};
  const Image with = render(scene, {}).image;
  scene.spheres.clear();
  const Image without = render(scene, {}).image;
  // From the left edge of the picture to the sphere: full light, then less and less, then none.
  double last = 1.02;
  int full = 0, half = 0, none = 0;
  for (int x = 0; x < 90; ++x) {
    const double visible = with.pixel(x, 0)[0] / without.pixel(x, 0)[0];
    EXPECT_LE(visible, last + 0.02) << x;
    last = visible;
    full += visible > 0.999;
    half += visible > 0.05 && visible < 0.95;
    none += visible == 0;
  }
  EXPECT_GT(full, 20);
  EXPECT_GT(half, 3);
  EXPECT_GT(none, 3);
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

TEST(WhiteFurnace, WithInterReflectionIsWhiteBetweenWhiteSpheresToo) {
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

TEST(Environment, WithAnImageOfOneColourIsAnEvenOne) {
  Scene scene = on_the_ground();
  scene.sampler.sample_count = 64;
  scene.lights = {ConstantLight{{0.5, 0.5, 0.5}}};
  const double even = mean(render(scene, {}).image);
  scene.lights = {EnvmapLight{{1, 1, 1}, sky([](int, int) { return 0.5f; }), ""}};
  EXPECT_NEAR(mean(render(scene, {}).image) / even, 1, 5e-3);
}

TEST(Environment, WithASmallSunIsADirectionalLight) {
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

TEST(Checker, HasSquaresOfItsSizeAroundItsPoint) {
  Scene scene = one_plane(matt(0));
  scene.camera.origin = {0, 10, 1e-3};
  scene.camera.fov_degrees = 2 * std::atan(0.4) * 180 / kPi;  // 8 units across
  scene.film = {64, 64};
  scene.materials = {matt(0.2), matt(0.8)};
  scene.planes[0] = {{0, 0, 0}, {0, 1, 0}, 0, 1, 2};
  scene.lights = {DirectionalLight{{0, -1, 0}, {kPi, kPi, kPi}}};
  const Image image = render(scene, {}).image;
  for (int y = 4; y < 64; y += 8)
    for (int x = 4; x < 64; x += 8) {
      // The square between the plane's first and second axes, +x and -z, has the first material.
      const bool other = (x / 16 + y / 16) % 2 == 0;
      EXPECT_NEAR(image.pixel(x, y)[0], other ? 0.8 : 0.2, 1e-6) << x << ' ' << y;
    }
}

TEST(Mirror, APlaneShowsTheSceneThatIsReflectedInIt) {
  // What the camera sees in the floor is what it would see of a scene upside down below it.
  Scene scene = on_the_ground();
  scene.planes[0] = {{0, 0, 0}, {0, 1, 0}, 1, 1, 1};
  scene.materials[1] = matt(0);
  scene.materials[1].mirror_reflectance = {1, 1, 1};
  scene.camera = {{0, 2, 6}, {0, -1, 0}, {0, 1, 0}, 30};
  scene.depth.mirror = 1;
  const Image mirrored = render(scene, {}).image;
  Scene reflected = scene;
  reflected.planes.clear();
  for (Sphere& s : reflected.spheres) s.center.y *= -1;
  auto& light = std::get<DirectionalLight>(reflected.lights[0]);
  light.direction.y *= -1;
  const Image direct = render(reflected, {}).image;
  int seen = 0;
  for (std::size_t i = 0; i < direct.values().size(); ++i) {
    if (direct.values()[i] == 0) continue;
    // Spheres above the floor are in front of it; compare where the picture shows only the mirror.
    const std::size_t pixel = i / 3;
    if (int(pixel) / 48 < 20) continue;
    if (std::abs(mirrored.values()[i] - direct.values()[i]) < 1e-5f) ++seen;
  }
  EXPECT_GT(seen, 300);
}

TEST(Mirror, OfSeveralReflectionsFallsAsAPowerOfTheReflectance) {
  // Between two parallel mirrors a ray that goes straight at one meets a lamp after n reflections.
  Scene scene;
  scene.camera = {{0, 0, 0}, {0, 0.05, -1}, {0, 1, 0}, 0.01};
  scene.film = {1, 1};
  Material mirror = matt(0);
  mirror.mirror_reflectance = {0.9, 0.9, 0.9};
  scene.materials = {mirror};
  scene.planes = {{{0, 0, -1}, {0, 0, 1}}, {{0, 0, 1}, {0, 0, 1}}};
  // Above all: the ray climbs 0.05 a unit of length.
  scene.lights = {RectangleLight{{0, 1, 0}, {5, 0, 0}, {0, 0, 0.99}, {1, 1, 1}}};
  for (auto& l : scene.lights) {
    auto& r = std::get<RectangleLight>(l);
    std::swap(r.half_u, r.half_v);  // shines down
    if (cross(r.half_u, r.half_v).y > 0) std::swap(r.half_u, r.half_v);
  }
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
  scene.camera.focus_distance = 3;
  scene.sampler.sample_count = 64;
  // Out of focus by much more than a square: nearly even.
  const Image blurred = render(scene, {}).image;
  for (const float v : blurred.values()) EXPECT_NEAR(v, 0.5, 0.25);
  EXPECT_NEAR(mean(blurred), 0.5, 0.02);
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

TEST(Antialiasing, SpendsItsSamplesOnEdgesAndKeepsThePicture) {
  Scene scene = canonical_scene("two_spheres");
  scene.sampler.sample_count = 128;
  const RenderResult planned = render(scene, {}), all = with_all(scene);
  EXPECT_LT(planned.work.camera_rays, all.work.camera_rays / 2);
  const float peak = *std::max_element(all.image.values().begin(), all.image.values().end());
  for (std::size_t i = 0; i < all.image.values().size(); ++i)
    EXPECT_NEAR(planned.image.values()[i], all.image.values()[i],
                3e-3 * std::max(all.image.values()[i], 0.01f * peak));
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

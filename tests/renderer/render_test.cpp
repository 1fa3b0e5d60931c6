#include "renderer/render.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "core/threads.hpp"
#include "renderer/kernels/kernels.hpp"
#include "renderer/pixel_ray.hpp"
#include "renderer/scene/scene_io.hpp"
#include "tests/canonical_scene.hpp"
#include "tests/renderer/simple_scenes.hpp"

namespace lobelia {
namespace {

constexpr const char* kCanonical[] = {"head_on",     "oblique_45", "grazing_80",
                                      "point_light", "two_lights", "two_spheres"};

Scene canonical(const std::string& name, int width = 96, int height = 96) {
  Scene scene = canonical_scene(name);
  scene.film = {width, height};
  return scene;
}

float brightest(const Image& image) {
  return *std::max_element(image.values().begin(), image.values().end());
}

/// Radiance of the highlight at the centre of every pixel, from the formula, one pixel at a time and
/// without the kernels.
std::vector<Rgb> formula(const Scene& scene) {
  std::vector<Rgb> sum(std::size_t(scene.film.width) * scene.film.height);
  for (int s = 0; s < int(scene.spheres.size()); ++s)
    for (int l = 0; l < int(scene.lights.size()); ++l) {
      const Material& material = scene.materials[scene.spheres[s].material];
      const HighlightMap map = highlight_map(scene, l, s);
      const Highlight& h = material.highlight;
      const double coefficient = radiance_coefficient(h);
      for (std::size_t i = 0; i < sum.size(); ++i) {
        if (std::isnan(map.angle[i])) continue;
        const double half_sine = std::sin(map.angle[i] / 2);
        const double value = coefficient *
                             lobe_value(h.lobe, 2 * half_sine * half_sine, h.exponent) *
                             geometry_factor(h.model, h.exponent, map.n_dot_l[i], map.n_dot_v[i]);
        const auto& light = std::get<DirectionalLight>(scene.lights[l]);
        sum[i] = sum[i] + light.irradiance *
                              (value * material.specular_reflectance +
                               map.n_dot_l[i] / std::numbers::pi * material.diffuse_reflectance);
      }
    }
  return sum;
}

TEST(Render, EveryModelAndLobeIsTheFormulaInEveryPixel) {
  for (const char* name : {"head_on", "oblique_45", "grazing_80"})
    for (const ModelId model : all_models())
      for (const LobeId& lobe : all_lobes())
        for (const double n : {1.0, 16.0, 128.0, 1024.0, 1e5}) {
          Scene scene = canonical(name, 64, 48);
          scene.materials[0].highlight = {model, lobe, Normalisation::kExact, n};
          scene.materials[0].specular_reflectance = {1, 0.5, 0.25};
          scene.materials[0].diffuse_reflectance = {0.1, 0.2, 0.3};
          const auto truth = formula(scene);
          for (const auto precision :
               {std::optional<Precision>(), std::optional(Precision::kFloat64)}) {
            RenderOptions options;
            options.precision = precision;
            const Image image = render(scene, options).image;
            const double peak = brightest(image);
            ASSERT_GT(peak, 0);
            double worst = 0;
            for (std::size_t i = 0; i < truth.size(); ++i) {
              const float* p = image.values().data() + 3 * i;
              worst = std::max({worst, std::abs(p[0] - truth[i].r), std::abs(p[1] - truth[i].g),
                                std::abs(p[2] - truth[i].b)});
            }
            // Half a unit of float32 at the peak, and a little for the two ways of finding the angle;
            // or what the plan may add where it chooses the precision.
            EXPECT_LE(worst, (precision ? 1e-7 : kAllowedShadingError) * peak)
                << name << " " << info(model).name << " " << info(lobe).name << " n = " << n;
          }
        }
}

TEST(Render, TheHighlightPeaksWhereTheHalfVectorIsTheNormal) {
  // Light at 45 degrees: the normal there is the unit vector between light and eye. Its image is
  // found through the camera by hand.
  Scene scene = canonical("oblique_45", 512, 512);
  scene.materials[0].highlight.exponent = 256;
  const Image image = render(scene, {}).image;
  const Vec3 to_light{0.5, 0.5, std::numbers::sqrt2 / 2};
  Vec3 normal = normalize(to_light + Vec3{0, 0, 1});
  for (int i = 0; i < 50; ++i)  // the eye is near, so its direction depends on the point
    normal = normalize(to_light + normalize(Vec3{0, 0, 5} - normal));
  const double half = std::tan(14 * std::numbers::pi / 180), depth = 5 - normal.z;
  const double x = (normal.x / depth / half + 1) * 256, y = (1 - normal.y / depth / half) * 256;
  const auto at = std::max_element(image.values().begin(), image.values().end());
  const auto pixel = std::distance(image.values().begin(), at) / 3;
  EXPECT_NEAR(double(pixel % 512) + 0.5, x, 1);
  EXPECT_NEAR(double(pixel / 512) + 0.5, y, 1);
}

TEST(Render, IsTheSameBitForBitWhateverTheNumberOfThreads) {
  for (const char* name : kCanonical) {
    Scene scene = canonical(name, 130, 70);
    scene.sampler = {3, 7};
    RenderOptions one, many;
    one.threads = 1;
    many.threads = 5;
    EXPECT_TRUE(same(render(scene, one).image, render(scene, many).image)) << name;
  }
}

TEST(Render, OfOneSampleIsTheSameBitForBitWhateverTheNumberOfThreads) {
  for (const char* name : kCanonical) {
    const Scene scene = canonical(name, 301, 230);
    ASSERT_GT(std::size_t(scene.film.width * scene.film.height), kPixelsOfOneThread)
        << "or one thread renders all";
    RenderOptions one, many;
    one.threads = 1;
    many.threads = 5;
    EXPECT_TRUE(same(render(scene, one).image, render(scene, many).image)) << name;
  }
}

TEST(Render, WithEveryEffectForcedIsTheSameBitForBit) {
  for (const char* name : kCanonical) {
    const Scene scene = canonical(name);
    RenderOptions all;
    all.effects = EffectPolicy::kAll;
    EXPECT_TRUE(same(render(scene, {}).image, render(scene, all).image)) << name;
  }
}

TEST(Render, TracesNoShadowRayWhereThePlanHasShadowsOff) {
  for (const char* name : kCanonical) {
    const RenderResult result = render(canonical(name), {});
    EXPECT_LE(result.work.camera_rays, result.plan.camera_rays);
    EXPECT_GT(result.work.camera_rays, 0u);
    EXPECT_LE(result.work.shadow_rays, result.plan.max_shadow_rays);
    EXPECT_EQ(result.work.shadow_rays > 0, std::string(name) == "two_spheres") << name;
  }
}

TEST(Render, TheShadowOfTheSmallSphereCutsTheHighlight) {
  Scene scene = canonical("two_spheres", 128, 128);
  const Image with = render(scene, {}).image;
  scene.spheres.pop_back();
  const Image without = render(scene, {}).image;
  int darker = 0;
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x)
      if (without.pixel(x, y)[0] > 0.5f && with.pixel(x, y)[0] == 0) ++darker;
  EXPECT_GT(darker, 20);
}

TEST(Render, LightsAdd) {
  Scene both = canonical("two_lights");
  const Image sum = render(both, {}).image;
  Scene first = both, second = both;
  first.lights = {both.lights[0]};
  second.lights = {both.lights[1]};
  const Image a = render(first, {}).image, b = render(second, {}).image;
  for (std::size_t i = 0; i < sum.values().size(); ++i)
    EXPECT_NEAR(sum.values()[i], a.values()[i] + b.values()[i], 1e-6 * brightest(sum));
}

TEST(Render, APointLightFallsWithTheSquareOfItsDistance) {
  Scene scene = canonical("head_on", 65, 65);
  scene.lights = {PointLight{{0, 0, 1e4}, {1e8, 1e8, 1e8}}};
  const float far = brightest(render(scene, {}).image);
  scene.lights = {PointLight{{0, 0, 2e4}, {1e8, 1e8, 1e8}}};
  EXPECT_NEAR(far / brightest(render(scene, {}).image), 4, 1e-3);
}

TEST(Render, ManySamplesApproachTheAreaOfTheSphereInThePicture) {
  Scene scene = canonical("head_on", 32, 32);
  scene.materials[0].specular_reflectance = {};
  scene.materials[0].diffuse_reflectance = {1, 1, 1};
  scene.lights = {PointLight{{0, 0, 5}, {1, 1, 1}}};
  // With the light in the eye every visible point is lit; the limb darkens, so compare with a finer
  // picture, not with the disc.
  scene.sampler.sample_count = 64;
  const Image coarse = render(scene, {}).image;
  scene.film = {512, 512};
  scene.sampler.sample_count = 1;
  const Image fine = render(scene, {}).image;
  const auto mean = [](const Image& image) {
    double sum = 0;
    for (const float v : image.values()) sum += v;
    return sum / double(image.values().size());
  };
  EXPECT_NEAR(mean(coarse) / mean(fine), 1, 2e-3);
}

TEST(Render, TheSeedMovesTheSamplesAndNothingElse) {
  Scene scene = canonical("oblique_45");
  scene.sampler = {4, 1};
  const Image a = render(scene, {}).image;
  EXPECT_TRUE(same(a, render(scene, {}).image));
  scene.sampler.seed = 2;
  EXPECT_FALSE(same(a, render(scene, {}).image));
  scene.sampler.sample_count = 1;
  const Image centre = render(scene, {}).image;
  scene.sampler.seed = 3;
  EXPECT_TRUE(same(centre, render(scene, {}).image));
}

TEST(Kernels, DarkenALightAtTheHorizonInEveryPrecisionAtTheSameCosine) {
  // An RDF has no cosine to fade with: its highlight stands up to the horizon itself.
  Vec3Chunk normal{}, to_eye{}, to_light{};
  alignas(64) double value[kChunk]{};
  const double cosines[] = {0, 0x1p-1074, 1e-310, 1e-40, 0x1p-127, 1e-20, -0x1p-1074, -1e-20};
  for (std::size_t i = 0; i < std::size(cosines); ++i) {
    normal.z[i] = 1;
    to_eye.x[i] = -1, to_eye.z[i] = cosines[i];
    to_light.x[i] = 1, to_light.z[i] = cosines[i];
  }
  for (const Precision precision :
       {Precision::kFloat32, Precision::kMixed, Precision::kFloat64, Precision::kFloat16}) {
    const Highlight highlight{*find_model("phong_rdf"), {}, Normalisation::kExact, 16};
    kernels().shade(highlight, precision)(highlight, std::size(cosines), normal, to_eye, to_light,
                                          value);
    for (std::size_t i = 0; i < std::size(cosines); ++i)
      EXPECT_EQ(value[i], cosines[i] > 0 ? 1 : 0) << name(precision) << " " << cosines[i];
  }
}

TEST(Render, APictureInHalfFloatsIsOffByNoMoreThanItsBoundAndByMoreThanAnyOther) {
  for (const ModelId model : all_models())
    for (const char* lobe : {"cosine", "cs16", "gauss", "schlick"})
      for (const double n : {8.0, 128.0, 1024.0}) {
        Scene scene = canonical("oblique_45", 64, 64);
        Highlight& highlight = scene.materials[0].highlight;
        highlight = {model, *find_lobe(lobe), Normalisation::kExact, n};
        const auto by = [&](Precision precision) {
          RenderOptions options;
          options.precision = precision;
          return render(scene, options).image;
        };
        const Image half = by(Precision::kFloat16), wide = by(Precision::kFloat64);
        double most = 0;
        for (std::size_t i = 0; i < half.values().size(); ++i)
          most = std::max(most, std::abs(double(half.values()[i]) - double(wide.values()[i])));
        most /= radiance_coefficient(highlight);
        // Measured from 6e-4 to 0.03; the light's irradiance is 1.
        EXPECT_GT(most, 1e-4) << info(model).name << " " << lobe << " " << n;
        EXPECT_LE(most, shading_error_bound(Precision::kFloat16, highlight,
                                            min_half_lengths(scene).at(0)))
            << info(model).name << " " << lobe << " " << n;
      }
}

TEST(Render, OddSizesHaveNoGapsAndNoSeams) {
  // Widths about the size of a chunk and of a register, against the same picture in one pixel steps.
  for (const int width : {1, 3, 7, 511, 512, 513, 1031}) {
    Scene scene = canonical("head_on", width, 9);
    const Image image = render(scene, {}).image;
    for (int x = 0; x < width; ++x)
      for (int y = 0; y < 9; ++y)  // head-on: the same from left and right
        ASSERT_NEAR(image.pixel(x, y)[0], image.pixel(width - 1 - x, y)[0], 2e-6 * brightest(image))
            << width;
  }
}

struct HardCase {
  const char* name;
  std::function<void(Scene&)> make;
  bool dark;  ///< nothing at all can be lit
};

TEST(Render, HardCasesHaveNoNanAndNoInfinity) {
  const HardCase cases[] = {
      {"light behind the sphere",
       [](Scene& s) {
         s.lights = {DirectionalLight{{0, 0, 1}, {1, 1, 1}}};
       },
       true},
      {"light at a right angle",
       [](Scene& s) {
         s.lights = {DirectionalLight{{1, 0, 0}, {1, 1, 1}}};
       },
       false},
      {"light inside the sphere",
       [](Scene& s) {
         s.lights = {PointLight{{0.1, 0, 0}, {1, 1, 1}}};
       },
       true},
      {"light on the surface",
       [](Scene& s) {
         s.lights = {PointLight{{0, 0, 1}, {1, 1, 1}}};
       },
       true},
      {"no light", [](Scene& s) { s.lights.clear(); }, true},
      {"no sphere", [](Scene& s) { s.spheres.clear(); }, true},
      {"camera inside", [](Scene& s) { s.spheres[0].radius = 10; }, true},
      {"camera looks away",
       [](Scene& s) {
         s.camera.target = {0, 0, 10};
       },
       true},
      {"exponent 1e8", [](Scene& s) { s.materials[0].highlight.exponent = 1e8; }, false},
      {"exponent 1e-3", [](Scene& s) { s.materials[0].highlight.exponent = 1e-3; }, false},
      {"tiny sphere, near",
       [](Scene& s) {
         s.spheres[0].radius = 1e-6;
         s.camera.origin = {0, 0, 5e-6};
       },
       false},
      {"huge and distant",
       [](Scene& s) {
         s.spheres[0].radius = 1e6;
         s.camera.origin = {0, 0, 5e6};
       },
       false},
      {"1e7 radii away, through a telescope",
       [](Scene& s) {
         s.camera.origin = {0, 0, 1e7};
         s.camera.fov_degrees = 2e-5;
       },
       false},
      {"two concentric spheres",
       [](Scene& s) {
         s.spheres.push_back({{0, 0, 0}, 0.5, 0});
       },
       false},
      {"the same sphere twice", [](Scene& s) { s.spheres.push_back(s.spheres[0]); }, false},
  };
  for (const auto& hard : cases)
    for (std::size_t m = 0; m < models().size(); ++m) {
      Scene scene = canonical("head_on", 33, 33);
      scene.materials[0].highlight.model = {std::uint8_t(m)};
      hard.make(scene);
      const Image image = render(scene, {}).image;
      for (const float v : image.values())
        ASSERT_TRUE(std::isfinite(v) && v >= 0) << hard.name << " " << models()[m].name;
      EXPECT_EQ(brightest(image) == 0, hard.dark) << hard.name << " " << models()[m].name;
    }
}

TEST(Render, SpheresInOnePlaceDoNotShadeEachOther) {
  // By exact arithmetic an inner sphere shades nothing of an outer one; by rounding it may seem to.
  for (const double inner : {1.0, std::nextafter(1.0, 0.0), 1 - 1e-14, 1 - 1e-12, 1 - 1e-6, 0.5})
    for (const char* name : {"head_on", "oblique_45", "grazing_80"})
      for (const double size : {1e-6, 1.0, 1e6}) {
        Scene scene = canonical(name);
        scene.materials[0].highlight.exponent = 1;
        scene.camera.origin = size * scene.camera.origin;
        scene.spheres[0].radius = size;
        const Image alone = render(scene, {}).image;
        scene.spheres.push_back({scene.spheres[0].center, inner * size, 0});
        RenderOptions all;
        all.effects = EffectPolicy::kAll;
        EXPECT_TRUE(same(alone, render(scene, all).image)) << name << " " << inner << " " << size;
      }
}

TEST(Render, ADistantSphereIsAsRoundAndBrightAsANearOne) {
  // The same picture of a sphere a million times as far and as large.
  Scene near = canonical("head_on", 65, 65), far = near;
  far.camera.origin = {0, 0, 5e6};
  far.spheres[0].radius = 1e6;
  const Image a = render(near, {}).image, b = render(far, {}).image;
  for (std::size_t i = 0; i < a.values().size(); ++i)
    EXPECT_NEAR(a.values()[i], b.values()[i], 1e-6 * brightest(a));
}

TEST(Render, ReportsProgressUpToTheEnd) {
  std::atomic<double> largest{0};
  RenderOptions options;
  options.on_progress = [&](double fraction) {
    for (double seen = largest;
         fraction > seen && !largest.compare_exchange_weak(seen, fraction);) {
    }
  };
  render(canonical("head_on"), options);
  EXPECT_EQ(largest, 1);
}

}  // namespace
}  // namespace lobelia

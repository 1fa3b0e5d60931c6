#include "renderer/render.hpp"

#include <atomic>

#include "base/system/threads.hpp"
#include "renderer/accelerator.hpp"
#include "renderer/chord.hpp"
#include "renderer/kernels/kernels.hpp"
#include "renderer/scene/scene.hpp"
#include "tests/canonical_scene.hpp"
#include "tests/renderer/random_scene.hpp"
#include "tests/renderer/simple_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

Scene canonical(const std::string& name, int width = 96, int height = 96) {
  Scene scene = canonical_scene(name);
  scene.film = {width, height};
  return scene;
}

TEST(Render, IsTheSameBitForBitInAnyNumberOfThreads) {
  for (const char* name : {"oblique_45", "point_light", "two_spheres"}) {
    const Scene scene = canonical(name, 301, 230);
    ASSERT_GT(std::size_t(scene.film.width * scene.film.height), kPixelsOfOneThread)
        << "or one thread renders all";
    RenderOptions one, many;
    one.threads = 1;
    many.threads = 5;
    EXPECT_TRUE(same(render(scene, one).image, render(scene, many).image)) << name;
  }
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

TEST(Render, KeepsTheErrorBoundOfHalfFloats) {
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
        EXPECT_TRUE(same(alone, with_all(scene).image)) << name << " " << inner << " " << size;
      }
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

// Renders that stop: at an error, at a time, at a number of samples.

Scene noisy() {
  Scene scene;
  scene.camera = {{0, 2, 6}, {0, 0.8, 0}, {0, 1, 0}, 40};
  scene.film = {64, 48};
  scene.sampler.sample_count = 16;
  scene.lights = {SphereLight{{2, 4, 2}, 0.7, {20, 20, 20}}};
  scene.materials = {matt(0.5)};
  scene.spheres = {{{0, 1, 0}, 1, 0}};
  scene.planes = {{{0, 0, 0}, {0, 1, 0}}};
  return scene;
}

double rms_difference(const Image& a, const Image& b) {
  double difference = 0, value = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    difference += std::pow(double(a.values()[i]) - b.values()[i], 2);
    value += std::pow(double(b.values()[i]), 2);
  }
  return std::sqrt(difference / value);
}

TEST(Rounds, StopAtTheRequestedError) {
  Scene scene = noisy();
  scene.sampler.sample_count = 4096;
  const Image truth = render(scene, {}).image;
  scene.sampler.seed = 5;
  int last = 0;
  for (const double target : {0.1, 0.03, 0.01}) {
    RenderOptions options;
    options.target_error = target;
    const RenderResult result = render(scene, options);
    EXPECT_LE(*result.error, target);
    EXPECT_LE(rms_difference(result.image, truth), 1.1 * target) << target;
    EXPECT_GE(result.samples, last);
    EXPECT_NE(result.stop_reason.find("error"), std::string::npos) << result.stop_reason;
    last = result.samples;
  }
  EXPECT_GT(last, 8);
}

TEST(Rounds, TakeNoMoreSamplesThanAllowed) {
  RenderOptions options;
  options.target_error = 1e-9;
  options.max_samples = 24;
  const RenderResult result = render(noisy(), options);
  EXPECT_EQ(result.samples, 24);
  EXPECT_EQ(result.work.camera_rays, 64u * 48 * 24);
  EXPECT_GT(*result.error, 1e-9);
}

TEST(Rounds, GiveThePictureOfTheSameSamplesTakenAtOnce) {
  Scene scene = noisy();
  RenderOptions options;
  options.target_error = 1e-9;
  options.max_samples = 16;
  const Image rounds = render(scene, options).image, at_once = render(scene, {}).image;
  for (std::size_t i = 0; i < rounds.values().size(); ++i)
    EXPECT_NEAR(rounds.values()[i], at_once.values()[i], 1e-6 * (1 + at_once.values()[i]));
}

TEST(Rounds, StopWhenTheTimeIsUp) {
  Scene scene = noisy();
  scene.sampler.sample_count = 65536;
  RenderOptions options;
  options.time_limit = 0.2;
  const RenderResult result = render(scene, options);
  EXPECT_GE(result.samples, 1);
  EXPECT_LT(result.samples, 65536);
  EXPECT_NE(result.stop_reason.find("time limit"), std::string::npos) << result.stop_reason;
}

TEST(Rounds, AreOneForAPictureWithNothingRandom) {
  Scene scene = noisy();
  scene.sampler.sample_count = 1;
  scene.lights = {DirectionalLight{normalize({-1, -2, -1}), {1, 1, 1}}};
  RenderOptions options;
  options.target_error = 1e-6;
  const RenderResult result = render(scene, options);
  EXPECT_EQ(result.samples, 1);
  EXPECT_FALSE(result.error);
}

Scene plain() {
  Scene scene = one_sphere(shiny(16));
  scene.camera.fov_degrees = 28;
  scene.film = {24, 24};
  scene.lights = {DirectionalLight{{0, 0, -1}, {1, 1, 1}}};
  return scene;
}

float brightest(const Scene& scene) {
  const Image image = render(scene, {}).image;
  return *std::max_element(image.values().begin(), image.values().end());
}

TEST(Remarks, AreNoneForAnOrdinaryScene) {
  Scene scene = plain();
  EXPECT_THAT(remarks(scene), IsEmpty());
  EXPECT_GT(brightest(scene), 1);
  // The camera looks aside, but with the sphere's rim in a corner.
  scene.camera.target = {1.9, 1.9, 0};
  EXPECT_THAT(remarks(scene), IsEmpty());
}

TEST(Remarks, SayWhyAPictureIsBlackAndItIs) {
  constexpr std::pair<void (*)(Scene&), const char*> kCases[] = {
      {[](Scene& s) { s.lights.clear(); }, "no light: the picture is black"},
      {[](Scene& s) {
         s.lights = {PointLight{{0, 0, 3}, {0, 0, 0}}};
       },
       "no light shines"},
      {[](Scene& s) {
         s.lights = {PointLight{{0, 0.2, 0}, {1, 1, 1}}};
       },
       "light 0 is inside sphere 0"},
      {[](Scene& s) { s.spheres.clear(); }, "shows nothing"},
      {[](Scene& s) {
         s.camera.origin = {0, 0, 0.5};
       },
       "inside sphere 0"},
      {[](Scene& s) {
         s.camera.target = {0, 0, 10};
       },
       "looks away"},
  };
  for (const auto& [change, remark] : kCases) {
    Scene scene = plain();
    change(scene);
    EXPECT_THAT(remarks(scene), ElementsAre(HasSubstr(remark)));
    EXPECT_EQ(brightest(scene), 0) << remark;
  }
}

TEST(Remarks, ExplainASceneWithLightsAlone) {
  Scene scene = plain();
  scene.spheres.clear();
  scene.lights = {ConstantLight{{0.5, 0.5, 0.5}}};
  EXPECT_THAT(remarks(scene), ElementsAre(HasSubstr("its lights alone")));
  EXPECT_EQ(brightest(scene), 0.5f);
}

TEST(Remarks, ExplainACameraOnASphere) {
  Scene scene = plain();
  for (int i = 0; i < 200; ++i) {
    const double up = std::sin(0.01 * i), across = std::cos(0.01 * i);
    scene.camera.origin = {across * std::sin(i), up, across * std::cos(i)};
    scene.camera.target = {0.1, -0.2, 0.3};
    EXPECT_THAT(remarks(scene), ElementsAre(HasSubstr("on sphere 0"))) << i;
    EXPECT_EQ(brightest(scene), 0) << i;
  }
}

TEST(Remarks, NameALightThatFacesAwayFromEverything) {
  Random random(64);
  int away = 0;
  for (int k = 0; k < 300; ++k) {
    Scene scene = canonical_scene("two_spheres");
    scene.film.width = scene.film.height = 24;
    const Vec3 place = 5 * random.direction(), towards = random.direction();
    const double cutoff = random.between(1, 90);
    if (k % 2)
      scene.lights = {SpotLight{place, towards, {100, 100, 100}, cutoff, cutoff / 2}};
    else
      scene.lights = {PointLight{place, {100, 100, 100}, towards}};
    for (Material& material : scene.materials) material.diffuse_reflectance = {1, 1, 1};
    const std::vector<std::string> found = remarks(scene);
    if (found.empty()) continue;
    ++away;
    EXPECT_THAT(found, ElementsAre(HasSubstr("light 0 faces away from every shape")));
    EXPECT_EQ(brightest(scene), 0) << k;
  }
  EXPECT_GT(away, 50);
  EXPECT_LT(away, 250);
}

TEST(Remarks, AreFewWhateverTheNumberOfSpheres) {
  Scene scene = plain();
  scene.spheres.resize(100000, scene.spheres[0]);
  scene.camera.origin = {0, 0, 0};
  scene.camera.target = {0, 0, -1};
  EXPECT_LE(remarks(scene).size(), 3u);
}

struct Crowd {
  std::vector<Sphere> spheres;
  std::mt19937_64 random{1};
  double even() { return double(random() >> 11) * 0x1p-52 - 1; }  // in [-1, 1)
  Vec3 vector() { return {even(), even(), even()}; }
};

/// The loop that the accelerator stands for.
Accelerator::Hit nearest(const Crowd& crowd, Vec3 origin, Vec3 direction, int leaves) {
  Accelerator::Hit best{-1, 0};
  for (int k = 0; k < int(crowd.spheres.size()); ++k) {
    const Chord chord = chord_of(crowd.spheres[std::size_t(k)], origin, direction);
    if (k == leaves || !(chord.half_squared > 0 && chord.entry() > 0)) continue;
    if (!is_outside(crowd.spheres[std::size_t(k)], origin)) continue;
    if (best.sphere < 0 || chord.entry() < best.distance) best = {k, chord.entry()};
  }
  return best;
}

bool blocked(const Crowd& crowd, Vec3 point, Vec3 to_light, double distance, int leaves) {
  for (int k = 0; k < int(crowd.spheres.size()); ++k) {
    const Sphere& s = crowd.spheres[std::size_t(k)];
    if (k != leaves && blocks(s, inner_radius(s), point, to_light, distance)) return true;
  }
  return false;
}

TEST(Accelerator, AnswersAsALoopOverAllSpheresBitForBit) {
  int hits = 0, hidden = 0;
  for (const double scale : {1.0, 1e6, 1e-6})
    for (const double away : {0.0, 1e7}) {
      Crowd crowd;
      const Vec3 middle{away * scale, 0, 0};
      for (int i = 0; i < 500; ++i)
        crowd.spheres.push_back({middle + scale * crowd.vector(),
                                 scale * std::pow(10, -2 + std::abs(crowd.even())) * 0.5, 0});
      const Accelerator accelerator(crowd.spheres);
      for (int ray = 0; ray < 4000; ++ray) {
        const bool from_surface = ray % 2;
        const int leaves = from_surface ? int(crowd.random() % crowd.spheres.size()) : -1;
        Vec3 origin = middle + scale * Vec3{5 * crowd.even(), 5 * crowd.even(), 1e3 * crowd.even()};
        Vec3 direction = normalize(middle + scale * crowd.vector() - origin);
        if (from_surface) {
          const Sphere& s = crowd.spheres[std::size_t(leaves)];
          origin = s.center + s.radius * normalize(crowd.vector());
          direction = normalize(crowd.vector());
        }
        const auto expected = nearest(crowd, origin, direction, leaves);
        const auto found = accelerator.nearest(origin, direction, leaves);
        ASSERT_EQ(found.sphere, expected.sphere);
        if (expected.sphere >= 0) {
          ASSERT_EQ(found.distance, expected.distance);
        }
        hits += expected.sphere >= 0;
        const double distance = scale * std::abs(crowd.even());
        const bool in_the_way = blocked(crowd, origin, direction, distance, leaves);
        ASSERT_EQ(accelerator.blocked(origin, direction, distance, leaves), in_the_way);
        hidden += in_the_way;
      }
    }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(hidden, 200);
}

}  // namespace
}  // namespace lobelia

// Formulas per pixel against our renderer, and the engine that they are.
#include "reference_scenes/engines/analytic/analytic.hpp"

#include <fmt/format.h>

#include "base/system/files.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "reference_scenes/replicates.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/scene_io.hpp"
#include "studies/stability/cases.hpp"
#include "tests/more_samples.hpp"
#include "tests/reference_scenes/hall_scene.hpp"
#include "tests/reference_scenes/ourselves.hpp"
#include "tests/reference_scenes/test_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

constexpr HighlightChoice kChoice{"modified_phong", "cs16", "exact", 64};

ReferenceResult evaluated(const Scene& scene, const ReferenceOptions& options = {}) {
  return Session(*make_analytic({}), options).render(scene);
}

/// The largest difference between our picture and that of the formulas. Measured: 2.9e-6 of the peak, at n = 1e6, and no
/// more on an edge.
void expect_agreement(const std::string& name, const Scene& scene) {
  SCOPED_TRACE(name);
  constexpr double kAllowed = 1e-5;
  const ReferenceResult theirs = evaluated(scene);
  ASSERT_EQ(theirs.error, "");
  const Image ours = render(scene, {}).image;
  const double peak = *std::ranges::max_element(theirs.image.values());
  const auto ring = truth::edge_ring(scene);
  int elsewhere = 0, on_edges = 0;
  for (std::size_t i = 0; i < ours.values().size(); ++i) {
    const double apart = std::abs(double(ours.values()[i]) - theirs.image.values()[i]);
    if (!(apart <= kAllowed * peak)) ++(ring[i / 3] != 0 ? on_edges : elsewhere);
  }
  EXPECT_EQ(elsewhere, 0);
  EXPECT_LE(on_edges, 9) << "three pixels";
}

TEST(Analytic, AgreesWithUsCloseToAHighlightThatAMirrorShowsToo) {
  for (const ModelInfo& model : models())
    for (const char* lobe : {"cosine", "cs16", "cs64", "schlick", "gauss", "spherical_gaussian"})
      for (const double n : {16.0, 1024.0, 1e6})
        for (const Scene& close :
             stability::close_to_highlight(hall_scene({model.name, lobe, "exact", n}, 48), n))
          expect_agreement(fmt::format("{} {} {}", model.name, lobe, n), close);
}

/// The hall with its lamps on its floor, on its wall, on a sphere and where the floor and the wall meet, moved
/// along the surface's normal by so many times the closeness of docs/conventions.md.
Scene hall_of_lamps_on_surfaces(double aside, double scale, Vec3 away) {
  Scene scene = hall_scene(kChoice, 48);
  const Vec3 wall = scene.planes[1].normal, on_sphere = normalize({0.5, 0.3, 1});
  const Sphere body = scene.spheres[0];
  const double corner = -4 - (wall.x * -1.5) / wall.z;
  const double close = 1e-12 * (length(away) > 0 ? length(away) : 6);
  scene.lights = {
      PointLight{Vec3{1.5, aside * close, 2}, {6, 9, 12}},
      PointLight{Vec3{0, 0, -4} + Vec3{wall.z, 0, -wall.x} + aside * close * wall, {4, 2, 3}},
      PointLight{body.center + (body.radius + aside * close) * on_sphere, {1, 2, 1}},
      PointLight{{-1.5, 0, corner}, {3, 3, 5}, normalize({0.5, 1, 1})}};
  return moved(scene, scale, away);
}

TEST(Analytic, AgreesWithUsOnLampsOnSurfacesAndAHairBesideThem) {
  for (const double scale : {1e-3, 1.0, 1e4})
    for (const Vec3 away : {Vec3{}, Vec3{1e4, 3e4, -2e4}})
      for (const double aside : {0.0, 0.1, -0.1, 10.0, -10.0})
        expect_agreement(fmt::format("scale {}, {} away, {} aside", scale, away.x, aside),
                         hall_of_lamps_on_surfaces(aside, scale, away));
}

TEST(Analytic, RefusesASceneInWordsAndEvaluatesTheNext) {
  std::vector<Scene> scenes(2, hall_scene(kChoice, 8));
  scenes[0].depth.glossy = 1;
  const auto engine = make_analytic({});
  Session session(*engine, {});
  const ReferenceResult refused = session.render(scenes[0]);
  EXPECT_THAT(refused.error, HasSubstr("a glossy_depth of 0 is comparable"));
  EXPECT_EQ(refused.failure, FailureClass::kRefused);
  EXPECT_EQ(session.render(scenes[1]).error, "");
}

TEST(Analytic, IsStoppedByTheTimeLimit) {
  ReferenceOptions options;
  options.fine = true;
  options.time_limit = std::chrono::duration<double>(1e-6);
  EXPECT_EQ(evaluated(hall_scene(kChoice, 64), options).error,
            "Analytic was stopped after 1e-06 s, the time limit of a picture");
}

TEST(Analytic, KeepsTheSceneAsItsInput) {
  const TemporaryDirectory directory;
  const Scene scene = hall_scene(kChoice, 16);
  keep_analytic_input(scene, {}, directory.path());
  EXPECT_EQ(scene_to_xml(read_scene(directory.path() / "scene.xml")), scene_to_xml(scene));
  EXPECT_TRUE(std::filesystem::exists(directory.path() / "analytic.sh"));
}

// The average of scenes without a lens, lights with a size and several rays a pixel is the scene with them.

/// By our own renderer, from pictures of the kind that engines are asked for.
ReferenceResult average(const Scene& scene, int points) {
  ReferenceOptions options;
  options.points = points;
  OurselvesAsAnEngine ourselves;
  ReferenceResult result = Session(ourselves, options).render(scene);
  EXPECT_EQ(result.error, "");
  return result;
}

/// The same from samples of lights and directions, as a user would have it; so many that their noise counts
/// for nothing.
Image converged(Scene scene) {
  scene.sampler.sample_count = 32768 * more_samples();
  return render(scene, {}).image;
}

TEST(Replicates, AverageToThePictureWithinTheirOwnNoise) {
  for (NamedScene& named : soft_scenes({"modified_phong", "cosine", "exact", 8}, 16)) {
    SCOPED_TRACE(named.name);
    // With one ray a pixel there is no antialiasing to average; ours has it as soon as it samples.
    if (named.scene.sampler.sample_count == 1) named.scene.sampler.sample_count = 4;
    const Image truth = converged(named.scene);
    double before = 1e9;
    for (const int base : {256, 4096}) {
      const int points = base * more_samples();
      const ReferenceResult result = average(named.scene, points);
      const ReplicateStatistics s = replicate_statistics(result, truth, points, 1e-4);
      // Neighbours share their points, so a few may fall out together.
      EXPECT_LE(s.beyond, 3u) << "of " << s.random << " at " << points << " points";
      EXPECT_LT(double(s.of_twenty), 0.25 * double(s.random) + 5) << points << " points";
      // All pixels share their points, so this is a single draw, whose luck is known at these points alone.
      if (more_samples() == 1) {
        EXPECT_LT(s.rms, before / 2.5) << points << " points";
      }
      before = s.rms;
    }
  }
}

TEST(Replicates, AreTheSameForTheSameSeedAndOthersForAnother) {
  const Scene scene = soft_scenes({"phong_rdf", "cosine", "exact", 8}, 8).back().scene;
  const auto first_light = [&](std::uint64_t seed) {
    return std::get<PointLight>(replicates(scene, 2, 3, seed)[1][2].scene.lights[0]).position;
  };
  EXPECT_EQ(first_light(1), first_light(1));
  EXPECT_NE(first_light(1), first_light(2));
}

TEST(Replicates, ShowAllLampsInOnePictureWhereOnlyLightsVary) {
  const auto scenes = soft_scenes({"phong_rdf", "cosine", "exact", 8}, 8);
  const auto lamps = replicates(scenes[1].scene, 2, 5, 0);
  ASSERT_EQ(lamps.size(), 2u);
  ASSERT_EQ(lamps[0].size(), 1u);
  EXPECT_EQ(lamps[0][0].scene.lights.size(), 6u) << "five lamps and the sun";
  EXPECT_EQ(replicates(scenes[5].scene, 2, 5, 0)[0].size(), 5u);
  EXPECT_FALSE(needs_replicates(lamps[0][0].scene));
}

TEST(Replicates, ShowTheLightsThemselvesOnlyWhereNothingIsBefore) {
  Scene scene = sphere_scene({"phong_rdf", "cosine", "exact", 8}, {}, 32);
  scene.lights = {SphereLight{{0, 0, -3}, 2.5, {3, 3, 3}}, ConstantLight{{1, 0, 0}}};
  const Image seen = SizedLights(scene).seen_in(scene);
  EXPECT_EQ(seen.pixel(16, 16)[0], 0) << "the ball";
  EXPECT_EQ(seen.pixel(0, 0)[0], 1) << "the sky alone";
  EXPECT_EQ(seen.pixel(1, 16)[0], 4) << "the lamp, and the sky behind it";
}

TEST(Replicates, IgnoreTheSurfaceUnderALight) {
  Scene scene = sphere_scene({"phong_rdf", "cosine", "exact", 8}, {}, 64);
  const Vec3 normal = normalize({0.3, -0.2, 1}), along = normalize(cross(normal, {1, 2, 3}));
  const Vec3 place{0.3, 0.2, -3};
  scene.lights = {RectangleLight{place, 2.0 * along, 2.0 * cross(normal, along), {3, 3, 3}},
                  SphereLight{{0, 0, 0}, 1, {5, 5, 5}}};
  Scene empty = scene;
  empty.spheres.clear();
  const Image alone = SizedLights(empty).seen_in(empty);
  scene.planes = {{place + 0.7 * along, normal, 0, 0, 1}};
  const Image seen = SizedLights(scene).seen_in(scene);
  int bulb = 0, rectangle = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      // The bulb's sphere hides what is behind it.
      const float value = alone.pixel(x, y)[0], expected = value > 3 ? 5 : value;
      EXPECT_EQ(seen.pixel(x, y)[0], expected) << x << ", " << y;
      (expected == 5 ? bulb : rectangle) += expected > 0;
    }
  EXPECT_GT(bulb, 500);
  EXPECT_GT(rectangle, 200);
}

}  // namespace
}  // namespace lobelia

#include "renderer/plan/plan.hpp"

#include <fmt/format.h>

#include "base/system/error.hpp"
#include "renderer/plan/effects/catalogue.hpp"
#include "tests/canonical_scene.hpp"
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

}  // namespace
}  // namespace lobelia

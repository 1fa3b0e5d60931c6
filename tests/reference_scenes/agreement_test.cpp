// The real POV-Ray and the real Blender against our renderer, pixel by pixel.
#include <fmt/format.h>

#include "reference_scenes/engine.hpp"
#include "renderer/render.hpp"
#include "tests/reference_scenes/ourselves.hpp"
#include "tests/reference_scenes/render_all.hpp"
#include "tests/reference_scenes/require_engine.hpp"
#include "tests/reference_scenes/test_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// The error that the engine's number format and precision leave, and no more.
struct Tolerance {
  double relative, of_peak;
};
Tolerance tolerance_of(std::string_view engine) {
  // Measured over 540 pictures of 256 x 256: every model and normalisation, n = 16, 128, 1024, six
  // lights. POV-Ray writes half floats, which round by up to 2^-11: 4.88e-4 of the value. Cycles
  // computes in float32: 2.0e-5 of the peak (n = 1024, grazing light); by light from behind, 3.4e-5
  // in one pixel.
  return engine == "povray" ? Tolerance{6e-4, 1e-8} : Tolerance{0, 3e-5};
}
/// Pixels whose ray grazes the silhouette or the terminator, where a rounding decides.
constexpr int kAllowedOutliers = 3;
/// Pixels whose ray meets a checker's edge within the rounding of float32, of far squares by the dozen.
constexpr int kCheckerOutliers = 9;

class Agreement : public WithRealEngine {
 protected:
  void expect_agreement(const std::vector<NamedScene>& named, int outliers = kAllowedOutliers) {
    const Tolerance tolerance = tolerance_of(GetParam());
    std::vector<Scene> scenes;
    for (const NamedScene& one : named) scenes.push_back(one.scene);
    std::size_t results = 0;
    render_all(*engine_, scenes, {}, [&](std::size_t index, ReferenceResult result) {
      ++results;
      SCOPED_TRACE(named[index].name);
      ASSERT_EQ(result.error, "");
      const Image ours = render(scenes[index], {}).image;
      ASSERT_GT(*std::ranges::max_element(ours.values()), 0) << "nothing to compare";
      const Difference d = difference(result.image, ours, tolerance.relative, tolerance.of_peak);
      EXPECT_TRUE(d.finite);
      EXPECT_LE(d.outliers, outliers) << "worst is " << d.worst << " of the peak";
      EXPECT_EQ(result.record.engine.version, engine_->status().version);
    });
    EXPECT_EQ(results, scenes.size());
    ASSERT_GT(results, 0u);
  }

  /// The engine's averages and those of our own renderer of the same pictures.
  void expect_averages(
      const std::vector<NamedScene>& named, const ReferenceOptions& options,
      const std::function<void(const ReferenceResult&, const ReferenceResult&)>& check) {
    std::vector<Scene> scenes;
    for (const NamedScene& one : named) scenes.push_back(one.scene);
    std::vector<ReferenceResult> ours(scenes.size());
    OurselvesAsAnEngine ourselves;
    render_all(ourselves, scenes, options,
               [&](std::size_t i, ReferenceResult result) { ours[i] = std::move(result); });
    std::size_t results = 0;
    render_all(*engine_, scenes, options, [&](std::size_t index, ReferenceResult result) {
      ++results;
      SCOPED_TRACE(named[index].name);
      ASSERT_EQ(result.error, "");
      check(result, ours[index]);
    });
    EXPECT_EQ(results, scenes.size());
  }
};

TEST_P(Agreement, HoldsForEveryModelWithEveryLobe) {
  std::vector<LobeId> lobes(all_lobes().begin(), all_lobes().end());
  for (const char* name : {"cs12", "cs1024"}) lobes.push_back(*find_lobe(name));
  std::vector<NamedScene> scenes;
  for (const ModelInfo& model : models())
    for (const LobeId& lobe : lobes) {
      // Which exponent goes with which light does not matter to either; each pair would take long.
      const HighlightChoice sharp{model.name, info(lobe).name, "exact", 1024};
      const HighlightChoice wide{model.name, info(lobe).name, "exact", 3};
      const std::string name = fmt::format("{} {}", model.name, info(lobe).name);
      scenes.push_back({name + " n=1024", sphere_scene(sharp, {directional_at(45)}, 64)});
      scenes.push_back({name + " n=3", sphere_scene(wide, {point_light()}, 64)});
    }
  expect_agreement(scenes);
}

TEST_P(Agreement, HoldsForEveryModelWithALobeByItsFormula) {
  // The last one has every function.
  constexpr const char* kFormulas[] = {
      "max(0, 1 - n*s/6)^6", "1/(1 + n*s/4)^4", "exp(-n*x^2/2)",
      "exp(-n*s/4) * cos(atan(s)) * sqrt(c) * sin(acos(s)) * pow(c, 1.5) / "
      "(1 + log(1 + n*s) + tan(x/3)^2 - min(0, -abs(asin(s))))"};
  std::vector<NamedScene> scenes;
  for (const ModelInfo& model : models())
    for (const char* formula : kFormulas) {
      const HighlightChoice sharp{model.name, "cosine", "exact", 1024};
      const HighlightChoice wide{model.name, "cosine", "exact", 3};
      const std::string name = fmt::format("{} {}", model.name, formula);
      scenes.push_back({name + " n=1024", sphere_scene(sharp, {directional_at(45)}, 64)});
      scenes.push_back({name + " n=3", sphere_scene(wide, {point_light()}, 64)});
      for (auto last = scenes.end() - 2; last != scenes.end(); ++last)
        last->scene.materials[0].highlight.lobe = formula_lobe(formula);
    }
  // Two formulas in one picture.
  Scene both = shadow_scene({"modified_phong", "cosine", "exact", 20}, {directional_at(45)}, 64);
  Material other = both.materials[0];
  both.materials[0].highlight.lobe = formula_lobe(kFormulas[0]);
  other.highlight.lobe = formula_lobe(kFormulas[1]);
  both.spheres.back().material = int(both.materials.size());
  both.materials.push_back(other);
  scenes.push_back({"two formulas", both});
  expect_agreement(scenes);
}

TEST_P(Agreement, HoldsForSchlicksFactorWhereItMattersMost) {
  std::vector<NamedScene> scenes;
  for (const ModelInfo& model : models())
    for (const double degrees : {45.0, 120.0}) {
      Scene scene = shadow_scene({model.name, "cs16", "exact", 12},
                                 {directional_at(degrees), point_light({2, 4, 8})}, 64);
      for (Material& material : scene.materials) material.fresnel = Fresnel::kSchlick;
      scene.materials[0].specular_reflectance = {0.02, 0.5, 0};
      scenes.push_back({fmt::format("{} at {} degrees", model.name, degrees), scene});
    }
  // POV-Ray would shade this by itself, were it not for the factor.
  Scene grey = sphere_scene({"phong_rdf", "cosine", "exact", 20}, {directional_at(100)}, 64);
  grey.materials[0].specular_reflectance = 0.04 * kWhite;
  grey.materials[0].fresnel = Fresnel::kSchlick;
  scenes.push_back({"grey", grey});
  expect_agreement(scenes);
}

TEST_P(Agreement, HoldsForALobeWiderThanAHemisphere) {
  std::vector<NamedScene> scenes;
  for (const ModelInfo& model : models())
    for (const double exponent : {5.0, 0.01})
      scenes.push_back(
          {fmt::format("{} n={}", model.name, exponent),
           sphere_scene({model.name, "cs16", "exact", exponent}, {directional_at(45)}, 64)});
  expect_agreement(scenes);
}

TEST_P(Agreement, HoldsInAllUnitsOfTheScene) {
  std::vector<NamedScene> scenes;
  const Scene scene = shadow_scene({"modified_phong", "cs16", "exact", 50},
                                   {point_light({2, 4, 8}), directional_at(30)}, 96);
  for (const double size : {1e-4, 1e4})
    scenes.push_back({fmt::format("size {}", size), moved(scene, size, {30, -20, 10})});
  expect_agreement(scenes);
}

TEST_P(Agreement, HoldsForPlanesCheckersAndLampsWithACosine) {
  const Light lamp = PointLight{{2.2, 3, 2.4}, {25, 20, 15}, normalize({-1, -1, -1})};
  const Light spot = SpotLight{{2.2, 3, 2.4}, normalize({-2, -3, -2.6}), {50, 40, 30}, 25, 8};
  std::vector<NamedScene> scenes;
  for (const ModelInfo& model : models()) {
    Scene scene = ground_scene({model.name, "cosine", "exact", 30}, {directional_at(50), lamp}, 64);
    scene.planes[1] = {{0, 0, -3}, normalize({0.3, 0.1, -1}), 1, 2, 0.4};
    scene.camera.principal_point_offset_x = 0.05;
    scenes.push_back({std::string(model.name), scene});
  }
  for (const char* model : {"phong_rdf", "modified_blinn_phong"})
    scenes.push_back({fmt::format("{} under a spot", model),
                      ground_scene({model, "cosine", "exact", 30}, {spot}, 64)});
  scenes.push_back({"grey", mirror_scene({"phong_rdf", "cosine", "exact", 30}, {lamp}, 64)});
  scenes.back().scene.depth.mirror = 0;
  expect_agreement(scenes, 3 + kCheckerOutliers);
}

/// A lamp in the floor, one in the wall, one where they meet, and one in an oblique plane behind all.
std::vector<Light> lamps_in_planes(Scene& scene) {
  const Vec3 normal = normalize({-0.3, 0.23, 1.1}), place{1.7, 0.2, -2.3};
  scene.planes.push_back({place + 3.0 * normalize(cross(normal, {1, 2, 3})), normal, 1, 1, 1});
  return {PointLight{{1.4, -1, 0.7}, {6, 5, 4}}, PointLight{{-2, 0.5, -4}, {4, 5, 6}},
          PointLight{{1, -1, -4}, {9, 9, 9}}, PointLight{place, {2, 3, 2}}};
}

TEST_P(Agreement, HoldsForLampsThatLieInPlanes) {
  std::vector<NamedScene> scenes;
  for (const char* model : {"phong_rdf", "modified_phong"})
    for (const Vec3 away : {Vec3{}, Vec3{3e3, -1e3, 2e3}}) {
      Scene scene = ground_scene({model, "cosine", "exact", 20}, {}, 64);
      scene.lights = lamps_in_planes(scene);
      scenes.push_back({fmt::format("{}, {} away", model, away.x), moved(scene, 1, away)});
    }
  expect_agreement(scenes, kCheckerOutliers);
}

TEST_P(Agreement, HoldsForRectanglesInPlanesOnTheSamePoints) {
  Scene scene = ground_scene({"phong_rdf", "cosine", "exact", 20}, {}, 24);
  scene.lights = {RectangleLight{{-1, 0.7, -4}, {0.5, 0, 0}, {0, 0.5, 0}, {9, 6, 3}},
                  RectangleLight{{1.3, -1, 1}, {0, 0, 0.3}, {0.3, 0, 0}, {9, 6, 3}}};
  ReferenceOptions options;
  options.points = kReplicates;
  expect_averages({{"two rectangles", scene}}, options,
                  [&](const ReferenceResult& theirs, const ReferenceResult& ours) {
                    const Tolerance t = tolerance_of(GetParam());
                    const Difference d =
                        difference(theirs.image, ours.image, t.relative, t.of_peak);
                    EXPECT_LE(d.outliers, kCheckerOutliers) << d.worst;
                    EXPECT_GT(ours.image.pixel(8, 1)[0], 8) << "the lamp on the wall is seen";
                  });
}

TEST_P(Agreement, HoldsForMirrors) {
  std::vector<NamedScene> scenes;
  for (const char* model : {"phong_rdf", "blinn_phong_rdf"})
    scenes.push_back({model, mirror_scene({model, "cosine", "exact", 30},
                                          {directional_at(50), point_light()}, 64)});
  if (GetParam() == "blender") {
    for (const char* model : {"modified_phong", "modified_blinn_phong", "blinn_phong_ndf"})
      scenes.push_back(
          {model, mirror_scene({model, "cs16", "exact", 30}, {directional_at(50)}, 64)});
    for (Material& material : scenes.back().scene.materials) material.fresnel = Fresnel::kSchlick;
    // Below 0.02 Schlick's factor does not grow to 1.
    scenes.push_back({"faint", scenes.back().scene});
    for (Material& material : scenes.back().scene.materials)
      material.mirror_reflectance = {0.01, 0.005, 0};
  }
  expect_agreement(scenes, 3 + kCheckerOutliers);
}

TEST_P(Agreement, HoldsForEverySoftEffectOnTheSamePoints) {
  const auto scenes = soft_scenes({"modified_phong", "cosine", "exact", 24}, 24);
  ReferenceOptions options;
  options.points = kReplicates;
  expect_averages(scenes, options, [](const ReferenceResult& theirs, const ReferenceResult& ours) {
    // Edges are on the other side in single pictures of the sixteen.
    const Difference d = difference(theirs.image, ours.image, 6e-4, 2e-4);
    EXPECT_LE(d.outliers, 8) << "worst is " << d.worst << " of the peak";
    EXPECT_LT(d.worst, 0.05);
  });
}

TEST_P(Agreement, HoldsForTheSmallestPictureAndForWideOnes) {
  const HighlightChoice choice{"modified_phong", "cosine", "exact", 8};
  Scene small = sphere_scene(choice, {directional_at(20)}, 4);
  Scene flat = sphere_scene(choice, {directional_at(20)}, 64);
  flat.film = {64, 5};
  Scene wide = sphere_scene(choice, {directional_at(20)}, 64);
  wide.camera.fov_degrees = 150;
  wide.camera.origin = {0, 0, 1.5};
  expect_agreement({{"small", small}, {"flat", flat}, {"wide", wide}});
}

/// Engines count an offset in widths, heights or longer sides, which are the same in a square.
TEST_P(Agreement, HoldsForAFilmAsideInAWideAndInATallPicture) {
  Scene wide = sphere_scene({"modified_phong", "cosine", "exact", 8}, {directional_at(20)}, 48);
  wide.film.height = 16;
  wide.camera.principal_point_offset_x = 0.1;
  wide.camera.principal_point_offset_y = -0.2;
  Scene tall = wide;
  std::swap(tall.film.width, tall.film.height);
  expect_agreement({{"wide", wide}, {"tall", tall}});
}

INSTANTIATE_TEST_SUITE_P(Engines, Agreement, testing::Values("povray", "blender"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace lobelia

#include "renderer/render.hpp"
#include "renderer/scene/scene_io.hpp"
#include "studies/accuracy/accuracy.hpp"
#include "studies/accuracy/lobe_candidates.hpp"
#include "studies/cost/benchmarks.hpp"
#include "studies/cost/convergence.hpp"
#include "studies/cost/scenes.hpp"
#include "tests/canonical_scene.hpp"
#include "tests/test.hpp"

namespace lobelia::cost {
namespace {

const Variant& find(const Table& table, const std::string& name) {
  for (const Variant& variant : table.variants)
    if (variant.name == name) return variant;
  throw std::out_of_range(name);
}

TEST(PictureLevel, ChecksEachLobeInEachPrecision) {
  Options options;
  options.effort = Effort::kQuick;
  options.scenes = {{"head_on", canonical_scene("head_on")}};
  const auto tables = measure_pictures(options);
  ASSERT_EQ(tables.size(), 1u);
  const Table& table = tables[0];
  EXPECT_EQ(table.id, "picture-head_on");
  EXPECT_EQ(table.variants.size(), all_lobes().size() * precision_names().size());
  EXPECT_THAT(table.remarks[0], HasSubstr("formulas"));
  std::set<std::string> names;
  for (const Variant& variant : table.variants) {
    EXPECT_TRUE(names.insert(variant.name).second) << variant.name;
    EXPECT_EQ(variant.errors.size(), table.errors.size());
    ASSERT_TRUE(variant.facts && variant.facts->rays) << variant.name;
    // Half floats have no fused kernel, which traces no ray far from the highlight.
    if (variant.name.ends_with("(emulated)")) {
      EXPECT_EQ(variant.facts->rays->camera, 128 * 128);
    } else {
      EXPECT_LT(variant.facts->rays->camera, 128 * 128 * 0.6);
    }
    EXPECT_GT(variant.facts->rays->camera, 0);
    EXPECT_GT(cost_of(variant).median, 0);
  }
  EXPECT_THAT(table.remarks.back(), HasSubstr("--accuracy goes by"));
  EXPECT_LT(find(table, "cs16, float32").facts.value().predicted_cost,
            find(table, "cosine, float32").facts.value().predicted_cost);
  // cs64 is cos^64; the formulas and our float64 differ by roundings at most.
  for (const char* same : {"cosine, float64", "cs64, float64"}) {
    EXPECT_LE(find(table, same).errors[2].second, 2e-7);
    EXPECT_LE(find(table, same).errors[0].second, 1e-4);
  }
  EXPECT_GT(find(table, "cosine, float32").errors[2].second, 0);
  EXPECT_LE(find(table, "cosine, float32").errors[2].second, kAllowedShadingError);
  double before = 1e9;
  for (const char* lobe : {"cs2", "cs4", "cs8", "cs16", "cs32", "cs64"}) {
    const Variant& variant = find(table, std::string(lobe) + ", float64");
    EXPECT_LT(variant.errors[2].second, before) << lobe;
    before = variant.errors[2].second;
  }
}

TEST(PictureLevel, NamesTheTruthOfARandomPicture) {
  Options options;
  options.effort = Effort::kQuick;
  Scene soft = canonical_scene("effects/area_light");
  soft.sampler.sample_count = 2;
  options.scenes = {{"soft", soft}};
  const Table table = measure_pictures(options).at(0);
  EXPECT_THAT(table.remarks[0], HasSubstr("8 samples a pixel, another seed"));
  EXPECT_THAT(table.remarks[1], HasSubstr("noise of 2 samples"));
  // As noisy whatever the precision, and no variant is the truth itself.
  EXPECT_GT(find(table, "cosine, float64").errors[2].second, 1e-3);
  EXPECT_EQ(setting(find(table, "cosine, float64"), "samples"), 2);
}

TEST(WithLobe, KeepsTheCoefficientOfAMaterialThatHasItAlready) {
  Scene s = canonical_scene("head_on");
  s.materials.push_back(s.materials[0]);
  s.materials[0].highlight.normalisation = s.materials[1].highlight.normalisation =
      Normalisation::kPaper;
  s.materials[1].highlight.lobe = *find_lobe("cs16");
  const Scene changed = accuracy::with_lobe(s, *find_lobe("cs16"));
  EXPECT_EQ(changed.materials[0].highlight.lobe, *find_lobe("cs16"));
  EXPECT_EQ(changed.materials[0].highlight.normalisation, Normalisation::kExact);
  EXPECT_EQ(changed.materials[1].highlight.normalisation, Normalisation::kPaper);
  EXPECT_EQ(accuracy::own_lobe(s), std::nullopt);
  EXPECT_EQ(accuracy::own_lobe(changed), find_lobe("cs16"));
}

TEST(LobeCandidates, HaveTheScenesOwnLobeThoughNoListHasIt) {
  Scene s = canonical_scene("head_on");
  EXPECT_EQ(accuracy::lobe_candidates(s).size(), all_lobes().size());
  s.materials[0].highlight.lobe = *find_lobe("cs10");
  EXPECT_EQ(accuracy::lobe_candidates(s).size(), all_lobes().size() + 1);
}

TEST(PictureTruth, IsTheSceneAsItStandsCoefficientIncluded) {
  Scene s = canonical_scene("head_on");
  s.film.width = s.film.height = 32;
  s.materials[0].highlight.exponent = 20;
  s.materials[0].highlight.lobe = *find_lobe("cs16");
  s.materials[0].highlight.normalisation = Normalisation::kPaper;
  const Image ours = render(s, {}).image;
  EXPECT_LE(accuracy::measure_at_peak("max_rel_peak", ours, accuracy::picture_truth(s, 1).image),
            1e-5);
  EXPECT_EQ(accuracy::rms_of_peak(ours, ours), 0);
  const double rms = accuracy::rms_of_peak(Image(32, 32), ours);
  EXPECT_GT(rms, 0);
  EXPECT_LT(rms, 1);
}

TEST(PictureTruth, IsDrawnFromAnotherSeedWhereTheSceneIsNoisy) {
  Scene s = below_sky(16);
  s.sampler.sample_count = 64;
  const accuracy::PictureTruth truth = accuracy::picture_truth(s, 64);
  EXPECT_THAT(truth.how, HasSubstr("another seed"));
  const Image ours = render(s, {}).image;
  // The same random numbers would leave the rounding of float32.
  EXPECT_GT(accuracy::rms_of_peak(ours, truth.image), 1e-4);
  EXPECT_LT(accuracy::rms_of_peak(ours, truth.image), 0.1);
}

// Light transport: how its error falls with samples, and what fits to that.

using ::testing::Contains;
using Directions = Experiment::Directions;

/// Without Blender, which is asked for in tests with the label engines.
Options quick() {
  Options options;
  options.effort = Effort::kQuick;
  options.programs = {{"blender", "/nowhere/blender"}};
  return options;
}

class Transport : public testing::Test {
 protected:
  static void SetUpTestSuite() { tables_ = new std::vector<Table>(measure_transport(quick())); }
  static void TearDownTestSuite() { delete tables_; }
  static inline std::vector<Table>* tables_ = nullptr;
};

TEST_F(Transport, HasATableForEachKindOfScene) {
  std::vector<std::string> ids;
  for (const Table& table : *tables_) ids.push_back(table.id);
  EXPECT_EQ(ids, (std::vector<std::string>{"transport-rectangle_light", "transport-environment",
                                           "transport-inter_reflection"}));
}

TEST_F(Transport, ErrorsOfImportanceSamplingFallWithSamplesAndAreLessThanOfEvenOnes) {
  for (const Table& table : *tables_) {
    SCOPED_TRACE(table.id);
    std::map<std::string, double> errors;
    for (const Variant& variant : table.variants) {
      ASSERT_TRUE(variant.error_spreads) << variant.name;
      EXPECT_EQ(variant.error_spreads->size(), 1u);
      errors[variant.name] = variant.errors[0].second;
    }
    EXPECT_EQ(table.variants.size(), 9u) << "three variants to draw directions";
    EXPECT_GT(errors.at("ours, 1"), 1.5 * errors.at("ours, 4"));
    EXPECT_GT(errors.at("ours, 4"), 1.5 * errors.at("ours, 16"));
    EXPECT_LT(errors.at("ours, 16"), errors.at("ours, evenly, 16"));
    for (const char* remark :
         {"without Cycles: ", "ours: the error falls as the samples to the power -",
          "an error of 1e-02 takes"})
      EXPECT_THAT(table.remarks, Contains(HasSubstr(remark)));
  }
}

Material material(double exponent, Rgb specular, Rgb diffuse) {
  Material m;
  m.highlight.exponent = exponent;
  m.specular_reflectance = specular;
  m.diffuse_reflectance = diffuse;
  return m;
}

/// Every effect of the catalogue is on: three spheres, a mirror among them, on a checker below a rectangle light and
/// a sky, seen through a lens.
Scene everything() {
  Scene scene;
  scene.camera = {{0, 1.6, 5.2}, {0, -0.3, 0}, {0, 1, 0}, 36};
  scene.camera.aperture_radius = 0.08;
  scene.camera.focus_distance = 5;
  scene.film = {16, 16};
  scene.depth = {3, 2};
  scene.lights = {RectangleLight{{1, 3.2, 1.4}, {0.9, 0, 0}, {0, 0, 0.5}, {5, 5, 5}},
                  ConstantLight{{0.12, 0.15, 0.2}}};
  scene.materials = {material(96, {0.04, 0.04, 0.04}, {0.6, 0.15, 0.1}),
                     material(256, {0.2, 0.2, 0.2}, {}),
                     material(48, {0.5, 0.4, 0.2}, {0.1, 0.08, 0.04}),
                     material(1, {}, {0.7, 0.68, 0.64}), material(1, {}, {0.12, 0.12, 0.14})};
  scene.materials[0].fresnel = Fresnel::kSchlick;
  scene.materials[1].mirror_reflectance = {0.8, 0.8, 0.8};
  scene.spheres = {
      {{-1.1, -0.3, 0.4}, 0.7, 0}, {{0.5, -0.2, -0.6}, 0.8, 1}, {{0.9, -0.6, 1}, 0.4, 2}};
  scene.planes = {{{0, -1, 0}, {0, 1, 0}, 3, 4, 0.75}};
  return scene;
}

/// Means of a picture by other ways to draw directions; `relative`: of the planned ones.
void expect_the_same_light(const Scene& scene, Directions directions, int samples,
                           double relative) {
  RenderOptions how;
  how.experiment.directions = directions;
  const double planned = mean(render_timed(scene, 64, 1).result.image);
  EXPECT_NEAR(mean(render_timed(scene, samples, 2, how).result.image) / planned, 1, relative);
}

TEST(Directions, BringTheSameLightHoweverTheyAreDrawn) {
  const Scene scene = everything();
  for (const Directions directions : {Directions::kLight, Directions::kSurface, Directions::kEven})
    expect_the_same_light(scene, directions, 4096, 0.01);
  expect_the_same_light(with_inter_reflection(below_rectangle(16)), Directions::kEven, 4096, 0.02);
}

TEST(Directions, CastOnlyRaysOfTheirOwnKind) {
  RenderOptions how;
  how.experiment.directions = Directions::kSurface;
  const Work surface = render_timed(below_rectangle(16), 4, 1, how).result.work;
  EXPECT_EQ(surface.shadow_rays, 0u);
  EXPECT_GT(surface.scattered_rays, 0u);
  how.experiment.directions = Directions::kLight;
  const Work light = render_timed(below_sky(16), 4, 1, how).result.work;
  EXPECT_GT(light.shadow_rays, 0u);
  EXPECT_EQ(light.scattered_rays, 0u);
}

std::vector<double> powers(const std::vector<double>& x, double factor, double exponent) {
  std::vector<double> y;
  for (const double v : x) y.push_back(factor * std::pow(v, exponent));
  return y;
}

TEST(SlopeFit, HasTheTextbooksStandardErrorOfThreePoints) {
  // y = x but for the middle, which is e^0.3 too high: residuals -0.1, 0.2, -0.1 around the line; 1 left.
  const Slope slope =
      fit_slope({std::exp(-1), 1, std::exp(1)}, {std::exp(-1), std::exp(0.3), std::exp(1)});
  EXPECT_NEAR(slope.value, 1, 1e-12);
  EXPECT_NEAR(slope.standard_error, std::sqrt(0.06 / 1 / 2), 1e-12);
}

TEST(SlopeFit, HasNoErrorFromTwoPoints) {
  EXPECT_TRUE(std::isnan(fit_slope({1}, {1}).value));
  EXPECT_NEAR(fit_slope({1, 4}, {1, 0.5}).value, -0.5, 1e-12);
  EXPECT_TRUE(std::isnan(fit_slope({1, 4}, {1, 0.5}).standard_error));
}

TEST(TimeToError, IsInterpolatedOnThePowerLawBetweenTwoPoints) {
  const std::vector<double> seconds{1, 4, 16};
  const auto errors = powers(seconds, 0.2, -0.5);
  const TimeTo time = time_to(seconds, seconds, errors, 0.2 / std::sqrt(8));
  EXPECT_NEAR(time.seconds, 8, 1e-12);
  EXPECT_EQ(time.reach, TimeTo::Reach::kWithin);
}

TEST(TimeToError, ExtrapolatesBeyondTheLastPoint) {
  const std::vector<double> samples{1, 4, 16, 64},
      seconds{5.1, 5.4, 6.6, 11.4};  // 5 and 0.1 for each
  auto errors = powers(samples, 0.2, -0.5);
  errors[0] = 9;  // before the last three: it has no say
  const TimeTo time = time_to(samples, seconds, errors, 0.2 / 100);
  EXPECT_NEAR(time.seconds, 5 + 0.1 * 1e4, 1e-6);
  EXPECT_EQ(time.reach, TimeTo::Reach::kBeyond);
  EXPECT_TRUE(std::isinf(time_to({1, 2}, {1, 2}, {1, 1}, 0.5).seconds))
      << "the error does not fall";
  EXPECT_TRUE(std::isinf(time_to({1, 4}, {2, 2}, {1, 0.5}, 0.1).seconds)) << "no time to be seen";
}

TEST(TimeToError, IsThatOfTheFirstPointWhereItIsGoodEnough) {
  const TimeTo time = time_to({1, 4}, {3, 4}, {0.1, 0.05}, 0.2);
  EXPECT_EQ(time.seconds, 3);
  EXPECT_EQ(time.reach, TimeTo::Reach::kAtOnce);
}

}  // namespace
}  // namespace lobelia::cost

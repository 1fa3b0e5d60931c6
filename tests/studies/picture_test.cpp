#include "renderer/render.hpp"
#include "renderer/scene/scene_io.hpp"
#include "studies/accuracy/accuracy.hpp"
#include "studies/accuracy/lobe_candidates.hpp"
#include "studies/cost/benchmarks.hpp"
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
    EXPECT_GT(variant.seconds.median, 0);
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

}  // namespace
}  // namespace lobelia::cost

#include "studies/accuracy/accuracy.hpp"

#include "base/pictures/image_values.hpp"
#include "renderer/scene/scene_io.hpp"
#include "studies/accuracy/lobe_candidates.hpp"
#include "tests/canonical_scene.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia::accuracy {
namespace {

constexpr const char* kScenes[] = {"grazing_80",  "head_on",    "oblique_45",
                                   "point_light", "two_lights", "two_spheres"};
constexpr double kExponents[] = {3.5, 16, 64, 250.5};

Scene scene(const std::string& name, int side = 96) {
  Scene result = canonical_scene(name);
  result.film.width = result.film.height = side;
  return result;
}

Scene with_highlight(Scene scene, double exponent, const char* lobe,
                     const char* model = "phong_rdf") {
  for (Material& material : scene.materials) {
    material.highlight.exponent = exponent;
    material.highlight.lobe = *find_lobe(lobe);
    material.highlight.model = *find_model(model);
  }
  return scene;
}

Image picture(const Choice& choice) {
  RenderOptions options;
  choice.apply(options);
  return render(choice.scene, options).image;
}

/// Chooses for each of the accuracies, from the loosest, and holds the pictures to them.
void hold(const Scene& scene, const std::vector<std::string>& accuracies) {
  double cost = 0;
  for (const std::string& text : accuracies) {
    SCOPED_TRACE(text);
    const Choice choice = choose(scene, parse_accuracy(text));
    const Reached reached = measure_reached(scene, choice, picture(choice));
    EXPECT_LE(choice.predicted, choice.asked.value);
    EXPECT_LE(reached.value, choice.asked.value);
    EXPECT_LE(reached.value, choice.predicted);
    EXPECT_TRUE(reached.held(choice));
    EXPECT_THAT(reached.against, HasSubstr("formulas"));
    EXPECT_LE(choice.cost, choice.own_cost);
    EXPECT_GE(choice.cost, cost) << "more accuracy for less";
    cost = choice.cost;
  }
}

TEST(Accuracy, IsReachedByTheCanonicalScenes) {
  for (const char* name : kScenes)
    for (const double exponent : kExponents) {
      SCOPED_TRACE(::testing::Message() << name << ", n = " << exponent);
      const Scene s = with_highlight(scene(name), exponent, "cosine");
      hold(s, {"0.5", "0.2", "1e-1", "3e-2", "1e-2", "1e-3", "1e-5", "1e-6"});
      hold(s, {"de2000=20", "de2000=5", "de2000=2", "de2000=1", "de2000=0.3", "de2000=0.01"});
    }
}

TEST(Accuracy, IsReachedForEveryModelWithEveryLobe) {
  for (const ModelId model : all_models())
    for (const char* lobe : {"schlick", "cs16", "gauss", "cs10"}) {
      SCOPED_TRACE(::testing::Message() << info(model).name << ", " << lobe);
      const Scene s = with_highlight(scene("oblique_45", 64), 40, lobe, info(model).name.data());
      hold(s, {"1e-1", "1e-2", "1e-4"});
      hold(s, {"de2000=5", "de2000=1"});
    }
}

TEST(Accuracy, IsReachedByAPartlyMeasuredPicture) {
  Scene s = scene("two_spheres", 400);
  s.film.width = 517;
  hold(s, {"1e-1", "1e-2", "1e-3"});
  hold(s, {"de2000=5", "de2000=1"});
}

TEST(Accuracy, IsReachedInMirrorsByABoundThatCountsThem) {
  Scene s = scene("effects/mirrors");
  s.sampler.sample_count = 1;
  EXPECT_EQ(choose(s, parse_accuracy("1e-3")).basis, Basis::kBound);
  hold(s, {"0.5", "1e-1", "1e-2", "1e-4"});
  hold(s, {"de2000=5", "de2000=1"});
}

TEST(Accuracy, IsReachedInNoiseToo) {
  for (const char* name : {"effects/area_light", "effects/mirrors"})
    for (const char* text : {"0.03", "de2000=4"}) {
      SCOPED_TRACE(::testing::Message() << name << ", " << text);
      const Scene s = scene(name, 40);
      const Choice choice = choose(s, parse_accuracy(text), 128);
      ASSERT_TRUE(choice.samples.has_value());
      const Reached reached = measure_reached(s, choice, picture(choice));
      EXPECT_LE(reached.value, choice.asked.value);
      EXPECT_GT(reached.value, 0);
      EXPECT_EQ(choice.basis, Basis::kTrial);
      EXPECT_THAT(choice.why, HasSubstr("samples"));
    }
}

TEST(Accuracy, TakesMoreSamplesForASmallerError) {
  const Scene s = scene("effects/area_light", 32);
  const Choice loose = choose(s, parse_accuracy("0.1"), 64),
               tight = choose(s, parse_accuracy("0.01"), 64);
  EXPECT_LT(*loose.samples, *tight.samples);
  EXPECT_EQ(loose.measure, Measure::kRmsOfPeak);
  const auto few = [&](const char* text) { choose(s, parse_accuracy(text), 2); };
  const std::string error = error_words(ExitCode::kInput, [&] { few("0.001"); });
  EXPECT_THAT(error, HasSubstr("cannot be reached with 2 samples"));
  const std::size_t at = error.rfind("--accuracy ");
  ASSERT_NE(at, std::string::npos);
  EXPECT_NO_THROW(few(error.substr(at + 11).c_str())) << "the best possible is possible";
}

TEST(Accuracy, KeepsTheScenesLobeIfItIsTheCheapest) {
  const Scene s = with_highlight(scene("head_on"), 250.5, "cosine");
  const auto cosine = *find_lobe("cosine");
  EXPECT_EQ(choose(s, parse_accuracy("1e-6")).lobe, cosine);
  // With another order of costs another lobe is chosen.
  const auto own_first = [&](LobeId lobe, Precision) { return lobe == cosine ? 1.0 : 2.0; };
  EXPECT_EQ(choose(s, parse_accuracy("0.5"), 1, own_first).lobe, cosine);
  const auto all_alike = [](LobeId, Precision) { return 1.0; };
  EXPECT_EQ(choose(s, parse_accuracy("0.5"), 1, all_alike).lobe, cosine);
  EXPECT_NE(choose(s, parse_accuracy("0.5")).lobe, cosine);
}

TEST(Accuracy, IsReachedForACosineByACubicAndSquarings) {
  for (const double exponent : {100.0, 250.5, 1024.0}) {
    const Scene s = with_highlight(scene("oblique_45"), exponent, "cosine");
    for (const char* asked : {"1e-2", "1e-3", "1e-4"}) {
      const Choice choice = choose(s, parse_accuracy(asked));
      ASSERT_TRUE(choice.lobe) << exponent << " " << asked;
      EXPECT_EQ(family(*choice.lobe), "pk") << exponent << " " << asked;
      EXPECT_LT(choice.cost, choice.own_cost / 5) << exponent << " " << asked;
    }
  }
}

TEST(Accuracy, FindsThatAnEvenPowerOfTheCosineNeedsNoLogarithm) {
  const Scene s = with_highlight(scene("oblique_45"), 100, "cosine");
  const Choice choice = choose(s, parse_accuracy("1e-6"));
  EXPECT_EQ(choice.lobe, find_lobe("cs100"));
  EXPECT_EQ(choice.precision, Precision::kFloat64);
  EXPECT_LT(choice.cost, choice.own_cost);
}

TEST(Accuracy, KeepsHighlightsThatDifferWhereNoLobeStandsForAll) {
  Scene s = with_highlight(scene("two_spheres"), 250.5, "cosine");
  s.materials.push_back(s.materials[0]);
  s.materials[1].highlight.lobe = *find_lobe("gauss");
  s.spheres[1].material = 1;
  const Choice choice = choose(s, parse_accuracy("1e-5"));
  EXPECT_EQ(choice.lobe, std::nullopt);
  EXPECT_EQ(choice.scene.materials[1].highlight.lobe, *find_lobe("gauss"));
  EXPECT_TRUE(measure_reached(s, choice, picture(choice)).held(choice));
  EXPECT_TRUE(as_json(accuracy_record(choice, {}))["chose"]["lobe"].is_null());
}

TEST(Accuracy, TriesTheWholePictureWithoutABound) {
  // Light from straight ahead: some half vector is unknown, and no precision has a bound.
  Scene s = with_highlight(scene("head_on"), 64, "cosine", "blinn_phong_rdf");
  std::get<DirectionalLight>(s.lights[0]).direction = {0, 0, 1};
  s.lights.push_back(scene("head_on").lights[0]);
  const Choice choice = choose(s, parse_accuracy("1e-3"));
  EXPECT_EQ(choice.basis, Basis::kTrial);
  EXPECT_LT(choice.cost, choice.own_cost);
  EXPECT_TRUE(measure_reached(s, choice, picture(choice)).held(choice));
}

TEST(Accuracy, HoldsForABlackPicture) {
  Scene dark = scene("head_on");
  std::get<DirectionalLight>(dark.lights[0]).irradiance = {};
  Scene dark_noise = dark;
  dark_noise.sampler.sample_count = 4;
  for (const Scene& s : {dark, dark_noise})
    for (const char* asked : {"0.1", "1e-6", "de2000=1"}) {
      SCOPED_TRACE(asked);
      const Choice choice = choose(s, parse_accuracy(asked), 8);
      EXPECT_EQ(choice.lobe, own_lobe(s));
      EXPECT_EQ(choice.precision, Precision::kFloat64);
      const Image image = picture(choice);
      EXPECT_EQ(peak_value(image), 0);
      const Reached reached = measure_reached(s, choice, image);
      EXPECT_TRUE(reached.held(choice));
      EXPECT_EQ(reached.value, 0);
      EXPECT_THAT(reached_text(choice, reached), HasSubstr("there was nothing to measure"));
    }
}

TEST(Accuracy, IsMeasuredForAHighlightBetweenThePixelsThatAreLookedAt) {
  Scene s = with_highlight(scene("oblique_45", 2048), 1e8, "cosine");
  const Choice choice = choose(s, parse_accuracy("1e-3"));
  const Image image = picture(choice);
  ASSERT_GT(peak_value(image), 0);
  const Reached reached = measure_reached(s, choice, image);
  EXPECT_FALSE(reached.black);
  EXPECT_TRUE(reached.held(choice));
  const Reached lost = measure_reached(s, choice, Image(image.width(), image.height()));
  EXPECT_FALSE(lost.black);
  EXPECT_GT(lost.value, 0.5);
}

TEST(Accuracy, SaysWhetherItWasHeld) {
  const Scene s = scene("head_on");
  const Choice choice = choose(s, parse_accuracy("1e-1"));
  Choice other = choice;
  other.asked.value = 1e-3;
  const Reached reached = measure_reached(s, other, picture(choice));
  EXPECT_FALSE(reached.held(other));
  EXPECT_THAT(reached_text(other, reached), HasSubstr("does NOT hold"));
  const Json record = as_json(accuracy_record(other, reached));
  EXPECT_EQ(record["reached"]["held"], false);
  EXPECT_EQ(record["unit"], "ofPeak");
  EXPECT_EQ(record["basis"], "bound");
  EXPECT_FALSE(as_json(accuracy_record(choice, {})).contains("reached"));
}

TEST(ParseAccuracy, TakesAShareOfThePeakOrACiede2000) {
  EXPECT_EQ(parse_accuracy("1e-3").value, 1e-3);
  EXPECT_EQ(parse_accuracy("1e-3").unit, Accuracy::Unit::kOfPeak);
  EXPECT_EQ(parse_accuracy("de2000=2").value, 2);
  EXPECT_EQ(parse_accuracy("de2000=2").unit, Accuracy::Unit::kCiede2000);
  for (const char* text : {"", "0", "-1", "nan", "inf", "2", "1e-7", "de2000",
                           "de2000=", "de2000=0", "de2000=nan", "de2000=101", "flip=1", "1e-3x"})
    EXPECT_THAT(error_words(ExitCode::kUsage, [&] { parse_accuracy(text); }),
                HasSubstr("1e-06 to 1"))
        << text;
}

TEST(ShadingCost, GrowsWithTheOrderAndIsLeastWithoutTranscendentals) {
  for (std::size_t p = 0; p < precision_names().size(); ++p) {
    const auto cost = [&](const char* lobe) {
      return shading_cost(*find_lobe(lobe), Precision(p));
    };
    EXPECT_LT(cost("cs2"), cost("cs16"));
    EXPECT_LT(cost("cs16"), cost("cs64"));
    EXPECT_LT(cost("cs64"), cost("schlick") * 3);
    EXPECT_LT(cost("cs64"), cost("spherical_gaussian"));
    EXPECT_LT(cost("spherical_gaussian"), cost("cosine"));
  }
}

}  // namespace
}  // namespace lobelia::accuracy

// Explanations of values, without a shader: mistakes that are planted in formulas, and right formulas in other forms.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "studies/shader_check/explain.hpp"
#include "studies/shader_check/judge.hpp"
#include "studies/shader_check/mistakes.hpp"
#include "studies/shader_check/outputs.hpp"
#include "tests/more_samples.hpp"
#include "tests/test.hpp"

namespace lobelia::shader_check {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAreArray;

/// Mistakes in a formula, and what is done to its result.
struct PlantedInFormula {
  Highlight highlight;
  std::vector<const Mistake*> shape;
  double factor = 1, ambient = 0, diffuse = 0;
  const OutputStep* output = nullptr;
  std::vector<std::string> names;
  std::string words;

  bool of_roughness() const {
    return std::ranges::any_of(shape, [](const Mistake* one) { return one->of_roughness; });
  }
};

Observed observed_of(const PlantedInFormula& planted, bool in_double = false) {
  Observed observed;
  for (const double n : kUsualExponents) {
    Highlight here = planted.highlight;
    here.exponent = n;
    const double coefficient = planted.factor * radiance_coefficient(here);
    const std::vector<Point> points = domain_points(here, n, 600);
    const std::vector<Seen> seen(points.begin(), points.end());
    const std::vector<double> shape =
        shape_values(formula_of(planted.highlight, n, planted.shape), seen);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double light = std::max(seen[i].as(Reversed::kNone).n_dot_l, 0.0);
      double value = coefficient * shape[i] + planted.ambient + planted.diffuse * light;
      if (planted.output) value = planted.output->value(value);
      observed.points.push_back(points[i]);
      observed.values.push_back(in_double ? value : double(float(value)));
    }
  }
  return observed;
}

std::vector<PlantedInFormula> single_mistakes() {
  std::vector<PlantedInFormula> all;
  for (const ModelId model : all_models()) {
    const Highlight highlight{model, *find_lobe(info(model).has_shadowing ? "ggx" : "cosine")};
    for (const Mistake& mistake : mistakes()) {
      const Mistake* const made[] = {&mistake};
      if ((mistake.applies && !mistake.applies(highlight)) ||
          (mistake.part == Part::kLobe && formula_of(highlight, 1, made).lobe == highlight.lobe))
        continue;
      all.push_back(
          {highlight, {&mistake}, 1, 0, 0, nullptr, {std::string(mistake.id)}, mistake.words});
    }
    for (const OutputStep& step : output_steps()) {
      all.push_back(
          {highlight, {}, 1, 0, 0, &step, {std::string(step.id)}, std::string(step.words)});
      if (!step.also.empty()) all.back().names.emplace_back(step.also);
    }
    const auto add = [&](const char* name, double factor, double ambient, double diffuse) {
      all.push_back({highlight, {}, factor, ambient, diffuse, nullptr, {name}, name});
    };
    add("pi-rounded", std::numbers::pi / 3.14, 0, 0);
    add("four-missing", 4, 0, 0);
    add("two-twice", 0.5, 0, 0);
    add("factor", 1.7, 0, 0);
    add("ambient", 1, 0.05, 0);
    add("diffuse", 1, 0, 0.3);
  }
  return all;
}

/// Whether two mistakes may be in one shader, and are seen there.
bool may_join(const PlantedInFormula& a, const PlantedInFormula& b) {
  if (a.highlight.model != b.highlight.model || a.names == b.names) return false;
  if (a.shape.empty() && b.shape.empty() && (a.output != nullptr) == (b.output != nullptr))
    return false;
  return a.shape.empty() || b.shape.empty() || a.shape[0]->part != b.shape[0]->part;
}

PlantedInFormula joined(const PlantedInFormula& a, const PlantedInFormula& b) {
  PlantedInFormula both = a;
  both.shape.insert(both.shape.end(), b.shape.begin(), b.shape.end());
  both.factor *= b.factor;
  both.ambient += b.ambient;
  both.diffuse += b.diffuse;
  if (b.output) both.output = b.output;
  both.names.insert(both.names.end(), b.names.begin(), b.names.end());
  both.words += " + " + b.words;
  return both;
}

/// The share that is named; all others have to be explained as simply by others that do the same.
double share_named(const std::vector<PlantedInFormula>& planted) {
  int named = 0, explained = 0;
  for (const PlantedInFormula& one : planted) {
    const auto found = explain(one.highlight, observed_of(one), one.of_roughness());
    const bool is_named = testing::Matches(UnorderedElementsAreArray(one.names))(found.mistakes);
    named += is_named;
    explained += found.complete;
    if (found.complete)
      EXPECT_LE(found.mistakes.size(), one.names.size())
          << info(one.highlight.model).name << ": " << one.words << ": " << found.sentence;
    else
      EXPECT_THAT(found.mistakes, testing::SizeIs(testing::Le(1u)))
          << info(one.highlight.model).name << ": " << one.words << ": " << found.sentence;
  }
  EXPECT_GE(explained, 0.95 * double(planted.size()));
  return named / double(planted.size());
}

TEST(Explain, NamesSingleMistakesOfTheCatalogueInEveryModel) {
  EXPECT_GE(share_named(some_of(single_mistakes())), 0.95);
}

TEST(Explain, NamesRandomPairsOfMistakes) {
  const std::vector<PlantedInFormula> singles = single_mistakes();
  std::vector<PlantedInFormula> pairs;
  std::mt19937 random(58);
  while (pairs.size() < 60u * std::size_t(more_samples())) {
    const auto& a = singles[random() % singles.size()];
    const auto& b = singles[random() % singles.size()];
    if (may_join(a, b)) pairs.push_back(joined(a, b));
  }
  EXPECT_GE(share_named(pairs), 0.85);
}

TEST(Explain, SaysTheSameOfValuesInDouble) {
  for (const PlantedInFormula& one : some_of(single_mistakes(), 20))
    EXPECT_EQ(explain(one.highlight, observed_of(one, true), one.of_roughness()).mistakes,
              explain(one.highlight, observed_of(one), one.of_roughness()).mistakes)
        << one.words;
}

TEST(Explain, IdentifiesEveryModelByItsValues) {
  for (const ModelId model : all_models())
    for (const char* lobe : {"cosine", "ggx"}) {
      const Highlight highlight{model, *find_lobe(lobe)};
      const Identified found =
          identify(all_highlights(), observed_of({highlight, {}, 1, 0, 0, nullptr, {}, ""}), false);
      EXPECT_THAT(found.explanation.mistakes, testing::IsEmpty()) << info(model).name;
      EXPECT_EQ(found.highlight.model, model);
      EXPECT_EQ(found.highlight.lobe, highlight.lobe);
    }
}

/// A shader in float32, as people write it.
using Shader = std::function<float(Vec3 normal, Vec3 to_eye, Vec3 to_light, float n)>;
float cosine_of_half(Vec3 normal, Vec3 to_eye, Vec3 to_light) {
  const auto to_float = [](Vec3 v) { return Vec3{float(v.x), float(v.y), float(v.z)}; };
  const Vec3 sum = to_float(to_light + to_eye);
  const float inverse = 1 / std::sqrt(float(dot(sum, sum)));
  return float(dot(normal, to_float(double(inverse) * sum)));
}
float light(Vec3 normal, Vec3 to_light) { return std::max(float(dot(normal, to_light)), 0.0F); }

struct Judged {
  records::ShaderCheck record;
  records::ShaderExplanation explanation;
};
Judged judged(const Highlight& highlight, const Shader& shader,
              std::vector<double> exponents = {std::begin(kUsualExponents),
                                               std::end(kUsualExponents)}) {
  const Plan plan = judged_plan(highlight, exponents, exponents[exponents.size() / 2]);
  std::vector<ShaderValue> values;
  for (const Point& p : plan.points) {
    const float value = shader(p.normal, p.to_eye, p.to_light, float(p.exponent));
    ShaderValue& to = values.emplace_back();
    to.r = to.g = to.b = value;
    to.written = true;
  }
  Judge judge(highlight, plan, values);
  Judged result;
  judge.judge(result.record);
  result.explanation = judge.explanation(result.record.oddities, false);
  return result;
}

constexpr float kPi = 3.14159265F;
const Highlight kHeightfield{*find_model("blinn_phong_heightfield"), *find_lobe("cosine")};
float heightfield_coefficient(float n) { return (n + 2) / (8 * kPi); }

TEST(Judge, PassesRightFormulasInOtherForms) {
  const Shader by_logarithm = [](Vec3 N, Vec3 V, Vec3 L, float n) {
    return heightfield_coefficient(n) *
           std::exp2(n * std::log2(std::max(cosine_of_half(N, V, L), 0.0F))) * light(N, L);
  };
  EXPECT_EQ(judged(kHeightfield, by_logarithm).record.verdict, "passes");
  const Highlight ggx{*find_model("microfacet_smith"), *find_lobe("ggx")};
  const Shader with_guard = [](Vec3 N, Vec3 V, Vec3 L, float n) {
    const float nv = float(dot(N, V)), nl = light(N, L), nh = cosine_of_half(N, V, L);
    if (nv <= 0) return 0.0F;
    const float a2 = 2 / (n + 2), d = (nh * a2 - nh) * nh + 1;
    const float by_light = nv * std::sqrt((nl - nl * a2) * nl + a2),
                by_eye = nl * std::sqrt((nv - nv * a2) * nv + a2);
    return a2 / (kPi * d * d) * 0.5F / (by_light + by_eye) * nl;
  };
  EXPECT_EQ(judged(ggx, with_guard).record.verdict, "passes");
}

TEST(Judge, ReportsLightOfAnEyeBelowTheSurfaceApart) {
  const Shader lit_below = [](Vec3 N, Vec3 V, Vec3 L, float n) {
    if (dot(N, V) <= 0) return light(N, L) > 0.5F ? 1.0F : std::nanf("");
    return heightfield_coefficient(n) * std::pow(std::max(cosine_of_half(N, V, L), 0.0F), n) *
           light(N, L);
  };
  const records::ShaderCheck record = judged(kHeightfield, lit_below).record;
  EXPECT_EQ(record.verdict, "passes");
  EXPECT_EQ(record.oddities.nan, 0u);
  EXPECT_GT(record.oddities.below_lit, 50u);
  EXPECT_GT(record.oddities.below_nonfinite, 50u);
}

TEST(Explain, NamesSmallCausesOnlyWhereTheyAreShown) {
  const auto heightfield = [](float factor, float least, float least_light) -> Shader {
    return [=](Vec3 N, Vec3 V, Vec3 L, float n) {
      const float nl = std::max(float(dot(N, L)), least_light);
      return factor * heightfield_coefficient(n) *
             std::pow(std::max(cosine_of_half(N, V, L), least), n) * nl;
    };
  };
  const auto rounded_pi = judged(kHeightfield, heightfield(kPi / 3.14F, 0, 0)).explanation;
  EXPECT_THAT(rounded_pi.mistakes, ElementsAre("pi-rounded"));
  EXPECT_THAT(rounded_pi.sentence, HasSubstr("1.00051 times too bright: pi is 3.14"));
  const auto floor = judged(kHeightfield, heightfield(1, 1e-4F, 1e-4F)).explanation;
  EXPECT_THAT(floor.mistakes, ElementsAre("floor"));
  EXPECT_THAT(floor.sentence, HasSubstr("max(N.L, 0.0001)"));
  const auto both = judged(kHeightfield, heightfield(4, 1e-4F, 1e-4F)).explanation;
  EXPECT_THAT(both.mistakes, ElementsAre("four-missing", "floor"));
  EXPECT_THAT(both.sentence, HasSubstr("it is 4 times too bright"));
  const auto sharp = judged(kHeightfield, heightfield(1, 0, 0), {20000}).explanation;
  EXPECT_THAT(sharp.mistakes, ElementsAre("float32-cosine"));
  // A factor has one sign, and a wave is far above rounding.
  const auto wave = judged(kHeightfield, [&](Vec3 N, Vec3 V, Vec3 L, float n) {
    return heightfield(1, 0, 0)(N, V, L, n) * (1 + 2e-4F * std::sin(40 * float(N.x)));
  });
  EXPECT_EQ(wave.record.verdict, "differs");
  EXPECT_THAT(wave.explanation.mistakes, testing::IsEmpty());
  EXPECT_THAT(wave.explanation.sentence, HasSubstr("no known mistake explains it"));
}

TEST(Explain, NamesNanOfANegativeBaseWithItsShare) {
  const Highlight phong{*find_model("modified_phong"), *find_lobe("cosine")};
  const auto found =
      judged(phong, [](Vec3 N, Vec3 V, Vec3 L, float n) {
        const Vec3 mirrored = 2 * dot(N, V) * N - V;
        const float c = float(dot(mirrored, L));
        return (n + 2) / kPi * (c < 0 ? std::nanf("") : std::pow(c, n)) * light(N, L);
      }).explanation;
  EXPECT_THAT(found.mistakes, ElementsAre("two-missing", "negative-base"));
  EXPECT_THAT(found.sentence, HasSubstr("calls: pow of a negative base, there is no max(..., 0)"));
}

TEST(Explain, TellsNoNearestThatLeavesMoreThanATenthOfThePeak) {
  const auto toon = judged(kHeightfield, [](Vec3 N, Vec3 V, Vec3 L, float n) {
    return heightfield_coefficient(n) *
           (std::pow(std::max(cosine_of_half(N, V, L), 0.0F), n) > 0.5F ? 1.0F : 0.0F) *
           light(N, L);
  });
  EXPECT_THAT(toon.explanation.sentence, HasSubstr("none comes near"));
}

}  // namespace
}  // namespace lobelia::shader_check

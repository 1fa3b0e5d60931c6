// Conversions, held to closed forms and to a scan by formulas that are written anew here.
#include "studies/convert/convert.hpp"

#include "base/words/constants.hpp"
#include "compare/metrics/ciede2000.hpp"
#include "renderer/albedo.hpp"
#include "renderer/ggx.hpp"
#include "studies/convert/curve.hpp"
#include "tests/more_samples.hpp"
#include "tests/test.hpp"

namespace lobelia::conversion {
namespace {

const ShadingModel kGgxModel{};

ShadingModel model(std::string_view name) { return *find_shading_model(name); }

std::vector<ShadingModel> catalogue() {
  std::vector<ShadingModel> all;
  for (const ModelId id : all_models()) all.push_back({id});
  return all;
}

double best(ShadingModel from, double parameter, ShadingModel to, Measure measure) {
  return best_parameter({from, to, parameter, 1, measure}, measure).parameter;
}

/// The row of a rule or of a measure.
template <class Row>
const Row& row(const std::vector<Row>& rows, std::string_view name) {
  const auto found = std::ranges::find_if(rows, [&](const Row& one) {
    if constexpr (requires { one.measure; })
      return one.measure == name;
    else
      return one.name == name;
  });
  EXPECT_NE(found, rows.end()) << name;
  return *found;
}

TEST(Curve, ReflectsTheModelsEnergyAtNormalIncidence) {
  for (const ShadingModel& one : catalogue())
    for (const double n : {1e-3, 0.5, 16.0, 1e3, 1e8}) {
      const Highlight highlight{*one.id, *find_lobe("cosine"), Normalisation::kExact, n};
      EXPECT_NEAR(Curve(one, n, 1).energy(), directional_albedo_of_light(highlight, 0), 1e-9)
          << one.name() << " " << n;
    }
  EXPECT_NEAR(Curve(kGgxModel, 1, 1).energy(), 1 - std::log(2), 1e-14);
  EXPECT_NEAR(Curve(kGgxModel, 1e-4, 1).energy(), 1, 1e-6);
}

/// Where cos^power of an angle is a half, without cancellation.
double cosine_half_width(double power) {
  return 2 * std::asin(std::sqrt(-std::expm1(-std::log(2) / power) / 2));
}

TEST(Curve, HasTheHalfWidthOfTheClosedForm) {
  // Times the cosine of the eye, cos^n of a Phong model has one power more.
  for (const char* name : {"phong_rdf", "modified_phong"})
    for (const double n : {1e-3, 3.0, 32.0, 1e4, 1e8})
      EXPECT_NEAR(Curve(model(name), n, 1).half_width() / cosine_half_width(n + 1), 1, 1e-12) << n;
  // For a small highlight the cosine of the eye is 1.
  EXPECT_NEAR(Curve(model("blinn_phong_ndf"), 1e8, 1).half_width() / (2 * cosine_half_width(1e8)),
              1, 1e-7);
  // (sin a)^2 = alpha^2 (sqrt(2) - 1) / (1 - alpha^2) is where D is half.
  const double alpha = 1e-4,
               half_vector = std::asin(alpha * std::sqrt((std::sqrt(2) - 1) / (1 - alpha * alpha)));
  EXPECT_NEAR(Curve(kGgxModel, alpha, 1).half_width() / (2 * half_vector), 1, 1e-7);
  // For alpha = 1 the curve is cos x / (2 pi (1 + cos x)).
  EXPECT_NEAR(Curve(kGgxModel, 1, 1).half_width(), std::acos(1 / 3.0), 1e-14);
}

TEST(Curve, IsHalfOfItsPeakAtOneAngleAlone) {
  for (const double alpha : {1e-4, 0.01, 0.3, 0.7, 1.0})
    for (const double f0 : {0.001, 1.0}) {
      const Curve curve(kGgxModel, alpha, f0);
      for (double degrees = 0; degrees < 90; degrees += 0.5) {
        const double angle = degrees * kPi / 180;
        EXPECT_EQ(curve(angle) > curve.peak() / 2, angle < curve.half_width()) << alpha << degrees;
      }
      EXPECT_NEAR(curve(kRightAngle), 0, 1e-12 * curve.peak());
    }
}

TEST(Curve, IsTintedByFresnelForGgxOnlyAwayFromTheMirror) {
  const Curve white(kGgxModel, 0.3, 1), grey(kGgxModel, 0.3, 0.04);
  EXPECT_EQ(white.peak(), grey.peak());
  // F / F0 by Schlick at an eye of 80 degrees, 40 from the half vector.
  const double base = 1 - std::cos(40 * kPi / 180), angle = 80 * kPi / 180;
  EXPECT_NEAR(grey(angle) / white(angle), 1 + 0.96 / 0.04 * std::pow(base, 5), 1e-12);
}

TEST(BestByWidth, IsAsWideAndComesBackToWhereItBegan) {
  for (const ShadingModel& one : catalogue())
    for (const double n : {8.0, 32.0, 500.0, 1e6}) {
      const double alpha = best(one, n, kGgxModel, Measure::kWidth);
      EXPECT_NEAR(Curve(kGgxModel, alpha, 1).half_width() / Curve(one, n, 1).half_width(), 1, 1e-8)
          << one.name() << n;
      EXPECT_NEAR(best(kGgxModel, alpha, one, Measure::kWidth) / n, 1, 1e-9) << one.name() << n;
    }
}

TEST(Best, IsTheParameterItselfForTheSameModel) {
  for (int measure = 0; measure < 4; ++measure) {
    EXPECT_NEAR(best(model("phong_rdf"), 77, model("phong_rdf"), Measure(measure)) / 77, 1, 1e-5);
    EXPECT_NEAR(best(kGgxModel, 0.2, kGgxModel, Measure(measure)) / 0.2, 1, 1e-5);
  }
}

TEST(Best, KeepsAFlatLobeFlat) {
  for (int measure = 0; measure < 4; ++measure)
    for (const char* to : {"phong_rdf", "blinn_phong_rdf"})
      EXPECT_EQ(best(model("phong_rdf"), 0, model(to), Measure(measure)), 0) << to << measure;
}

// ---- an implementation of its own: curves by the textbook, errors by sampling

double plain_heightfield(double n, double x) {
  return (n + 2) / (8 * kPi) * std::pow(std::cos(x / 2), n) * std::cos(x);
}
double plain_ggx(double alpha, double x) {
  const double c = std::cos(x / 2), v = std::cos(x), a2 = alpha * alpha;
  const double d = a2 / (kPi * std::pow(c * c * (a2 - 1) + 1, 2));
  const double lambda = (std::sqrt(1 + a2 * (1 / (v * v) - 1)) - 1) / 2;
  return d / ((1 + lambda) * 4);
}

double plain_error(Measure measure, double n, double alpha) {
  constexpr int kSamples = 4000;
  const double white = std::max(plain_heightfield(n, 0), plain_ggx(alpha, 0));
  double largest = 0, energy = 0;
  for (int i = 0; i <= kSamples; ++i) {
    const double x = kRightAngle * i / kSamples;
    const double from = plain_heightfield(n, x), to = plain_ggx(alpha, x);
    energy += std::abs(from - to) * 2 * kPi * std::sin(x) * kRightAngle / kSamples;
    if (measure == Measure::kMax) largest = std::max(largest, std::abs(from - to));
    const auto shown = [&](double value) {
      const double light = std::min(1.0, value / white);
      return lab_from_display({light, light, light});
    };
    if (measure == Measure::kCiede2000)
      largest = std::max(largest, ciede2000(shown(from), shown(to)));
  }
  return measure == Measure::kEnergy ? energy : largest;
}

TEST(Best, IsTheLeastOfAScanByAnotherImplementation) {
  for (const Measure measure : {Measure::kMax, Measure::kEnergy, Measure::kCiede2000})
    for (const double n : some_of(std::vector{4.0, 8.0, 32.0, 512.0})) {
      const double found = best(model("blinn_phong_heightfield"), n, kGgxModel, measure);
      double least = kInfinity, least_alpha = 0;
      for (double alpha = 0.02; alpha <= 1; alpha *= 1.01)
        if (const double error = plain_error(measure, n, alpha); error < least) {
          least = error;
          least_alpha = alpha;
        }
      EXPECT_LE(plain_error(measure, n, found), least * (1 + 1e-4)) << n << " " << found;
      EXPECT_NEAR(found / least_alpha, 1, 0.011) << n << " " << int(measure);
    }
}

TEST(Errors, AreThoseOfAnotherImplementation) {
  const Curve from(model("blinn_phong_heightfield"), 32, 1);
  // The largest difference of the first is at the peak, that of the second beside it.
  for (const double alpha : {0.2, 0.2425}) {
    const Curve to(kGgxModel, alpha, 1);
    EXPECT_NEAR(largest_difference(from, to).value, plain_error(Measure::kMax, 32, alpha), 1e-7);
    EXPECT_NEAR(misplaced_energy(from, to), plain_error(Measure::kEnergy, 32, alpha), 1e-6);
    EXPECT_NEAR(largest_ciede2000(from, to).value, plain_error(Measure::kCiede2000, 32, alpha),
                1e-4);
  }
  EXPECT_GT(largest_difference(from, Curve(kGgxModel, 0.2425, 1)).angle, 0.1);
}

TEST(Rules, HaveTheQuotedPeaksWithTheirWidths) {
  const double n = 32;
  // The distributions alone, as functions of the angle of N from H.
  const auto peak = [&](double alpha) { return 1 / (kPi * alpha * alpha) / ((n + 2) / (2 * kPi)); };
  const double walter = std::sqrt(2 / (n + 2)), blender = std::pow(1 - std::sqrt(n / 1000), 2);
  const records::Conversion conversion =
      convert({model("blinn_phong_heightfield"), kGgxModel, n, 1, Measure::kMax});
  for (const auto& [name, alpha] : {std::pair("Walter", walter), {"Blender", blender}}) {
    const auto& rule = row(conversion.rules, name);
    EXPECT_NEAR(*rule.highlight->alpha, alpha, 1e-15) << name;
    EXPECT_NEAR(rule.errors->peak_ratio, peak(alpha), 1e-12) << name;
  }
  // G and the cosine of the eye shape the rest: little of a highlight, more of none.
  EXPECT_NEAR(row(conversion.rules, "Walter").errors->half_width_ratio, 0.826, 0.001);
  EXPECT_NEAR(row(conversion.rules, "Blender").errors->half_width_ratio, 2.56, 0.01);
  const auto small = convert({model("blinn_phong_heightfield"), kGgxModel, 1e6, 1, Measure::kMax});
  EXPECT_NEAR(row(small.rules, "Walter").errors->half_width_ratio,
              std::sqrt((std::sqrt(2) - 1) / std::log(2)), 1e-5);
  EXPECT_NEAR(small.best.front().errors.largest_of_peak, 0.146, 0.0005);
}

TEST(Rules, BackFromGgxAreTheInverse) {
  const ShadingModel heightfield = model("blinn_phong_heightfield");
  const auto there = rules(heightfield, kGgxModel), back = rules(kGgxModel, heightfield);
  ASSERT_EQ(there.size(), back.size());
  for (std::size_t i = 0; i < there.size(); ++i)
    for (const double n : {0.1, 8.0, 32.0, 999.0}) {
      EXPECT_EQ(there[i].name, back[i].name);
      EXPECT_NEAR(*back[i].convert(*there[i].convert(n)) / n, 1, 1e-9) << there[i].name << " " << n;
    }
}

TEST(Rules, SayWhyTheyGiveNoHighlight) {
  const auto to_ggx =
      convert({model("blinn_phong_heightfield"), kGgxModel, 1000, 1, Measure::kMax});
  EXPECT_EQ(row(to_ggx.rules, "Blender").because, "alpha 0 is a mirror");
  EXPECT_FALSE(row(to_ggx.rules, "Blender").errors);
  const auto back = convert({kGgxModel, model("phong_rdf"), 1, 1, Measure::kMax});
  EXPECT_EQ(row(back.rules, "Walter").highlight->exponent, 0);
  const auto narrow = convert({kGgxModel, model("phong_rdf"), 1e-3, 1, Measure::kMax});
  EXPECT_EQ(row(narrow.rules, "Babylon").because, "the rule has no such exponent");
}

TEST(Conversion, HasFiniteFiguresOverTheWholeRange) {
  const auto expect_finite = [](const records::Conversion& conversion) {
    for (const auto& best : conversion.best) {
      const records::ConversionErrors& errors = best.errors;
      for (const double figure :
           {errors.largest_of_peak, errors.peak_ratio, errors.energy_ratio, errors.half_width_ratio,
            errors.misplaced_energy, errors.largest_ciede2000}) {
        EXPECT_TRUE(std::isfinite(figure) && figure >= 0)
            << conversion_text(conversion) << best.measure;
      }
    }
  };
  for (const char* name : {"phong_rdf", "blinn_phong_heightfield"})
    for (const double n : some_of(std::vector{0.0, 1e-3, 1.0, 1e4, 1e8}))
      for (const char* to : {"ggx", "modified_blinn_phong"})
        expect_finite(convert({model(name), model(to), n, 1, Measure::kMax}));
  for (const double alpha : {1e-4, 0.3, 1.0})
    expect_finite(convert({kGgxModel, model("modified_phong"), alpha, 0.04, Measure::kMax}));
}

TEST(Conversion, SaysThatItIsAtTheEndOfTheRange) {
  // Blinn-Phong would need 4e8.
  const auto conversion =
      convert({model("phong_rdf"), model("blinn_phong_rdf"), 1e8, 1, Measure::kMax});
  for (const auto& best : conversion.best) {
    EXPECT_TRUE(best.is_end_of_range) << best.measure;
    EXPECT_EQ(*best.highlight.exponent, 1e8) << best.measure;
  }
}

TEST(Range, HasAGapWithoutAnAnswer) {
  const auto text = range_text(convert_range({kGgxModel, model("phong_rdf"), 0, 1, Measure::kMax}));
  EXPECT_THAT(text, testing::HasSubstr(" - "));
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("nan")));
}

}  // namespace
}  // namespace lobelia::conversion

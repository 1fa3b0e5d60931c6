// The judge of BSDFs on values in double: no driver, and many random numbers.
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "studies/shader_check/bsdf/chances.hpp"
#include "studies/shader_check/bsdf/explain.hpp"
#include "tests/test.hpp"

namespace lobelia::shader_check::bsdf {
namespace {

constexpr double kPi = std::numbers::pi;

Vec3 mirrored(Vec3 v, Vec3 about) { return 2 * dot(v, about) * about - v; }

/// eval without the cosine, pdf and sample for one exponent, in the local frame.
struct Triple {
  std::function<double(Vec3 v, Vec3 l)> eval, pdf;
  std::function<Vec3(Vec3 v, double u1, double u2)> sample;
};

Triple phong(double n) {
  const auto cosine = [](Vec3 v, Vec3 l) { return std::max(0.0, dot(mirrored(v, {0, 0, 1}), l)); };
  return {
      [=](Vec3 v, Vec3 l) {
        return l.z > 0 && v.z > 0 ? (n + 2) / (2 * kPi) * std::pow(cosine(v, l), n) : 0;
      },
      [=](Vec3 v, Vec3 l) { return (n + 1) / (2 * kPi) * std::pow(cosine(v, l), n); },
      [=](Vec3 v, double u1, double u2) {
        const Vec3 r = mirrored(v, {0, 0, 1}),
                   a = normalize(std::abs(r.z) < 0.9 ? cross(r, {0, 0, 1}) : cross(r, {1, 0, 0})),
                   b = cross(r, a);
        const double c = std::pow(u1, 1 / (n + 1)), s = std::sqrt(1 - c * c), t = 2 * kPi * u2;
        return s * std::cos(t) * a + s * std::sin(t) * b + c * r;
      }};
}

Triple blinn(double n) {
  const auto d = [n](double c) { return (n + 2) / (2 * kPi) * std::pow(std::max(c, 0.0), n); };
  return {[=](Vec3 v, Vec3 l) { return l.z > 0 && v.z > 0 ? d(normalize(v + l).z) / 4 : 0; },
          [=](Vec3 v, Vec3 l) {
            if (l.z <= 0 || v.z <= 0) return 0.0;
            const Vec3 h = normalize(v + l);
            return d(h.z) * h.z / (4 * dot(v, h));
          },
          [=](Vec3 v, double u1, double u2) {
            const double c = std::pow(u1, 1 / (n + 2)), s = std::sqrt(1 - c * c), t = 2 * kPi * u2;
            const Vec3 h{s * std::cos(t), s * std::sin(t), c};
            return dot(v, h) > 0 ? mirrored(v, h) : Vec3{0, 0, -1};
          }};
}

Triple ggx(double n) {
  const double alpha = std::sqrt(2 / (n + 2));
  const auto d = [alpha](Vec3 h) {
    const double c = (h.x * h.x + h.y * h.y) / (alpha * alpha) + h.z * h.z;
    return 1 / (kPi * alpha * alpha * c * c);
  };
  const auto lambda = [alpha](Vec3 v) {
    return (std::sqrt(1 + alpha * alpha * (1 - v.z * v.z) / (v.z * v.z)) - 1) / 2;
  };
  return {[=](Vec3 v, Vec3 l) {
            return l.z > 0 && v.z > 0
                       ? d(normalize(v + l)) / (1 + lambda(v) + lambda(l)) / (4 * v.z * l.z)
                       : 0;
          },
          [=](Vec3 v, Vec3 l) {
            return l.z > 0 && v.z > 0 ? d(normalize(v + l)) / (1 + lambda(v)) / (4 * v.z) : 0;
          },
          [=](Vec3 v, double u1, double u2) {
            const Vec3 w = normalize({alpha * v.x, alpha * v.y, v.z});
            const double side = std::hypot(w.x, w.y), r = std::sqrt(u1), t = 2 * kPi * u2,
                         s = (1 + w.z) / 2, x = r * std::cos(t),
                         y = (1 - s) * std::sqrt(1 - x * x) + s * r * std::sin(t);
            const Vec3 a = side > 0 ? Vec3{-w.y / side, w.x / side, 0} : Vec3{1, 0, 0},
                       b = cross(w, a),
                       h = x * a + y * b + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * w;
            return mirrored(v, normalize({alpha * h.x, alpha * h.y, std::max(0.0, h.z)}));
          }};
}

void fill(GridValues& grid, Vec3 eye, const Triple& triple) {
  for (const auto& node : grid.grid.nodes())
    grid.values.push_back({triple.eval(eye, node.direction), triple.eval(node.direction, eye),
                           triple.pdf(eye, node.direction)});
}

BsdfValues values_of(const Triple& triple, double exponent, std::uint64_t seed,
                     std::size_t samples) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform;
  BsdfValues values;
  for (const double degrees : {0.0, 45.0, 80.0}) {
    BsdfSettingValues& setting = values.settings.emplace_back();
    setting.exponent = exponent;
    setting.eye_degrees = degrees;
    setting.eye = eye_at(degrees);
    std::vector<Vec3> above, below;
    for (std::size_t i = 0; i < samples / 4; ++i) {
      const double u1 = uniform(random);
      const Vec3 d = triple.sample(setting.eye, u1, uniform(random));
      (d.z > 0 ? above : below).push_back(d);
    }
    for (std::size_t i = 0; i < samples; ++i) {
      BsdfSample& one = setting.samples.emplace_back();
      const double u1 = uniform(random);
      one.direction = triple.sample(setting.eye, u1, uniform(random));
      one.pdf = triple.pdf(setting.eye, one.direction);
      one.eval = triple.eval(setting.eye, one.direction);
    }
    setting.above.grid = HemisphereGrid(above, true, 27, 24, 3);
    setting.check.grid = HemisphereGrid(above, true, 21, 18, 3);
    setting.below.grid = HemisphereGrid(below, false, 18, 15, 3);
    for (GridValues* grid : {&setting.above, &setting.check, &setting.below})
      fill(*grid, setting.eye, triple);
  }
  return values;
}

records::BsdfCheck judged(const BsdfValues& values) {
  records::BsdfCheck record;
  judge_bsdf(values, record);
  explain_bsdf(values, {}, record);
  return record;
}

constexpr Triple (*kTriples[])(double) = {phong, blinn, ggx};

TEST(BsdfJudge, CallsNoRightTripleWrongForAnySeed) {
  std::uint64_t seed = 0;
  std::size_t told = 0;
  for (; seed < 200; ++seed)
    for (const auto triple : kTriples) {
      const double n = std::array{1.0, 16.0, 256.0}[seed % 3];
      const records::BsdfCheck record = judged(values_of(triple(n), n, seed, 8000));
      EXPECT_EQ(record.verdict, "passes")
          << "seed " << seed << ": " << record.failures.front().sentence;
      told += record.settings.size();
    }
  EXPECT_EQ(told, 200u * 3 * 3);
}

TEST(BsdfJudge, ChancesOfAChiSquareAreEvenForARightTriple) {
  // Kolmogorov and Smirnov's distance, of which 1.95 / sqrt(count) has a chance of 0.001.
  std::vector<double> chances;
  for (std::uint64_t seed = 0; seed < 60; ++seed)
    for (const records::BsdfSetting& setting :
         judged(values_of(ggx(16), 16, 1000 + seed, 20'000)).settings)
      chances.push_back(setting.chance);
  std::ranges::sort(chances);
  double distance = 0;
  for (std::size_t i = 0; i < chances.size(); ++i)
    distance =
        std::max(distance, std::abs(chances[i] - (double(i) + 0.5) / double(chances.size())));
  EXPECT_LT(distance, 1.95 / std::sqrt(double(chances.size())));
}

TEST(BsdfJudge, NamesAFactorWithAnyShapeOnlyIfBothAreThere) {
  const auto mistakes_of = [](const Triple& triple) {
    std::vector<std::string> names;
    for (const auto& one : judged(values_of(triple, 16, 7, 20'000)).explanations)
      names.push_back(one.mistake);
    return names;
  };
  for (const double factor : {0.25, 0.5, 1.3, 2 * kPi}) {
    Triple scaled = ggx(16), both = blinn(16);
    const Triple right = ggx(16), half = blinn(16);
    scaled.pdf = [=](Vec3 v, Vec3 l) { return factor * right.pdf(v, l); };
    both.pdf = [=](Vec3 v, Vec3 l) {
      return factor * half.pdf(v, l) * 4 * dot(v, normalize(v + l));
    };
    EXPECT_EQ(mistakes_of(scaled), std::vector<std::string>{"pdf-factor"}) << factor;
    EXPECT_EQ(mistakes_of(both), (std::vector<std::string>{"half-vector-jacobian", "pdf-factor"}))
        << factor;
  }
  // Nothing that has a name.
  Triple other = ggx(16);
  const Triple right = ggx(16);
  other.pdf = [=](Vec3 v, Vec3 l) { return right.pdf(v, l) * (1 + 0.3 * l.x); };
  const records::BsdfCheck record = judged(values_of(other, 16, 7, 20'000));
  EXPECT_EQ(record.verdict, "fails");
  EXPECT_TRUE(record.explanations.empty());
}

TEST(BsdfJudge, SeesAnEvalThatAChiSquareDoesNot) {
  // mitsuba3#134: sample and pdf agree, and eval is another model's.
  Triple wrong = ggx(16);
  wrong.eval = [](Vec3, Vec3 l) { return l.z > 0 ? 0.4 : 0; };
  const records::BsdfCheck record = judged(values_of(wrong, 16, 3, 20'000));
  ASSERT_EQ(record.failures.size(), 1u);
  EXPECT_EQ(record.failures.front().check, "energy");
  Triple hole = ggx(16);
  const Triple right = ggx(16);
  hole.pdf = [=](Vec3 v, Vec3 l) { return l.x > 0 ? 0 : 2 * right.pdf(v, l); };
  hole.sample = [=](Vec3 v, double u1, double u2) {
    Vec3 l = right.sample(v, u1, u2);
    l.x = -std::abs(l.x);
    return l;
  };
  std::vector<std::string> checks;
  for (const auto& failure : judged(values_of(hole, 16, 3, 20'000)).failures)
    checks.push_back(failure.check);
  EXPECT_THAT(checks, testing::Contains("support"));
  EXPECT_THAT(checks, testing::Contains("mean-weight"));
}

TEST(BsdfChances, AreThoseOfTheTables) {
  EXPECT_NEAR(chance_of_chi_square(3.841459, 1), 0.05, 1e-6);
  EXPECT_NEAR(chance_of_chi_square(18.307038, 10), 0.05, 1e-6);
  EXPECT_NEAR(chance_of_chi_square(29.588298, 10), 0.001, 1e-8);
  EXPECT_NEAR(chance_of_chi_square(2 * 20.0, 2), std::exp(-20), 1e-14);
  EXPECT_EQ(chance_of_chi_square(1e300, 5), 0);
  EXPECT_EQ(chance_of_chi_square(std::nan(""), 5), 0);
  EXPECT_EQ(chance_of_chi_square(0, 5), 1);
  EXPECT_EQ(chance_of_mean(0, 100, 1, 1), 1);
  EXPECT_LT(chance_of_mean(0.5, 10000, 0.25, 1), 1e-100);
}

}  // namespace
}  // namespace lobelia::shader_check::bsdf

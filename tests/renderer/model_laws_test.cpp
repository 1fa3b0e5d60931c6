// Laws that every model of the catalogue obeys with every lobe.
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "renderer/highlight.hpp"
#include "renderer/models/catalogue.hpp"

namespace lobelia {
namespace {

constexpr double kPi = std::numbers::pi;

/// The integrand of the paper's table over the angle x, written out again from the table: the tests
/// must not use the weights that the coefficients are made of.
double integrand(std::string_view model, LobeId lobe, double n, double x) {
  const auto at = [&](double angle) {
    return lobe_value(lobe, 2 * std::pow(std::sin(angle / 2), 2), n);
  };
  if (model == "phong_rdf" || model == "blinn_phong_ndf") return at(x) * std::sin(x);
  if (model == "modified_phong" || model == "blinn_phong_heightfield")
    return at(x) * std::cos(x) * std::sin(x);
  if (model == "blinn_phong_rdf") return at(x / 2) * std::sin(x);
  if (model == "modified_blinn_phong") return at(x / 2) * std::cos(x) * std::sin(x);
  ADD_FAILURE() << "write the integrand of " << model << " here";
  return 0;
}

/// Energy reflected at normal incidence (of D for a distribution of normals), by quadrature.
double energy(const Highlight& h) {
  using Quadrature = boost::math::quadrature::gauss_kronrod<double, 61>;
  // For the last piece: cos^0.1 has a vertical tangent at a right angle.
  static boost::math::quadrature::tanh_sinh<double> to_the_corner;
  const std::string_view model = info(h.model).name;
  const auto f = [&](double x) { return integrand(model, h.lobe, h.exponent, x); };
  // The interval in pieces about the lobe's width, the last ones nearly empty.
  double sum = 0, begin = 0;
  for (const double factor : {1.0, 2.0, 4.0, 6.0, 8.0, 16.0, 1e9}) {
    const double end = std::min(kPi / 2, factor / std::sqrt(h.exponent));
    if (end > begin)
      sum += h.exponent > 1 || end < kPi / 2 ? Quadrature::integrate(f, begin, end, 12, 1e-12)
                                             : to_the_corner.integrate(f, begin, end, 1e-12);
    begin = std::max(begin, end);
  }
  const bool distribution = model == "blinn_phong_ndf" || model == "blinn_phong_heightfield";
  return 2 * kPi * sum * radiance_coefficient(h) * (distribution ? 4 : 1);
}

TEST(EveryModel, WithItsExactCoefficientReflectsExactlyTheEnergyThatArrives) {
  int cases = 0;
  for (const ModelId model : all_models())
    for (const LobeId lobe : all_lobes())
      for (const double n : {0.1, 1.0, 2.0, 15.9, 16.0, 54.0, 55.0, 128.0, 1024.0, 1e4, 1e6}) {
        ++cases;
        EXPECT_NEAR(energy({model, lobe, Normalisation::kExact, n}), 1, 3e-10)
            << info(model).name << " " << info(lobe).name << " n = " << n;
      }
  EXPECT_EQ(cases, int(all_models().size() * all_lobes().size() * 11));
}

TEST(EveryModel, HasTheSameExactCoefficientForCs16AndCosineAtExponent16) {
  const LobeId cosine = *find_lobe("cosine"), cs16 = *find_lobe("cs16");
  for (const ModelId model : all_models())
    EXPECT_NEAR(radiance_coefficient({model, cs16, Normalisation::kExact, 16}) /
                    radiance_coefficient({model, cosine, Normalisation::kExact, 16}),
                1, 1e-14)
        << info(model).name;
}

TEST(EveryModel, StaysFiniteWhereTheProductOfTheClosedFormOverflowsFloat32) {
  for (const ModelId model : all_models())
    for (const LobeId lobe : all_lobes())
      for (const double n : {kMinExponent, 1e8}) {
        const double c = radiance_coefficient({model, lobe, Normalisation::kExact, n});
        EXPECT_TRUE(std::isfinite(c) && c > 0) << info(model).name << " " << n;
      }
}

TEST(ThePaper, CosineColumnIsExactButForOneMisprint) {
  const LobeId cosine = *find_lobe("cosine");
  for (const ModelId model : all_models())
    for (const double n : {1.0, 16.0, 128.0, 1024.0}) {
      const double ratio = radiance_coefficient({model, cosine, Normalisation::kPaper, n}) /
                           radiance_coefficient({model, cosine, Normalisation::kExact, n});
      // 4 pi where 8 pi is true: twice the energy.
      const double expected = info(model).name == "modified_blinn_phong" ? 2 : 1;
      EXPECT_NEAR(ratio, expected, 1e-12) << info(model).name << " n = " << n;
    }
}

TEST(ThePaper, Cs16CoefficientsMissTheEnergyByTheseResiduals) {
  // Largest |1 - energy| over n = 16..1024; the paper prints 4.7e-4, 1.3e-3, 1.5e-3 and 9.5e-3 for
  // the first four: the last two of these are not reproducible.
  const std::map<std::string_view, double> expected{
      {"phong_rdf", 4.71e-4},       {"modified_phong", 1.27e-3},
      {"blinn_phong_rdf", 5.2e-3},  {"modified_blinn_phong", 5.6e-2},
      {"blinn_phong_ndf", 4.71e-4}, {"blinn_phong_heightfield", 1.27e-3}};
  const LobeId cs16 = *find_lobe("cs16");
  for (const ModelId model : all_models()) {
    double largest = 0;
    for (double n = 16; n <= 1024; n *= 1.05)
      largest = std::max(largest, std::abs(1 - energy({model, cs16, Normalisation::kPaper, n})));
    ASSERT_TRUE(expected.contains(info(model).name));
    EXPECT_NEAR(largest, expected.at(info(model).name), 0.015 * largest) << info(model).name;
  }
}

TEST(PovRay, UsesPiTimesOurCoefficientsOfTheTwoModelsThatItHas) {
  // POV-Ray 3.7's parser: `phong albedo` (n + 1)/2, `specular albedo` (n + 2)/(4 (2 - 2^(-n/2))).
  const LobeId cosine = *find_lobe("cosine");
  for (const double n : {1.0, 40.0, 1000.0}) {
    EXPECT_NEAR(
        kPi * radiance_coefficient({*find_model("phong_rdf"), cosine, Normalisation::kExact, n}),
        (n + 1) / 2, 1e-10 * n);
    EXPECT_NEAR(kPi * radiance_coefficient(
                          {*find_model("blinn_phong_rdf"), cosine, Normalisation::kExact, n}),
                (n + 2) / (4 * (2 - std::exp2(-n / 2))), 1e-10 * n);
  }
}

TEST(EveryModel, IsDarkWhereTheLightIsBelowTheHorizon) {
  for (const ModelId model : all_models())
    for (const LobeId lobe : all_lobes())
      for (const double n_dot_l : {0.0, -1e-300, -0.5, std::nan("")})
        EXPECT_EQ(highlight_radiance({model, lobe, Normalisation::kExact, 16}, n_dot_l, 0), 0);
}

TEST(EveryModel, CarriesTheCosineExactlyWhereItsCatalogueEntrySaysSo) {
  for (const ModelId model : all_models()) {
    const Highlight h{model, {}, Normalisation::kExact, 16};
    const double ratio = highlight_radiance(h, 0.25, 0.01) / highlight_radiance(h, 0.5, 0.01);
    EXPECT_NEAR(ratio, info(model).applies_cosine ? 0.5 : 1, 1e-14) << info(model).name;
  }
}

TEST(Names, LeadBackToTheirEntries) {
  for (const ModelId id : all_models()) EXPECT_EQ(find_model(info(id).name), id);
  for (const LobeId id : all_lobes()) EXPECT_EQ(find_lobe(info(id).name), id);
  EXPECT_FALSE(find_model("phong"));
  EXPECT_FALSE(find_lobe(""));
}

}  // namespace
}  // namespace lobelia

// With its exact coefficient a model's integral is 1, by adaptive quadrature of its own evaluation. How far the paper's
// coefficients are from that.
#include "renderer/reflector.hpp"
#include "tests/renderer/laws/cases.hpp"
#include "tests/renderer/laws/quadrature.hpp"

namespace lobelia {
namespace {

/// The integral over a hemisphere that the model's catalogue entry names. It meets the model through
/// eval alone: no weights, no closed form.
double normalised_integral(const Highlight& h) {
  const Reflector reflector({"", h, {1, 1, 1}, {}});
  const Vec3 normal{0, 0, 1};
  const NormalisedQuantity what = info(h.model).normalised;
  const auto integrand = [&](double angle) {
    const Vec3 direction{std::sin(angle), 0, std::cos(angle)};
    if (what == NormalisedQuantity::kRadiance)
      return reflector.eval(normal, normal, direction).r * std::sin(angle);
    // Where light and eye are one, they are the half vector: radiance = D / 4 times the geometry factor.
    const double distribution = 4 * reflector.eval(normal, direction, direction).r /
                                geometry_factor(h.model, h.exponent, direction.z, direction.z);
    const double projected = what == NormalisedQuantity::kProjectedNormals ? direction.z : 1;
    return distribution * projected * std::sin(angle);
  };
  return 2 * kPi * integrate(integrand, 1 / std::sqrt(h.exponent), kPi / 2);
}

TEST(EveryModel, IsNormalisedByItsExactCoefficientAsItsEntrySays) {
  for (const Highlight& h : highlights(every_model(), kExponents))
    EXPECT_NEAR(normalised_integral(h), 1, 3e-10) << text(h);
}

/// By how much the paper's coefficient is larger than the exact one.
double excess(ModelId model, std::string_view lobe, double n) {
  return radiance_coefficient({model, *find_lobe(lobe), Normalisation::kPaper, n}) /
             radiance_coefficient({model, *find_lobe(lobe), Normalisation::kExact, n}) -
         1;
}

TEST(ThePaper, CosineColumnIsExactButForOneMisprint) {
  for (const ModelId model : every_model())
    for (const double n : {1.0, 16.0, 128.0, 1024.0}) {
      // 4 pi where 8 pi is true: twice the energy.
      const double expected = info(model).name == "modified_blinn_phong" ? 1 : 0;
      EXPECT_NEAR(excess(model, "cosine", n), expected, 1e-12) << info(model).name << " n = " << n;
    }
}

TEST(ThePaper, Cs16CoefficientsMissTheEnergyByTheseResiduals) {
  // Largest |1 - energy| over n = 16..1024; the paper prints 4.7e-4, 1.3e-3, 1.5e-3 and 9.5e-3 for
  // the first four: the last two of these are not reproducible.
  const std::map<std::string_view, double> expected{
      {"phong_rdf", 4.71e-4},       {"modified_phong", 1.27e-3},
      {"blinn_phong_rdf", 5.2e-3},  {"modified_blinn_phong", 5.6e-2},
      {"blinn_phong_ndf", 4.71e-4}, {"blinn_phong_heightfield", 1.27e-3}};
  for (const auto& [name, residual] : expected) {
    double largest = 0;
    for (double n = 16; n <= 1024; n *= 1.05)
      largest = std::max(largest, std::abs(excess(*find_model(name), "cs16", n)));
    EXPECT_NEAR(largest, residual, 0.015 * largest) << name;
  }
}

}  // namespace
}  // namespace lobelia

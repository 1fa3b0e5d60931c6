// What an exact coefficient makes 1, by adaptive quadrature of the model's own evaluation.
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

TEST(EveryModel, WithItsExactCoefficientIsNormalisedAsItsCatalogueEntrySays) {
  for (const Highlight& h : highlights(every_model(), kExponents))
    EXPECT_NEAR(normalised_integral(h), 1, 3e-10) << text(h);
}

TEST(EveryModel, WithAPaperCoefficientIsNormalisedByTheRatioOfTheTwo) {
  for (const Highlight& h : highlights(every_model(), kExponents, Normalisation::kPaper)) {
    Highlight exact = h;
    exact.normalisation = Normalisation::kExact;
    const double ratio = radiance_coefficient(h) / radiance_coefficient(exact);
    EXPECT_NEAR(normalised_integral(h), ratio, 3e-10 * ratio) << text(h);
  }
}

TEST(EveryModel, HasAFiniteCoefficientAtTheEndsOfTheExponents) {
  for (const Highlight& h :
       highlights_of_both(every_model(), std::vector{kMinExponent, kMaxExponent})) {
    const double c = radiance_coefficient(h);
    EXPECT_TRUE(std::isfinite(c) && c > 0) << text(h);
  }
}

}  // namespace
}  // namespace lobelia

// Directional albedo: the quadrature against another one, and what holds for every model.
#include "renderer/albedo.hpp"

#include "renderer/reflector.hpp"
#include "tests/more_samples.hpp"
#include "tests/renderer/laws/cases.hpp"

namespace lobelia {
namespace {

constexpr double kIncidences[] = {0, 1, 30, 45, 60, 80, 89, 89.9, 89.99};

Vec3 direction(double polar, double azimuth) {
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
          std::cos(polar)};
}

/// By brute force: midpoints of a grid of light directions, which knows nothing of lobes.
struct BruteForce {
  double seen = 0, of_light = 0;
  BruteForce(const Highlight& h, double incidence) {
    const Reflector reflector({"", h, {1, 1, 1}, {}});
    const Vec3 normal{0, 0, 1}, fixed = direction(incidence, 0);
    constexpr int kPolar = 300, kAzimuth = 200;
    for (int i = 0; i < kPolar; ++i) {
      const double polar = kPi / 2 * (i + 0.5) / kPolar;
      for (int j = 0; j < kAzimuth; ++j) {
        const Vec3 moving = direction(polar, kPi * (j + 0.5) / kAzimuth);
        const double solid_angle = std::sin(polar) * kPi / 2 / kPolar * 2 * kPi / kAzimuth;
        seen += solid_angle * reflector.eval(normal, fixed, moving).r;
        of_light += solid_angle * reflector.eval(normal, moving, fixed).r * moving.z / fixed.z;
      }
    }
  }
};

TEST(DirectionalAlbedo, IsTheSumOverAGridOfDirections) {
  for (const Highlight& h : some_of(highlights_of_both(every_model(), std::vector{8.0}), 9))
    for (const double degrees : {0.0, 50.0, 85.0}) {
      const BruteForce sum(h, radians(degrees));
      // Steps of 0.005 and 0.016; the RDF models jump at the horizon and all lobes bend at s = 1.
      EXPECT_NEAR(directional_albedo(h, radians(degrees)), sum.seen, 2e-4)
          << text(h) << " at " << degrees;
      EXPECT_NEAR(directional_albedo_of_light(h, radians(degrees)), sum.of_light,
                  2e-4 / std::cos(radians(degrees)))
          << text(h) << " at " << degrees;
    }
}

TEST(DirectionalAlbedo, IsForTheFirstPowerTheSkyAsATiltedPlaneSeesIt) {
  // Phong (RDF) with n = 1 is L.R / pi: the irradiance on a plane with the normal R, of which
  // (1 + cos) / 2 sees the sky. The lobe and the horizon cut each other at every incidence.
  const Highlight h{*find_model("phong_rdf"), *find_lobe("cosine"), Normalisation::kExact, 1};
  for (const double degrees : kIncidences)
    EXPECT_NEAR(directional_albedo(h, radians(degrees)), (1 + std::cos(radians(degrees))) / 2,
                1e-11)
        << degrees;
}

TEST(DirectionalAlbedo, IsTheSameForLightOrEyeOnlyWithTheCosine) {
  for (const Highlight& h : some_of(highlights_of_both(every_model(), kExponents))) {
    double largest = 0;
    for (const double degrees : kIncidences) {
      const double seen = directional_albedo(h, radians(degrees)),
                   of_light = directional_albedo_of_light(h, radians(degrees));
      EXPECT_TRUE(std::isfinite(seen) && seen >= 0) << text(h) << " at " << degrees;
      EXPECT_TRUE(std::isfinite(of_light) && of_light >= 0) << text(h) << " at " << degrees;
      largest = std::max(largest, std::abs(seen - of_light) / std::max(seen, of_light));
    }
    // An RDF's differ most at 89.99 degrees; least, by 1.1e-3, where a lobe is narrower than what is
    // left to the horizon.
    EXPECT_TRUE(info(h.model).applies_cosine ? largest < 1e-13 : largest > 1e-3)
        << text(h) << ": " << largest;
  }
}

/// Schlick's tail falls like 1 / s only. As a distribution of normals under Smith's shadowing for GGX it is no surface: the
/// shadowing belongs to a tail that falls like 1 / s^2, and unless the lobe is broad anyway, more is reflected than arrives
/// at grazing angles.
bool is_a_surface(const Highlight& h) {
  return !(info(h.model).has_shadowing && info(h.lobe).name == "schlick" && h.exponent >= 16);
}

TEST(EveryModel, SendsNoMoreToAnyEyeThanTheSkyHolds) {
  for (const Highlight& h :
       some_of(highlights(every_model(), std::vector{0.1, 16.0, 1024.0, 1e6}), 5)) {
    const AlbedoPeak peak = largest_albedo(h);
    EXPECT_EQ(peak.above_one_from.has_value(), !is_a_surface(h)) << text(h) << ": " << peak.albedo;
    // Shadowing leaves more at grazing angles, where GGX brightens.
    if (!info(h.model).has_shadowing) {
      EXPECT_EQ(peak.incidence, 0) << text(h);
    }
  }
}

TEST(EveryModel, ReturnsMoreThanArrivesTowardsGrazingExactlyWhereItLacksTheCosine) {
  for (const Highlight& h : some_of(highlights(every_model(), std::vector{0.1, 16.0, 1024.0}), 4)) {
    const AlbedoPeak peak = largest_albedo_of_light(h);
    const bool makes_light = !info(h.model).applies_cosine || !is_a_surface(h);
    EXPECT_EQ(peak.albedo > 1 + 1e-9, makes_light) << text(h);
    EXPECT_EQ(peak.above_one_from.has_value(), makes_light) << text(h);
  }
}

TEST(LargestAlbedo, IsReachedAtItsStatedAngle) {
  for (const Highlight& h : some_of(highlights(every_model(), std::vector{0.1, 16.0, 1e4}), 13)) {
    const AlbedoPeak seen = largest_albedo(h), of_light = largest_albedo_of_light(h);
    EXPECT_NEAR(directional_albedo(h, seen.incidence), seen.albedo, 1e-9) << text(h);
    EXPECT_NEAR(directional_albedo_of_light(h, of_light.incidence), of_light.albedo,
                1e-9 * of_light.albedo)
        << text(h);
    if (of_light.above_one_from) {
      EXPECT_GT(directional_albedo_of_light(h, *of_light.above_one_from), 1) << text(h);
      EXPECT_LE(directional_albedo_of_light(h, *of_light.above_one_from - 1e-6), 1 + 1e-9);
    }
    for (double incidence = 0; incidence <= kMostGrazing; incidence += 0.171) {
      EXPECT_LE(directional_albedo(h, incidence), seen.albedo + 2e-9) << text(h);
      EXPECT_LE(directional_albedo_of_light(h, incidence), of_light.albedo + 2e-9) << text(h);
    }
  }
}

TEST(LargestAlbedo, HasTheFiguresOfTheConventions) {
  const auto of_light = [](const char* model) {
    return largest_albedo_of_light(
        {*find_model(model), *find_lobe("cosine"), Normalisation::kExact, 16});
  };
  EXPECT_NEAR(of_light("phong_rdf").albedo, 531.8, 0.1);
  EXPECT_NEAR(*of_light("phong_rdf").above_one_from, radians(74.3), radians(0.05));
  EXPECT_NEAR(of_light("blinn_phong_rdf").albedo, 287.3, 0.1);
  EXPECT_NEAR(*of_light("blinn_phong_rdf").above_one_from, radians(86.1), radians(0.05));
}

}  // namespace
}  // namespace lobelia

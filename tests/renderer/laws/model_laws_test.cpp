// Every model multiplies its lobe by the cosine where it should, is black below the horizon, and is finite.
#include "base/words/constants.hpp"
#include "renderer/albedo.hpp"
#include "renderer/reflector.hpp"
#include "tests/more_samples.hpp"
#include "tests/renderer/laws/cases.hpp"
#include "tests/renderer/laws/directions.hpp"
#include "tests/renderer/laws/quadrature.hpp"

namespace lobelia {
namespace {

/// Smith's G / ((N.L) (N.V)) for GGX as Heitz prints it.
double textbook_shadowing(double exponent, double n_dot_l, double n_dot_v) {
  const auto lambda = [&](double c) {
    return (std::sqrt(1 + 2 / (exponent + 2) * (1 / (c * c) - 1)) - 1) / 2;
  };
  return 1 / ((1 + lambda(n_dot_l) + lambda(n_dot_v)) * n_dot_l * n_dot_v);
}

TEST(EveryModel, HasTheFactorsOfItsCatalogueEntry) {
  for (const Highlight& h : highlights_of_both(every_model(), kExponents))
    for (const double n_dot_l : {1e-9, 0.25, 0.5, 1.0})
      for (const double n_dot_v : {1e-9, 0.3, 1.0}) {
        const double factor =
            (info(h.model).applies_cosine ? n_dot_l : 1) *
            (info(h.model).has_shadowing ? textbook_shadowing(h.exponent, n_dot_l, n_dot_v) : 1);
        EXPECT_NEAR(highlight_radiance(h, n_dot_l, n_dot_v, 0), radiance_coefficient(h) * factor,
                    1e-14 * radiance_coefficient(h) * std::max(1.0, factor))
            << text(h);
        EXPECT_LE(factor, largest_shadowing(h.model, h.exponent)) << text(h);
      }
}

TEST(EveryModel, IsDarkWhereTheLightIsBelowTheHorizon) {
  for (const Highlight& h : highlights_of_both(every_model(), kExponents))
    for (const double n_dot_l : {0.0, -1e-300, -0.5, std::nan("")})
      EXPECT_EQ(highlight_radiance(h, n_dot_l, 0.5, 0), 0) << text(h);
}

TEST(EveryModel, IsFiniteWithoutNegativesAboveTheHorizon) {
  const Frame frame;
  for (const Highlight& h : highlights_of_both(every_model(), kExponents)) {
    const Reflector reflector({"", h, {1, 1, 1}, {0.5, 0.5, 0.5}, Fresnel::kSchlick});
    for (const Pair& p : direction_pairs(frame, h.exponent)) {
      const double radiance = reflector.eval(frame.normal, p.to_eye, p.to_light).r;
      const double pdf = reflector.pdf(frame.normal, p.to_eye, p.to_light);
      EXPECT_TRUE(std::isfinite(radiance) && radiance >= 0) << text(h) << ": " << radiance;
      EXPECT_TRUE(std::isfinite(pdf) && pdf >= 0) << text(h) << ": " << pdf;
    }
  }
}

TEST(EveryModel, IsZeroBelowTheHorizonOrForNoDirection) {
  const Vec3 up{0, 0, 1}, down{0.1, 0, -1}, aside{1, 0, 0};
  const Vec3 none[] = {{0, 0, 0}, {kInfinity, 0, 1}, {0, std::nan(""), 1}};
  for (const Highlight& h : highlights(every_model(), std::vector{16.0})) {
    const Reflector reflector({"", h, {1, 1, 1}, {1, 1, 1}});
    std::vector<std::array<Vec3, 3>> cases{
        {up, up, down}, {up, down, up}, {up, up, aside}, {up, aside, up}};
    for (const Vec3 v : none) cases.insert(cases.end(), {{v, up, up}, {up, v, up}, {up, up, v}});
    for (const auto& [normal, to_eye, to_light] : cases) {
      EXPECT_EQ(reflector.eval(normal, to_eye, to_light), Rgb{}) << text(h);
      EXPECT_EQ(reflector.pdf(normal, to_eye, to_light), 0) << text(h);
    }
    for (const Vec3 v : {none[0], none[1], none[2], down, aside})
      EXPECT_FALSE(reflector.sample(up, v, 0, 0.5, 0.5)) << text(h);
  }
}

TEST(EveryModel, AsksDirectionsForNoLength) {
  const Frame frame;
  for (const Highlight& h : highlights(every_model(), std::vector{16.0})) {
    const Reflector reflector({"", h, {1, 1, 1}, {1, 1, 1}});
    const Vec3 to_eye = frame(0.6, 1), to_light = frame(0.5, 4);
    const double radiance = reflector.eval(frame.normal, to_eye, to_light).r;
    for (const double length : {1e-300, 1e-3, 1e300})
      EXPECT_NEAR(
          reflector.eval(length * frame.normal, length * to_eye, length * to_light).r / radiance, 1,
          1e-12)
          << text(h) << " " << length;
  }
}

TEST(Names, LeadBackToTheirEntries) {
  for (const ModelId id : every_model()) EXPECT_EQ(find_model(info(id).name), id);
  for (const LobeId& id : lobes()) EXPECT_EQ(find_lobe(info(id).name), id);
  EXPECT_FALSE(find_model("phong"));
  for (const char* name : {"", "cs", "cs0", "cs1", "cs15", "cs1026", "cs-2", "cs016", "cs2 ", "pk",
                           "pk3", "pk3.0", "pk3.5", "pk4", "pk3_2", "pk3.20"})
    EXPECT_FALSE(find_lobe(name)) << name;
}

// Helmholtz reciprocity, f_r(L, V) = f_r(V, L): of every model that carries the cosine, and of no other.

std::vector<ModelId> brdfs() {
  return models_where([](const ModelInfo& m) { return m.applies_cosine; });
}

/// f_r read out of the radiance.
double brdf(const Reflector& reflector, Vec3 normal, Vec3 to_eye, Vec3 to_light) {
  return reflector.eval(normal, to_eye, to_light).r / dot(normal, to_light);
}

TEST(EveryBrdf, IsTheSameWithLightAndEyeExchanged) {
  const Frame frame;
  for (const Highlight& h : highlights_of_both(brdfs(), kExponents)) {
    const double coefficient = radiance_coefficient(h);
    int bright = 0;
    for (const Rgb diffuse : {Rgb{}, Rgb{0.5, 0.5, 0.5}}) {
      const Reflector reflector({"", h, {0.2, 0.2, 0.2}, diffuse, Fresnel::kSchlick});
      for (const Pair& p : direction_pairs(frame, h.exponent)) {
        const double there = brdf(reflector, frame.normal, p.to_eye, p.to_light),
                     back = brdf(reflector, frame.normal, p.to_light, p.to_eye);
        // Unit vectors are rounded: 1e-16 to N.L, of which what is left is divided by, and to
        // a lobe that is up to sqrt(n) steep.
        const double cosine = std::min(dot(frame.normal, p.to_eye), dot(frame.normal, p.to_light));
        EXPECT_NEAR(there, back, std::max(coefficient, there) * (1e-12 + 1e-15 / cosine))
            << text(h);
        bright += there > 0.01 * coefficient;
      }
    }
    EXPECT_GT(bright, 10) << text(h) << ": the pairs miss the highlight";
  }
}

TEST(ReciprocityGap, IsRoundingForBrdfsButLargeForRdfs) {
  for (const Highlight& h : highlights_of_both(every_model(), kExponents)) {
    const double gap = reciprocity_gap(h);
    // The gap of an RDF is about the lobe's width over the cosine at the last eye, 85 degrees.
    EXPECT_TRUE(info(h.model).applies_cosine
                    ? gap < 1e-11
                    : gap < 1 && gap > std::min(0.25, 5 / std::sqrt(h.exponent)))
        << text(h) << ": " << gap;
  }
}

// With its exact coefficient a model's integral is 1, by adaptive quadrature of its own evaluation. How far the paper's
// coefficients are from that.

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

// Directional albedo: the quadrature against another one, and what holds for every model.

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

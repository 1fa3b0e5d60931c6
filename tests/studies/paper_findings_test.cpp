// What of the paper holds: every verdict and every figure that docs/errata.md leans on. Values come
// from an independent calculation or a closed form; tolerances are about half a unit of what is printed.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/studies/measured_claims.hpp"

namespace lobelia::paper {
namespace {

const Claim& claim(std::string_view name) {
  for (const Claim& candidate : measured_claims())
    if (candidate.name == name) return candidate;
  throw std::out_of_range("no claim " + std::string(name));
}

TEST(PaperFindings, every_claim_of_the_catalogue_has_the_verdict_that_is_known) {
  const std::map<std::string_view, std::string_view> known = {
      {"cs16-largest-error", kConfirmed},
      {"cs16-smallest-error", kNotReproduced},
      {"cs16-without-power", kNotReproduced},
      {"cs16-operations", kConfirmed},
      {"cs16-normalised", kFound},
      {"cs16-tail", kFound},
      {"theta-cr", kConfirmed},
      {"theta-cr-beyond", kConfirmed},
      {"theta-cr-growth", kConfirmed},
      {"residual-phong-rdf", kConfirmed},
      {"residual-modified-phong", kConfirmed},
      {"residual-blinn-phong-rdf-cut", kConfirmed},
      {"residual-blinn-phong-rdf", kNotReproduced},
      {"residual-modified-blinn-phong", kNotReproduced},
      {"residual-distributions", kConfirmed},
      {"cosine-column", kConfirmed},
      {"cosine-modified-blinn-phong", kNotReproduced},
      {"factor-1.063", kConfirmed},
      {"best-digits", kFound},
      {"bounds-blinn-phong-rdf", kConfirmed},
      {"bounds-modified-blinn-phong", kNotReproduced},
      {"bounds-of-cs16", kFound},
      {"outside-the-range", kFound},
      {"schlick-epicentre", kNotReproduced},
      {"schlick-epicentre-inflection", kConfirmed},
      {"schlick-tail", kConfirmed},
      {"schlick-division", kConfirmed},
      {"schlick-cost", kConfirmed},
      {"gauss-accuracy", kConfirmed},
      {"gauss-inverse-cosine", kConfirmed},
      {"gauss-angle", kNotReproduced},
      {"more-accurate-lobe", kNotReproduced},
      {"more-accurate-energy", kConfirmed},
      {"more-accurate-normalised", kNotReproduced},
      {"reciprocity-brdf", kConfirmed},
      {"reciprocity-rdf", kNotReproduced},
      {"energy-cs16", kNotReproduced},
      {"energy-brdf", kConfirmed},
      {"energy-rdf-seen", kConfirmed},
      {"energy-rdf-lit", kNotReproduced},
      {"distribution-as-rdf", kFound},
      {"distribution-as-brdf", kFound},
      {"renderer-constants", kFound},
  };
  EXPECT_EQ(measured_claims().size(), known.size());
  for (const Claim& measured : measured_claims()) {
    ASSERT_TRUE(known.contains(measured.name)) << "pin the verdict of " << measured.name;
    EXPECT_EQ(measured.verdict, known.at(measured.name)) << measured.name;
  }
}

struct Pin {
  std::string_view claim;
  std::size_t figure;
  double value, tolerance;
};

TEST(PaperFindings, have_the_measured_figures_that_are_known) {
  const double pi_by_180 = std::acos(-1) / 180;
  const Pin pins[] = {
      {"cs16-largest-error", 0, 0.017012, 1e-6},
      {"cs16-smallest-error", 0, 0, 1e-15},
      {"cs16-smallest-error", 1, 10.369, 5e-3},
      {"cs16-operations", 0, 4, 0},
      {"cs16-normalised", 0, 1.063 * 1024 / 1025 - 1, 1e-12},
      {"cs16-tail", 0, 0.92053, 1e-5},
      {"cs16-tail", 2, 0.290, 5e-4},
      {"theta-cr", 0, 6 / 32.0 / std::acos(1008 / 1024.0) - 1, 1e-12},
      {"theta-cr", 1, 1 - 1.5 / (90 * pi_by_180), 1e-12},
      {"theta-cr-beyond", 0, std::pow(1 - 64 * (1 - std::cos(6 / 32.0)), 16), 1e-19},
      {"theta-cr-beyond", 1, std::pow(std::cos(1.5), 16), 1e-22},
      {"residual-phong-rdf", 0, 1.063 * 16 / 17 - 1, 1e-12},
      {"residual-modified-phong", 0, 1.27456e-3, 1e-8},
      {"residual-modified-phong", 1, 1.00044, 1e-5},
      {"residual-blinn-phong-rdf-cut", 0, 1.52910e-3, 1e-8},
      {"residual-blinn-phong-rdf-cut", 1, 1 - 9.56e-4, 1e-6},
      {"residual-blinn-phong-rdf", 0, 5.20784e-3, 1e-8},
      {"residual-modified-blinn-phong", 0, 5.6125e-2, 1e-6},
      {"residual-modified-blinn-phong", 2, 0.9677, 1e-4},
      {"residual-distributions", 0, 1.063 * 16 / 17 - 1, 1e-12},
      {"residual-distributions", 1, 1.27456e-3, 1e-8},
      {"cosine-modified-blinn-phong", 0, 2, 1e-12},
      {"factor-1.063", 0, 17 / 16.0, 1e-12},
      {"best-digits", 0, 4.4e-4, 1e-5},
      {"best-digits", 1, 1.3e-3, 5e-5},
      {"best-digits", 2, 5.4e-3, 5e-5},
      {"bounds-of-cs16", 0, 3.04 / 0.068, 1e-12},
      {"outside-the-range", 0, 1.063 * 16 / 17 * (1 - std::pow(15 / 16.0, 17)), 1e-12},
      // The relative error, which is the paper's word; as a share of the peak; and over the hemisphere.
      {"schlick-epicentre", 0, 0.181, 5e-4},
      {"schlick-epicentre", 2, 9.05e-2, 1e-4},
      {"schlick-epicentre", 3, 0.2034, 5e-4},
      {"schlick-epicentre-inflection", 0, 9.91e-2, 1e-4},
      // At n = 32 the base is -1 at a right angle, and theta_cr is 60 degrees.
      {"theta-cr-growth", 0, 1.5, 1e-12},
      {"theta-cr-growth", 1, std::asin(std::sqrt(1 / 64.0)) / std::asin(std::sqrt(1 / 128.0)),
       1e-12},
      {"theta-cr-growth", 3, std::pow(63, 16), 1e16},
      {"theta-cr-growth", 4, 32, 1e-12},
      {"schlick-cost", 0, 2, 0},
      {"schlick-cost", 2, 3, 0},
      {"schlick-cost", 4, 4, 0},   // n = 16: four squarings
      {"schlick-cost", 5, 18, 0},  // n = 1023: nine, and nine products
      {"gauss-angle", 0, std::exp(-8 * std::pow(45 * pi_by_180, 2)), 1e-15},
      {"gauss-angle", 1, 1, 0},
      // c - c^16 is largest where 16 c^15 = 1.
      {"cs16-without-power", 0, 15 / 16.0 * std::pow(16, -1 / 15.0), 1e-12},
      {"cs16-without-power", 1, 0.017012, 1e-6},
      {"more-accurate-lobe", 0, 0.017012, 1e-6},
      {"more-accurate-lobe", 1, 0.2034, 5e-4},
      {"more-accurate-lobe", 2, 1.15684e-2, 1e-7},
      {"more-accurate-lobe", 3, 26.4687, 1e-3},
      {"more-accurate-energy", 0, 5.6125e-2, 1e-6},
      {"more-accurate-energy", 1, 1 - 2 * std::acos(-1) / 1026, 1e-12},
      {"more-accurate-normalised", 0, 1.063 * 16 / 17 - 1, 1e-12},
      {"schlick-tail", 1, std::acos(16 / 270.0) / pi_by_180, 1e-9},
      {"schlick-tail", 5, 6.17, 5e-3},
      {"gauss-accuracy", 0, 1.15684e-2, 1e-7},
      {"gauss-accuracy", 3, 1.84, 5e-3},
      {"gauss-inverse-cosine", 3, 1.73e-2, 1e-4},
      {"reciprocity-rdf", 0, std::cos(5 * pi_by_180) / std::cos(85 * pi_by_180), 1e-9},
      {"energy-cs16", 0, 1.005208, 1e-6},
      {"energy-brdf", 0, 1, 1e-8},
      {"energy-brdf", 1, 0.50000, 1e-5},
      {"energy-brdf", 2, 0.27376, 1e-5},
      {"energy-rdf-seen", 0, 1, 1e-8},
      // Phong's lobe has the mean cosine (n+1)/(n+2) about its axis.
      {"energy-rdf-lit", 2, 17 / 18.0, 1e-8},
      {"energy-rdf-lit", 1, 74.3, 0.05},
      {"energy-rdf-lit", 4, 85.6, 0.05},
      {"energy-rdf-lit", 8, 0.80176, 1e-5},
      {"distribution-as-rdf", 0, 4 * 17 / 18.0 * (1 - std::exp2(-9)), 1e-12},
      {"distribution-as-brdf", 0, 0.75574, 1e-5},
      {"distribution-as-brdf", 2, 0.80020, 1e-5},
      {"renderer-constants", 0, 0, 1e-14},
  };
  for (const Pin& pin : pins) {
    ASSERT_LT(pin.figure, claim(pin.claim).measured.size()) << pin.claim;
    const Figure& figure = claim(pin.claim).measured[pin.figure];
    EXPECT_NEAR(figure.value, pin.value, pin.tolerance) << pin.claim << ": " << figure.what;
  }
}

TEST(PaperFindings, speak_of_the_relative_error_of_schlicks_lobe_as_the_paper_does) {
  for (const char* name : {"schlick-epicentre", "schlick-epicentre-inflection"}) {
    EXPECT_NE(claim(name).statement.find("relative error"), std::string::npos) << name;
    EXPECT_NE(claim(name).measured[0].what.find("of the local value"), std::string::npos) << name;
  }
}

TEST(PaperFindings, rdfs_reflect_more_than_arrives_towards_grazing_light_and_brdfs_never) {
  EXPECT_GT(claim("energy-rdf-lit").measured[0].value, 50);
  EXPECT_LT(claim("energy-brdf").measured[0].value, 1 + 1e-8);
}

TEST(PaperFindings, no_misprint_of_one_digit_reaches_the_printed_residual_of_row_4) {
  EXPECT_GT(claim("best-digits").measured[3].value, 9.55e-3);
}

}  // namespace
}  // namespace lobelia::paper

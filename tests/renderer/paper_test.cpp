// Numbers that the paper and POV-Ray print, beside ours.
#include <map>

#include "renderer/albedo.hpp"
#include "tests/renderer/laws/cases.hpp"

namespace lobelia {
namespace {

const LobeId kCosine = *find_lobe("cosine"), kCs16 = *find_lobe("cs16");

/// By how much the paper's coefficient is larger than the exact one.
double excess(ModelId model, LobeId lobe, double n) {
  return radiance_coefficient({model, lobe, Normalisation::kPaper, n}) /
             radiance_coefficient({model, lobe, Normalisation::kExact, n}) -
         1;
}

TEST(ThePaper, CosineColumnIsExactButForOneMisprint) {
  for (const ModelId model : every_model())
    for (const double n : {1.0, 16.0, 128.0, 1024.0}) {
      // 4 pi where 8 pi is true: twice the energy.
      const double expected = info(model).name == "modified_blinn_phong" ? 1 : 0;
      EXPECT_NEAR(excess(model, kCosine, n), expected, 1e-12) << info(model).name << " n = " << n;
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
      largest = std::max(largest, std::abs(excess(*find_model(name), kCs16, n)));
    EXPECT_NEAR(largest, residual, 0.015 * largest) << name;
  }
}

TEST(ThePaper, SaysThatTheModelsAreReciprocalAndTheRdfsAreNot) {
  for (const char* name : {"phong_rdf", "blinn_phong_rdf"})
    EXPECT_GT(reciprocity_gap({*find_model(name), kCosine, Normalisation::kPaper, 16}), 0.9);
}

TEST(ThePaper, SpeaksOfEnergyAtNormalIncidenceOnly) {
  // The table of docs/conventions.md: what an RDF returns of light near grazing.
  const auto of_light = [](const char* model, double n) {
    return largest_albedo_of_light({*find_model(model), kCosine, Normalisation::kExact, n});
  };
  EXPECT_NEAR(of_light("phong_rdf", 16).albedo, 531.8, 0.1);
  EXPECT_NEAR(*of_light("phong_rdf", 16).above_one_from, radians(74.3), radians(0.05));
  EXPECT_NEAR(of_light("blinn_phong_rdf", 16).albedo, 287.3, 0.1);
  EXPECT_NEAR(*of_light("blinn_phong_rdf", 16).above_one_from, radians(86.1), radians(0.05));
}

TEST(PovRay, UsesPiTimesOurCoefficientsOfTheTwoModelsThatItHas) {
  // POV-Ray 3.7's parser: `phong albedo` (n + 1)/2, `specular albedo` (n + 2)/(4 (2 - 2^(-n/2))).
  for (const double n : {1.0, 40.0, 1000.0}) {
    EXPECT_NEAR(
        kPi * radiance_coefficient({*find_model("phong_rdf"), kCosine, Normalisation::kExact, n}),
        (n + 1) / 2, 1e-10 * n);
    EXPECT_NEAR(kPi * radiance_coefficient(
                          {*find_model("blinn_phong_rdf"), kCosine, Normalisation::kExact, n}),
                (n + 2) / (4 * (2 - std::exp2(-n / 2))), 1e-10 * n);
  }
}

}  // namespace
}  // namespace lobelia

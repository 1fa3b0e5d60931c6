// The findings of `lobelia check-shader --bsdf` on the functions eval, sample and pdf of a shader.
#pragma once

#include "base/records/struct_type.hpp"

namespace lobelia::records {

inline constexpr std::string_view kBsdfVerdicts[] = {"passes", "fails"};
/// In the order of a report.
inline constexpr std::string_view kBsdfChecks[] = {
    "finite",        "unit-direction", "random-numbers", "pdf-integral", "samples-lost",
    "chi-square",    "mean-direction", "pdf-at-samples", "support",      "mean-weight",
    "pdf-of-sample", "weight",         "energy"};

/// One exponent, and one angle of the eye.
struct BsdfSetting {
  double exponent = 0, eye_degrees = 0;
  double pdf_above = 0, pdf_below = 0, quadrature_error = 0;
  std::size_t samples = 0, samples_below = 0, samples_rejected = 0;
  double chi_square = 0, freedom = 0, chance = 0;
  double albedo = 0, albedo_of_samples = 0, not_reciprocal = 0;
};

/// A test that failed, where it failed most.
struct BsdfFailure {
  std::string check, sentence;
  double exponent = 0, eye_degrees = 0;
  std::size_t settings = 0;
};

/// A mistake that explains failures: with it put right, in double, the tests pass.
struct BsdfExplanation {
  std::string mistake, sentence;
};

struct BsdfCheck {
  std::vector<std::string> command;
  std::string file, sha256, language, eval, sample, pdf;
  std::string api, device, driver;
  std::string verdict;
  double false_alarms = 0;
  std::size_t random_tests = 0;
  bool eval_has_cosine = false;
  bool reciprocal = false;
  std::vector<BsdfSetting> settings;
  std::vector<BsdfFailure> failures;
  std::vector<BsdfExplanation> explanations;
  std::vector<std::string> remarks;
};

void define_bsdf_check_tables(Tables& tables);

}  // namespace lobelia::records

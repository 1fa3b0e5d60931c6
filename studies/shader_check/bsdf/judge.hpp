// The verdict on a BSDF, from values alone.
#pragma once

#include <functional>

#include "base/records/bsdf_check.hpp"
#include "studies/shader_check/bsdf/values.hpp"

namespace lobelia::shader_check::bsdf {

/// The chance that a right BSDF fails a random test of a run.
inline constexpr double kFalseAlarms = 1e-6;
/// The share of samples of which a given weight or pdf may be off by more than kRounding: float32 knows a narrow lobe less
/// well than its values.
inline constexpr double kFewSamples = 0.01, kRounding = 2e-3;

/// A pdf put right: what a direction's pdf is multiplied by, and whether lost samples are no samples at all.
struct PdfCorrection {
  std::function<double(const BsdfSettingValues&, Vec3 light)> factor;  ///< empty: 1
  bool drops_lost = false;
};

/// The tests of one setting that need the pdf.
struct PdfTests {
  double above = 0, below = 0, error = 0;
  std::size_t samples_below = 0, samples_rejected = 0;
  double chi_square = 0, freedom = 0;
  double chance_of_shape = 1, chance_of_lost = 1, chance_of_mean = 1, chance_of_weight = 1;
  double albedo = 0, albedo_error = 0, albedo_of_samples = 0;
  double share_without_pdf = 0;  ///< of the albedo, in directions where pdf is 0
  double samples_without_pdf = 0;
  bool is_known = true;  ///< the integral of pdf is, well enough for random tests

  /// Whether sample() follows pdf, each random test having the chance `level` of a false alarm.
  bool follows(double level) const;
  bool is_density() const;
};
PdfTests pdf_tests(const BsdfSettingValues& setting, bool eval_has_cosine,
                   const PdfCorrection& correction = {});

/// Whether enough settings have a known integral.
bool are_known(std::size_t unknown, const BsdfValues& values);

/// The number of random tests of a run.
std::size_t random_tests(const BsdfValues& values);
double level_of_each(const BsdfValues& values);

/// Whether eval includes the cosine of the light: it is then reciprocal only without it.
bool eval_has_cosine(const BsdfValues& values);

/// eval with the cosine of the light.
double reflected(double eval, Vec3 light, bool has_cosine);

/// Sets the verdict, settings, failures and remarks of a record.
void judge_bsdf(const BsdfValues& values, records::BsdfCheck& record);

}  // namespace lobelia::shader_check::bsdf

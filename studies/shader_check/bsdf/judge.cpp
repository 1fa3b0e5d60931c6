#include "studies/shader_check/bsdf/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/shader_check/bsdf/chances.hpp"

namespace lobelia::shader_check::bsdf {
namespace {

constexpr int kTestsOfSetting = 6;  ///< shape, lost, three means, weight
constexpr double kLeastExpected = 50;
/// An integral's error by float32 and the grids: up to 1.3e-3 where max(0, cosine) has its edge in the hemisphere.
constexpr double kOfIntegral = 3e-3;
/// More than this of a cell's share would be seen as a wrong chi square.
constexpr double kMostError = 5e-3;

double known(double value) { return std::isfinite(value) ? value : 0; }

struct Integrals {
  double pdf = 0, albedo = 0, of_square = 0, largest = 0, without_pdf = 0;
  Vec3 mean, square;
};

struct Tester {
  const BsdfSettingValues& setting;
  bool has_cosine;
  const PdfCorrection& correction;

  double pdf(double value, Vec3 light) const {
    return known(value) * (correction.factor ? known(correction.factor(setting, light)) : 1);
  }

  Integrals integrals(const GridValues& grid) const {
    Integrals sum;
    for (std::size_t i = 0; i < grid.values.size(); ++i) {
      const auto& node = grid.grid.nodes()[i];
      const Vec3 d = node.direction;
      const double p = pdf(grid.values[i].pdf, d),
                   f = reflected(known(grid.values[i].eval), d, has_cosine);
      sum.pdf += node.solid_angle * p;
      sum.albedo += node.solid_angle * f;
      sum.mean = sum.mean + node.solid_angle * p * d;
      sum.square = sum.square + node.solid_angle * p * Vec3{d.x * d.x, d.y * d.y, d.z * d.z};
      if (p > 0) {
        sum.of_square += node.solid_angle * f * f / p;
        sum.largest = std::max(sum.largest, f / p);
      } else {
        sum.without_pdf += node.solid_angle * f;
      }
    }
    return sum;
  }

  /// Cells with too few expected samples are taken together.
  void chi_square(const std::vector<double>& seen, double count, const Integrals& sum,
                  PdfTests& tests) const {
    std::vector<double> expected(seen.size());
    for (std::size_t i = 0; i < setting.above.values.size(); ++i) {
      const auto& node = setting.above.grid.nodes()[i];
      expected[node.cell] +=
          node.solid_angle * pdf(setting.above.values[i].pdf, node.direction) / sum.pdf * count;
    }
    double e = 0, s = 0, left_e = 0, left_s = 0;
    std::size_t bins = 0;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      e += expected[k], s += seen[k];
      if (e >= kLeastExpected) {
        tests.chi_square += (s - e) * (s - e) / e;
        ++bins;
        e = s = 0;
      }
    }
    left_e = e, left_s = s;
    if (left_e > 5) {
      tests.chi_square += (left_s - left_e) * (left_s - left_e) / left_e;
      ++bins;
    } else if (left_s > left_e + 20) {
      // Samples where pdf expects none.
      tests.chi_square += (left_s - left_e) * (left_s - left_e);
      ++bins;
    }
    tests.freedom = bins > 1 ? double(bins - 1) : 0;
    tests.chance_of_shape = chance_of_chi_square(tests.chi_square, tests.freedom);
  }
};

double two_sided(double distance, double error) { return std::abs(distance) - error; }

std::string at(const BsdfSettingValues& setting) {
  return fmt::format("n = {:g}, eye at {:g} degrees", setting.exponent, setting.eye_degrees);
}

/// Collects a test's failures over the settings, and keeps the worst.
class Failures {
 public:
  Failures(std::string_view check, records::BsdfCheck& record) : record_(record) {
    failure_.check = check;
  }
  /// Only in a record: settings where it failed, with the largest `severity` shown.
  void add(const BsdfSettingValues& setting, double severity, const std::string& sentence) {
    if (failure_.settings++ == 0 || severity > worst_) {
      worst_ = severity;
      failure_.sentence = sentence + " (" + at(setting) + ")";
      failure_.exponent = setting.exponent;
      failure_.eye_degrees = setting.eye_degrees;
    }
  }
  ~Failures() {
    if (failure_.settings > 0) record_.failures.push_back(std::move(failure_));
  }
  Failures(const Failures&) = delete;

 private:
  records::BsdfCheck& record_;
  records::BsdfFailure failure_;
  double worst_ = 0;
};

/// The largest change if light and eye are exchanged, of the largest value. With the cosine taken out of it or not.
double not_reciprocal(const BsdfSettingValues& setting, bool has_cosine) {
  double largest = 0, change = 0;
  for (std::size_t i = 0; i < setting.above.values.size(); ++i) {
    const double light = has_cosine ? setting.above.grid.nodes()[i].direction.z : 1,
                 eye = has_cosine ? setting.eye.z : 1;
    const double one = known(setting.above.values[i].eval) * eye,
                 other = known(setting.above.values[i].swapped) * light;
    largest = std::max({largest, std::abs(one), std::abs(other)});
    change = std::max(change, std::abs(one - other));
  }
  return largest > 0 ? change / largest : 0;
}

void judge_oddities(const BsdfValues& values, records::BsdfCheck& record) {
  const BsdfSettingValues& first = values.settings.front();
  const auto add = [&](std::string_view check, const std::string& sentence) {
    record.failures.push_back({std::string(check), sentence, first.exponent, first.eye_degrees, 0});
  };
  if (values.not_finite + values.negative > 0)
    add("finite", fmt::format("{} of {} calls are no finite number and {} are negative: first {}",
                              values.not_finite, values.calls, values.negative, values.first_odd));
  if (values.not_unit > 0)
    add("unit-direction",
        fmt::format("{} directions of sample are no unit vectors", values.not_unit));
  for (int k = 0; k < 2; ++k)
    if (values.random_unused[k])
      add("random-numbers",
          fmt::format("sample gives the same direction whatever the {} random number is",
                      k == 0 ? "first" : "second"));
  if (values.coloured > 0)
    record.remarks.push_back(
        fmt::format("{} values of eval are coloured; red was tested", values.coloured));
}

/// Judges the pdf and the weight that sample() gives beside the direction.
void judge_given(const BsdfValues& values, const BsdfSettingValues& setting, bool has_cosine,
                 Failures& of_pdf, Failures& of_weight) {
  std::size_t wrong_pdf = 0, wrong_weight = 0, weight_below = 0;
  for (const BsdfSample& sample : setting.samples) {
    if (!sample.is_valid) continue;
    if (sample.direction.z <= 0) {
      weight_below += values.has_given_weight && std::abs(sample.given_weight) > 1e-6 &&
                      known(sample.eval) == 0;
      continue;
    }
    wrong_pdf += values.has_given_pdf &&
                 !(std::abs(sample.given_pdf - sample.pdf) <= kRounding * sample.pdf);
    const double weight =
        sample.pdf > 0 ? reflected(sample.eval, sample.direction, has_cosine) / sample.pdf : 0;
    wrong_weight += values.has_given_weight &&
                    !(std::abs(sample.given_weight - weight) <= kRounding * weight + 1e-6);
  }
  const double count = double(setting.samples.size());
  if (double(wrong_pdf) > kFewSamples * count)
    of_pdf.add(setting, double(wrong_pdf),
               fmt::format("the pdf that sample gives is not pdf's at {:.3g} % of the samples",
                           100 * double(wrong_pdf) / count));
  if (double(wrong_weight) > kFewSamples * count)
    of_weight.add(
        setting, double(wrong_weight),
        fmt::format("the weight that sample gives is not eval times the cosine over pdf at "
                    "{:.3g} % of the samples",
                    100 * double(wrong_weight) / count));
  else if (weight_below > 0)
    of_weight.add(setting, double(weight_below) / count,
                  fmt::format("{:.3g} % of the samples are below the surface, where eval is 0, and "
                              "have a weight",
                              100 * double(weight_below) / count));
}

}  // namespace

Vec3 eye_at(double degrees) {
  // Beside the axes, so that a wrong frame shows.
  constexpr double kTurn = 0.7;
  const double angle = degrees * 3.14159265358979323846 / 180;
  return {std::sin(angle) * std::cos(kTurn), std::sin(angle) * std::sin(kTurn), std::cos(angle)};
}

double reflected(double eval, Vec3 light, bool has_cosine) {
  return has_cosine ? eval : eval * std::abs(light.z);
}

bool PdfTests::is_density() const { return above + below <= 1 + std::max(kOfIntegral, 3 * error); }

bool PdfTests::follows(double level) const {
  return is_density() && std::min({chance_of_shape, chance_of_lost, chance_of_mean}) >= level &&
         samples_without_pdf <= kFewSamples / 10;
}

bool are_known(std::size_t unknown, const BsdfValues& values) {
  return 2 * unknown < values.settings.size();
}

std::size_t random_tests(const BsdfValues& values) {
  return values.settings.size() * kTestsOfSetting;
}
/// Bonferroni's, because the tests of a setting are not independent.
double level_of_each(const BsdfValues& values) {
  return kFalseAlarms / double(random_tests(values));
}

PdfTests pdf_tests(const BsdfSettingValues& setting, bool has_cosine,
                   const PdfCorrection& correction) {
  const Tester tester{setting, has_cosine, correction};
  const Integrals sum = tester.integrals(setting.above), again = tester.integrals(setting.check);
  PdfTests tests;
  tests.above = sum.pdf;
  tests.below = tester.integrals(setting.below).pdf;
  tests.error = std::abs(sum.pdf - again.pdf);
  tests.is_known = tests.error <= kMostError * std::max(sum.pdf, 1e-9);
  tests.albedo = sum.albedo;
  tests.albedo_error = std::abs(sum.albedo - again.albedo);
  tests.share_without_pdf = sum.albedo > 0 ? sum.without_pdf / sum.albedo : 0;

  std::vector<double> seen(setting.above.grid.cells());
  double above = 0, weight = 0, largest = sum.largest, without = 0;
  Vec3 mean;
  for (const BsdfSample& sample : setting.samples) {
    const Vec3 d = sample.direction;
    tests.samples_rejected += !sample.is_valid;
    if (!sample.is_valid) continue;
    if (d.z <= 0) {
      ++tests.samples_below;
      continue;
    }
    ++above;
    ++seen[setting.above.grid.cell_of(d)];
    mean = mean + d;
    const double p = tester.pdf(sample.pdf, d);
    if (p > 0) {
      const double one = reflected(known(sample.eval), d, has_cosine) / p;
      weight += one;
      largest = std::max(largest, one);
    } else {
      ++without;
    }
  }
  const double count = correction.drops_lost ? above : double(setting.samples.size());
  tests.samples_without_pdf = without / std::max(1.0, above);
  tests.albedo_of_samples = count > 0 ? weight / count : 0;
  if (count == 0 || above < kLeastExpected || !(sum.pdf > 1e-6)) {
    // Nearly all is lost: there is no shape to see.
    tests.chance_of_lost = two_sided(above / std::max(1.0, count) - sum.pdf, 0.01) > 0 ? 0 : 1;
    return tests;
  }
  if (!tests.is_known) return tests;
  tester.chi_square(seen, above, sum, tests);
  const double share = std::min(1.0, sum.pdf);
  tests.chance_of_lost = chance_of_mean(two_sided(above / count - sum.pdf, tests.error + 1e-4),
                                        count, share * (1 - share), 1);
  for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    const double expected = sum.mean.*axis / sum.pdf, off = mean.*axis / above - expected,
                 error = std::abs(expected - again.mean.*axis / again.pdf) + 1e-5;
    tests.chance_of_mean = std::min(
        tests.chance_of_mean,
        chance_of_mean(two_sided(off, error), above,
                       std::max(0.0, sum.square.*axis / sum.pdf - expected * expected), 2));
  }
  const double error = tests.albedo_error + 1e-4 * sum.albedo;
  tests.chance_of_weight =
      chance_of_mean(two_sided(tests.albedo_of_samples - sum.albedo, error), count,
                     std::max(0.0, sum.of_square - sum.albedo * sum.albedo), largest);
  return tests;
}

bool eval_has_cosine(const BsdfValues& values) {
  double without = 0, with = 0;
  for (const BsdfSettingValues& setting : values.settings) {
    without = std::max(without, not_reciprocal(setting, false));
    with = std::max(with, not_reciprocal(setting, true));
  }
  return with < 0.1 * without && with < 0.01;
}

void judge_bsdf(const BsdfValues& values, records::BsdfCheck& record) {
  const bool has_cosine = eval_has_cosine(values);
  const double level = level_of_each(values);
  record.false_alarms = kFalseAlarms;
  record.random_tests = random_tests(values);
  record.eval_has_cosine = has_cosine;
  judge_oddities(values, record);
  double change = 0, lost = 0;
  const BsdfSettingValues *changed = nullptr, *most_lost = nullptr;
  {
    Failures density("pdf-integral", record), at_samples("pdf-at-samples", record),
        of_sample("pdf-of-sample", record), lost_samples("samples-lost", record),
        shape("chi-square", record), mean("mean-direction", record), support("support", record),
        mean_weight("mean-weight", record), weight("weight", record), energy("energy", record);
    std::size_t unknown = 0;
    for (const BsdfSettingValues& setting : values.settings) {
      const PdfTests t = pdf_tests(setting, has_cosine);
      const double count = double(setting.samples.size()),
                   reciprocity = not_reciprocal(setting, has_cosine);
      record.settings.push_back({setting.exponent, setting.eye_degrees, t.above, t.below, t.error,
                                 setting.samples.size(), t.samples_below, t.samples_rejected,
                                 t.chi_square, t.freedom, t.chance_of_shape, t.albedo,
                                 t.albedo_of_samples, reciprocity});
      if (reciprocity > change) change = reciprocity, changed = &setting;
      const double lost_here = double(t.samples_below + t.samples_rejected) / count;
      if (lost_here > lost) lost = lost_here, most_lost = &setting;
      if (!t.is_density())
        density.add(setting, t.above + t.below,
                    fmt::format("pdf integrates to {:.6g} over the sphere", t.above + t.below));
      if (t.samples_without_pdf > kFewSamples / 10)
        at_samples.add(setting, t.samples_without_pdf,
                       fmt::format("pdf is 0 at {:.3g} % of the directions that sample gives",
                                   100 * t.samples_without_pdf));
      if (t.chance_of_lost < level)
        lost_samples.add(setting, std::abs(1 - lost_here - t.above),
                         fmt::format("{:.4g} % of the samples are above the surface, but pdf "
                                     "integrates to {:.6g} there",
                                     100 * (1 - lost_here), t.above));
      if (t.chance_of_shape < level)
        shape.add(
            setting, t.freedom > 0 ? t.chi_square / t.freedom : 0,
            fmt::format("sample does not follow pdf: chi square is {:.4g} with {:g} degrees of "
                        "freedom",
                        t.chi_square, t.freedom));
      if (t.chance_of_mean < level)
        mean.add(setting, -t.chance_of_mean, "the mean direction of sample is not that of pdf");
      if (t.share_without_pdf > kOfIntegral)
        support.add(setting, t.share_without_pdf,
                    fmt::format("pdf is 0 where eval has {:.3g} % of the albedo",
                                100 * t.share_without_pdf));
      if (t.chance_of_weight < level)
        mean_weight.add(setting, std::abs(t.albedo_of_samples - t.albedo),
                        fmt::format("the mean of eval times the cosine over pdf is {:.6g}, but the "
                                    "albedo is {:.6g} by quadrature",
                                    t.albedo_of_samples, t.albedo));
      if (t.albedo > 1 + kOfIntegral + 3 * t.albedo_error)
        energy.add(setting, t.albedo,
                   fmt::format("a white furnace gives back {:.6g} of its light", t.albedo));
      judge_given(values, setting, has_cosine, of_sample, weight);
      if (!t.is_known) {
        ++unknown;
        record.remarks.push_back(fmt::format(
            "sample is not tested there, because two grids give {:.4g} and {:.4g} for the integral "
            "of pdf ({})",
            t.above, t.above + t.error, at(setting)));
      }
    }
    if (!are_known(unknown, values))
      density.add(values.settings.front(), 0,
                  "the integral of pdf is not known: it varies too fast where sample is smooth");
  }
  std::ranges::stable_sort(record.failures, {}, [](const records::BsdfFailure& failure) {
    return std::ranges::find(records::kBsdfChecks, failure.check);
  });
  record.reciprocal = change <= kRounding;
  record.remarks.push_back(
      record.reciprocal
          ? fmt::format("eval is reciprocal{}",
                        has_cosine ? ", without the cosine that it includes" : "")
          : fmt::format(
                "eval is not reciprocal: exchanging light and eye changes it by up to {:.2g} "
                "of its peak ({})",
                change, at(*changed)));
  if (most_lost)
    record.remarks.push_back(
        fmt::format("up to {:.3g} % of the samples are lost, below the surface or not valid ({})",
                    100 * lost, at(*most_lost)));
  record.verdict = records::kBsdfVerdicts[record.failures.empty() ? 0 : 1];
}

}  // namespace lobelia::shader_check::bsdf

#include "studies/shader_check/bsdf/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace lobelia::shader_check::bsdf {
namespace {

/// The cosines that a factor may be made of.
struct Cosines {
  Cosines(const BsdfSettingValues& setting, Vec3 light)
      : n_dot_l(std::abs(light.z)), n_dot_v(std::abs(setting.eye.z)) {
    const Vec3 sum = light + setting.eye;
    const double size = length(sum);
    n_dot_h = size > 0 ? std::abs(sum.z) / size : 1;
    v_dot_h = size / 2;
  }
  double n_dot_l, n_dot_v, n_dot_h, v_dot_h;
};

/// The share of microfacets of a GGX distribution that the eye sees, by Smith.
double ggx_visible(double cosine, double alpha) {
  const double squared = cosine * cosine;
  return 2 / (1 + std::sqrt(1 + alpha * alpha * (1 - squared) / squared));
}

/// `power` of sqrt(2 / (n + 2)): a roughness may be its root, or be squared.
double visible_over_all(const BsdfSettingValues& setting, Vec3 light, double power) {
  const Cosines c(setting, light);
  const double alpha = std::pow(2 / (setting.exponent + 2), power / 2);
  return ggx_visible(c.n_dot_v, alpha) * c.v_dot_h / (c.n_dot_v * c.n_dot_h);
}

struct Candidate {
  BsdfMistake mistake;
  double (*factor)(const BsdfSettingValues&, Vec3 light);  ///< that puts a pdf right
};

template <int kPowerOfHalf>
double for_all(const BsdfSettingValues& s, Vec3 l) {
  return 1 / visible_over_all(s, l, kPowerOfHalf / 2.0);
}
template <int kPowerOfHalf>
double for_visible(const BsdfSettingValues& s, Vec3 l) {
  return visible_over_all(s, l, kPowerOfHalf / 2.0);
}
constexpr BsdfMistake kVisiblePdf{
    "pdf-of-visible-normals",
    "pdf is that of visible normals, but sample takes them from D(H) N.H"};
constexpr BsdfMistake kVisibleSampled{"visible-normals-sampled",
                                      "sample takes visible normals, but pdf is that of D(H) N.H"};

const Candidate kCandidates[] = {
    {{"half-vector-jacobian", "pdf is that of the half vector: 1 / (4 V.H) is missing"},
     [](const BsdfSettingValues& s, Vec3 l) { return 1 / (4 * Cosines(s, l).v_dot_h); }},
    {{"half-vector-jacobian-twice", "pdf has 1 / (4 V.H) once too often"},
     [](const BsdfSettingValues& s, Vec3 l) { return 4 * Cosines(s, l).v_dot_h; }},
    {{"pdf-cosine-missing", "N.L is missing in pdf"},
     [](const BsdfSettingValues& s, Vec3 l) { return Cosines(s, l).n_dot_l; }},
    {{"pdf-cosine-twice", "pdf has N.L once too often"},
     [](const BsdfSettingValues& s, Vec3 l) { return 1 / Cosines(s, l).n_dot_l; }},
    {{"pdf-half-vector-cosine-missing", "N.H is missing in pdf"},
     [](const BsdfSettingValues& s, Vec3 l) { return Cosines(s, l).n_dot_h; }},
    {{"pdf-half-vector-cosine-twice", "pdf has N.H once too often"},
     [](const BsdfSettingValues& s, Vec3 l) { return 1 / Cosines(s, l).n_dot_h; }},
    {kVisiblePdf, for_all<2>},
    {kVisiblePdf, for_all<1>},
    {kVisiblePdf, for_all<4>},
    {kVisibleSampled, for_visible<2>},
    {kVisibleSampled, for_visible<1>},
    {kVisibleSampled, for_visible<4>},
};

constexpr BsdfMistake kOthers[] = {
    {"pdf-factor", "pdf is not normalised; the report has its factor"},
    {"hemisphere-not-rejected",
     "pdf is normalised over the directions above the surface, but sample also gives some below"},
    {"pdf-other-parameter",
     "pdf takes the square, the root, twice or half of the roughness or exponent of sample"},
    {"random-number-unused", "one random number is not used, or the other one in its place"},
    {"weight-cosine-missing", "the weight has no N.L"},
    {"weight-cosine-twice", "the weight has N.L once too often"},
    {"weight-without-pdf", "the weight is eval with the cosine, not divided by pdf"},
    {"weight-is-eval", "the weight is eval"},
    {"weight-factor", "the weight has a constant factor too much"},
    {"weight-below", "samples below the surface have a weight"},
    {"given-pdf", "the pdf that sample gives lacks what pdf has, or the other way round"},
};

/// "4", "1 / (2 pi)": a factor that has a name, or its digits.
std::string factor_text(double factor) {
  constexpr double kPi = std::numbers::pi;
  const std::pair<double, const char*> names[] = {{2, "2"},
                                                  {4, "4"},
                                                  {8, "8"},
                                                  {kPi, "pi"},
                                                  {2 * kPi, "2 pi"},
                                                  {4 * kPi, "4 pi"},
                                                  {8 * kPi, "8 pi"},
                                                  {kPi / 2, "pi / 2"},
                                                  {4 / kPi, "4 / pi"},
                                                  {kPi / 4, "pi / 4"}};
  for (const auto& [value, name] : names) {
    if (std::abs(factor / value - 1) < 2e-3) return name;
    if (std::abs(factor * value - 1) < 2e-3) return std::string("1 / (") + name + ")";
  }
  return fmt::format("{:.4g}", factor);
}

class Explainer {
 public:
  Explainer(const BsdfValues& values, std::span<const BsdfVariant> variants,
            records::BsdfCheck& record)
      : values_(values), variants_(variants), record_(record), level_(level_of_each(values)) {}

  void explain() {
    for (int k = 0; k < 2; ++k)
      if (values_.random_unused[k])
        add("random-number-unused",
            fmt::format("the {} random number is not used, or the other one is used in its place",
                        k == 0 ? "first" : "second"));
    const bool uses_both = !values_.random_unused[0] && !values_.random_unused[1];
    if (uses_both && has_failed({"pdf-integral", "samples-lost", "chi-square", "mean-direction"}))
      explain_pdf();
    if (has_failed({"pdf-of-sample"})) explain_given_pdf();
    if (has_failed({"weight"})) explain_weight();
  }

 private:
  using Factors = std::map<double, double>;  ///< by exponent

  bool has_failed(std::initializer_list<std::string_view> checks) const {
    return std::ranges::any_of(record_.failures, [&](const records::BsdfFailure& failure) {
      return std::ranges::find(checks, failure.check) != checks.end();
    });
  }
  void add(std::string_view mistake, std::string sentence) {
    for (const records::BsdfExplanation& known : record_.explanations)
      if (known.mistake == mistake) return;
    record_.explanations.push_back({std::string(mistake), std::move(sentence)});
  }

  bool follows(const BsdfValues& values, const PdfCorrection& correction) const {
    std::size_t unknown = 0;
    for (const BsdfSettingValues& setting : values.settings) {
      const PdfTests tests = pdf_tests(setting, record_.eval_has_cosine, correction);
      if (!tests.follows(level_) || tests.chance_of_weight < level_) return false;
      unknown += !tests.is_known;
    }
    return are_known(unknown, values);
  }

  /// The factor that makes the share of samples above the surface of the integral, where the fewest samples are lost.
  Factors factors(const BsdfValues& values, const PdfCorrection& correction) const {
    Factors found;
    std::map<double, double> most;
    for (const BsdfSettingValues& setting : values.settings) {
      const PdfTests tests = pdf_tests(setting, record_.eval_has_cosine, correction);
      const double above =
          1 - double(tests.samples_below + tests.samples_rejected) / double(setting.samples.size());
      if (!(tests.above > 1e-9) || above <= most[setting.exponent]) continue;
      most[setting.exponent] = above;
      found[setting.exponent] = above / tests.above;
    }
    return found;
  }

  static std::string text_of(const Factors& factors) {
    double least = factors.begin()->second, most = least;
    for (const auto& [exponent, factor] : factors)
      least = std::min(least, factor), most = std::max(most, factor);
    if (most < 1.002 * least) return factor_text(1 / most) + " times too large";
    std::string text;
    for (const auto& [exponent, factor] : factors)
      text += fmt::format("{}{} times at n = {:g}", text.empty() ? "" : ", ",
                          factor_text(1 / factor), exponent);
    return "too large by a factor that depends on n: " + text;
  }

  /// With a shape put right, alone or with a factor.
  bool try_pdf(const BsdfValues& values, const BsdfMistake* mistake,
               const PdfCorrection& correction) {
    if (mistake && follows(values, correction)) {
      add(mistake->name, std::string(mistake->sentence));
      return true;
    }
    const Factors found = factors(values, correction);
    if (found.empty()) return false;
    PdfCorrection both = correction;
    both.factor = [&](const BsdfSettingValues& setting, Vec3 light) {
      const auto factor = found.find(setting.exponent);
      return (factor == found.end() ? 1 : factor->second) *
             (correction.factor ? correction.factor(setting, light) : 1);
    };
    if (!follows(values, both)) return false;
    if (mistake) add(mistake->name, std::string(mistake->sentence));
    add("pdf-factor", fmt::format("pdf is not normalised: {}it is {}",
                                  mistake ? "apart from that " : "", text_of(found)));
    return true;
  }

  void explain_pdf() {
    if (!has_failed({"chi-square", "mean-direction"}) && follows(values_, {{}, true})) {
      add("hemisphere-not-rejected",
          "pdf is normalised over the directions above the surface, but sample also gives some "
          "below and does not draw again");
      return;
    }
    if (try_pdf(values_, nullptr, {})) return;
    for (const BsdfVariant& variant : variants_) {
      const BsdfMistake mistake{variant.mistake, variant.sentence};
      if (follows(variant.values, {})) {
        add(mistake.name, std::string(mistake.sentence));
        return;
      }
    }
    // The plainest first: alone, then with a factor.
    for (const bool with_factor : {false, true})
      for (const Candidate& candidate : kCandidates) {
        const PdfCorrection correction{candidate.factor};
        if (with_factor ? try_pdf(values_, &candidate.mistake, correction)
                        : follows(values_, correction)) {
          add(candidate.mistake.name, std::string(candidate.mistake.sentence));
          return;
        }
      }
  }

  /// Whether `expected` is what sample() gave at nearly all samples above the surface.
  template <class Expected, class Given>
  bool fits(Expected expected, Given given) const {
    std::size_t count = 0, wrong = 0;
    for (const BsdfSettingValues& setting : values_.settings)
      for (const BsdfSample& sample : setting.samples) {
        if (!sample.is_valid || sample.direction.z <= 0 || !(sample.pdf > 0)) continue;
        const double e = expected(setting, sample);
        ++count;
        wrong += !(std::abs(given(sample) - e) <= kRounding * std::abs(e) + 1e-9);
      }
    return count > 0 && double(wrong) <= kFewSamples * double(count);
  }
  /// The ratio in the middle.
  template <class Expected, class Given>
  double middle_ratio(Expected expected, Given given) const {
    std::vector<double> ratios;
    for (const BsdfSettingValues& setting : values_.settings)
      for (const BsdfSample& sample : setting.samples) {
        if (!sample.is_valid || sample.direction.z <= 0 || !(sample.pdf > 0)) continue;
        const double ratio = given(sample) / expected(setting, sample);
        if (std::isfinite(ratio)) ratios.push_back(ratio);
      }
    if (ratios.empty()) return 1;
    const auto middle = ratios.begin() + std::ptrdiff_t(ratios.size() / 2);
    std::ranges::nth_element(ratios, middle);
    return *middle;
  }

  void explain_given_pdf() {
    const auto given = [](const BsdfSample& sample) { return sample.given_pdf; };
    const auto try_one = [&](auto expected, const std::string& words) {
      if (fits(expected, given)) {
        add("given-pdf", words);
        return true;
      }
      const double ratio = middle_ratio(expected, given);
      const auto scaled = [&](const BsdfSettingValues& setting, const BsdfSample& sample) {
        return ratio * expected(setting, sample);
      };
      if (!fits(scaled, given)) return false;
      add("given-pdf", words + fmt::format("{}it is {} times pdf's", words.empty() ? "" : "; then ",
                                           factor_text(ratio)));
      return true;
    };
    if (try_one([](const BsdfSettingValues&, const BsdfSample& sample) { return sample.pdf; },
                "the pdf that sample gives: "))
      return;
    for (const Candidate& candidate : kCandidates) {
      if (try_one(
              [&](const BsdfSettingValues& setting, const BsdfSample& sample) {
                return sample.pdf * candidate.factor(setting, sample.direction);
              },
              fmt::format("of pdf, but not of the pdf that sample gives: {}",
                          candidate.mistake.sentence)) ||
          try_one(
              [&](const BsdfSettingValues& setting, const BsdfSample& sample) {
                return sample.pdf / candidate.factor(setting, sample.direction);
              },
              fmt::format("of the pdf that sample gives, but not of pdf: {}",
                          candidate.mistake.sentence)))
        return;
    }
  }

  void explain_weight() {
    const bool has_cosine = record_.eval_has_cosine;
    const auto given = [](const BsdfSample& sample) { return sample.given_weight; };
    const auto right = [&](const BsdfSettingValues&, const BsdfSample& sample) {
      return reflected(sample.eval, sample.direction, has_cosine) / sample.pdf;
    };
    if (fits(right, given)) {
      add("weight-below",
          "samples below the surface have a weight: give 0 for them, or a mark "
          "that they are not valid");
      return;
    }
    const struct {
      BsdfMistake mistake;
      double (*factor)(const BsdfSample&);
    } candidates[] = {
        {{"weight-cosine-missing", "N.L is missing in the weight of sample"},
         [](const BsdfSample& s) { return 1 / s.direction.z; }},
        {{"weight-cosine-twice", "the weight of sample has N.L once too often"},
         [](const BsdfSample& s) { return s.direction.z; }},
        {{"weight-without-pdf", "the weight of sample is not divided by pdf"},
         [](const BsdfSample& s) { return s.pdf; }},
        {{"weight-is-eval", "the weight of sample is eval, without N.L over pdf"},
         [](const BsdfSample& s) { return s.pdf / s.direction.z; }},
    };
    for (const auto& candidate : candidates)
      if (fits([&](const BsdfSettingValues& setting,
                   const BsdfSample& s) { return right(setting, s) * candidate.factor(s); },
               given)) {
        add(candidate.mistake.name, std::string(candidate.mistake.sentence));
        return;
      }
    const double ratio = middle_ratio(right, given);
    if (fits([&](const BsdfSettingValues& setting,
                 const BsdfSample& s) { return ratio * right(setting, s); },
             given))
      add("weight-factor",
          fmt::format("the weight of sample is {} times too large", factor_text(ratio)));
  }

  const BsdfValues& values_;
  std::span<const BsdfVariant> variants_;
  records::BsdfCheck& record_;
  double level_;
};

}  // namespace

std::span<const BsdfMistake> bsdf_mistakes() {
  static const std::vector<BsdfMistake> all = [] {
    std::vector<BsdfMistake> list;
    for (const Candidate& candidate : kCandidates)
      if (std::ranges::find(list, candidate.mistake.name, &BsdfMistake::name) == list.end())
        list.push_back(candidate.mistake);
    list.insert(list.end(), std::begin(kOthers), std::end(kOthers));
    return list;
  }();
  return all;
}

bool needs_variants(const BsdfValues& values, const records::BsdfCheck& record) {
  return !values.random_unused[0] && !values.random_unused[1] &&
         std::ranges::any_of(record.failures, [](const records::BsdfFailure& failure) {
           return failure.check == "chi-square" || failure.check == "mean-direction";
         });
}

void explain_bsdf(const BsdfValues& values, std::span<const BsdfVariant> variants,
                  records::BsdfCheck& record) {
  Explainer(values, variants, record).explain();
}

}  // namespace lobelia::shader_check::bsdf

#include "studies/shader_check/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "studies/shader_check/mistakes.hpp"

namespace lobelia::shader_check {
namespace {

/// Float32 leaves at most this many tolerances at all points but the worst, and at nearly all of them.
constexpr double kAlmostAll = 0.997, kMost = 0.98;
constexpr double kPenaltyOfMost = 1.5;  // of a candidate that fits most points but not almost all
constexpr double kCoefficientTolerance = 1e-3;
constexpr double kFreeCoefficient = 2;  // as much as two mistakes
/// Above it, float32 leaves nothing of a power of a cosine that a coefficient could be told from.
constexpr double kMostExponent = 2e4;

/// The points of one exponent.
struct Group {
  double exponent = 1, own = 1, peak = 0, allowed = 0;
  std::vector<Geometry> geometry;
  std::vector<double> values;
};

std::vector<Group> groups_of(const Highlight& highlight, const Observed& observed) {
  std::map<double, Group> by_exponent;
  for (std::size_t i = 0; i < observed.points.size(); ++i) {
    const double n = observed.points[i].exponent;
    const Geometry geometry(observed.points[i]);
    if (!std::isfinite(observed.values[i]) || is_at_an_edge(highlight, geometry)) continue;
    Group& group = by_exponent[n];
    group.geometry.push_back(geometry);
    group.values.push_back(observed.values[i]);
    group.peak = std::max(group.peak, std::abs(observed.values[i]));
  }
  std::vector<Group> groups;
  for (auto& [n, group] : by_exponent) {
    Highlight here = highlight;
    here.exponent = group.exponent = n;
    group.own = radiance_coefficient(here);
    group.peak = std::max(group.peak, 1e-6 * group.own);
    group.allowed = textbook_rounding(n) * group.peak;
    groups.push_back(std::move(group));
  }
  return groups;
}

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The differences that a candidate leaves, in tolerances.
struct Left {
  double almost_all = 0, most = 0, most_of_peak = 0;
  void add(const Group& group, std::vector<double> differences) {
    // The higher one first: the lower one is then below it.
    almost_all = std::max(almost_all, quantile(differences, kAlmostAll) / group.allowed);
    const double q = quantile(differences, kMost);
    most = std::max(most, q / group.allowed);
    most_of_peak = std::max(most_of_peak, q / group.peak);
  }
  double penalty() const {
    return almost_all <= 1 ? 0
           : most <= 1     ? kPenaltyOfMost
                           : std::numeric_limits<double>::infinity();
  }
};

struct Candidate {
  std::vector<const Mistake*> shape;
  const CoefficientMistake* coefficient = nullptr;
  bool has_free_coefficient = false;
  const OutputMistake* output = nullptr;
  Left left;
  std::vector<FactorAt> factors;

  double score() const {
    return double(shape.size()) + (coefficient ? 1 : 0) +
           (has_free_coefficient ? kFreeCoefficient : 0) + (output ? 1 : 0) + left.penalty();
  }
};

class Search {
 public:
  Search(const Highlight& highlight, const Observed& observed, bool of_roughness)
      : highlight_(highlight), groups_(groups_of(highlight, observed)) {
    for (const Mistake& mistake : mistakes())
      if ((!mistake.applies || mistake.applies(highlight)) &&
          (of_roughness || !mistake.of_roughness) && !is_own_lobe(mistake))
        usable_.push_back(&mistake);
    // The narrower explanation first: 2 / alpha^2 is n + 2.
    std::ranges::stable_partition(usable_, &Mistake::of_roughness);
  }

  const Candidate& best() {
    try_shape({});
    for (const Mistake* one : usable_) try_shape({one});
    if (best_->score() <= 1) return *best_;
    try_outputs();
    if (best_->score() <= 1) return *best_;
    for (std::size_t i = 0; i < usable_.size(); ++i)
      for (std::size_t j = i + 1; j < usable_.size(); ++j)
        if (usable_[i]->part != usable_[j]->part) try_shape({usable_[i], usable_[j]});
    return *best_;
  }

 private:
  bool is_own_lobe(const Mistake& mistake) const {
    if (mistake.part != Part::kLobe) return false;
    const Mistake* const made[] = {&mistake};
    return formula_of(highlight_, 1, made).lobe == highlight_.lobe;
  }

  std::vector<double> shape_of(const Group& group, const std::vector<const Mistake*>& shape) const {
    const Formula formula = formula_of(highlight_, group.exponent, shape);
    std::vector<double> values;
    values.reserve(group.values.size());
    for (const Geometry& geometry : group.geometry) {
      const double value = shape_value(formula, geometry);
      values.push_back(std::isfinite(value) ? value : 0);
    }
    return values;
  }

  /// With the coefficient that fits each exponent best.
  void try_shape(std::vector<const Mistake*> shape) {
    Candidate candidate;
    candidate.shape = std::move(shape);
    std::vector<std::pair<double, double>> fitted;  // exponent of the group and of the lobe
    for (const Group& group : groups_) {
      const std::vector<double> values = shape_of(group, candidate.shape);
      double products = 0, squares = 0, largest = 0;
      for (std::size_t i = 0; i < values.size(); ++i) {
        products += group.values[i] * values[i];
        squares += values[i] * values[i];
        largest = std::max(largest, std::abs(values[i]));
      }
      const double factor = squares > 0 ? products / squares : 0;
      std::vector<double> differences(values.size());
      for (std::size_t i = 0; i < values.size(); ++i)
        differences[i] = std::abs(group.values[i] - factor * values[i]);
      candidate.left.add(group, std::move(differences));
      // A lobe that nothing is seen of has no coefficient.
      if (factor * largest > 0.01 * group.peak && group.peak > 1e-5 * group.own &&
          formula_of(highlight_, group.exponent, candidate.shape).exponent < kMostExponent)
        candidate.factors.push_back({group.exponent, factor / group.own});
    }
    if (std::isfinite(candidate.left.penalty())) find_coefficient(candidate);
    keep(std::move(candidate));
  }

  double own_at(double n) const {
    Highlight here = highlight_;
    here.exponent = std::clamp(n, kMinExponent, kMaxExponent);
    return radiance_coefficient(here);
  }

  /// How far the fitted factors are from a coefficient; 0 if there are none.
  template <class Value>
  double distance(const Candidate& candidate, Value value, bool of_lobe_exponent) const {
    double largest = 0;
    for (const FactorAt& at : candidate.factors) {
      const double n = of_lobe_exponent
                           ? formula_of(highlight_, at.exponent, candidate.shape).exponent
                           : at.exponent;
      const double expected = value(own_at(n), n);
      largest = std::max(largest, std::abs(at.factor * own_at(at.exponent) / expected - 1));
    }
    return largest;
  }

  void find_coefficient(Candidate& candidate) const {
    for (const bool of_lobe : {false, true})
      if (distance(
              candidate, [](double own, double) { return own; }, of_lobe) < kCoefficientTolerance)
        return;
    for (const CoefficientMistake& mistake : coefficient_mistakes())
      for (const bool of_lobe : {false, true}) {
        if (distance(
                candidate, [&](double own, double n) { return mistake.value(highlight_, own, n); },
                of_lobe) >= kCoefficientTolerance)
          continue;
        candidate.coefficient = &mistake;
        return;
      }
    candidate.has_free_coefficient = true;
  }

  void try_outputs() {
    for (const OutputMistake& output : output_mistakes()) {
      try_output(output, {}, nullptr);
      for (const CoefficientMistake& coefficient : coefficient_mistakes())
        try_output(output, {}, &coefficient);
      for (const Mistake* one : usable_) try_output(output, {one}, nullptr);
    }
  }

  void try_output(const OutputMistake& output, std::vector<const Mistake*> shape,
                  const CoefficientMistake* coefficient) {
    Candidate candidate;
    candidate.shape = std::move(shape);
    candidate.output = &output;
    candidate.coefficient = coefficient;
    for (const Group& group : groups_) {
      std::vector<double> values = shape_of(group, candidate.shape);
      const double factor =
          coefficient ? coefficient->value(highlight_, group.own, group.exponent) : group.own;
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = std::abs(group.values[i] - output.value(factor * values[i]));
      candidate.left.add(group, std::move(values));
    }
    keep(std::move(candidate));
  }

  /// Keeps the first of equal candidates, unless another leaves far less.
  void keep(Candidate candidate) {
    const auto better = [&] {
      if (!best_) return true;
      const double ours = candidate.score(), theirs = best_->score();
      if (!std::isfinite(ours) && !std::isfinite(theirs))
        return candidate.left.most_of_peak < best_->left.most_of_peak;
      return ours < theirs || (ours == theirs && candidate.left.most < 0.3 * best_->left.most);
    };
    if (better()) best_ = std::move(candidate);
  }

  Highlight highlight_;
  std::vector<Group> groups_;
  std::vector<const Mistake*> usable_;
  std::optional<Candidate> best_;
};

std::string times(double factor) {
  return factor >= 1 ? fmt::format("{:.3g} times too bright", factor)
                     : fmt::format("{:.3g} times too dark", 1 / factor);
}

/// "3.14 times too bright", or from where to where.
std::string factor_text(const std::vector<FactorAt>& factors) {
  if (factors.empty()) return "";
  const auto [least, most] = std::ranges::minmax_element(factors, {}, &FactorAt::factor);
  if (most->factor < least->factor * 1.005) return times(factors.back().factor);
  return fmt::format("{} at n = {:g} and {} at n = {:g}", times(factors.front().factor),
                     factors.front().exponent, times(factors.back().factor),
                     factors.back().exponent);
}

std::string coefficient_words(const Highlight& highlight, const CoefficientMistake& mistake) {
  if (mistake.id == "coefficient")
    return fmt::format("the coefficient is {}, where {} is expected", mistake.words,
                       own_coefficient_text(highlight));
  const bool is_distribution = info(highlight.model).normalised != NormalisedQuantity::kRadiance;
  if (mistake.id == "four-missing" && is_distribution)
    return "the 4 of the half-vector is missing (f_r = D / 4)";
  return mistake.words;
}

}  // namespace

double textbook_rounding(double exponent) { return std::min(2e-5 + 6e-7 * exponent, 0.02); }
double allowed_error(double exponent) { return std::min(textbook_rounding(exponent), 1e-3); }

Explanation explain(const Highlight& highlight, const Observed& observed, bool of_roughness) {
  Search search(highlight, observed, of_roughness);
  const Candidate& best = search.best();
  Explanation explanation;
  explanation.is_complete = std::isfinite(best.score()) && !best.has_free_coefficient;
  explanation.left_of_peak = best.left.most_of_peak;
  explanation.factors = best.factors;
  std::string words;
  const auto add = [&](std::string_view id, const std::string& sentence) {
    explanation.mistakes.emplace_back(id);
    words += (words.empty() ? "" : "; ") + sentence;
  };
  if (best.coefficient) add(best.coefficient->id, coefficient_words(highlight, *best.coefficient));
  for (const Mistake* mistake : best.shape) add(mistake->id, mistake->words);
  if (best.output) add(best.output->id, std::string(best.output->words));
  if (!std::isfinite(best.score())) {
    explanation.mistakes.clear();
    explanation.sentence =
        fmt::format("no known mistake explains it; the nearest{} leaves {:.1e} of the peak",
                    words.empty() ? " is the model itself, which" : ", that " + words + ",",
                    best.left.most_of_peak);
    return explanation;
  }
  if (words.empty() && !best.has_free_coefficient && best.left.penalty() == 0) {
    explanation.mistakes = {"float32-cosine"};
    explanation.sentence =
        "the exponent multiplies float32's rounding of the cosine; 1 - cosine as half the square of a "
        "difference of vectors would keep the angle";
    return explanation;
  }
  const std::string factor = factor_text(best.factors);
  const bool has_factor = best.coefficient || best.has_free_coefficient;
  if (best.has_free_coefficient)
    words = "by no factor that is known" + (words.empty() ? "" : "; " + words);
  explanation.sentence = has_factor && !factor.empty() ? fmt::format("it is {}: {}", factor, words)
                         : words.empty()               ? "it is the model but for a few directions"
                                                       : words;
  return explanation;
}

}  // namespace lobelia::shader_check

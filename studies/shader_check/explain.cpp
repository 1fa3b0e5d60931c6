#include "studies/shader_check/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "studies/shader_check/search.hpp"
#include "studies/shader_check/signatures.hpp"

namespace lobelia::shader_check {
namespace {

/// A nearest candidate that leaves more of the peak says nothing of a shader.
constexpr double kNear = 0.1;

/// Nearer to 1, a factor is float32's rounding.
constexpr double kNoFactor = 5e-6;
constexpr double kSeenFactor = 3;  // of a nearest: so many times what remains

/// With digits enough to see how far it is from 1.
std::string times(double factor) {
  const double ratio = factor >= 1 ? factor : 1 / factor;
  const int digits = ratio >= 1.1 ? 3
                     : ratio > 1  ? std::clamp(2 - int(std::floor(std::log10(ratio - 1))), 3, 8)
                                  : 3;
  return fmt::format("{:.{}g} times too {}", ratio, digits, factor >= 1 ? "bright" : "dark");
}

/// "3.14 times too bright", or with the exponents where it is largest and least.
std::string factor_text(const std::vector<records::ShaderFactor>& factors) {
  if (factors.empty()) return "";
  auto [least, most] = std::ranges::minmax_element(factors, {}, &records::ShaderFactor::factor);
  if (std::max(most->factor, 1 / least->factor) < 1 + kNoFactor) return "";
  const double change = std::abs(std::log(most->factor / least->factor));
  if (change < 0.005 * std::max(std::abs(std::log(most->factor)), 1e-3) ||
      most->factor < least->factor * 1.0001)
    return times(factors.front().factor);
  if (std::abs(std::log(most->factor)) < std::abs(std::log(least->factor))) std::swap(least, most);
  return fmt::format("{} at n = {:g} and {} at n = {:g}", times(most->factor), most->exponent,
                     times(least->factor), least->exponent);
}

std::string additions_text(const Additions& additions) {
  if (additions.ambient && additions.diffuse)
    return fmt::format("{:.3g} + {:.3g} N.L is on top", additions.of_ambient, additions.of_diffuse);
  if (additions.ambient) return fmt::format("{:.3g} is on top", additions.of_ambient);
  return additions.diffuse ? fmt::format("{:.3g} N.L is on top", additions.of_diffuse) : "";
}

/// All that a candidate says, but for the factor.
std::string words_of(const Candidate& candidate) {
  std::string words = candidate.coefficient.words;
  const auto add = [&](const std::string& sentence) {
    if (!sentence.empty()) words += (words.empty() ? "" : "; ") + sentence;
  };
  for (const Mistake* mistake : candidate.shape) add(mistake->words);
  add(additions_text(candidate.fit.additions));
  for (const OutputStep* step : candidate.chain) add(std::string(step->words));
  return words;
}

std::string sentence_of(const Candidate& candidate) {
  const std::string words = words_of(candidate), factor = factor_text(candidate.factors);
  // An exposure is a factor that its words have.
  const bool has_factor = candidate.coefficient.cost > 0 && candidate.chain.empty();
  if (!has_factor || factor.empty()) return words;
  if (!candidate.coefficient.is_known)
    return fmt::format("it is {}, by no coefficient that is known{}", factor,
                       words.empty() ? "" : "; " + words);
  return fmt::format("it is {}: {}", factor, words);
}

std::string nearest_text(const Candidate& nearest) {
  const double left = nearest.fit.left.most_of_peak;
  if (!(left <= kNear))
    return fmt::format(
        "no known mistake explains it, and none comes near: {:.0f} % of the peak remain",
        100 * left);
  // A factor that is as near to 1 as what remains is no news.
  const bool is_seen = std::ranges::any_of(nearest.factors, [&](const records::ShaderFactor& at) {
    return std::abs(std::log(at.factor)) > kSeenFactor * left;
  });
  const std::string words = words_of(nearest), factor = is_seen ? factor_text(nearest.factors) : "";
  return fmt::format(
      "no known mistake explains it; the nearest{}{}; what remains is {:.1e} of the peak",
      words.empty() ? " is the model itself" : ": " + words, factor.empty() ? "" : ", " + factor,
      left);
}

/// Appends what is known of calls that gave NaN.
void add_nan(const Candidate& best, const Observed& observed,
             records::ShaderExplanation& explanation) {
  const bool counts_all = observed.calls > 0;
  const std::size_t calls = counts_all ? observed.calls : observed.values.size(),
                    nan = counts_all
                              ? observed.nan
                              : std::size_t(std::ranges::count_if(
                                    observed.values, [](double v) { return std::isnan(v); }));
  if (nan == 0) return;
  const bool is_known = is_power_of_negative(best, observed);
  std::string sentence = fmt::format("NaN at {} of {} calls", nan, calls);
  if (is_known) {
    explanation.mistakes.emplace_back("negative-base");
    sentence += ": pow of a negative base, there is no max(..., 0)";
  }
  explanation.complete = explanation.complete && is_known;
  explanation.sentence += (explanation.sentence.empty() ? "" : "; ") + sentence;
}

records::ShaderExplanation explanation_of(const Search& search, const Observed& observed,
                                          bool is_half, bool differs) {
  const Candidate& best = search.best();
  records::ShaderExplanation explanation;
  explanation.left_of_peak = best.fit.left.most_of_peak;
  explanation.factors = best.factors;
  explanation.complete = best.explains() && best.coefficient.is_known;
  if (!best.explains()) {
    explanation.sentence = nearest_text(best);
  } else {
    for (const std::string_view id : best.ids()) explanation.mistakes.emplace_back(id);
    explanation.sentence = sentence_of(best);
    if (search.other() && sentence_of(*search.other()) != sentence_of(best))
      explanation.sentence += "; or, which gives the same: " + sentence_of(*search.other());
  }
  if (is_half && best.explains()) {
    explanation.mistakes.emplace_back("half-float-result");
    explanation.sentence +=
        (explanation.sentence.empty() ? "" : "; ") + std::string("every result is a half float");
  }
  add_nan(best, observed, explanation);
  if (best.explains() && explanation.sentence.empty()) {
    if (!differs) {
      explanation.sentence = "it is the model within the rounding of float32";
    } else if (is_rounding_of_cosine(best, observed)) {
      explanation.mistakes = {"float32-cosine"};
      explanation.sentence =
          "the exponent multiplies float32's rounding of the cosine; 1 - cosine as half the square of a "
          "difference of vectors would keep the angle";
    } else {
      explanation.sentence = "it is the model but for a few directions";
    }
  }
  return explanation;
}

/// Says it of a shader that gives nothing to search.
std::optional<records::ShaderExplanation> empty_explanation(const Observed& observed) {
  const bool is_zero = std::ranges::all_of(observed.values, [](double v) { return v == 0; });
  if (!is_zero && std::ranges::any_of(observed.values, [](double v) { return std::isfinite(v); }))
    return std::nullopt;
  records::ShaderExplanation found;
  found.mistakes = {is_zero ? "zero" : "no-number"};
  found.sentence = is_zero ? "it is 0 in every direction" : "it is no finite number anywhere";
  found.complete = true;
  return found;
}

/// If two models explain the same values, the report names the one that is off by a known factor rather than the one that
/// needs another coefficient, and the one that has a geometry term.
double rank(const Candidate& candidate) {
  constexpr double kLess = 0.1;
  const auto ids = candidate.ids();
  const bool is_other = std::ranges::count(ids, "coefficient") > 0 ||
                        (std::ranges::count(ids, "geometry-term") > 0 &&
                         !info(candidate.highlight.model).has_shadowing);
  return candidate.score() + (is_other ? kLess : 0);
}

/// `differs`: it is known not to be the model.
Identified search_all(std::span<const Highlight> highlights, const Observed& observed,
                      bool of_roughness, bool differs) {
  if (auto empty = empty_explanation(observed)) return {highlights.front(), std::move(*empty)};
  Searched values(observed);
  std::vector<std::unique_ptr<Search>> searches;
  for (const Highlight& highlight : highlights)
    searches.push_back(
        std::make_unique<Search>(highlight, values, of_roughness, highlights.size() == 1));
  const auto best = [&]() -> const Search& {
    return **std::ranges::min_element(searches, [](const auto& a, const auto& b) {
      const Candidate &ours = a->best(), &theirs = b->best();
      if (ours.explains() != theirs.explains()) return ours.explains();
      if (ours.explains()) return rank(ours) < rank(theirs);
      return ours.fit.left.most_of_peak < theirs.fit.left.most_of_peak;
    });
  };
  for (const auto& search : searches) search->try_one_mistake();
  // A fitted number is as simple as a mistake.
  if (!(best().best().score() < 1.5))
    for (const auto& search : searches) search->try_two_mistakes();
  if (!best().best().explains())
    for (const auto& search : searches) search->try_microfacet_forms();
  return {best().best().highlight, explanation_of(best(), observed, values.is_half, differs)};
}

}  // namespace

double textbook_rounding(double exponent) { return std::min(2e-5 + 6e-7 * exponent, 0.02); }
double allowed_error(double exponent) { return std::min(textbook_rounding(exponent), 1e-3); }

std::vector<std::string_view> mistake_names() {
  std::vector<std::string_view> names = coefficient_mistake_names();
  for (const Mistake& mistake : mistakes()) names.push_back(mistake.id);
  for (const OutputStep& step : output_steps()) names.push_back(step.id);
  for (const std::string_view name :
       {"fresnel", "floor", "exponent-fixed", "ambient", "diffuse", "half-float-result",
        "float32-cosine", "negative-base", "zero", "no-number"})
    names.push_back(name);
  return names;
}

std::vector<Highlight> all_highlights() {
  std::vector<Highlight> all;
  for (const LobeId& lobe : all_lobes())
    for (const ModelId model : all_models()) all.push_back({model, lobe});
  return all;
}

records::ShaderExplanation explain(const Highlight& highlight, const Observed& observed,
                                   bool of_roughness) {
  return search_all({&highlight, 1}, observed, of_roughness, true).explanation;
}

Identified identify(std::span<const Highlight> highlights, const Observed& observed,
                    bool of_roughness) {
  return search_all(highlights, observed, of_roughness, false);
}

}  // namespace lobelia::shader_check

#include "studies/shader_check/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lobelia::shader_check {
namespace {

constexpr std::size_t kSome = 48;  // points of a sample at each exponent
/// A sample is small: what fits all values may leave a little more of it.
constexpr double kMoreOfASample = 1.5;
/// Above it, float32 leaves nothing of a power of a cosine that a coefficient could be told from.
constexpr double kMostExponent = 2e4;
constexpr double kUnclear = 1e-2;  // the relative error of a coefficient that tells nothing
/// Another candidate of the same cost is better if it leaves this share, and as good if it does not leave its inverse.
constexpr double kFarLess = 0.3;
constexpr double kLeastAddition = 1e-4;  // of the lowest peak
constexpr std::ptrdiff_t kSharers = 4;   // calls that give the largest value

bool is_far_off(const Left& left) { return left.most > kMoreOfASample; }

/// Of one that explains nothing: a mistake that does not halve what the bare model leaves is no news.
double distance(const Candidate& candidate) {
  const bool is_bare = candidate.shape.empty() && candidate.chain.empty();
  return candidate.fit.left.most_of_peak * (is_bare ? 1 : 2);
}

/// The largest value, if several calls give just that, as behind a clamp.
double shared_largest(const std::vector<Group>& groups) {
  double largest = 0;
  for (const Group& group : groups)
    for (const double value : group.values) largest = std::max(largest, value);
  std::ptrdiff_t calls = 0;
  for (const Group& group : groups) calls += std::ranges::count(group.values, largest);
  return calls >= kSharers ? largest : 0;
}

}  // namespace

bool Candidate::explains() const { return std::isfinite(score()); }

std::vector<std::string_view> Candidate::ids() const {
  std::vector<std::string_view> ids = coefficient.ids;
  for (const Mistake* mistake : shape) ids.push_back(mistake->id);
  if (fit.additions.ambient) ids.push_back("ambient");
  if (fit.additions.diffuse) ids.push_back("diffuse");
  for (const OutputStep* step : chain) {
    ids.push_back(step->id);
    if (!step->also.empty()) ids.push_back(step->also);
  }
  return ids;
}

Searched::Searched(const Observed& observed)
    : some{Samples({}, true), {}}, all{Samples({}, false), {}} {
  std::vector<Group> groups = groups_of(observed);
  is_half = are_half_floats(groups);
  if (is_half) allow_half_floats(groups);
  all.samples = Samples(std::move(groups), false);
  some.samples = Samples(some_of(all.samples.groups(), kSome), true);
  for (const OutputStep& step : output_steps()) steps.push_back(&step);
  const double end = shared_largest(all.samples.groups());
  if (is_half || end <= 0 || end == 1) return;
  clamp_words_ = fmt::format("the result is clamped to {:.4g}", end);
  clamp_ = clamp_to(end, clamp_words_);
  steps.push_back(&clamp_);
}

const std::vector<Radiances>& Searched::Values::of(const Chain& chain) {
  const auto [at, is_new] = radiances.try_emplace(chain);
  if (is_new) at->second = radiances_of(samples.groups(), chain);
  return at->second;
}

const OutputStep* Searched::power(double exponent, const std::string& text) {
  const auto [at, is_new] = powers_.try_emplace(exponent);
  if (is_new) {
    at->second.words = fmt::format("the result has a gamma of {}", text);
    at->second.step = power_step(exponent, at->second.words);
  }
  return &at->second.step;
}

Search::Search(const Highlight& highlight, Searched& values, bool of_roughness, bool other_models)
    : highlight_(highlight), values_(values), names_(highlight) {
  for (const Mistake& mistake : mistakes()) {
    if (mistake.applies && !mistake.applies(highlight)) continue;
    if (mistake.of_roughness && !of_roughness) continue;
    // Beside models of the other angle that is no mistake.
    if (!other_models &&
        (mistake.id == "mirror-for-half-vector" || mistake.id == "half-vector-for-mirror"))
      continue;
    if (mistake.part == Part::kLobe) {
      const Mistake* const made[] = {&mistake};
      if (!other_models || formula_of(highlight_, 1, made).lobe == highlight_.lobe) continue;
    }
    usable_.push_back(&mistake);
  }
  // The narrower explanation first: 2 / alpha^2 is n + 2.
  std::ranges::stable_partition(usable_, &Mistake::of_roughness);
}

bool Search::has(const Shape& shape, Part part) const {
  return std::ranges::any_of(shape, [&](const Mistake* one) { return one->part == part; });
}

const Mistake* Search::keep(Mistake mistake) { return &fitted_.emplace_back(std::move(mistake)); }

std::vector<Formula> Search::formulas(const Shape& shape) const {
  std::vector<Formula> all;
  for (const Group& group : values_.all.samples.groups())
    all.push_back(formula_of(highlight_, group.exponent, shape));
  return all;
}

void Search::try_one_mistake() {
  try_shape({});
  for (const Mistake* one : usable_) try_shape({one});
  try_additions({}, {});
  try_fits({}, {}, true);
  for (const OutputStep* step : values_.steps) try_shape({}, {step});
  try_powers({});
}

void Search::try_two_mistakes() {
  for (std::size_t i = 0; i < usable_.size(); ++i)
    for (std::size_t j = i + 1; j < usable_.size(); ++j)
      if (usable_[i]->part != usable_[j]->part) try_shape({usable_[i], usable_[j]});
  for (const Mistake* one : usable_) {
    try_additions({one}, {});
    try_powers({one});
    try_fits({one}, {}, one->part != Part::kExponent && one->part != Part::kLobe);
  }
  for (const Mistake* guard : guards_beside_fresnel({})) {
    try_fits({guard}, {}, true);
    try_additions({guard}, {});
  }
  for (const OutputStep* step : values_.steps) {
    for (const Mistake* one : usable_) try_shape({one}, {step});
    try_additions({}, {step});
    try_fits({}, {step}, false);
  }
  for (const Chain& chain : chains_of_two()) try_shape({}, chain);
}

std::vector<const Mistake*> Search::guards_beside_fresnel(const Shape& shape) {
  std::vector<const Mistake*> all = fitted_guards(shape, {});
  for (const Mistake* fresnel : fitted_fresnel(shape, {})) {
    Shape with_fresnel = shape;
    with_fresnel.push_back(fresnel);
    for (const Mistake* guard : fitted_guards(with_fresnel, {})) all.push_back(guard);
  }
  return all;
}

void Search::try_microfacet_forms() {
  for (const Mistake* term : usable_) {
    if (term->part != Part::kGeometryTerm) continue;
    for (const Mistake* guard : guards_beside_fresnel({term})) try_fits({term, guard}, {}, false);
  }
}

void Search::try_shape(const Shape& shape, const Chain& chain, Additions additions) {
  const std::vector<Formula> formula = formulas(shape);
  Searched::Values &some = values_.some, &all = values_.all;
  if (!std::ranges::all_of(some.of(chain), &Radiances::are_possible)) return;
  const Fit of_some = shader_check::fit(some.samples.groups(), some.of(chain), formula,
                                        some.samples.shapes(formula), additions);
  Candidate candidate{highlight_, shape, chain, of_some, {}, {}, 0};
  // Of those that explain nothing, only the nearest counts, and it is told by the simple ones.
  const bool adds = additions.ambient || additions.diffuse;
  const bool is_simple = shape.size() <= 1 && chain.empty() && !adds;
  const bool off = is_far_off(of_some.left);
  if (off && !is_simple) return;
  if (off && best_ &&
      (best_->explains() || of_some.left.most_of_peak > 2 * best_->fit.left.most_of_peak))
    return;
  if (!std::ranges::all_of(all.of(chain), &Radiances::are_possible)) return;
  candidate.fit = shader_check::fit(all.samples.groups(), all.of(chain), formula,
                                    all.samples.shapes(formula), additions);
  // Light is added, and so much that it is no rounding.
  const Additions& found = candidate.fit.additions;
  const double least =
      kLeastAddition * std::ranges::min(all.of(chain), {}, &Radiances::largest).largest;
  if ((additions.ambient && found.of_ambient <= least) ||
      (additions.diffuse && found.of_diffuse <= least))
    return;
  name(candidate);
  if (is_simple || candidate.explains()) keep(std::move(candidate));
}

void Search::try_additions(const Shape& shape, const Chain& chain) {
  for (const bool only_lit : {false, true}) {
    try_shape(shape, chain, {true, false, only_lit});
    if (!only_lit) try_shape(shape, chain, {false, true, false});
    try_shape(shape, chain, {true, true, only_lit});
  }
}

void Search::try_fits(const Shape& shape, const Chain& chain, bool with_exponent) {
  const auto with = [&](const Mistake* mistake) {
    if (!mistake) return;
    Shape more = shape;
    more.push_back(mistake);
    try_shape(more, chain);
  };
  if (!has(shape, Part::kFresnel))
    for (const Mistake* fresnel : fitted_fresnel(shape, chain)) with(fresnel);
  if (!has(shape, Part::kBehind))
    for (const Mistake* floor : fitted_floors(shape, chain)) with(floor);
  if (!has(shape, Part::kGuard))
    for (const Mistake* guard : fitted_guards(shape, chain)) with(guard);
  if (with_exponent) with(fitted_exponent(shape));
}

void Search::try_powers(const Shape& shape) {
  for (const OutputStep* power : fitted_powers(shape)) {
    try_shape(shape, {power});
    if (shape.empty()) try_shape(shape, {values_.steps.front(), power});
  }
}

void Search::name(Candidate& candidate) {
  const std::vector<Formula> formula = formulas(candidate.shape);
  const std::vector<Group>& groups = values_.all.samples.groups();
  std::vector<FittedCoefficient> fitted;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const double n = groups[g].exponent, c = candidate.fit.coefficients[g];
    const double error = 3 * candidate.fit.errors[g];
    if (!candidate.fit.is_seen[g] || formula[g].exponent > kMostExponent || error > kUnclear)
      continue;
    // The inverse of an output step may multiply the rounding, as the power of 2.4 of sRGB does.
    const double share = candidate.chain.empty() ? 0.5 : 1.5,
                 rounding = share * textbook_rounding(std::max(n, formula[g].exponent));
    fitted.push_back({n, formula[g].exponent, c, rounding + error});
    candidate.factors.push_back({n, c / names_.own(n)});
  }
  candidate.cost = double(candidate.shape.size() + candidate.chain.size()) +
                   (candidate.fit.additions.ambient ? 1 : 0) +
                   (candidate.fit.additions.diffuse ? 1 : 0);
  if (!std::isfinite(candidate.fit.left.penalty())) return;
  if (fitted.empty()) {
    // A highlight that is not seen explains nothing.
    candidate.fit.left.most = candidate.fit.left.almost_all =
        std::numeric_limits<double>::infinity();
    return;
  }
  candidate.coefficient = names_.name(fitted, formula.front().lobe, !candidate.chain.empty());
  candidate.cost += candidate.coefficient.cost;
}

void Search::keep(Candidate candidate) {
  if (!best_) {
    best_ = std::move(candidate);
    return;
  }
  const double ours = candidate.score(), theirs = best_->score();
  if (!std::isfinite(ours)) {
    if (!std::isfinite(theirs) && distance(candidate) < distance(*best_))
      best_ = std::move(candidate);
    return;
  }
  // Less than a thousandth of what rounding may leave is as good as nothing.
  const double left = std::max(candidate.fit.left.most, 1e-3),
               best_left = std::max(best_->fit.left.most, 1e-3);
  if (ours < theirs || (ours == theirs && left < kFarLess * best_left)) {
    best_ = std::move(candidate);
    other_.reset();
  } else if (ours == theirs && kFarLess * left < best_left && candidate.ids() != best_->ids()) {
    other_ = std::move(candidate);
  }
}

}  // namespace lobelia::shader_check

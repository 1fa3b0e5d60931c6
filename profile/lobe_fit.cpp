#include "profile/lobe_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "base/words/constants.hpp"
#include "profile/critical.hpp"

namespace lobelia {
namespace {

// Steps small enough not to miss a single minimum of the sum of squares. A few thousand pixels suffice to locate it.
constexpr double kRatio = 1.25;
constexpr std::size_t kScanned = 4096;

/// A place of the highlight: what it shows is scale * coefficient * lobe.
struct Place {
  double log_cosine;  ///< of the lobe's angle
  double scale;
  double n_dot_l = 1, n_dot_v = 1;
};

struct Term {
  Place centre;
  double radiance;
  double weight = 1, error = kNaN;  ///< 0 for a clipped pixel
  double rounding = 0;
  int x = 0, y = 0;
  std::size_t nodes = 0, count = 0;  ///< in LobeTerms::nodes; none: the pixel shows its centre
};

/// Pixels, and the places of those that are means.
struct LobeTerms {
  std::vector<Term> pixels;
  std::vector<Place> nodes = {};  ///< the scale includes the share of the pixel

  std::span<const Place> places_of(const Term& term) const {
    if (term.count == 0) return {&term.centre, 1};
    return std::span(nodes).subspan(term.nodes, term.count);
  }
};

double log_cosine(double angle) {
  const double half_sine = std::sin(angle / 2);
  return std::log1p(-std::min(1.0, 2 * half_sine * half_sine));
}

/// Logarithm of a lobe over its peak, and the derivative of that by the logarithm of its width.
struct Lobe {
  double log_value, slope;
};

struct CosinePower {
  static constexpr double kSmallest = 1e-3, kLargest = 1e8;
  Lobe operator()(const Place& place, double exponent) const {
    const double power = exponent * place.log_cosine;
    return {power, power};
  }
};

/// Widths of microfacet distributions.
struct Microfacets {
  static constexpr double kSmallest = 1e-4, kLargest = 4;
  static double tangent_squared(double cosine) { return 1 / (cosine * cosine) - 1; }
};

struct Ggx : Microfacets {
  Lobe operator()(const Place& place, double alpha) const {
    const double squared = alpha * alpha, cosine2 = std::exp(2 * place.log_cosine);
    const double spread = (1 - cosine2) / squared, sum = cosine2 + spread;
    Lobe lobe{-2 * std::log(sum), 4 * spread / sum};
    for (const double cosine : {place.n_dot_l, place.n_dot_v}) {
      const double steep = squared * tangent_squared(cosine), root = std::sqrt(1 + steep);
      lobe.log_value += std::log(2 / (1 + root));
      lobe.slope -= steep / (root * (1 + root));
    }
    return lobe;
  }
};

struct Beckmann : Microfacets {
  Lobe operator()(const Place& place, double alpha) const {
    const double steepness = std::expm1(-2 * place.log_cosine) / (alpha * alpha);
    Lobe lobe{-steepness - 4 * place.log_cosine, 2 * steepness};
    for (const double cosine : {place.n_dot_l, place.n_dot_v}) {
      const double a = 1 / (alpha * std::sqrt(tangent_squared(cosine)));
      if (!(a < 1.6)) continue;
      const double above = (3.535 + 2.181 * a) * a, below = 1 + (2.276 + 2.577 * a) * a;
      lobe.log_value += std::log(above / below);
      lobe.slope -= a * ((3.535 + 4.362 * a) / above - (2.276 + 5.154 * a) / below);
    }
    return lobe;
  }
};

/// A pixel's value without the coefficient, and its derivative by the logarithm of the width.
struct LobeValue {
  double f = 0, by_width = 0;
};
template <class Family>
LobeValue value_of(Family family, std::span<const Place> places, double width) {
  LobeValue value;
  for (const Place& place : places) {
    const Lobe lobe = family(place, width);
    const double f = place.scale * std::exp(lobe.log_value);
    value.f += f;
    if (f != 0) value.by_width += f * lobe.slope;
  }
  return value;
}

/// The best coefficient at a width.
struct Best {
  double coefficient, squares;
  double score;  ///< half of minus the derivative of the squares by the width's logarithm
};

/// Every `stride`th pixel alone counts, for a look from afar by its centre alone.
template <class Family>
Best best_at(Family family, const LobeTerms& terms, double width, std::size_t stride = 0) {
  const std::vector<Term>& pixels = terms.pixels;
  double ff = 0, fy = 0;
  std::vector<LobeValue> values;
  const std::size_t step = std::max<std::size_t>(1, stride);
  for (std::size_t i = 0; i < pixels.size(); i += step) {
    const Term& term = pixels[i];
    const LobeValue& value = values.emplace_back(
        value_of(family, stride > 0 ? std::span(&term.centre, 1) : terms.places_of(term), width));
    ff += term.weight * value.f * value.f;
    fy += term.weight * value.f * term.radiance;
  }
  Best best{ff > 0 ? fy / ff : 0, 0, 0};
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Term& term = pixels[k * step];
    const double residual = term.radiance - best.coefficient * values[k].f;
    best.squares += term.weight * residual * residual;
    best.score += term.weight * residual * best.coefficient * values[k].by_width;
  }
  return best;
}

/// The logarithm of the width with the least sum of squares over a few thousand pixels.
template <class Family>
double scan(Family family, const LobeTerms& terms) {
  const std::size_t stride = terms.pixels.size() / kScanned + 1;
  double least = kInfinity, at = kNaN;
  for (double u = std::log(Family::kSmallest); u <= std::log(Family::kLargest);
       u += std::log(kRatio)) {
    const Best best = best_at(family, terms, std::exp(u), stride);
    if (best.coefficient > 0 && best.squares < least) {
      least = best.squares;
      at = u;
    }
  }
  return at;
}

/// The root of the score near `u`, or NaN.
template <class Family>
double refine(Family family, const LobeTerms& terms, double u) {
  const auto score = [&](double v) { return best_at(family, terms, std::exp(v)).score; };
  double reach = std::log(kRatio);
  double low = u - reach, high = u + reach, at_low = score(low), at_high = score(high);
  for (int wider = 0; wider < 4 && !(at_low > 0 && at_high < 0); ++wider) {
    reach *= 2;
    if (!(at_low > 0)) at_low = score(low = u - reach);
    if (!(at_high < 0)) at_high = score(high = u + reach);
  }
  if (!(at_low > 0 && at_high < 0)) return kNaN;
  std::uintmax_t steps = 100;
  const auto [from, to] = boost::math::tools::toms748_solve(
      score, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(52), steps);
  return (from + to) / 2;
}

/// The variance of a sum of independent terms by their squares, and how well these tell it.
struct SumVariance {
  double variance = 0, fourth_powers = 0;

  void add(double term) {
    variance += term * term;
    fourth_powers += term * term * term * term;
  }
  /// Half of the interval that holds the sum as often as two standard deviations of a normal number do.
  double standard_error() const {
    constexpr double kBeyondTwoDeviations = 0.0455;
    static const CriticalT critical(kBeyondTwoDeviations);
    if (!(fourth_powers > 0)) return 0;
    const double freedom = 3 * variance * variance / fourth_powers;
    return std::sqrt(variance) * critical(freedom) / critical.normal();
  }
};

/// Estimates the variance of a sum of one value for each pixel. Neighbours may err together, so it is the largest of
/// those by blocks of 1, 2, 4 ... pixels to a side, as long as there are enough blocks.
SumVariance variance_of_sum(const std::vector<Term>& terms, const std::vector<double>& values) {
  constexpr std::size_t kFewestBlocks = 30;
  SumVariance largest;
  for (const double value : values) largest.add(value);
  for (int shift = 1; shift < 16; ++shift) {
    std::unordered_map<std::uint64_t, double> blocks;
    for (std::size_t i = 0; i < terms.size(); ++i)
      if (terms[i].weight > 0)
        blocks[(std::uint64_t(terms[i].y >> shift) << 32) + std::uint64_t(terms[i].x >> shift)] +=
            values[i];
    if (blocks.size() < kFewestBlocks) break;
    const double unbiased = std::sqrt(double(blocks.size()) / double(blocks.size() - 1));
    SumVariance of_blocks;
    for (const auto& [block, sum] : blocks) of_blocks.add(sum * unbiased);
    if (of_blocks.variance > largest.variance) largest = of_blocks;
  }
  return largest;
}

/// The width's standard error, by HC3; with known errors and rounding at least by these. `above_half` pixels are above half
/// of the peak.
template <class Family>
double standard_error(Family family, const LobeTerms& all, double width, double coefficient,
                      double above_half, bool shared) {
  const std::vector<Term>& terms = all.pixels;
  // Derivatives by the relative change of the coefficient (a) and of the width (b).
  struct Row {
    double a, b, residual;
  };
  std::vector<Row> rows;
  double aa = 0, ab = 0, bb = 0;
  for (const Term& term : terms) {
    const LobeValue value = value_of(family, all.places_of(term), width);
    const double f = coefficient * value.f, by_width = coefficient * value.by_width;
    rows.push_back({f, by_width, term.radiance - f});
    aa += term.weight * f * f;
    ab += term.weight * f * by_width;
    bb += term.weight * by_width * by_width;
  }
  const double determinant = aa * bb - ab * ab;
  double known = 0, together = 0;
  std::vector<double> scores;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    const double influence = terms[i].weight * (aa * row.b - ab * row.a) / determinant;
    const double leverage = terms[i].weight *
                            (bb * row.a * row.a - 2 * ab * row.a * row.b + aa * row.b * row.b) /
                            determinant;
    scores.push_back(influence * row.residual / std::max(1e-6, 1 - leverage));
    const double rounding = influence * terms[i].rounding;
    known += rounding * rounding;
    if (std::isnan(terms[i].error)) continue;
    const double error = influence * terms[i].error;
    known += error * error;
    together += error;
  }
  // The places of a pixel give its mean exactly up to degree 5, so what is left falls as the sixth power of the half-width.
  // The smallest lobes with any of our filters are off by less.
  constexpr double kOfMeans = 1.5e-6;
  const double of_means =
      all.nodes.empty() ? 0 : kOfMeans * std::pow(double(kFewestPixelsOfALobe) / above_half, 3);
  return width * std::max({std::sqrt(known), variance_of_sum(terms, scores).standard_error(),
                           shared ? std::abs(together) : 0, of_means});
}

LobeFit no_fit(std::size_t pixels, std::string why) {
  return {kNaN, kNaN, kNaN, kNaN, pixels, std::move(why)};
}

template <class Family>
LobeFit fit_lobe(Family family, const LobeTerms& all, bool shared, const std::string& what) {
  const std::vector<Term>& terms = all.pixels;
  const auto known =
      std::size_t(std::ranges::count_if(terms, [](const Term& term) { return term.weight > 0; }));
  if (known < kFewestPixelsOfALobe)
    return no_fit(known, fmt::format("it has {} pixels{}, too few: {} are needed", known,
                                     known < terms.size() ? " that are not clipped" : "",
                                     kFewestPixelsOfALobe));
  const double coarse = scan(family, all);
  if (std::isnan(coarse)) return no_fit(known, "it holds no light");
  const double width = std::exp(refine(family, all, coarse));
  if (!(width >= Family::kSmallest && width <= Family::kLargest))
    return no_fit(known, fmt::format("no {} fits it better than its neighbours do", what));
  const auto within = std::size_t(std::ranges::count_if(terms, [&](const Term& term) {
    return family(term.centre, width).log_value >= std::log(0.5);
  }));
  if (within < kFewestPixelsOfALobe)
    return no_fit(
        known,
        fmt::format("not resolved: {} of its pixels are above half of its peak, {} are needed",
                    within, kFewestPixelsOfALobe));
  const Best best = best_at(family, all, width);
  double brightest = 0, squares = 0;
  for (const Term& term : terms) {
    const double value = best.coefficient * value_of(family, all.places_of(term), width).f;
    brightest = std::max(brightest, value);
    if (term.weight > 0) squares += (term.radiance - value) * (term.radiance - value);
  }
  return {width,
          standard_error(family, all, width, best.coefficient, double(within), shared),
          best.coefficient,
          std::sqrt(squares / double(known)) / brightest,
          known,
          ""};
}

/// A family's fit, and the residual of each pixel.
struct Candidate {
  FamilyFit family;
  double squares = 0;  ///< weighted
  double rms = 0;      ///< unweighted
  std::vector<double> residuals;
};

template <class Family>
Candidate candidate(Family family, FittedFamily name, bool times_n_dot_l, LobeTerms terms,
                    bool shared) {
  const bool cosine = name == FittedFamily::kPhong || name == FittedFamily::kBlinnPhong;
  const auto scale = [&](Place& place) {
    if (times_n_dot_l) place.scale *= place.n_dot_l;
    if (!cosine) place.scale /= place.n_dot_v;
  };
  for (Term& term : terms.pixels) scale(term.centre);
  for (Place& node : terms.nodes) scale(node);
  Candidate one;
  one.family = {
      name, times_n_dot_l,
      fit_lobe(family, terms, shared, cosine ? "power of a cosine" : "microfacet distribution")};
  double residuals = 0, errors = 0;
  for (const Term& term : terms.pixels) {
    const LobeFit& fit = one.family.fit;
    const double residual =
        term.radiance - fit.coefficient * value_of(family, terms.places_of(term), fit.width).f;
    one.residuals.push_back(residual);
    if (!(term.weight > 0)) continue;
    one.squares += term.weight * residual * residual;
    residuals += residual * residual;
    errors += term.error * term.error;
  }
  one.rms = std::sqrt(residuals / double(one.family.fit.pixels));
  one.family.noise_share = std::sqrt(residuals / errors);
  return one;
}

/// See "told apart" in the header. The pixels' weights decide which count.
double told_apart(const std::vector<Term>& terms, const Candidate& better, const Candidate& worse) {
  std::vector<double> products;
  double more = 0;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const double r = better.residuals[i], d = worse.residuals[i] - r;
    products.push_back(terms[i].weight * r * d);
    more += terms[i].weight * (2 * r + d) * d;
  }
  return more > 0 ? more / (2 * std::sqrt(variance_of_sum(terms, products).variance)) : 0;
}

/// Adds half of what the width would be off by if the other fit were the right one.
void add_doubt(LobeFit& fit, const LobeFit& other) {
  fit.standard_error = std::hypot(fit.standard_error, (fit.width - other.width) / 2);
}

/// Takes the middle of two fits of which either may be the right one, so that the error need not reach from one to the
/// other.
void meet_halfway(LobeFit& fit, const LobeFit& other) {
  fit.standard_error = std::max(fit.standard_error, other.standard_error);
  add_doubt(fit, other);
  fit.width = (fit.width + other.width) / 2;
  fit.coefficient = (fit.coefficient + other.coefficient) / 2;
}

/// The families that explain pixels which show their centres, or their means.
struct Explained {
  std::vector<Candidate> families;  ///< the best first
  LobeTerms half;                   ///< about the half vector, with the weights
};

Explained explain(std::span<const SeenLobe> pixels, bool shared, bool means) {
  double peak = 0;
  for (const SeenLobe& pixel : pixels) peak = std::max(peak, pixel.radiance);
  const auto terms = [&](double SeenLobe::*angle, double LobeNode::*angle_of_node) {
    LobeTerms result;
    for (const SeenLobe& pixel : pixels) {
      const double floor = peak / 1000;
      const double weight =
          std::isnan(pixel.error) ? 1 : 1 / (pixel.error * pixel.error + floor * floor);
      const bool is_known = pixel.is_known && !(means && pixel.nodes.empty());
      Term& term = result.pixels.emplace_back(
          Term{{log_cosine(pixel.*angle), pixel.irradiance, pixel.n_dot_l, pixel.n_dot_v},
               pixel.radiance - (means ? pixel.more_beneath : 0),
               is_known ? weight : 0,
               pixel.error,
               pixel.rounding,
               pixel.x,
               pixel.y});
      if (!means) continue;
      term.nodes = result.nodes.size();
      term.count = pixel.nodes.size();
      for (const LobeNode& node : pixel.nodes)
        result.nodes.push_back({log_cosine(node.*angle_of_node), node.share * node.irradiance,
                                node.n_dot_l, node.n_dot_v});
    }
    return result;
  };
  Explained result{{}, terms(&SeenLobe::half_vector, &LobeNode::half_vector)};
  const LobeTerms reflection = terms(&SeenLobe::reflection, &LobeNode::reflection);
  for (const auto& [name, of] :
       {std::pair{FittedFamily::kPhong, &reflection}, {FittedFamily::kBlinnPhong, &result.half}}) {
    Candidate plain = candidate(CosinePower{}, name, false, *of, shared);
    Candidate lit = candidate(CosinePower{}, name, true, *of, shared);
    const bool plain_is_better = plain.squares <= lit.squares || lit.family.fit.why_not.size() > 0;
    Candidate &better = plain_is_better ? plain : lit, &other = plain_is_better ? lit : plain;
    // Noise may have chosen.
    if (better.family.fit.why_not.empty() && other.family.fit.why_not.empty() &&
        told_apart(of->pixels, better, other) < kToldApart)
      add_doubt(better.family.fit, other.family.fit);
    result.families.push_back(std::move(better));
  }
  result.families.push_back(candidate(Ggx{}, FittedFamily::kGgx, false, result.half, shared));
  result.families.push_back(
      candidate(Beckmann{}, FittedFamily::kBeckmann, false, result.half, shared));
  std::ranges::stable_sort(result.families, {}, [](const Candidate& one) {
    return one.family.fit.why_not.empty() ? one.squares : kInfinity;
  });
  return result;
}

std::vector<FamilyFit> families_of(const Explained& explained) {
  std::vector<FamilyFit> result;
  const Candidate& best = explained.families.front();
  for (const Candidate& one : explained.families) {
    result.push_back(one.family);
    // Relative to the same peak: beyond clipped pixels, another family may rise far higher.
    if (best.rms > 0) result.back().fit.residual = one.rms / best.rms * best.family.fit.residual;
    result.back().apart =
        one.family.fit.why_not.empty() ? told_apart(explained.half.pixels, best, one) : kNaN;
  }
  return result;
}

}  // namespace

LobeFit fit_cosine_lobe(std::span<const LobeSample> samples) {
  LobeTerms terms;
  for (const LobeSample& sample : samples) {
    if (!std::isfinite(sample.radiance) || !std::isfinite(sample.angle + sample.scale))
      return no_fit(samples.size(), "a pixel of it is not finite");
    terms.pixels.push_back({{log_cosine(sample.angle), sample.scale},
                            sample.radiance,
                            sample.is_known ? 1.0 : 0.0,
                            kNaN,
                            0,
                            0,
                            0,
                            terms.nodes.size(),
                            sample.nodes.size()});
    for (const LobeSample::Node& node : sample.nodes)
      terms.nodes.push_back({log_cosine(node.angle), node.scale});
  }
  return fit_lobe(CosinePower{}, terms, false, "power of a cosine");
}

Explanation explain_highlight(std::span<const SeenLobe> pixels, bool shared, PixelsShow show) {
  if (show != PixelsShow::kUnknown)
    return {families_of(explain(pixels, shared, show == PixelsShow::kMeans)), show};
  const Explained centres = explain(pixels, shared, false), means = explain(pixels, shared, true);
  Explanation by_centres{families_of(centres), PixelsShow::kCentres};
  Explanation by_means{families_of(means), PixelsShow::kMeans};
  const Candidate &a = centres.families.front(), &b = means.families.front();
  if (!b.family.fit.why_not.empty()) return by_centres;
  if (!a.family.fit.why_not.empty()) return by_means;
  // Judged by the pixels that both fit.
  if (told_apart(means.half.pixels, b, a) >= kToldApart) return by_means;
  if (told_apart(means.half.pixels, a, b) >= kToldApart) return by_centres;
  for (FamilyFit& one : by_centres.families) {
    const auto other = std::ranges::find(by_means.families, one.family, &FamilyFit::family);
    if (one.fit.why_not.empty() && other->fit.why_not.empty()) meet_halfway(one.fit, other->fit);
  }
  by_centres.pixels = PixelsShow::kUnknown;
  return by_centres;
}

std::vector<FamilyFit> explain_highlight(std::span<const SeenLobe> pixels, bool shared) {
  return explain_highlight(pixels, shared, PixelsShow::kCentres).families;
}

}  // namespace lobelia

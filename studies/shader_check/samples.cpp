#include "studies/shader_check/samples.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "base/pictures/half.hpp"

namespace lobelia::shader_check {
namespace {

/// Float32 leaves at most this many tolerances at all points but the worst, and at nearly all of them.
constexpr double kAlmostAll = 0.997, kMost = 0.98;
constexpr double kPenaltyOfMost = 1.5;  // of a candidate that fits most points but not almost all
/// Where L + V is shorter, float32 does not know H.
constexpr double kLeastHalfLength = 0.2;
/// The peak of a group, but for values that stand out, as of a division by a small cosine.
constexpr double kPeakShare = 0.95, kLeastPeak = 1e-3;
/// A cosine of float32 is off by 1e-7 or so: by the share of it that rounding is of this.
constexpr double kGrazing = 0.01;
/// As in textbook_rounding, without its end: a lobe's exponent may be far above the one asked for.
constexpr double kRoundingPerExponent = 6e-7;
constexpr std::size_t kFewestHalves = 100;
constexpr double kSeen = 0.01;  // a highlight's share of the largest value

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void set_errors(Group& group) {
  std::vector<double> sizes;
  for (const double v : group.values) sizes.push_back(std::abs(v));
  const double largest = sizes.empty() ? 0 : std::ranges::max(sizes),
               peak = std::max({quantile(sizes, kPeakShare), kLeastPeak * largest, 1e-30});
  const double rounding = textbook_rounding(group.exponent);
  for (std::size_t i = 0; i < group.values.size(); ++i) {
    const Geometry& g = group.seen[i].as(Reversed::kNone);
    const double grazing = kGrazing / std::max(std::min(std::abs(g.n_dot_l), g.n_dot_v), 1e-6);
    group.errors.push_back((rounding * more_where_opposite(g) + 2e-5 * grazing) *
                           std::max(std::abs(group.values[i]), peak));
  }
}

template <class F>
std::uint64_t bits(F function) {
  static_assert(sizeof(F) == sizeof(std::uintptr_t));
  return std::bit_cast<std::uintptr_t>(function);
}

/// The sums of weighted products over a group that a fit needs.
struct Sums {
  double ss = 0, sy = 0, yy = 0;
  double s_[2] = {}, y_[2] = {}, q[2][2] = {};  // with the additions
};

/// ambient and diffuse as columns.
std::array<double, 2> columns(const Geometry& g, const Additions& additions) {
  const double light = std::max(g.n_dot_l, 0.0);
  const bool is_lit = !additions.only_lit || g.n_dot_l > 0;
  return {additions.ambient && is_lit ? 1.0 : 0.0, additions.diffuse ? light : 0.0};
}

void fit_additions(const std::vector<Sums>& all, Additions& additions) {
  double m[2][2] = {}, r[2] = {};
  for (const Sums& sums : all)
    for (int i = 0; i < 2; ++i) {
      const double share = sums.ss > 0 ? sums.s_[i] / sums.ss : 0;
      r[i] += sums.y_[i] - share * sums.sy;
      for (int j = 0; j < 2; ++j) m[i][j] += sums.q[i][j] - share * sums.s_[j];
    }
  if (!additions.ambient) m[0][0] = 1, m[0][1] = m[1][0] = r[0] = 0;
  if (!additions.diffuse) m[1][1] = 1, m[0][1] = m[1][0] = r[1] = 0;
  const double determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  if (!(determinant > 0)) return;
  additions.of_ambient = (r[0] * m[1][1] - r[1] * m[0][1]) / determinant;
  additions.of_diffuse = (m[0][0] * r[1] - m[1][0] * r[0]) / determinant;
}

}  // namespace

std::vector<Group> groups_of(const Observed& observed) {
  std::map<double, Group> by_exponent;
  for (std::size_t i = 0; i < observed.points.size(); ++i) {
    const Seen seen(observed.points[i]);
    const Geometry& g = seen.as(Reversed::kNone);
    if (!std::isfinite(observed.values[i]) || !is_defined(g) || std::abs(g.n_dot_l) < 1e-6 ||
        std::min(std::abs(g.mirror), std::abs(g.n_dot_h)) < 1e-5 ||
        g.half_length < kLeastHalfLength)
      continue;
    Group& group = by_exponent[observed.points[i].exponent];
    group.seen.push_back(seen);
    group.values.push_back(observed.values[i]);
  }
  std::vector<Group> groups;
  for (auto& [n, group] : by_exponent) {
    group.exponent = n;
    set_errors(group);
    groups.push_back(std::move(group));
  }
  return groups;
}

bool are_half_floats(const std::vector<Group>& groups) {
  std::set<double> seen;
  for (const Group& group : groups)
    for (const double value : group.values) {
      if (rounded_to_half(value) != value) return false;
      if (value != 0 && seen.size() < kFewestHalves) seen.insert(value);
    }
  return seen.size() == kFewestHalves;
}

void allow_half_floats(std::vector<Group>& groups) {
  for (Group& group : groups)
    for (std::size_t i = 0; i < group.values.size(); ++i)
      group.errors[i] += std::abs(group.values[i]) * 0x1p-11 + 0x1p-25;
}

std::vector<Group> some_of(const std::vector<Group>& groups, std::size_t count) {
  std::vector<Group> some = groups;
  for (Group& group : some) {
    const std::size_t size = std::min(count, group.seen.size());
    group.seen.erase(group.seen.begin() + std::ptrdiff_t(size), group.seen.end());
    group.values.resize(size);
    group.errors.resize(size);
  }
  return some;
}

std::vector<Radiances> radiances_of(const std::vector<Group>& groups, const Chain& chain) {
  std::vector<Radiances> all;
  for (const Group& group : groups) {
    Radiances& to = all.emplace_back();
    for (std::size_t i = 0; i < group.values.size(); ++i) {
      const Origin origin = origin_of(chain, group.values[i], group.errors[i]);
      to.are_possible = to.are_possible && origin.is_possible;
      const double least = 1e-12 * (1e-12 + std::abs(origin.radiance));
      to.value.push_back(origin.radiance);
      to.below.push_back(std::max(origin.below, least));
      to.above.push_back(std::max(origin.above, least));
      const double error = (to.below.back() + to.above.back()) / 2;
      to.weight.push_back(std::isfinite(error) ? 1 / (error * error) : 0);
      if (std::isfinite(error)) to.largest = std::max(to.largest, std::abs(origin.radiance));
    }
  }
  return all;
}

const std::vector<double>& Samples::lobe(std::size_t group, const Formula& f) {
  const Key key{group,
                std::bit_cast<std::uint64_t>(f.exponent),
                bits(f.lobe_cosine),
                std::bit_cast<std::uint64_t>(f.least_cosine),
                std::uint64_t(f.angle) + 2u * f.mirrored + 4u * std::uint64_t(f.half) +
                    16u * std::uint64_t(f.reversed),
                f.lobe.index,
                f.lobe.order,
                bits(f.lobe.formula.get())};
  if (!keeps_) lobes_.clear();
  const auto [at, is_new] = lobes_.try_emplace(key);
  if (is_new) at->second = lobe_values(f, groups_[group].seen);
  return at->second;
}

const std::vector<double>& Samples::factor(std::size_t group, const Formula& f) {
  const Key key{group,
                f.geometry_term ? std::bit_cast<std::uint64_t>(f.exponent) : 0,
                bits(f.cosine),
                bits(f.geometry_term),
                std::bit_cast<std::uint64_t>(f.least_product),
                std::bit_cast<std::uint64_t>(f.more_product),
                std::bit_cast<std::uint64_t>(f.f0),
                bits(f.fresnel),
                std::bit_cast<std::uint64_t>(f.least_light),
                std::uint64_t(f.behind) + 8u * std::uint64_t(f.reversed)};
  if (!keeps_) factors_.clear();
  const auto [at, is_new] = factors_.try_emplace(key);
  if (is_new) at->second = factor_values(f, groups_[group].seen);
  return at->second;
}

std::vector<std::vector<double>> Samples::shapes(std::span<const Formula> formulas) {
  std::vector<std::vector<double>> all;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    std::vector<double> values = lobe(g, formulas[g]);
    const std::vector<double>& factors = factor(g, formulas[g]);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] *= factors[i];
    all.push_back(std::move(values));
  }
  return all;
}

double Left::penalty() const {
  return almost_all <= 1 ? 0 : most <= 1 ? kPenaltyOfMost : kInfinity;
}

Fit fit(const std::vector<Group>& groups, const std::vector<Radiances>& radiances,
        std::span<const Formula> formulas, const std::vector<std::vector<double>>& shapes,
        Additions additions) {
  const bool adds = additions.ambient || additions.diffuse;
  std::vector<Sums> all(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Radiances& y = radiances[g];
    Sums& sums = all[g];
    for (std::size_t i = 0; i < y.value.size(); ++i) {
      const double w = y.weight[i], s = shapes[g][i];
      sums.ss += w * s * s;
      sums.sy += w * s * y.value[i];
      sums.yy += w * y.value[i] * y.value[i];
      if (!adds) continue;
      const auto c = columns(groups[g].seen[i].as(Reversed::kNone), additions);
      for (int k = 0; k < 2; ++k) {
        sums.s_[k] += w * s * c[k];
        sums.y_[k] += w * y.value[i] * c[k];
        for (int j = 0; j < 2; ++j) sums.q[k][j] += w * c[k] * c[j];
      }
    }
  }
  if (adds) fit_additions(all, additions);
  Fit result{{}, {}, {}, additions, {}};
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Radiances& y = radiances[g];
    const Sums& sums = all[g];
    const double of_additions =
        additions.of_ambient * sums.s_[0] + additions.of_diffuse * sums.s_[1];
    const double c = sums.ss > 0 ? (sums.sy - of_additions) / sums.ss : 0;
    const double n = groups[g].exponent,
                 more = std::max(kRoundingPerExponent * formulas[g].exponent / textbook_rounding(n),
                                 1.0);
    std::vector<double> ratios, differences;
    double largest = 0;
    for (std::size_t i = 0; i < y.value.size(); ++i) {
      double value = c * shapes[g][i];
      if (y.weight[i] > 0) largest = std::max(largest, std::abs(value));
      if (adds) {
        const auto column = columns(groups[g].seen[i].as(Reversed::kNone), additions);
        value += additions.of_ambient * column[0] + additions.of_diffuse * column[1];
      }
      const double difference = value - y.value[i];
      const double ratio = difference > 0 ? difference / y.above[i] : -difference / y.below[i];
      ratios.push_back(std::isfinite(ratio) ? ratio / more : 0);
      if (ratio > 0 && std::isfinite(ratio)) differences.push_back(std::abs(difference));
    }
    // The higher one first: the lower one is then below it.
    result.left.almost_all = std::max(result.left.almost_all, quantile(ratios, kAlmostAll));
    result.left.most = std::max(result.left.most, quantile(ratios, kMost));
    if (y.largest > 0)
      result.left.most_of_peak =
          std::max(result.left.most_of_peak, quantile(differences, kMost) / y.largest);
    result.coefficients.push_back(c);
    result.errors.push_back(sums.ss > 0 && c != 0 ? 1 / (std::abs(c) * std::sqrt(sums.ss)) : 1);
    result.is_seen.push_back(c > 0 && largest > kSeen * y.largest);
  }
  return result;
}

}  // namespace lobelia::shader_check

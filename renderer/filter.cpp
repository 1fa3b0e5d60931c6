#include "renderer/filter.hpp"

#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "renderer/filters/catalogue.hpp"

namespace lobelia {
namespace {

constexpr auto kFilterNames =
    map_types<std::string_view>(Filters{}, []<class F>() { return F::kName; });

/// Steps of the cumulative distribution, which is linear within one: a relative error of 1e-7.
constexpr int kSteps = 4096;

}  // namespace

std::span<const std::string_view> filter_names() { return kFilterNames; }
std::string_view name(Filter filter) { return kFilterNames.at(filter.index); }

double filter_value(Filter filter, double x) {
  static constexpr auto kValues = map_types<double (*)(double)>(
      Filters{}, []<class F>() -> double (*)(double) { return &F::value; });
  return kValues.at(filter.index)(x);
}

int reach_of(Filter filter) { return int(std::ceil(filter.radius + 0.5)); }

std::optional<Filter> find_filter(std::string_view name) {
  static constexpr auto kRadii = map_types<double>(Filters{}, []<class F>() { return F::kRadius; });
  const auto index = find_id<std::size_t>(kFilterNames, name);
  if (!index) return std::nullopt;
  return Filter{std::uint8_t(*index), kRadii[*index]};
}

FilterSampler::FilterSampler(Filter filter) : box_(filter.index == 0), radius_(filter.radius) {
  if (box_) return;
  const auto integrate = [&](Axis& axis, double sign) {
    axis.cumulative.push_back(0);
    for (int i = 0; i < kSteps; ++i) {
      const double here = sign * filter_value(filter, 2 * (i + 0.5) / kSteps - 1);
      axis.cumulative.push_back(axis.cumulative.back() + std::max(0.0, here));
    }
    const double total = axis.cumulative.back();
    if (total > 0)
      for (double& c : axis.cumulative) c /= total;
    return total;
  };
  const double above = integrate(above_, 1), below = integrate(below_, -1);
  if (below == 0) return;
  const double positive = above * above + below * below, negative = 2 * above * below;
  above_share_ = above * above / positive;
  negative_weight_ = negative / (positive - negative);
  negative_every_ = std::uint32_t(std::lround((positive + negative) / negative));
}

FilterSampler::Place FilterSampler::place(std::uint32_t k) const {
  if (negative_every_ == 0) return {false, k};
  // The second sample is negative, so that two samples cover both parts.
  const bool negative = k % negative_every_ == 1;
  const std::uint32_t before = k / negative_every_ + (k % negative_every_ > 1);
  return {negative, negative ? before : k - before};
}

FilterSampler::Offset FilterSampler::operator()(bool negative, double u, double v) const {
  if (box_) return {radius_ * (2 * u - 1), radius_ * (2 * v - 1)};
  // The product of the two axes is negative with one factor below 0, positive with none or two.
  const double share = negative ? 0.5 : above_share_;
  const bool first = u < share;
  const Axis& x = first ? above_ : below_;
  const Axis& y = first != negative ? above_ : below_;
  return {x(first ? u / share : (u - share) / (1 - share), radius_), y(v, radius_)};
}

double FilterSampler::Axis::operator()(double u, double radius) const {
  const auto above = std::upper_bound(cumulative.begin() + 1, cumulative.end() - 1, u);
  const std::size_t step = std::size_t(above - cumulative.begin()) - 1;
  const double low = cumulative[step], width = cumulative[step + 1] - low;
  const double within = width > 0 ? (u - low) / width : 0.5;
  return radius * (2 * (double(step) + within) / kSteps - 1);
}

}  // namespace lobelia

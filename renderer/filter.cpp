#include "renderer/filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/words/text.hpp"
#include "renderer/filters.hpp"

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

namespace {

struct AxisNode {
  double x, weight;
};
using AxisNodes = std::vector<AxisNode>;

/// Nodes and weights of Gauss and Legendre of 4 nodes, over [-1, 1], for a mean.
constexpr std::array<AxisNode, 4> kLegendre = {{{-0.86113631159405258, 0.17392742256872692},
                                                {-0.33998104358485626, 0.32607257743127308},
                                                {0.33998104358485626, 0.32607257743127308},
                                                {0.86113631159405258, 0.17392742256872692}}};

/// The filter at nodes of `parts` equal parts of [-1, 1]; an even number separates the kinks at 0 and half of the radius.
AxisNodes legendre_nodes(Filter filter, int parts) {
  AxisNodes nodes;
  for (int part = 0; part < parts; ++part)
    for (const AxisNode& one : kLegendre) {
      const double x = (2 * part + 1 + one.x) / parts - 1;
      nodes.push_back({x, one.weight * filter_value(filter, x) / parts});
    }
  double sum = 0;
  for (const AxisNode& node : nodes) sum += node.weight;
  for (AxisNode& node : nodes) node.weight /= sum;
  return nodes;
}

/// The rule of so many nodes whose weight is the filter, which is even: in t = x^2, 3 nodes are 0 and a root, 4 are the two
/// roots of the orthogonal polynomial of degree 2. Weights are negative where
/// the filter is. Nothing if a node is not real.
std::optional<AxisNodes> gauss_nodes(const std::array<double, 4>& moments, bool four) {
  const auto& [one, second, fourth, sixth] = moments;
  if (!four) {
    const double t = fourth / second, weight = second * second / (2 * fourth);
    if (!(t > 0 && weight > 0 && weight < 0.5)) return std::nullopt;
    const double x = std::sqrt(t);
    return AxisNodes{{-x, weight}, {0, 1 - 2 * weight}, {x, weight}};
  }
  const double determinant = second * second - fourth * one;
  const double p = (sixth * one - fourth * second) / determinant;
  const double q = (fourth * fourth - sixth * second) / determinant;
  const double root = std::sqrt(p * p / 4 - q);
  const double low = -p / 2 - root, high = -p / 2 + root;
  // One and the second moment fix both weights.
  const double outer = (second - low) / (high - low);
  if (!(low > 0 && high <= 1 && std::abs(outer) < 1)) return std::nullopt;
  const double near = std::sqrt(low), far = std::sqrt(high);
  return AxisNodes{
      {-far, outer / 2}, {-near, (1 - outer) / 2}, {near, (1 - outer) / 2}, {far, outer / 2}};
}

AxisNodes axis_nodes(Filter filter) {
  constexpr int kParts = 64;
  std::array<double, 4> moments{};
  for (const AxisNode& node : legendre_nodes(filter, kParts)) {
    double power = node.weight;
    for (double& moment : moments) {
      moment += power;
      power *= node.x * node.x;
    }
  }
  constexpr double kWide = 0.1;
  const bool four = moments[1] * filter.radius * filter.radius > kWide;
  for (const bool so_many : {four, true})
    if (auto nodes = gauss_nodes(moments, so_many)) return *std::move(nodes);
  return legendre_nodes(filter, 4);
}

}  // namespace

std::vector<FilterNode> filter_nodes(Filter filter) {
  const AxisNodes axis = axis_nodes(filter);
  std::vector<FilterNode> nodes;
  for (const AxisNode& y : axis)
    for (const AxisNode& x : axis)
      nodes.push_back({filter.radius * x.x, filter.radius * y.x, x.weight * y.weight});
  return nodes;
}

}  // namespace lobelia

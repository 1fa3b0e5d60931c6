#include "renderer/filter_nodes.hpp"

#include <array>
#include <cmath>
#include <optional>

namespace lobelia {
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

#include "renderer/light_tree.hpp"

#include <algorithm>
#include <limits>

#include "base/words/constants.hpp"

namespace lobelia {
namespace {

/// A highlight need not fall with the cosine, so even a light near the horizon keeps this share.
constexpr double kAtHorizon = 0.2;
/// A squared distance that no power divided by it overflows.
constexpr double kNearest = 1e-60;
/// The largest number below 1.
constexpr double kBelowOne = 1 - std::numeric_limits<double>::epsilon() / 2;

double component(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

struct Box {
  Vec3 low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  void add(Vec3 from, Vec3 to) {
    low = {std::min(low.x, from.x), std::min(low.y, from.y), std::min(low.z, from.z)};
    high = {std::max(high.x, to.x), std::max(high.y, to.y), std::max(high.z, to.z)};
  }
  int longest_axis() const {
    const Vec3 side = high - low;
    return side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
  }
};

}  // namespace

LightTree::LightTree(const std::vector<Light>& lights, std::span<const int> indices,
                     double closeness)
    : leaf_of_(lights.size(), -1), slack_(4 * closeness) {
  std::vector<Node> leaves;
  for (const int index : indices) {
    const Light& light = lights[std::size_t(index)];
    if (is_black(strength(light))) continue;
    const Lamp lamp = is_area(light) ? *lamp_of_same_power(light) : lamp_of(light);
    Node leaf;
    leaf.is_distant = lamp.is_distant;
    leaf.center = lamp.is_distant ? -lamp.direction : lamp.position;
    leaf.half = {reach_along(light, {1, 0, 0}), reach_along(light, {0, 1, 0}),
                 reach_along(light, {0, 0, 1})};
    leaf.power = max_component(lamp.strength);
    leaf.normal = lamp.normal;
    leaf.light = index;
    leaves.push_back(leaf);
  }
  if (leaves.empty()) return;
  nodes_.reserve(2 * leaves.size() - 1);
  build(leaves);
  parent_.assign(nodes_.size(), -1);
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (nodes_[n].light >= 0) {
      leaf_of_[std::size_t(nodes_[n].light)] = int(n);
    } else {
      parent_[n + 1] = int(n);
      parent_[std::size_t(nodes_[n].second)] = int(n);
    }
  }
}

void LightTree::build(std::span<Node> leaves) {
  if (leaves.size() == 1) {
    nodes_.push_back(leaves[0]);
    return;
  }
  // Distant lights have no place among the others.
  auto middle = std::stable_partition(leaves.begin(), leaves.end(),
                                      [](const Node& leaf) { return leaf.is_distant; });
  const bool mixed = middle != leaves.begin() && middle != leaves.end();
  Box whole, centers;
  Node node;
  for (const Node& leaf : leaves) {
    whole.add(leaf.center - leaf.half, leaf.center + leaf.half);
    centers.add(leaf.center, leaf.center);
    node.power += leaf.power;
  }
  if (!mixed) {
    // In halves, so that no order of lights makes a deep tree.
    middle = leaves.begin() + std::ptrdiff_t(leaves.size() / 2);
    std::nth_element(leaves.begin(), middle, leaves.end(),
                     [axis = centers.longest_axis()](const Node& a, const Node& b) {
                       const double x = component(a.center, axis), y = component(b.center, axis);
                       return x != y ? x < y : a.light < b.light;
                     });
  }
  node.is_distant = leaves[0].is_distant;
  node.center = 0.5 * (whole.low + whole.high);
  node.half = 0.5 * (whole.high - whole.low);
  const std::size_t at = nodes_.size();
  nodes_.push_back(node);
  build({leaves.begin(), middle});
  nodes_[at].second = int(nodes_.size());
  build({middle, leaves.end()});
}

double LightTree::importance(const Node& node, Vec3 point, Vec3 normal) {
  const Vec3 offset = node.is_distant ? node.center : node.center - point;
  const double height = dot(normal, offset) + std::abs(normal.x) * node.half.x +
                        std::abs(normal.y) * node.half.y + std::abs(normal.z) * node.half.z;
  if (!(height > 0)) return 0;
  const double reach = length(node.half);
  const double distance =
      node.is_distant ? 1 : std::sqrt(std::max({dot(offset, offset), reach * reach, kNearest}));
  double value = node.power * (kAtHorizon + (1 - kAtHorizon) * std::min(1.0, height / distance)) /
                 (distance * distance);
  if (dot(node.normal, node.normal) > 0) {
    const double before = -dot(node.normal, offset);
    if (!(before > 0)) return 0;
    value *= std::min(1.0, (before + reach) / (distance + reach));
  }
  return value;
}

double LightTree::first_share(std::size_t node, Vec3 point, Vec3 normal) const {
  const double first = importance(nodes_[node + 1], point, normal);
  const double second = importance(nodes_[std::size_t(nodes_[node].second)], point, normal);
  const double sum = first + second;
  return sum > 0 ? first / sum : -1;
}

LightTree::Choice LightTree::choose(Vec3 point, Vec3 normal, double u) const {
  if (nodes_.empty()) return {};
  std::size_t at = 0;
  double probability = 1;
  while (nodes_[at].light < 0) {
    const double first = first_share(at, point, normal);
    if (first < 0) return {};
    const bool takes_first = u < first;
    const double share = takes_first ? first : 1 - first;
    u = std::min(kBelowOne, (takes_first ? u : u - first) / share);
    probability *= share;
    at = takes_first ? at + 1 : std::size_t(nodes_[at].second);
  }
  if (!(probability > 0)) return {};
  return {nodes_[at].light, probability};
}

double LightTree::probability(int light, Vec3 point, Vec3 normal) const {
  int at = leaf_of_[std::size_t(light)];
  if (at < 0) return 0;
  double probability = 1;
  for (int up = parent_[std::size_t(at)]; up >= 0; at = up, up = parent_[std::size_t(at)]) {
    const double first = first_share(std::size_t(up), point, normal);
    if (first < 0) return 0;
    probability *= at == up + 1 ? first : 1 - first;
  }
  return probability;
}

LightTree::Ray LightTree::ray_of(const Rays& rays, int index) const {
  const std::size_t i = std::size_t(index);
  // A zero becomes so small a number that every quotient is finite or infinite, never NaN.
  const auto inverse = [](double x) { return 1 / (std::abs(x) > 1e-290 ? x : 1e-290); };
  return {{rays.origin.x[i], rays.origin.y[i], rays.origin.z[i]},
          {inverse(-rays.to_eye.x[i]), inverse(-rays.to_eye.y[i]), inverse(-rays.to_eye.z[i])},
          rays.distance[i] * (1 + 1e-9) + slack_};
}

bool LightTree::crosses(const Ray& ray, const Node& node) const {
  double begin = 0, end = ray.distance;
  const auto cut = [&](double origin, double inverse, double center, double half) {
    const double wide = half * (1 + 1e-9) + slack_;
    const double a = (center - wide - origin) * inverse, b = (center + wide - origin) * inverse;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  };
  cut(ray.origin.x, ray.inverse.x, node.center.x, node.half.x);
  cut(ray.origin.y, ray.inverse.y, node.center.y, node.half.y);
  cut(ray.origin.z, ray.inverse.z, node.center.z, node.half.z);
  return begin <= end;
}

}  // namespace lobelia

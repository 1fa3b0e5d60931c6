#include "studies/shader_check/bsdf/grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lobelia::shader_check::bsdf {
namespace {

constexpr double kPi = std::numbers::pi;

double angle_of(Vec3 v) { return std::atan2(std::hypot(v.x, v.y), std::abs(v.z)); }
double turn_of(Vec3 v) { return std::atan2(v.y, v.x); }

/// A third of the edges even, the others with as many values between each two. Beyond the outermost of these the distances
/// double, because there a density falls quickly.
std::vector<double> edges(double begin, double end, int parts, std::vector<double>& values) {
  std::vector<double> all{begin, end};
  const int even = values.empty() ? parts : parts / 3, dense = parts - even;
  for (int k = 1; k < even; ++k) all.push_back(begin + (end - begin) * k / even);
  if (!values.empty()) {
    std::ranges::sort(values);
    const auto quantile = [&](double share) {
      return values[std::size_t(share * double(values.size() - 1))];
    };
    for (int k = 1; k <= dense; ++k) all.push_back(quantile(double(k) / (dense + 1)));
    const double first = quantile(1.0 / (dense + 1)), last = quantile(double(dense) / (dense + 1));
    for (double step = std::max(0.1 * (last - first), 1e-3 * (end - begin)), off = step;
         off < end - begin; step *= 1.6, off += step)
      all.insert(all.end(), {first - off, last + off});
  }
  std::ranges::sort(all);
  const double least = 1e-4 * (end - begin);
  std::vector<double> apart{begin};
  for (const double edge : all)
    if (edge > apart.back() + least && edge < end - least) apart.push_back(edge);
  apart.push_back(end);
  return apart;
}

struct GaussPoint {
  double at, weight;  ///< in [-1, 1]
};
std::vector<GaussPoint> gauss_points(int order) {
  if (order == 2) return {{-1 / std::numbers::sqrt3, 1}, {1 / std::numbers::sqrt3, 1}};
  if (order == 3) {
    const double at = std::sqrt(0.6);
    return {{-at, 5.0 / 9}, {0, 8.0 / 9}, {at, 5.0 / 9}};
  }
  const double inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2)),
               outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2)), root = std::sqrt(30.0);
  return {{-outer, (18 - root) / 36},
          {-inner, (18 + root) / 36},
          {inner, (18 + root) / 36},
          {outer, (18 - root) / 36}};
}

std::size_t part_of(const std::vector<double>& edges, double value) {
  const auto after = std::upper_bound(edges.begin() + 1, edges.end() - 1, value);
  return std::size_t(after - edges.begin()) - 1;
}

}  // namespace

HemisphereGrid::HemisphereGrid(std::span<const Vec3> dense, bool is_above, int bands, int sectors,
                               int order) {
  std::vector<double> values;
  for (const Vec3& v : dense) values.push_back(angle_of(v));
  angles_ = edges(0, kPi / 2, bands, values);
  std::vector<std::vector<double>> turns(angles_.size() - 1);
  for (const Vec3& v : dense) turns[part_of(angles_, angle_of(v))].push_back(turn_of(v));
  first_.push_back(0);
  for (std::vector<double>& in_band : turns) {
    turns_.push_back(edges(-kPi, kPi, sectors, in_band));
    first_.push_back(first_.back() + turns_.back().size() - 1);
  }
  const std::vector<GaussPoint> points = gauss_points(order);
  for (std::size_t band = 0; band + 1 < angles_.size(); ++band)
    for (std::size_t sector = 0; sector + 1 < turns_[band].size(); ++sector)
      for (const GaussPoint& a : points)
        for (const GaussPoint& t : points) {
          const double wide = (angles_[band + 1] - angles_[band]) / 2,
                       round = (turns_[band][sector + 1] - turns_[band][sector]) / 2,
                       angle = angles_[band] + wide * (1 + a.at),
                       turn = turns_[band][sector] + round * (1 + t.at);
          const Vec3 direction{std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn),
                               (is_above ? 1 : -1) * std::cos(angle)};
          nodes_.push_back({direction, wide * round * a.weight * t.weight * std::sin(angle),
                            first_[band] + sector});
        }
}

std::size_t HemisphereGrid::cell_of(Vec3 direction) const {
  const std::size_t band = part_of(angles_, angle_of(direction));
  return first_[band] + part_of(turns_[band], turn_of(direction));
}

}  // namespace lobelia::shader_check::bsdf

#include "renderer/highlight_reach.hpp"

#include <algorithm>
#include <cmath>

#include "base/words/constants.hpp"
#include "renderer/lobe_properties.hpp"

namespace lobelia {
namespace {

/// Rounds to 0 in float32.
constexpr double kBlack = 0x1p-151;
/// More than the kernels' s is wrong by, in float32 and where coordinates are below kFarthest radii.
constexpr double kErrorOfS = 1e-5;
/// That of the half-vector angle besides, where V + L has the length 1: the sum of opposite vectors has few digits.
constexpr double kErrorOfHalfVector = 1e-6;
constexpr double kFarthest = 1e6;

/// An eye or a light, as a sphere of radius 1 sees it.
class Onlooker {
 public:
  Onlooker(Vec3 offset, double radius)
      : distance_(length(offset) / radius), to_it(1 / length(offset) * offset) {}
  explicit Onlooker(Vec3 direction) : distance_(0), to_it(direction) {}

  bool is_near() const { return distance_ != 0 && !(distance_ > 1 + 1e-6); }
  /// Bound of the angle between the directions to it from the centre and from a point whose normal is within `angle`
  /// of the first.
  double parallax(double angle) const {
    if (distance_ == 0) return 0;
    const double seen = std::acos(1 / distance_);  // beyond, the point is turned away
    return angle >= seen ? std::asin(1 / distance_)
                         : std::atan2(std::sin(angle), distance_ - std::cos(angle));
  }
  /// The unit vector to it from the point with the normal N is centre * to_it - normal * N. Both fall as the angle
  /// between the two grows.
  struct Weights {
    double centre, normal;
  };
  Weights weights(double angle) const {
    if (distance_ == 0) return {1, 0};
    const double seen = std::min(angle, std::acos(1 / distance_));
    const double apart = std::hypot(std::sin(seen), distance_ - std::cos(seen));
    return {distance_ / apart, 1 / apart};
  }

 private:
  double distance_;  ///< in radii; 0: infinitely far

 public:
  const Vec3 to_it;
};

}  // namespace

std::optional<NormalCap> highlight_reach(const Highlight& highlight, const Sphere& sphere, Vec3 eye,
                                         const Lamp& lamp, double brightest) {
  if (highlight.lobe.formula || info(highlight.model).has_shadowing) return std::nullopt;
  const Onlooker viewer(eye - sphere.center, sphere.radius);
  const Onlooker light = lamp.is_distant ? Onlooker(-lamp.direction)
                                         : Onlooker(lamp.position - sphere.center, sphere.radius);
  if (viewer.is_near() || light.is_near()) return std::nullopt;
  for (const Vec3 point : {sphere.center, eye, lamp.position})
    if (!(length(point) < kFarthest * sphere.radius)) return std::nullopt;
  if (!lamp.is_distant) {
    const double nearest = length(lamp.position - sphere.center) - sphere.radius;
    brightest /= nearest * nearest;
  }
  const double nothing = kBlack / std::max(brightest, 1.0);
  const double angle = lobe_angle_at(prepare(highlight.lobe, highlight.exponent), nothing);
  const double s = versine(angle) + kErrorOfS;

  const Vec3 sum = light.to_it + viewer.to_it;
  const double sum_length = length(sum);
  if (!(sum_length > 1e-3)) return std::nullopt;
  const Vec3 axis = 1 / sum_length * sum;
  const double half = angle_between(axis, viewer.to_it);  // and to the light
  // A smaller cap has less parallax, which makes it smaller again. The first step holds for every normal.
  double reach = kRightAngle;
  for (int step = 0; step < 6; ++step) {
    // g is `half`, give or take so much.
    const double moved = (viewer.parallax(half + reach) + light.parallax(half + reach)) / 2;
    if (!(half + moved < kRightAngle)) return std::nullopt;
    const double shortest = 2 * std::cos(half + moved),
                 longest = 2 * std::cos(std::max(0.0, half - moved));  // V + L
    double across, along;  // V + L beside N, and along it, where the cap ends
    if (info(highlight.model).angle == LobeAngle::kReflection) {
      across = std::sqrt(2 * s);
      if (!(across < shortest)) return std::nullopt;
      along = std::sqrt(shortest * shortest - across * across);
    } else {
      const double cosine = std::max(0.0, 1 - s - kErrorOfHalfVector / shortest);
      across = longest * std::sqrt(1 - cosine * cosine);
      along = longest * cosine;
    }
    const double nearest = std::max(0.0, half - reach);
    const auto v_near = viewer.weights(nearest), v_far = viewer.weights(half + reach);
    const auto l_near = light.weights(nearest), l_far = light.weights(half + reach);
    const auto skew = [](double a, double b) { return (a - b) / (a + b); };
    const double aside =
        std::max(skew(v_near.centre, l_far.centre), skew(l_near.centre, v_far.centre));
    reach = std::min(reach, std::atan2(across, along + v_far.normal + l_far.normal) +
                                std::atan(aside * std::tan(half)) + 1e-6);
  }
  if (!(reach < kRightAngle - 1e-3)) return std::nullopt;
  return NormalCap{axis, reach};
}

Sphere ball_around(const NormalCap& cap, const Sphere& sphere) {
  Sphere ball = sphere;
  ball.center = sphere.center + sphere.radius * std::cos(cap.angle) * cap.axis;
  ball.radius = sphere.radius * std::sin(cap.angle);
  return ball;
}

}  // namespace lobelia

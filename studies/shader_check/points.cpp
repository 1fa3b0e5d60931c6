#include "studies/shader_check/points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace lobelia::shader_check {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

Vec3 rounded(Vec3 v) { return {float(v.x), float(v.y), float(v.z)}; }
Point rounded(Vec3 normal, Vec3 to_eye, Vec3 to_light, double exponent) {
  return {rounded(normal), rounded(to_eye), rounded(to_light), double(float(exponent))};
}

Vec3 mirrored_below(Vec3 v, Vec3 normal) { return v - 2 * dot(v, normal) * normal; }

class RandomPoints {
 public:
  RandomPoints(const Highlight& highlight, double exponent)
      : is_mirror_(info(highlight.model).angle == LobeAngle::kReflection), exponent_(exponent) {}

  Point operator()() {
    const Vec3 normal = direction();
    Vec3 eye = above(normal, uniform_(random_) < 0.2 ? 0.05 : 1), light;
    const double kind = uniform_(random_);
    if (kind < 1.0 / 6) {
      light = above(normal, 1);
      light = mirrored_below(light, normal);
    } else if (kind < 0.5) {
      light = above(normal, uniform_(random_) < 0.2 ? 0.05 : 1);
    } else {
      // Three half-widths of the lobe around the highlight.
      const double width = std::min(1.5, (is_mirror_ ? 3.5 : 7) / std::sqrt(exponent_));
      const Vec3 mirrored = 2 * dot(normal, eye) * normal - eye;
      light = normalize(mirrored + width * uniform_(random_) * direction());
      if (dot(light, normal) < 0) light = mirrored_below(light, normal);
    }
    return rounded(normal, eye, light, exponent_);
  }

 private:
  Vec3 direction() {
    std::normal_distribution<double> normal;
    return normalize({normal(random_), normal(random_), normal(random_)});
  }
  Vec3 above(Vec3 normal, double most) {
    const double height = most * (1e-4 + (1 - 1e-4) * uniform_(random_));
    const Vec3 any = direction(), across = normalize(any - dot(any, normal) * normal);
    return height * normal + std::sqrt(1 - height * height) * across;
  }
  bool is_mirror_;
  double exponent_;
  std::mt19937_64 random_{1};
  std::uniform_real_distribution<double> uniform_;
};

/// Nearer to the horizon, a rounding decides on which side the eye is.
constexpr double kLeastEyeCosine = 1e-6;

Vec3 in_plane(double radians) { return {std::sin(radians), 0, std::cos(radians)}; }

}  // namespace

Geometry::Geometry(const Point& point) {
  const auto unit = [](Vec3 v) { return length(v) > 0 ? normalize(v) : v; };
  const Vec3 n = unit(point.normal), v = unit(point.to_eye), l = unit(point.to_light), sum = l + v;
  half_length = length(sum);
  const Vec3 h = half_length > 0 ? (1 / half_length) * sum : sum;
  n_dot_l = dot(n, l), n_dot_v = dot(n, v), n_dot_h = dot(n, h), v_dot_h = dot(v, h),
  l_dot_v = dot(l, v);
  const Vec3 r = 2 * n_dot_v * n - v;
  mirror = dot(r, l);
  s_half = 0.5 * dot(n - h, n - h);
  s_mirror = 0.5 * dot(r - l, r - l);
  const Vec3 difference = l - v;
  const double apart = length(difference);
  n_dot_difference = apart > 0 ? dot(n, difference) / apart : 0;
}

std::vector<Point> domain_points(const Highlight& highlight, double exponent, std::size_t count) {
  std::vector<Point> points;
  RandomPoints random(highlight, exponent);
  while (points.size() < count) points.push_back(random());
  return points;
}

std::vector<Point> hard_points(double exponent) {
  const Vec3 up{0, 0, 1}, x{1, 0, 0}, high{0.6, 0, 0.8}, slant = normalize({1, 2, 3});
  const Vec3 low = normalize({0.6, 0.3, -0.01}), grazing = normalize({1, 0, 1e-7});
  std::vector<Point> points;
  for (const auto& [n, v, l] : {std::array{up, up, up},
                                {up, high, high},
                                {up, high, {-0.6, 0, 0.8}},
                                {slant, slant, slant},
                                {up, -high, high},
                                {up, -x, x},
                                {up, grazing, grazing},
                                {up, x, x},
                                {up, high, -up},
                                {up, high, low},
                                {up, high, x},
                                {up, -up, up},
                                {up, normalize({-1, 0, 1e-7}), grazing},
                                {up, up, grazing},
                                {up, grazing, up}})
    points.push_back(rounded(n, v, l, exponent));
  return points;
}

bool is_sphere(int x, int y, int size) {
  const double u = 2 * (x + 0.5) / size - 1, v = 1 - 2 * (y + 0.5) / size;
  return u * u + v * v < 1;
}

std::vector<Point> sphere_points(double degrees, double exponent, int size) {
  const Vec3 eye{0, 0, 1}, light = in_plane(degrees * kRadians);
  std::vector<Point> points;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double u = 2 * (x + 0.5) / size - 1, v = 1 - 2 * (y + 0.5) / size, rr = u * u + v * v;
      const Vec3 normal = rr < 1 ? Vec3{u, v, std::sqrt(1 - rr)} : normalize({u, v, 0});
      points.push_back(rounded(normal, eye, light, exponent));
    }
  return points;
}

Arc arc_points(double exponent) {
  constexpr double kLight = 60, kStep = 0.25;
  Arc arc;
  for (double normal = -kLight; normal < 90; normal += kStep) {
    arc.points.push_back(
        rounded(in_plane(normal * kRadians), {0, 0, 1}, in_plane(kLight * kRadians), exponent));
    arc.degrees.push_back(normal - kLight / 2);
  }
  return arc;
}

std::vector<Point> points_below(const Highlight& highlight, double exponent, std::size_t count) {
  std::vector<Point> points = domain_points(highlight, exponent, count);
  for (Point& point : points) point.to_eye = mirrored_below(point.to_eye, point.normal);
  return points;
}

double more_where_opposite(const Geometry& geometry) {
  constexpr double kShort = 0.4, kShortest = 0.01;
  return std::max(1.0, kShort / std::pow(std::max(geometry.half_length, kShortest), 2));
}

bool is_defined(const Geometry& geometry) { return geometry.n_dot_v > kLeastEyeCosine; }

Hemisphere hemisphere_points(LobeAngle angle, double degrees, double exponent) {
  constexpr int kRings = 64, kSpokes = 32;
  const Vec3 normal{0, 0, 1}, eye = in_plane(degrees * kRadians), mirrored{-eye.x, 0, eye.z},
                              side{0, 1, 0}, across = cross(side, mirrored);
  // Most rings within the lobe, by powers of its width: the angle from the mirror direction is pi t^p.
  const double width = (angle == LobeAngle::kReflection ? 3 : 6) / std::sqrt(exponent + 2);
  const double power =
      std::max(1.0, std::log(std::min(1.0, width / std::numbers::pi)) / std::log(0.6));
  Hemisphere all;
  for (int ring = 0; ring < kRings; ++ring) {
    const auto cosine = [&](int end) {
      return std::cos(std::numbers::pi * std::pow(double(end) / kRings, power));
    };
    // Two points of Gauss and Legendre over the cosine.
    const double middle = (cosine(ring) + cosine(ring + 1)) / 2,
                 half = (cosine(ring) - cosine(ring + 1)) / 2;
    for (const double side_of_middle : {-1, 1})
      for (int spoke = 0; spoke < kSpokes; ++spoke) {
        const double c = middle + side_of_middle * half / std::numbers::sqrt3,
                     sine = std::sqrt(1 - c * c),
                     turn = 2 * std::numbers::pi * (spoke + 0.5) / kSpokes;
        const Vec3 light =
            c * mirrored + sine * std::cos(turn) * across + sine * std::sin(turn) * side;
        if (light.z <= 0) continue;
        all.points.push_back(rounded(normal, eye, light, exponent));
        all.solid_angles.push_back(2 * std::numbers::pi * half / kSpokes);
      }
  }
  return all;
}

double Coefficients::at(double exponent) {
  const auto [at, is_new] = known_.try_emplace(exponent, 0);
  if (is_new) {
    highlight_.exponent = exponent;
    at->second = radiance_coefficient(highlight_);
  }
  return at->second;
}

double model_radiance(const Highlight& highlight, double coefficient, const Geometry& geometry) {
  if (geometry.n_dot_l <= 0) return 0;
  const double s =
      info(highlight.model).angle == LobeAngle::kReflection ? geometry.s_mirror : geometry.s_half;
  return coefficient * lobe_value(highlight.lobe, s, highlight.exponent) *
         geometry_factor(highlight.model, highlight.exponent, geometry.n_dot_l, geometry.n_dot_v);
}

bool is_at_an_edge(const Highlight& highlight, const Geometry& geometry) {
  const double cosine =
      info(highlight.model).angle == LobeAngle::kReflection ? geometry.mirror : geometry.n_dot_h;
  return std::abs(geometry.n_dot_l) < 1e-6 || std::abs(cosine) < 1e-5;
}

}  // namespace lobelia::shader_check

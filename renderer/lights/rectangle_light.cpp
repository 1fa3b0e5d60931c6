#include "renderer/lights/rectangle_light.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lobelia {
namespace {

/// Below this solid angle its corners' angles have lost too many digits, and above this distance in
/// sizes even sampling of area and of angle hardly differ.
constexpr double kSmallest = 1e-2;

/// The rectangle as seen from a point: axes along its sides, x0..x1 by y0..y1 in the plane z = z0 < 0.
struct View {
  Vec3 x, y, z;
  double x0, x1, y0, y1, z0;
  double area, half_u, half_v;
};

View view(const RectangleLight& light, Vec3 point) {
  View v;
  v.half_u = length(light.half_u);
  v.half_v = length(light.half_v);
  v.x = 1 / v.half_u * light.half_u;
  v.y = 1 / v.half_v * light.half_v;
  v.z = cross(v.x, v.y);
  const Vec3 way = light.center - point;
  const double cx = dot(way, v.x), cy = dot(way, v.y);
  v.x0 = cx - v.half_u, v.x1 = cx + v.half_u;
  v.y0 = cy - v.half_v, v.y1 = cy + v.half_v;
  v.z0 = dot(way, v.z);  // negative in front
  v.area = 4 * v.half_u * v.half_v;
  return v;
}

struct SphericalRectangle {
  double b0, b1, k, solid_angle;
};

SphericalRectangle spherical(const View& v) {
  // The normals of the four planes through the point and a side have one component of zero each, so
  // that their products are short.
  const double z2 = v.z0 * v.z0;
  const double n0 = -v.y0 / std::sqrt(z2 + v.y0 * v.y0), n1 = v.x1 / std::sqrt(z2 + v.x1 * v.x1);
  const double n2 = v.y1 / std::sqrt(z2 + v.y1 * v.y1), n3 = -v.x0 / std::sqrt(z2 + v.x0 * v.x0);
  const double g0 = std::acos(-n0 * n1), g1 = std::acos(-n1 * n2);
  const double g2 = std::acos(-n2 * n3), g3 = std::acos(-n3 * n0);
  const double k = 2 * std::numbers::pi - g2 - g3;
  return {n0, n2, k, g0 + g1 - k};
}

/// Whether angles are too small to sample; a bound from above of the solid angle decides, which both
/// sample() and meet() compute alike.
bool is_small(const View& v) {
  const double x = std::max({v.x0, -v.x1, 0.0}), y = std::max({v.y0, -v.y1, 0.0});
  const double nearest_squared = x * x + y * y + v.z0 * v.z0;
  return v.area * -v.z0 < kSmallest * nearest_squared * std::sqrt(nearest_squared);
}

}  // namespace

LightSample sample(const RectangleLight& light, Vec3 point, double u, double v) {
  const View r = view(light, point);
  if (!(r.z0 < 0)) return {};
  double px, py, pdf = 0;
  const bool small = is_small(r);
  if (small) {
    px = r.x0 + u * (r.x1 - r.x0);
    py = r.y0 + v * (r.y1 - r.y0);
  } else {
    const SphericalRectangle s = spherical(r);
    const double angle = u * s.solid_angle + s.k;
    const double f = (std::cos(angle) * s.b0 - s.b1) / std::sin(angle);
    const double c = std::clamp(std::copysign(1 / std::sqrt(f * f + s.b0 * s.b0), f), -1.0, 1.0);
    px = std::clamp(-c * r.z0 / std::sqrt(std::max(1e-300, 1 - c * c)), r.x0, r.x1);
    const double d2 = px * px + r.z0 * r.z0;
    const double h0 = r.y0 / std::sqrt(d2 + r.y0 * r.y0), h1 = r.y1 / std::sqrt(d2 + r.y1 * r.y1);
    const double h = h0 + v * (h1 - h0), h2 = h * h;
    py = h2 < 1 - 1e-12 ? std::clamp(h * std::sqrt(d2 / (1 - h2)), r.y0, r.y1) : r.y1;
    pdf = 1 / s.solid_angle;
  }
  const double squared = px * px + py * py + r.z0 * r.z0, distance = std::sqrt(squared);
  if (small) pdf = squared * distance / (r.area * -r.z0);
  return {1 / distance * (px * r.x + py * r.y + r.z0 * r.z), distance, pdf, light.radiance};
}

LightHit meet(const RectangleLight& light, Vec3 point, Vec3 direction) {
  const View r = view(light, point);
  const double towards = dot(direction, r.z);
  if (!(r.z0 < 0 && towards < 0)) return {};
  const double distance = r.z0 / towards;
  const double px = distance * dot(direction, r.x), py = distance * dot(direction, r.y);
  if (!(px >= r.x0 && px <= r.x1 && py >= r.y0 && py <= r.y1)) return {};
  const double pdf = is_small(r) ? distance * distance * distance / (r.area * -r.z0)
                                 : 1 / spherical(r).solid_angle;
  return {distance, pdf, light.radiance};
}

}  // namespace lobelia

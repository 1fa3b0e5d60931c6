#include "renderer/small_highlights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "renderer/frame.hpp"
#include "renderer/lobe_properties.hpp"
#include "renderer/pixel_ray.hpp"
#include "renderer/plan/idle_parts.hpp"

namespace lobelia {
namespace {

using Pair = std::array<double, 2>;

/// A point of a surface with its normal.
struct Place {
  Vec3 point, normal;
};

/// A place of a sphere by two coordinates around another one, along the tangents of its normal.
Place moved(const Sphere& sphere, const Place& from, const Tangents& t, Pair by) {
  const Vec3 normal = normalize(from.normal + by[0] * t.first + by[1] * t.second);
  return {sphere.center + sphere.radius * normal, normal};
}

Vec3 to_light(const Lamp& lamp, Vec3 point) {
  return lamp.is_distant ? -lamp.direction : normalize(lamp.position - point);
}

/// N - H, where both are unit vectors; 0 in the middle of every highlight.
Vec3 off_middle(const Lamp& lamp, Vec3 eye, const Place& at) {
  return at.normal - normalize(to_light(lamp, at.point) + normalize(eye - at.point));
}

/// Newton's method, with steps halved until they help.
std::optional<Place> middle_of(const Sphere& sphere, const Lamp& lamp, Vec3 eye, Place at) {
  constexpr int kMostSteps = 40;
  constexpr double kStep = 1e-6, kNear = 1e-13;
  for (int step = 0; step < kMostSteps; ++step) {
    const Tangents t = tangents(at.normal);
    const auto f = [&](Pair by) {
      const Vec3 off = off_middle(lamp, eye, moved(sphere, at, t, by));
      return Pair{dot(off, t.first), dot(off, t.second)};
    };
    const Pair here = f({0, 0}), a = f({kStep, 0}), b = f({0, kStep});
    const double size = std::hypot(here[0], here[1]);
    if (!std::isfinite(size)) return std::nullopt;
    if (size < kNear) return at;
    const double m00 = (a[0] - here[0]) / kStep, m10 = (a[1] - here[1]) / kStep,
                 m01 = (b[0] - here[0]) / kStep, m11 = (b[1] - here[1]) / kStep,
                 determinant = m00 * m11 - m01 * m10;
    if (determinant == 0) return std::nullopt;
    Pair by{(m01 * here[1] - m11 * here[0]) / determinant,
            (m10 * here[0] - m00 * here[1]) / determinant};
    double share = 1;
    for (; share > 1e-6; share /= 2) {
      const Pair there = f({share * by[0], share * by[1]});
      if (std::hypot(there[0], there[1]) < size) break;
    }
    if (share <= 1e-6) return size < 1e-9 ? std::optional(at) : std::nullopt;
    at = moved(sphere, at, t, {share * by[0], share * by[1]});
  }
  return std::nullopt;
}

std::optional<Place> middle_on(const Sphere& sphere, const Lamp& lamp, Vec3 eye) {
  const Vec3 half = to_light(lamp, sphere.center) + normalize(eye - sphere.center);
  if (!(length(half) > 0)) return std::nullopt;
  const Vec3 normal = normalize(half);
  return middle_of(sphere, lamp, eye, {sphere.center + sphere.radius * normal, normal});
}

/// Where the eye sees the lamp's mirror image.
std::optional<Place> middle_on(const Plane& plane, const Lamp& lamp, Vec3 eye) {
  const double height = dot(eye - plane.point, plane.normal);
  const Vec3 normal = height < 0 ? -plane.normal : plane.normal;
  const auto mirrored = [&](Vec3 v) { return v - 2 * dot(v, normal) * normal; };
  const Vec3 towards = lamp.is_distant ? mirrored(-lamp.direction)
                                       : plane.point + mirrored(lamp.position - plane.point) - eye;
  const double falls = -dot(towards, normal);
  if (!(falls > 0)) return std::nullopt;
  return Place{eye + std::abs(height) / falls * towards, normal};
}

/// Where a ray through a place of the film meets the surface.
std::optional<Place> met(const Sphere& sphere, Vec3 origin, Vec3 direction) {
  const Vec3 from = origin - sphere.center;
  const double b = dot(from, direction), c = dot(from, from) - sphere.radius * sphere.radius,
               d = b * b - c;
  if (!(d > 0)) return std::nullopt;
  const Vec3 point = origin + (-b - std::sqrt(d)) * direction;
  return Place{point, (1 / sphere.radius) * (point - sphere.center)};
}
std::optional<Place> met(const Plane& plane, Vec3 origin, Vec3 direction) {
  const double height = dot(origin - plane.point, plane.normal),
               falls = -dot(direction, plane.normal);
  if (!(height * falls > 0)) return std::nullopt;
  return Place{origin + height / falls * direction, height < 0 ? -plane.normal : plane.normal};
}

/// 1 - the cosine that a lobe sees.
double s_at(LobeAngle angle, const Lamp& lamp, Vec3 eye, const Place& at) {
  const Vec3 l = to_light(lamp, at.point), v = normalize(eye - at.point);
  const Vec3 off = angle == LobeAngle::kHalfVector ? at.normal - normalize(l + v)
                                                   : 2 * dot(at.normal, v) * at.normal - v - l;
  return dot(off, off) / 2;
}

class Finder {
 public:
  explicit Finder(const Scene& scene)
      : scene_(scene), frame_(camera_frame(scene.camera, scene.film)) {}

  template <class Surface>
  void look(const Surface& surface, const Material& material, const Lamp& lamp) {
    if (!has_highlight(material)) return;
    const auto middle = middle_on(surface, lamp, frame_.origin);
    if (!middle) return;
    const Vec3 view = middle->point - frame_.origin;
    const double ahead = dot(view, frame_.forward);
    if (!(ahead > 0) || !(dot(view, middle->normal) < 0) ||
        !(dot(to_light(lamp, middle->point), middle->normal) > 0))
      return;
    const double u = dot(view, frame_.right) / ahead, v = dot(view, frame_.up) / ahead;
    SmallHighlight found;
    found.x = ((u - frame_.shift_u) / frame_.half_width + 1) * frame_.width / 2;
    found.y = (1 - (v - frame_.shift_v) / frame_.half_height) * frame_.height / 2;
    constexpr double kOutside = 8;
    if (!(found.x > -kOutside && found.x < frame_.width + kOutside && found.y > -kOutside &&
          found.y < frame_.height + kOutside))
      return;
    // s = (a dx^2 + 2 b dx dy + c dy^2) / 2 around the middle.
    const Highlight& h = material.highlight;
    constexpr double kStep = 0.02;
    const auto curvature = [&](double dx, double dy) -> std::optional<double> {
      double sum = 0;
      for (const double sign : {-1.0, 1.0}) {
        const Vec3 ray =
            normalize(film_ray(frame_, found.x + sign * kStep * dx, found.y + sign * kStep * dy));
        const auto there = met(surface, frame_.origin, ray);
        if (!there) return std::nullopt;
        sum += s_at(info(h.model).angle, lamp, frame_.origin, *there);
      }
      return sum / (kStep * kStep);
    };
    const auto a = curvature(1, 0), c = curvature(0, 1), both = curvature(1, 1);
    if (!a || !c || !both) return;
    const double b = (*both - *a - *c) / 2, mean = (*a + *c) / 2,
                 apart = std::hypot((*a - *c) / 2, b), least = std::max(mean - apart, 1e-12 * mean);
    // A Gaussian exp(-s / s1) has fallen to a half at s1 ln 2.
    const double half = std::sin(lobe_angle_at(prepare(h.lobe, h.exponent), 0.5) / 2),
                 s1 = 2 * half * half / std::numbers::ln2;
    found.width = std::sqrt(s1 / (mean + apart));
    found.length = std::sqrt(s1 / least);
    if (found.width < kLeastWidth) all.push_back(found);
  }

  std::vector<SmallHighlight> all;

 private:
  const Scene& scene_;
  CameraFrame frame_;
};

}  // namespace

std::vector<SmallHighlight> find_small_highlights(const Scene& scene) {
  if (const auto trimmed = without_idle_parts(scene)) return find_small_highlights(*trimmed);
  const std::size_t surfaces = scene.spheres.size() + scene.planes.size();
  const bool is_random = scene.camera.aperture_radius > 0 ||
                         (scene.depth.glossy > 0 && surfaces > 1) ||
                         !std::ranges::all_of(scene.lights, is_delta);
  if (is_random || surfaces * scene.lights.size() > kMostPairsSearched) return {};
  Finder finder(scene);
  for (const Light& light : scene.lights) {
    const auto lamp = find_lamp(light);
    if (!lamp) continue;
    for (const Sphere& sphere : scene.spheres)
      finder.look(sphere, scene.materials[std::size_t(sphere.material)], *lamp);
    for (const Plane& plane : scene.planes) {
      finder.look(plane, scene.materials[std::size_t(plane.material)], *lamp);
      if (plane.checker_material != plane.material)
        finder.look(plane, scene.materials[std::size_t(plane.checker_material)], *lamp);
    }
  }
  return std::move(finder.all);
}

}  // namespace lobelia

// Rays of a scene under lights without size, in any type of number, for the .cpp files of verify/truth/:
// docs/conventions.md written out once more, without the renderer's code.
#pragma once

#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <optional>
#include <type_traits>
#include <variant>
#include <vector>

#include "renderer/scene/scene.hpp"
#include "verify/truth/vector.hpp"

namespace lobelia::truth {

/// What a ray meets. The normal is on the ray's side.
template <class Real>
struct Met {
  int surface = -1;  ///< spheres first, then planes
  int material = 0;
  Vector<Real> point, normal, to_eye;
  Real square_u = 0, square_v = 0;  ///< of a checker, counted from its plane's point
};

/// The light of one lamp at a point of a surface.
template <class Real>
struct Arrival {
  Vector<Real> to_light;
  Real n_dot_l;
  Real falloff;  ///< irradiance normal to the beam, per strength of the lamp
};

template <class Real>
class Tracer {
 public:
  using V = Vector<Real>;

  /// Of a scene that lives longer, without what why_not_evaluated() names.
  explicit Tracer(const Scene& scene);

  /// Calls visit(met) for what the ray through (x, y) of the film, in pixels from its upper left corner,
  /// meets, and then for what is seen of there by mirrors.
  template <class Visit>
  void follow(const Real& x, const Real& y, Visit visit) const {
    V origin = origin_, direction = camera_ray(x, y);
    int leaves = -1;
    for (int left = scene_.depth.mirror;; --left) {
      const auto met = meet(origin, direction, leaves);
      if (!met) return;
      visit(*met);
      if (left == 0 || is_black(scene_.materials[met->material].mirror_reflectance)) return;
      origin = met->point;
      direction = normalize(2 * dot(met->normal, met->to_eye) * met->normal - met->to_eye);
      leaves = met->surface;
    }
  }

  V camera_ray(const Real& x, const Real& y) const {
    const Real u = (2 * x / scene_.film.width - 1) * half_width_ + shift_u_;
    const Real v = (1 - 2 * y / scene_.film.height) * half_height_ + shift_v_;
    return normalize(forward_ + u * right_ + v * up_);
  }
  const V& camera_origin() const { return origin_; }

  /// The nearest along a ray of unit direction; never the surface that it leaves, which is convex.
  std::optional<Met<Real>> meet(const V& origin, const V& direction, int leaves = -1) const;

  /// Nothing where the light is below the horizon, shines the other way or is hidden.
  std::optional<Arrival<Real>> arrival(const Light& light, const Met<Real>& at) const;

 private:
  struct Ball {
    V center;
    Real radius_squared;
    Real
        inside_squared;  ///< what is nearer to the centre, squared, is inside and not on the surface
    explicit Ball(const Sphere& sphere);
  };
  struct Ground {
    V point, normal, first, second;
    Real size;
    explicit Ground(const Plane& plane);
    /// Along a ray; 0 where it runs along the plane.
    Real distance(const V& origin, const V& direction) const {
      const Real slope = dot(direction, normal);
      return slope == 0 ? Real(0) : Real(dot(point - origin, normal) / slope);
    }
  };
  /// Ray and sphere, counted from the point of the ray that is nearest to the centre: the roots of the
  /// quadratic equation are `along` -+ sqrt(half_squared), and nothing cancels however far the sphere is.
  struct Chord {
    V to_center, off_axis;
    Real along, half_squared;
    Chord(const Ball& ball, const V& origin, const V& direction)
        : to_center(ball.center - origin), along(dot(to_center, direction)) {
      off_axis = to_center - along * direction;
      half_squared = ball.radius_squared - dot(off_axis, off_axis);
    }
  };

  /// `distance` < 0 is an infinite one.
  bool is_hidden(const Met<Real>& at, const V& to_light, const Real& distance) const;

  const Scene& scene_;
  V origin_, forward_, right_, up_;
  Real half_width_, half_height_, shift_u_, shift_v_;
  std::vector<Ball> balls_;
  std::vector<Ground> grounds_;
};

/// A plane is met up to here; beyond is its horizon.
inline constexpr double kHorizon = 1e15;

template <class Real>
Tracer<Real>::Ball::Ball(const Sphere& sphere)
    : center(sphere.center), radius_squared(Real(sphere.radius) * sphere.radius) {
  if constexpr (std::is_same_v<Real, double>)
    inside_squared = inner_radius(sphere) * inner_radius(sphere);
  else
    inside_squared = radius_squared * (1 - ldexp(Real(1), -100));
}

template <class Real>
Tracer<Real>::Ground::Ground(const Plane& plane)
    : point(plane.point), normal(normalize(V(plane.normal))), size(plane.checker_size) {
  // The shortest turn that brings the nearer end of the z axis to the normal takes +x to `first`.
  const V axis(0, 0, std::signbit(plane.normal.z) ? -1 : 1);
  first = V(1, 0, 0) - Real(normal.x / (1 + dot(axis, normal))) * (axis + normal);
  second = cross(normal, first);
}

template <class Real>
Tracer<Real>::Tracer(const Scene& scene) : scene_(scene), origin_(scene.camera.origin) {
  using std::tan;
  const Camera& camera = scene.camera;
  forward_ = normalize(V(camera.target) - origin_);
  right_ = normalize(cross(forward_, V(camera.up)));
  up_ = cross(right_, forward_);
  half_width_ = tan(Real(camera.fov_degrees) * boost::math::constants::pi<Real>() / 360);
  half_height_ = half_width_ * scene.film.height / scene.film.width;
  shift_u_ = -2 * half_width_ * camera.principal_point_offset_x;
  shift_v_ = -2 * half_height_ * camera.principal_point_offset_y;
  for (const Sphere& sphere : scene.spheres) balls_.emplace_back(sphere);
  for (const Plane& plane : scene.planes) grounds_.emplace_back(plane);
}

template <class Real>
std::optional<Met<Real>> Tracer<Real>::meet(const V& origin, const V& direction, int leaves) const {
  using std::floor, std::sqrt;
  const int spheres = int(balls_.size());
  Met<Real> met;
  Real nearest;
  const auto is_nearest = [&](const Real& t) { return t > 0 && (met.surface < 0 || t < nearest); };
  V from_center;
  for (int k = 0; k < spheres; ++k) {
    if (k == leaves) continue;
    const Chord chord(balls_[k], origin, direction);
    // Cheap refusals first: a square root takes as long as thirty products.
    if (chord.along <= 0 || chord.half_squared <= 0) continue;
    const Real half = sqrt(chord.half_squared), t = chord.along - half;
    if (!is_nearest(t)) continue;
    nearest = t;
    met.surface = k;
    from_center = -(chord.off_axis + half * direction);
  }
  for (int k = 0; k < int(grounds_.size()); ++k) {
    if (spheres + k == leaves) continue;
    const Real t = grounds_[k].distance(origin, direction);
    if (!(t < kHorizon) || !is_nearest(t)) continue;
    nearest = t;
    met.surface = spheres + k;
  }
  if (met.surface < 0) return std::nullopt;
  met.to_eye = -direction;
  if (met.surface < spheres) {
    met.material = scene_.spheres[met.surface].material;
    met.point = balls_[met.surface].center + from_center;
    met.normal = normalize(from_center);
    return met;
  }
  const Ground& ground = grounds_[met.surface - spheres];
  const Plane& plane = scene_.planes[met.surface - spheres];
  met.point = origin + nearest * direction;
  met.normal = dot(ground.normal, met.to_eye) > 0 ? ground.normal : -ground.normal;
  met.material = plane.material;
  if (plane.material != plane.checker_material) {
    const V from = met.point - ground.point;
    met.square_u = floor(Real(dot(from, ground.first) / ground.size));
    met.square_v = floor(Real(dot(from, ground.second) / ground.size));
    const Real pair = (met.square_u + met.square_v) / 2;
    if (pair != floor(pair)) met.material = plane.checker_material;
  }
  return met;
}

template <class Real>
std::optional<Arrival<Real>> Tracer<Real>::arrival(const Light& light, const Met<Real>& at) const {
  using std::sqrt;
  Arrival<Real> arrival;
  arrival.falloff = 1;
  Real distance = -1;
  if (const auto* directional = std::get_if<DirectionalLight>(&light)) {
    arrival.to_light = normalize(-V(directional->direction));
  } else {
    const auto& lamp = std::get<PointLight>(light);
    const V way = V(lamp.position) - at.point;
    const Real square = dot(way, way);
    distance = sqrt(square);
    arrival.to_light = Real(1 / distance) * way;
    const Real towards = has_normal(lamp) ? Real(-dot(V(lamp.normal), arrival.to_light)) : Real(1);
    if (towards <= 0) return std::nullopt;
    arrival.falloff = towards / square;
  }
  arrival.n_dot_l = dot(at.normal, arrival.to_light);
  if (arrival.n_dot_l <= 0 || is_hidden(at, arrival.to_light, distance)) return std::nullopt;
  return arrival;
}

template <class Real>
bool Tracer<Real>::is_hidden(const Met<Real>& at, const V& to_light, const Real& distance) const {
  using std::sqrt;
  const int spheres = int(balls_.size());
  for (int k = 0; k < spheres; ++k) {
    if (k == at.surface) continue;
    const Chord chord(balls_[k], at.point, to_light);
    if (chord.half_squared <= 0) continue;
    if (dot(chord.to_center, chord.to_center) < balls_[k].inside_squared) return true;
    if (chord.along <= 0) continue;
    if (distance < 0 || chord.along - sqrt(chord.half_squared) < distance) return true;
  }
  for (int k = 0; k < int(grounds_.size()); ++k) {
    if (spheres + k == at.surface) continue;
    const Real t = grounds_[k].distance(at.point, to_light);
    if (t > 0 && (distance < 0 || t < distance)) return true;
  }
  return false;
}

}  // namespace lobelia::truth

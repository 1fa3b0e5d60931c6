// Rays through a scene under lights without size, in any type of number, for the .cpp files of this folder:
// docs/conventions.md written out once more, without the renderer's code.
#pragma once

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <optional>
#include <type_traits>
#include <vector>

#include "reference_scenes/engines/analytic/formulas/vector.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::truth {

/// A plane is met up to this distance; beyond is its horizon.
inline constexpr double kHorizon = 1e15;
/// A lamp lies on a surface if it is no farther from it than this share of Tracer::reach().
inline constexpr double kCloseness = 1e-12;

/// Where a ray meets a surface. The normal is on the ray's side.
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

  /// `scene` must outlive it, and why_not_evaluated() must be empty for it.
  explicit Tracer(const Scene& scene) : scene_(scene), origin_(scene.camera.origin) {
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
    const Real closeness = kCloseness * reach();
    for (const Light& light : scene.lights) lamps_.push_back(near_lamp(light, closeness));
  }

  /// Calls visit(met) for the surface that the ray through (x, y) meets, in pixels from the film's upper left corner,
  /// and then for each surface that mirrors show there.
  template <class Visit>
  void follow(const Real& x, const Real& y, Visit visit) const {
    V origin = origin_, direction = camera_ray(x, y);
    int leaves = -1;
    for (int left = scene_.depth.mirror;; --left) {
      const auto met = meet(origin, direction, leaves);
      if (!met) return;
      visit(*met);
      if (left == 0 || is_black(scene_.materials[met->material].mirror_reflectance) ||
          is_enclosed(*met))
        return;
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
  std::optional<Met<Real>> meet(const V& origin, const V& direction, int leaves = -1) const {
    using std::floor, std::sqrt;
    const int spheres = int(balls_.size());
    Met<Real> met;
    Real nearest{};
    const auto is_nearest = [&](const Real& t) {
      return t > 0 && (met.surface < 0 || t < nearest);
    };
    V from_center;
    for (int k = 0; k < spheres; ++k) {
      if (k == leaves) continue;
      const Chord chord(balls_[k], origin, direction);
      // Cheap refusals first: a square root takes as long as thirty products.
      if (chord.along <= 0 || chord.half_squared <= 0) continue;
      if (dot(chord.to_center, chord.to_center) <= balls_[k].outside_squared) continue;
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

  /// Nothing if the light is below the horizon, faces away or is hidden.
  std::optional<Arrival<Real>> arrival(std::size_t light, const Met<Real>& at) const {
    using std::sqrt;
    Arrival<Real> arrival;
    arrival.falloff = 1;
    if (const Lamp given = lamp_of(scene_.lights[light]); given.is_distant) {
      arrival.to_light = normalize(-V(given.direction));
      arrival.n_dot_l = dot(at.normal, arrival.to_light);
      if (arrival.n_dot_l <= 0 || is_hidden(at, arrival.to_light)) return std::nullopt;
      return arrival;
    }
    const NearLamp& lamp = lamps_[light];
    const V to_lamp = lamp.position - at.point;
    const Real square = dot(to_lamp, to_lamp), distance = sqrt(square);
    arrival.to_light = Real(1 / distance) * to_lamp;
    Real towards = lamp.has_normal ? Real(-dot(lamp.normal, arrival.to_light)) : Real(1);
    if (lamp.has_cone) {
      Real part = (towards - lamp.cos_cutoff) / (lamp.cos_beam - lamp.cos_cutoff);
      part = part < 0 ? Real(0) : part > 1 ? Real(1) : part;
      towards = part * part * (3 - 2 * part);
    }
    if (towards <= 0) return std::nullopt;
    arrival.falloff = towards / square;
    arrival.n_dot_l = dot(at.normal, arrival.to_light);
    if (arrival.n_dot_l <= 0 || is_hidden(at, lamp, arrival.to_light, distance))
      return std::nullopt;
    return arrival;
  }

 private:
  struct Ball {
    V center;
    Real radius_squared;
    /// Squared distances to the centre: nearer than the first is inside, farther than the second is outside. Between
    /// them a point is on the sphere, as near to it as doubles come.
    Real inside_squared, outside_squared;
    explicit Ball(const Sphere& sphere)
        : center(sphere.center),
          radius_squared(Real(sphere.radius) * sphere.radius),
          outside_squared(Real(outer_radius(sphere)) * outer_radius(sphere)) {
      if constexpr (std::is_same_v<Real, double>)
        inside_squared = inner_radius(sphere) * inner_radius(sphere);
      else
        inside_squared = radius_squared * (1 - ldexp(Real(1), -100));
    }
  };
  struct Ground {
    V point, normal, first, second;
    Real size;
    explicit Ground(const Plane& plane)
        : point(plane.point), normal(normalize(V(plane.normal))), size(plane.checker_size) {
      // The shortest turn that brings the nearer end of the z axis to the normal takes +x to `first`.
      const V axis(0, 0, std::signbit(plane.normal.z) ? -1 : 1);
      first = V(1, 0, 0) - Real(normal.x / (1 + dot(axis, normal))) * (axis + normal);
      second = cross(normal, first);
    }
    Real height(const V& at) const { return dot(at - point, normal); }
    /// Along a ray; 0 where it runs along the plane.
    Real distance(const V& origin, const V& direction) const {
      const Real slope = dot(direction, normal);
      return slope == 0 ? Real(0) : Real(dot(point - origin, normal) / slope);
    }
  };
  /// A near lamp, and where it is to each surface.
  struct NearLamp {
    V position, normal;
    bool has_normal = false, has_cone = false;
    Real cos_beam, cos_cutoff;
    std::vector<bool> lies_on;  ///< by surface: spheres first, then planes
    std::vector<Real> heights;  ///< over each plane; 0 over one that it lies on
  };
  /// A ray and a sphere, counted from the point of the ray nearest to the centre: the roots of the quadratic equation
  /// are `along` -+ sqrt(half_squared), and nothing cancels however far the sphere is.
  struct Chord {
    V to_center, off_axis;
    Real along, half_squared;
    Chord(const Ball& ball, const V& origin, const V& direction)
        : to_center(ball.center - origin), along(dot(to_center, direction)) {
      off_axis = to_center - along * direction;
      half_squared = ball.radius_squared - dot(off_axis, off_axis);
    }
    bool starts_inside(const Ball& ball) const {
      return dot(to_center, to_center) < ball.inside_squared;
    }
  };

  NearLamp near_lamp(const Light& light, const Real& closeness) const {
    using std::sqrt;
    NearLamp lamp;
    const auto given = find_near_lamp(light);
    if (!given) return lamp;
    lamp.position = V(given->position);
    lamp.normal = V(given->normal);
    lamp.has_normal = given->has_normal();
    if (given->spot) {
      using std::cos, std::acos;
      const Real degree = acos(Real(-1)) / 180;
      lamp.has_cone = true;
      lamp.cos_beam = cos(Real(given->spot->beam) * degree);
      lamp.cos_cutoff = cos(Real(given->spot->cutoff) * degree);
    }
    const auto is_close = [&](const Real& height) {
      return height <= closeness && -height <= closeness;
    };
    for (const Sphere& sphere : scene_.spheres) {
      const V from_center = lamp.position - V(sphere.center);
      lamp.lies_on.push_back(is_close(sqrt(dot(from_center, from_center)) - Real(sphere.radius)));
    }
    for (const Ground& ground : grounds_) {
      const Real height = ground.height(lamp.position);
      lamp.lies_on.push_back(is_close(height));
      lamp.heights.push_back(is_close(height) ? Real(0) : height);
    }
    return lamp;
  }

  /// Whether the point is inside a sphere, where no light comes.
  bool is_enclosed(const Met<Real>& at) const {
    for (int k = 0; k < int(balls_.size()); ++k) {
      const V to_center = balls_[k].center - at.point;
      if (k != at.surface && dot(to_center, to_center) < balls_[k].inside_squared) return true;
    }
    return false;
  }

  /// From a distant light.
  bool is_hidden(const Met<Real>& at, const V& to_light) const {
    const int spheres = int(balls_.size());
    for (int k = 0; k < spheres; ++k) {
      if (k == at.surface) continue;
      const Chord chord(balls_[k], at.point, to_light);
      if (chord.half_squared > 0 && (chord.along > 0 || chord.starts_inside(balls_[k])))
        return true;
    }
    for (int k = 0; k < int(grounds_.size()); ++k)
      if (spheres + k != at.surface && grounds_[k].distance(at.point, to_light) > 0) return true;
    return false;
  }

  /// From a near lamp.
  bool is_hidden(const Met<Real>& at, const NearLamp& lamp, const V& to_light,
                 const Real& distance) const {
    using std::sqrt;
    if (lamp.lies_on[at.surface]) return true;
    const int spheres = int(balls_.size());
    for (int k = 0; k < spheres; ++k) {
      if (k == at.surface) continue;
      if (lamp.lies_on[k]) {
        // Visible while it is nearer than the point's horizon on the sphere, where a tangent ends.
        const V aside = at.point - balls_[k].center;
        if (distance * distance >= dot(aside, aside) - balls_[k].radius_squared) return true;
        continue;
      }
      const Chord chord(balls_[k], at.point, to_light);
      if (chord.half_squared <= 0) continue;
      if (chord.starts_inside(balls_[k])) return true;
      if (chord.along > 0 && chord.along - sqrt(chord.half_squared) < distance) return true;
    }
    // By the sides of the plane that lamp and point are on, not by where the ray meets it.
    for (int k = 0; k < int(grounds_.size()); ++k)
      if (spheres + k != at.surface && lamp.heights[k] * grounds_[k].height(at.point) < 0)
        return true;
    return false;
  }

  /// The greatest coordinate of camera, surfaces and lamps.
  Real reach() const {
    double farthest = 0;
    const auto reach_to = [&](Vec3 place, double radius) {
      for (const double coordinate : {place.x, place.y, place.z})
        farthest = std::max(farthest, std::abs(coordinate) + radius);
    };
    reach_to(scene_.camera.origin, 0);
    for (const Sphere& sphere : scene_.spheres) reach_to(sphere.center, sphere.radius);
    for (const Plane& plane : scene_.planes) reach_to(plane.point, 0);
    for (const Light& light : scene_.lights)
      if (const auto lamp = find_near_lamp(light)) reach_to(lamp->position, 0);
    return farthest;
  }

  const Scene& scene_;
  V origin_, forward_, right_, up_;
  Real half_width_, half_height_, shift_u_, shift_v_;
  std::vector<Ball> balls_;
  std::vector<Ground> grounds_;
  std::vector<NearLamp> lamps_;  ///< by light; unused for a distant one
};

}  // namespace lobelia::truth

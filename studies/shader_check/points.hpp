// Directions and exponents at which a shader function is called, and what a model says of them.
#pragma once

#include <map>
#include <vector>

#include "base/words/vec.hpp"
#include "renderer/highlight.hpp"

namespace lobelia::shader_check {

/// Vectors as a shader has them, rounded to float32.
struct Point {
  Vec3 normal, to_eye, to_light;
  double exponent = 1;
};

/// The cosines of a point, from vectors of exact length in double, and what else a formula may use.
struct Geometry {
  explicit Geometry(const Point& point);
  double n_dot_l, n_dot_v, n_dot_h, v_dot_h, l_dot_v, mirror;  ///< mirror: R.L
  double s_half, s_mirror;  ///< 1 - cosine, from differences of vectors
  double half_length;       ///< of L + V
  double n_dot_difference;  ///< N.(L - V), normalised; 0 where L = V
};

/// How many times as much float32 may leave where L and V are nearly opposite: |L + V|^2 as 2 + 2 L.V is off by 4e-7.
double more_where_opposite(const Geometry& geometry);

/// Random directions for one exponent: eye above the horizon; half of them within the highlight, some grazing, and a sixth
/// with the light behind the surface.
std::vector<Point> domain_points(const Highlight& highlight, double exponent, std::size_t count);

/// Where a quotient, a root or a power might have no finite value: N = H, L = -V, grazing, N.L = 0.
std::vector<Point> hard_points(double exponent);

/// A sphere of the unit radius from far away, lit from `degrees` beside the eye, in reading order. Pixels beside it are
/// at its silhouette; `is_sphere` tells them.
std::vector<Point> sphere_points(double degrees, double exponent, int size);
bool is_sphere(int x, int y, int size);

/// The plane of the eye and a light 60 degrees from it; the normal goes from where the light sets to where the eye does.
struct Arc {
  std::vector<Point> points;
  std::vector<double> degrees;  ///< of the normal from the half vector
};
Arc arc_points(double exponent);

/// Directions with the eye below the surface, where no model is defined.
std::vector<Point> points_below(const Highlight& highlight, double exponent, std::size_t count);

/// Whether a model says anything there: the eye is above the surface. Behind the light it is 0.
bool is_defined(const Geometry& geometry);

/// Lights all over the hemisphere, for an eye at `degrees` from the normal, dense where a highlight is; with the solid
/// angles by which a sum over them is the integral.
struct Hemisphere {
  std::vector<Point> points;
  std::vector<double> solid_angles;
};
Hemisphere hemisphere_points(LobeAngle angle, double degrees, double exponent);

/// radiance_coefficient() of a highlight at any exponent, each computed once.
class Coefficients {
 public:
  explicit Coefficients(const Highlight& highlight) : highlight_(highlight) {}
  double at(double exponent);

 private:
  Highlight highlight_;
  std::map<double, double> known_;
};

/// The model's radiance, in double.
double model_radiance(const Highlight& highlight, double coefficient, const Geometry& geometry);

/// Whether the value jumps there, so that a rounding decides on which side float32 is.
bool is_at_an_edge(const Highlight& highlight, const Geometry& geometry);

}  // namespace lobelia::shader_check

// Reflection at a surface, one direction at a time, for samplers and quadratures. The kernels do the same for many
// points of a picture.
#pragma once

#include <optional>

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// A direction to take light from.
struct ReflectorSample {
  Vec3 to_light;
  Rgb radiance;  ///< eval(); the sample counts radiance / pdf
  double pdf;    ///< per steradian, > 0
};

/// A material: a highlight with its Fresnel factor over a Lambertian base.
///
/// Directions point away from the surface and may have any length. If one is zero, infinite or NaN, or if light or
/// eye is not above the horizon, every answer is 0.
class Reflector {
 public:
  explicit Reflector(const Material& material);

  /// Radiance towards the eye per unit irradiance on a plane normal to the beam. Includes the cosine of a BRDF; an
  /// RDF has none (docs/conventions.md).
  Rgb eval(Vec3 normal, Vec3 to_eye, Vec3 to_light) const;

  /// A direction drawn from three independent numbers in [0, 1); nothing below the horizon or where no light is
  /// reflected. The highlight's directions follow its lobe, around the mirror direction for the Phong models, of
  /// the half vector for the Blinn models.
  std::optional<ReflectorSample> sample(Vec3 normal, Vec3 to_eye, double choice, double u,
                                        double v) const;

  /// Density per steradian of to_light in sample(). Its integral over the hemisphere is 1 minus the share of failed
  /// draws.
  double pdf(Vec3 normal, Vec3 to_eye, Vec3 to_light) const;

  /// Unit vectors with eye and light above the horizon.
  struct Directions {
    Vec3 normal, to_eye, to_light;
  };
  /// pdf() and sample() without the checks, much faster.
  double pdf_above(const Directions& directions) const;
  std::optional<ReflectorSample> sample_above(Vec3 normal, Vec3 to_eye, double choice, double u,
                                              double v) const;

 private:
  static std::optional<Directions> above_horizon(Vec3 normal, Vec3 to_eye, Vec3 to_light);
  double one_minus_cos(const Directions& d) const;
  double specular_share(double n_dot_v) const;
  Rgb eval(const Directions& d, double s) const;
  double pdf(const Directions& d, double s) const;

  Material material_;
  bool has_highlight_;
  PreparedLobe lobe_;
  double coefficient_;
};

}  // namespace lobelia

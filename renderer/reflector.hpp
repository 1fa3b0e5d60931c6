// Reflection at a surface, one direction at a time: eval, sample, pdf. Samplers and quadratures use it. The kernels do the
// same for many points of a picture.
#pragma once

#include <optional>

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// A direction to take light from.
struct ReflectorSample {
  Vec3 to_light;
  Rgb radiance;  ///< eval() of it: radiance / pdf is what the sample counts
  double pdf;    ///< per steradian, > 0
};

/// A material: a highlight with its Fresnel factor over a Lambertian base.
///
/// Directions point away from the surface and need not be of unit length; where one of them is zero,
/// infinite or NaN, or where light or eye is not above the horizon, every answer is 0.
class Reflector {
 public:
  explicit Reflector(const Material& material);

  /// Radiance towards the eye per unit irradiance on a plane normal to the beam. So a BRDF's cosine is
  /// in it, and an RDF's, which has none, is not (docs/conventions.md).
  Rgb eval(Vec3 normal, Vec3 to_eye, Vec3 to_light) const;

  /// A direction drawn from three independent numbers in [0, 1), or nothing where the draw leads below
  /// the horizon or to a light that is not reflected. The highlight's direction follows its lobe: the
  /// mirror direction of the eye for the Phong models, the half vector for Blinn's.
  std::optional<ReflectorSample> sample(Vec3 normal, Vec3 to_eye, double choice, double u,
                                        double v) const;

  /// Density per steradian of to_light among the draws of sample(). Its integral over the hemisphere is
  /// 1 less the draws that lead nowhere.
  double pdf(Vec3 normal, Vec3 to_eye, Vec3 to_light) const;

  /// Unit vectors, eye and light above the horizon.
  struct Directions {
    Vec3 normal, to_eye, to_light;
  };
  /// The same of directions that are known to be such, at a fraction of the time.
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

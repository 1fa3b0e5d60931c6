// Ground truth for highlights in 50 digits, independent of the renderer: textbook formulas of the cosine, the paper's
// integrals by quadrature, and the quadratic formula for rays and spheres. Slow, and rounded to double at the end.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace lobelia::truth {

/// The lobe at s = 1 - cos(angle), s being exactly the given number.
double lobe(LobeId lobe, double s, double exponent);

/// The density of the lobe's samples over s in [0, 1], normalised by quadrature over s.
std::function<double(double s)> density(LobeId lobe, double exponent);

/// 1 - cos of an angle in radians, as 2 sin^2(angle/2).
double one_minus_cos(double angle);

/// The exact normalisation's radiance_coefficient: one over the paper's integral over the angle.
double coefficient(ModelId model, LobeId lobe, double exponent);

/// The coefficient by the highlight's own normalisation: exact, or as the paper prints it, misprints included. Throws
/// Error(kInput) for a lobe without a printed coefficient.
double coefficient(const Highlight& highlight);

/// Lobe times foreshortening: the highlight's share of its peak, for vectors of any length but 0.
/// 0 where the light is not above the horizon.
double shape(const Highlight& highlight, Vec3 normal, Vec3 to_eye, Vec3 to_light);

/// A scene by one ray through the centre of each pixel. Spheres are seen from outside only, and a tangent ray meets nothing.
class Picture {
 public:
  explicit Picture(const Scene& scene);
  ~Picture();
  Picture(Picture&&) noexcept;

  /// The sphere in pixel number `pixel` (in reading order), or -1.
  int sphere(std::size_t pixel) const;

  /// Radiance of every pixel in reading order, with `highlight` in place of every material's own, without Fresnel factor and
  /// diffuse base.
  std::vector<Rgb> highlights(const Highlight& highlight) const;

  /// The upper bound of a highlight with coefficient 1 here: the largest sum of a pixel's irradiances times reflectance.
  double peak() const;

 private:
  struct Pixels;
  std::unique_ptr<Pixels> pixels_;
};

}  // namespace lobelia::truth

// Ground truth for highlights, in 50 digits and by other means than the renderer's: textbook formulas of the cosine, the
// paper's integrals by quadrature, and the quadratic formula for rays and spheres. Slow, and rounded to double at the end.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace lobelia::truth {

/// The lobe at s = 1 - cos(angle), s being exactly the given number.
double lobe(LobeId lobe, double s, double exponent);

/// The density of the lobe's draws over s, s in [0, 1]: what they follow, over its integral by quadrature over s.
std::function<double(double s)> density(LobeId lobe, double exponent);

/// s = 1 - cos of the angle x in radians, and back: 2 sin^2(x/2).
double one_minus_cos(double angle);

/// radiance_coefficient of the exact normalisation: one over the paper's integral over the angle.
double coefficient(ModelId model, LobeId lobe, double exponent);

/// The same of the normalisation that the highlight has: exact, or as the paper prints it. Throws
/// Error(kInput) for a lobe of which it prints none.
double coefficient(const Highlight& highlight);

/// Lobe times foreshortening: the highlight's share of its peak, for vectors of any length but 0.
/// 0 where the light is not above the horizon.
double shape(const Highlight& highlight, Vec3 normal, Vec3 to_eye, Vec3 to_light);

/// A scene, one ray through the centre of each pixel. Spheres are seen from outside only; what a ray
/// merely touches it does not meet.
class Picture {
 public:
  explicit Picture(const Scene& scene);
  ~Picture();
  Picture(Picture&&) noexcept;

  /// The sphere that pixel number `pixel` (in reading order) shows, or -1.
  int sphere(std::size_t pixel) const;

  /// Radiance of every pixel in reading order, with `highlight` in place of every material's own;
  /// without Fresnel factor and diffuse base.
  std::vector<Rgb> highlights(const Highlight& highlight) const;

  /// The most that a highlight of coefficient 1 can have in this picture: the largest sum of a lit
  /// pixel's irradiances times reflectance.
  double peak() const;

 private:
  struct Pixels;
  std::unique_ptr<Pixels> pixels_;
};

}  // namespace lobelia::truth

// The highlight of a model at one parameter, as a curve: what `lobelia convert` compares.
//
// Light arrives along the normal of a flat surface. The curve says where it goes: the light that leaves per steradian, by
// the angle of the eye from the normal, which is the mirror direction. That is radiance times the cosine of the angle,
// per unit irradiance and reflectance. Radiance alone would let the grazing angles decide, where GGX brightens and a
// surface has no area to show it.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "renderer/highlight.hpp"

namespace lobelia::conversion {

/// A model of the catalogue with the cosine lobe; GGX without an id.
struct ShadingModel {
  std::optional<ModelId> id;

  bool is_ggx() const { return !id; }
  std::string_view name() const;
  /// Bounds of the parameter, which is the exponent, or alpha for GGX.
  double min() const;
  double max() const;
};

/// The models of the catalogue, and "ggx".
const std::vector<std::string_view>& shading_model_names();
std::optional<ShadingModel> find_shading_model(std::string_view name);

class Curve {
 public:
  /// `f0` is the reflectance head on. GGX has Schlick's Fresnel factor; the other models are not tinted by angle.
  Curve(ShadingModel model, double parameter, double f0);

  /// Half of the peak at one angle alone, and 0 at 90 degrees.
  double operator()(double angle) const { return radiance_(angle) * std::cos(angle); }
  const ShadingModel& model() const { return model_; }
  double parameter() const { return parameter_; }
  double peak() const { return peak_; }  ///< in the mirror direction
  double half_width() const;             ///< the angle with half of the peak, radians
  double energy() const;                 ///< the share of the beam that leaves
  /// Angles from 0 to 90 degrees, dense within the highlight, ascending.
  std::vector<double> angles() const;

 private:
  ShadingModel model_;
  double parameter_, peak_;
  std::function<double(double angle)> radiance_;
};

/// The angles of both curves, ascending, so that each pair of neighbours holds little of either curve.
std::vector<double> angles_of(const Curve& a, const Curve& b);

/// The integral of a curve times 2 pi sin x.
double energy_between(const std::function<double(double)>& curve, double from, double to);

// How far one highlight is from another.

struct Largest {
  double value, angle;  ///< radians
};

/// The largest |a - b|.
Largest largest_difference(const Curve& a, const Curve& b);
/// The largest CIEDE2000, in grey, on a display whose white is the brighter of both peaks.
Largest largest_ciede2000(const Curve& a, const Curve& b);
/// The energy of |a - b|: what arrives at another angle, or not at all. The energy itself does not tell highlights apart,
/// because models are normalised.
double misplaced_energy(const Curve& a, const Curve& b);

}  // namespace lobelia::conversion

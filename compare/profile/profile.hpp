// A highlight as a curve over the angle that its lobe sees: peak, width, energy, and where two
// pictures of it differ.
//
// Radiance here is the mean of R, G and B. The zones are those of the literature on such lobes:
//   epicentre  from the middle of the highlight to where the lobe has fallen to a half,
//   blooming   from there to where it has fallen to a thousandth: the tail that the eye still sees.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/image.hpp"
#include "core/record.hpp"

namespace lobelia {

inline constexpr double kEpicentreLobe = 0.5, kBloomingLobe = 1e-3;

/// Pictures by name, in the order they are reported in. One may be the formula: "analytic".
using NamedImages = std::vector<std::pair<std::string, const Image*>>;

/// The geometry of the pixels, in reading order.
struct ProfileGeometry {
  std::span<const double> angle;        ///< radians; NaN where the light does not reach the body
  std::span<const double> solid_angle;  ///< of the pixel, steradian
  double epicentre_end = 0;             ///< radians
  double blooming_end = 0;              ///< radians
};

struct HighlightShape {
  double peak = 0;        ///< the largest radiance of a lit pixel; NaN if one is not finite
  double peak_angle = 0;  ///< of that pixel, radians
  double half_width = 0;  ///< angle at which the curve falls to half the peak; NaN if it does not
  double energy = 0;      ///< sum of radiance * solid angle over the lit pixels, W/m^2
};

struct ZoneError {
  std::size_t pixels = 0;   ///< of the zone; if 0, the errors are NaN
  double max_abs = 0;       ///< radiance
  double rms = 0;           ///< radiance
  double max_rel_peak = 0;  ///< max_abs / the second picture's peak
};

struct ProfileDifference {
  std::string a, b;  ///< b is the reference
  ZoneError epicentre, blooming;
};

struct Profile {
  double epicentre_end = 0, blooming_end = 0;
  std::vector<double> angle;                  ///< of each bin: the mean of its pixels, radians
  std::vector<std::size_t> pixels;            ///< in each bin, never 0
  std::vector<std::string> names;             ///< of the pictures
  std::vector<std::vector<double>> radiance;  ///< [picture][bin], the mean of its pixels
  std::vector<HighlightShape> shapes;         ///< [picture]
  std::vector<ProfileDifference> differences;
};

/// `pairs` are indices into `images`. All must have as many pixels as the geometry: Error(kInput).
Profile measure_profile(const ProfileGeometry& geometry, const NamedImages& images,
                        const std::vector<std::pair<std::size_t, std::size_t>>& pairs);

/// As docs/records.md has it; `angle_name` is "reflection" or "half_vector".
Json profile_record(const Profile& profile, int light, int sphere, const std::string& angle_name);

}  // namespace lobelia

// A highlight as a curve over the angle that its lobe sees: peak, width, energy, the power of a cosine that it
// looks like, and where two pictures of it differ. docs/profiles.md defines every figure and the zones.
//
// Radiance here is the mean of R, G and B.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compare/profile/cosine_fit.hpp"
#include "compare/profile/peak.hpp"
#include "compare/profile/zones.hpp"
#include "core/image.hpp"
#include "records/profile.hpp"

namespace lobelia {

/// Pictures by name, in the order they are reported in. One may be the formula: "analytic".
using NamedImages = std::vector<std::pair<std::string, const Image*>>;

/// The mean of R, G and B of a pixel, by its index in reading order.
inline double radiance_at(const Image& image, std::size_t index) {
  const float* value = image.values().data() + 3 * index;
  return (double(value[0]) + double(value[1]) + double(value[2])) / 3;
}

/// The geometry of the pixels, in reading order.
struct ProfileGeometry {
  std::span<const double> angle;        ///< radians; NaN where the light does not reach the body
  std::span<const double> solid_angle;  ///< of the pixel, steradian
  ZoneEnds ends;                        ///< radians
  // Without these three there are no HighlightFigures.
  int width = 0;                       ///< of the film; 0: unknown
  std::span<const double> scale = {};  ///< radiance of the highlight is scale * coefficient * lobe
  std::span<const double> base = {};   ///< radiance beneath the highlight: of the diffuse base
  /// Unit vector in the picture, y down, along the line in which the plane of incidence is seen; nothing where
  /// eye, sphere and light lie on one line.
  std::optional<FilmPoint> incidence = {};
};

/// Half of the width between the places to both sides where the highlight has half of its peak.
struct HalfWidth {
  double pixels = 0;
  double angle = 0;  ///< of the lobe there, the mean of both sides, radians
};

/// Figures of the highlight alone, without the radiance beneath it; NaN if unknown.
struct HighlightFigures {
  Peak peak;           ///< to a fraction of a pixel
  FilmPoint centroid;  ///< weighted by radiance * solid angle, down to the end of the blooming zone
  double energy = 0;   ///< sum of radiance * solid angle over the lit pixels, W/m^2
  HalfWidth along, across;  ///< the plane of incidence; where there is none, x and y of the picture
  CosineFit cosine;         ///< down to the end of the blooming zone
  std::string why_not;      ///< a sentence where there is no peak or it is not resolved
};

/// `geometry.width` is not 0, and the picture has as many pixels as the geometry.
HighlightFigures measure_highlight(const ProfileGeometry& geometry, const Image& image);

struct HighlightShape {
  double peak = 0;        ///< the largest radiance of a lit pixel; NaN if one is not finite
  double peak_angle = 0;  ///< of that pixel, radians
  double half_width = 0;  ///< angle at which the curve falls to half the peak; NaN if it does not
  double energy = 0;      ///< sum of radiance * solid angle over the lit pixels, W/m^2
};

struct ProfileDifference {
  std::string a, b;  ///< b is the reference
  std::array<ZoneError, kZoneCount> zones;
};

struct Profile {
  ZoneEnds ends;
  std::optional<FilmPoint> incidence;
  std::vector<double> angle;                  ///< of each bin: the mean of its pixels, radians
  std::vector<std::size_t> pixels;            ///< in each bin, never 0
  std::vector<std::string> names;             ///< of the pictures
  std::vector<std::vector<double>> radiance;  ///< [picture][bin], the mean of its pixels
  std::vector<HighlightShape> shapes;         ///< [picture]
  std::vector<HighlightFigures> figures;      ///< [picture], or none at all
  std::vector<ProfileDifference> differences;
};

/// `pairs` are indices into `images`. All must have as many pixels as the geometry: Error(kInput).
Profile measure_profile(const ProfileGeometry& geometry, const NamedImages& images,
                        const std::vector<std::pair<std::size_t, std::size_t>>& pairs);

/// `angle_name` is "reflection" or "half_vector".
records::Profile profile_record(const Profile& profile, int light, int sphere,
                                const std::string& angle_name);

}  // namespace lobelia

// A highlight as a curve over the angle of its lobe: peak, width, energy, the power of a cosine that fits it, and
// the differences of two pictures by zone. docs/profiles.md defines every figure and the zones.
//
// Radiance here is the mean of R, G and B.
#pragma once

#include <functional>

#include "base/records/profile.hpp"
#include "base/words/constants.hpp"
#include "profile/lobe_fit.hpp"
#include "profile/noise.hpp"
#include "profile/outline.hpp"

namespace lobelia {

/// The zones of a highlight, from the middle outward: epicentre, flank and blooming zone. Each ends where the lobe falls
/// to this share of its peak. The literature on such lobes names the epicentre and the blooming zone, without limits.
inline constexpr std::array kZoneShares = {0.5, 0.05, 1e-3};
inline constexpr std::size_t kZoneCount = kZoneShares.size();

/// The end of each zone, in any measure that grows outward.
using ZoneEnds = std::array<double, kZoneCount>;
using ZoneErrors = std::array<records::ZoneError, kZoneCount>;

/// Collects the errors of the zones, pixel by pixel.
class ZoneErrorSums {
 public:
  void add(std::size_t zone, double difference);
  /// NaN for a zone without pixels, or with a difference that is not finite.
  ZoneErrors errors(double peak) const;

 private:
  struct Sum {
    std::size_t pixels = 0;
    double max_abs = 0, squares = 0;
    bool finite = true;
  };
  std::array<Sum, kZoneCount> sums_;
};

/// Pictures by name, in the order of the report. One may be the formula: "analytic".
using NamedImages = std::vector<std::pair<std::string, const Image*>>;

/// More geometry of the pixels, for fits of any lobe. In reading order; NaN where ProfileGeometry::angle is.
struct LobeGeometry {
  std::span<const double> reflection, half_vector;  ///< angles, radians
  std::span<const double> n_dot_l, n_dot_v;
  std::span<const double>
      irradiance;  ///< times reflectance and Fresnel factor, the mean of R, G and B
};

/// A pixel as the mean of its places.
struct PixelMean {
  std::vector<LobeNode> nodes;  ///< none if one of them does not see the lit sphere
  std::vector<LobeSample::Node>
      of_lobe;              ///< the same with the angle and the scale of the scene's lobe
  double more_beneath = 0;  ///< as SeenLobe has it
};

/// The geometry of the pixels, in reading order.
struct ProfileGeometry {
  std::span<const double> angle;        ///< radians; NaN where the light does not reach the sphere
  std::span<const double> solid_angle;  ///< of the pixel, steradian
  ZoneEnds ends;                        ///< radians
  // HighlightFigures need these three.
  int width = 0;                       ///< of the film; 0: unknown
  std::span<const double> scale = {};  ///< radiance of the highlight is scale * coefficient * lobe
  std::span<const double> base = {};   ///< radiance beneath the highlight: the diffuse base
  /// Unit vector in the picture, y down, along the plane of incidence; none if eye, sphere and light lie on a line.
  std::optional<FilmPoint> incidence = {};
  std::optional<LobeGeometry> lobes = {};
  /// Whether pixels show centres or means. Means need `mean`, of a pixel by its index; it is called from one thread.
  PixelsShow pixels = PixelsShow::kCentres;
  std::function<PixelMean(std::size_t pixel)> mean = {};
  std::size_t nodes_per_pixel = 1;
  FilmPoint middle = {kNaN, kNaN};  ///< where the scene has the highlight's peak; NaN if unknown
};

/// Half of the width between the places on both sides where the highlight has half of its peak.
struct HalfWidth {
  double pixels = 0;
  double angle = 0;  ///< of the lobe there, the mean of both sides, radians
};

/// Figures of the highlight alone, without the radiance beneath it; NaN if unknown.
struct HighlightFigures {
  Peak peak;           ///< to a fraction of a pixel
  FilmPoint centroid;  ///< weighted by radiance * solid angle, down to the end of the blooming zone
  double energy = 0;   ///< sum of radiance * solid angle over the lit pixels, W/m^2
  HalfWidth along, across;  ///< the plane of incidence; without one, x and y of the picture
  LobeFit cosine;           ///< down to the end of the blooming zone
  std::string why_not;      ///< a sentence if there is no peak or it is not resolved
  std::vector<FamilyFit> explanations;             ///< within 3 half-widths, the best first
  PixelsShow pixels = PixelsShow::kCentres;        ///< what the explanations take them for
  std::optional<records::HighlightErrors> errors;  ///< NaN where unknown
};

/// Facts about a picture besides its values.
struct PictureFacts {
  const PictureNoise* noise = nullptr;  ///< null: unknown
  std::vector<bool> clipped = {};       ///< of each pixel; empty: none. Fits leave these out.
  /// Standard deviation of the rounding of each pixel's radiance in the file; empty: unknown.
  std::vector<double> rounding = {};
  bool thorough = false;  ///< standard errors and explanations are wanted; they need the lobes
};

/// `geometry.width` is not 0. The picture and its facts have as many pixels as the geometry.
HighlightFigures measure_highlight(const ProfileGeometry& geometry, const Image& image,
                                   const PictureFacts& facts = {});

/// The name of where standard errors come from.
inline std::string noise_source(bool noise_is_given) {
  return std::string(records::kNoiseSources[noise_is_given ? 0 : 1]);
}

struct HighlightShape {
  double peak = 0;        ///< the largest radiance of a lit pixel; NaN if one is not finite
  double peak_angle = 0;  ///< of that pixel, radians
  double half_width = 0;  ///< angle at which the curve falls to half the peak; NaN if it does not
  double energy = 0;      ///< sum of radiance * solid angle over the lit pixels, W/m^2
};

struct ProfileDifference {
  std::string a, b;  ///< b is the reference
  ZoneErrors zones;
};

struct Profile {
  ZoneEnds ends;
  std::optional<FilmPoint> incidence;
  std::vector<double> angle;                  ///< of each bin: the mean of its pixels, radians
  std::vector<std::size_t> pixels;            ///< of each bin, never 0
  std::vector<std::string> names;             ///< of the pictures
  std::vector<std::vector<double>> radiance;  ///< [picture][bin], the mean of its pixels
  std::vector<HighlightShape> shapes;         ///< [picture]
  std::vector<HighlightFigures> figures;      ///< [picture], or none at all
  std::vector<ProfileDifference> differences;
};

/// `pairs` are indices into `images`. `facts` are those of each image, or empty. Throws Error(kInput) if a picture's pixels
/// are not as many as the geometry's.
Profile measure_profile(const ProfileGeometry& geometry, const NamedImages& images,
                        const std::vector<std::pair<std::size_t, std::size_t>>& pairs,
                        const std::vector<PictureFacts>& facts = {});

/// `angle_name` is "reflection" or "half_vector".
records::Profile profile_record(const Profile& profile, int light, int sphere,
                                const std::string& angle_name);

}  // namespace lobelia

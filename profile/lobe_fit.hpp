// The lobe that fits a highlight best, whatever the picture was made with: coefficient * lobe(angle), fitted to the pixels
// by weighted least squares.
//
// Families:     a power n of the cosine about the mirror direction (Phong) or of the half vector with the normal
//               (Blinn-Phong), each with or without the cosine N.L of the light; and the microfacet distributions of
//               Trowbridge and Reitz (GGX) and of Beckmann, D G / (N.V), with Smith's masking by Walter et al. 2007,
//               "Microfacet Models for Refraction through Rough Surfaces", eq. 25 to 28, 33 and 34. Fresnel's factor
//               is the scene's.
// Width:        alpha of a microfacet distribution; its roughness is the root of alpha, as in Blender and in Disney's model.
// Search:       the coefficient is linear, so the best one is known for every width, and only the width is searched: the
//               root of the derivative of the sum of squares, by Boost.Math's TOMS 748.
// Pixels:       a picture shows the lobe at its pixels' centres, or its mean over each pixel with a filter. A mean is a sum
//               over nodes, places of the pixel with weights, so the lobe is fitted and not its blurred copy. Where it is not
//               known which of the two a picture shows, both are fitted and told apart like families; if they cannot be, the
//               width is the middle of both, and half of their difference is added to the error.
// Error:        the square root of the width's entry in the covariance matrix of the residuals by White's estimate HC3
//               (MacKinnon, White 1985, "Some heteroskedasticity-consistent covariance matrix estimators"). It allows for
//               noise that differs from pixel to pixel. Explanations sum it over blocks of pixels too, and the largest
//               counts: neighbours share what a texture adds. A highlight has few pixels, and noise may be in few of
//               those. So the error is half of Student's interval of two deviations, with Satterthwaite's degrees of
//               freedom, 3 (sum s^2)^2 / sum s^4 over the terms s. With known noise or rounding it is at least theirs.
//               Without noise it tells how far the lobe is from the family, not the uncertainty of its width.
// Told apart:   two families, by the difference of their sums of squares over its standard deviation. With r the residual
//               of the better fit and d the difference of both fits, that is twice the deviation of the sum of r d.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace lobelia {

/// A place within a pixel whose mean is fitted, with its share of the pixel.
struct LobeNode {
  double share = 0;  ///< those of a pixel sum to 1; below 0 where the filter is
  double reflection = 0, half_vector = 0;  ///< angles, radians
  double n_dot_l = 1, n_dot_v = 1;
  double irradiance = 0;  ///< as SeenLobe has it
};

/// A pixel of a highlight: its radiance is scale * coefficient * lobe(angle).
struct LobeSample {
  double angle;  ///< radians, 0 to pi/2
  double scale;
  double radiance;
  bool is_known = true;  ///< false: clipped, so it is not fitted
  /// If the pixel is a mean: angle and scale of each place, the scale times its share. It has to outlive the fit.
  struct Node {
    double angle, scale;
  };
  std::span<const Node> nodes = {};
};

struct LobeFit {
  double width = 0;           ///< exponent or alpha; NaN if there is no fit
  double standard_error = 0;  ///< of the width
  double coefficient = 0;
  double residual = 0;     ///< root mean square over the brightest value of the lobe
  std::size_t pixels = 0;  ///< number of fitted pixels
  std::string why_not;     ///< a sentence if there is no fit
};

/// A lobe needs this many pixels above half of its peak to tell its width.
inline constexpr std::size_t kFewestPixelsOfALobe = 9;

/// Searches exponents from 1e-3 to 1e8.
LobeFit fit_cosine_lobe(std::span<const LobeSample> samples);

/// Named by records::kLobeFamilies.
enum class FittedFamily { kPhong, kBlinnPhong, kGgx, kBeckmann };

/// A pixel of a highlight whose camera and light are known.
struct SeenLobe {
  double reflection, half_vector;  ///< angles, radians
  double n_dot_l, n_dot_v;
  double irradiance;  ///< times the reflectance: what `scale` is without foreshortening
  double radiance;
  double error;          ///< standard error of the radiance; NaN if unknown
  double rounding = 0;   ///< standard deviation of what the file's rounding adds; 0 if unknown
  int x = 0, y = 0;      ///< of the pixel
  bool is_known = true;  ///< as LobeSample has it
  /// For a fit of means: the places of the pixel, and how much its mean of all that lies beneath the highlight exceeds
  /// what was subtracted at its centre. They have to outlive the fit.
  std::span<const LobeNode> nodes = {};
  double more_beneath = 0;
};

/// Named by records::kPixelsShow.
enum class PixelsShow {
  kCentres,  ///< the radiance at the pixel's centre
  kMeans,    ///< its mean over the pixel, with the film's filter
  kUnknown,  ///< one of the two
};

struct FamilyFit {
  FittedFamily family{};
  bool times_n_dot_l = false;  ///< the variant that fits better; false for microfacets
  LobeFit fit;
  double noise_share = 0;  ///< rms of the residuals over that of the errors; NaN if unknown
  double apart = 0;        ///< from the best family, in standard deviations; 0 for the best
};

/// Two families closer than this cannot be told apart.
inline constexpr double kToldApart = 2;

struct Explanation {
  std::vector<FamilyFit> families;  ///< every one once, the best first, those without a fit last
  PixelsShow pixels = PixelsShow::kCentres;  ///< unknown if that was asked and cannot be told
};

/// With errors, weights are 1 / (error^2 + (peak / 1000)^2), since no lobe is exact to less. If `shared`, errors of all
/// pixels may have the same sign, and the worse case counts. Pixels have nodes unless they show centres; one without any
/// is not fitted.
Explanation explain_highlight(std::span<const SeenLobe> pixels, bool shared, PixelsShow show);
/// The families of pixels that show their centres.
std::vector<FamilyFit> explain_highlight(std::span<const SeenLobe> pixels, bool shared);

}  // namespace lobelia

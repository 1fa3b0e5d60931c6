// Profiles: a highlight as curves and figures, with or without its scene.
#pragma once

#include "base/records/highlight.hpp"
#include "base/records/struct_type.hpp"

namespace lobelia::records {

/// The name of the formula's curves and pictures, and of the engine that evaluates it.
inline constexpr char kAnalytic[] = "analytic";

/// How a peak was found.
inline constexpr std::string_view kPeakFound[] = {"fitted", "pixel", "plateau", "edge", "none"};
/// Lobes that may explain a highlight.
inline constexpr std::string_view kLobeFamilies[] = {"phong", "blinn_phong", "ggx", "beckmann"};
/// How the fit of a lobe interprets the pixels.
inline constexpr std::string_view kPixelsShow[] = {"centres", "means", "unknown"};
inline constexpr std::string_view kFalloffs[] = {"gaussian", "ggx"};
/// Where standard errors come from.
inline constexpr std::string_view kNoiseSources[] = {"given", "scatter"};

struct Point {
  double x = 0, y = 0;
};

struct Peak {
  double x = 0, y = 0, radiance = 0;
  std::string found;
};

struct HalfWidth {
  double pixels = 0, degrees = 0;
};

struct CosineLobe {
  std::optional<double> exponent, standard_error, coefficient, rms_of_peak;
  std::optional<std::size_t> pixels;
  std::string because;
};

/// A family of lobes that was fitted.
struct LobeExplanation {
  std::string family;
  bool times_n_dot_l = false;
  std::optional<double> exponent, alpha, roughness, standard_error, coefficient, rms_of_peak;
  std::optional<double> rms_of_noise, deviations_from_best;
  std::string because;
};

/// Standard errors of the figures of a highlight.
struct HighlightErrors {
  std::string source;
  double peak = 0, energy = 0;
  Point place, centroid;
  double half_width_along_pixels = 0, half_width_across_pixels = 0;
};

struct ClippedPixels {
  std::size_t pixels = 0;
  std::string channels;
};

/// One or a few pixels that stand alone.
struct Speck {
  Point place;
  double radiance = 0;
  std::size_t pixels = 0;
};

struct HighlightFigures {
  Peak peak;
  Point centroid;
  HalfWidth half_width_along, half_width_across;
  double energy = 0;
  CosineLobe cosine_lobe;
  std::string because;
  std::vector<LobeExplanation> explanations;
  std::string pixels_show;
  std::optional<HighlightErrors> standard_errors;
  std::optional<ClippedPixels> clipped;
  std::vector<Speck> specks;
};

struct HighlightShape {
  double peak = 0, peak_angle_degrees = 0, half_width_degrees = 0, energy = 0;
  std::optional<HighlightFigures> highlight;
};

struct ZoneError {
  std::size_t pixels = 0;
  double max_abs = 0, rms = 0, max_rel_peak = 0;
};

/// One for each zone.
struct ZoneErrors {
  ZoneError epicentre, flank, blooming;
};

struct ZoneRanges {
  std::array<double, 2> epicentre_degrees{}, flank_degrees{}, blooming_degrees{};
};

struct ProfileCurve {
  std::vector<double> angle_degrees;
  std::vector<std::size_t> pixels;
  Named<std::vector<double>> radiance;
};

struct Subtracted {
  double diffuse_of_peak = 0, other_lights_of_peak = 0;
};

struct Profile {
  int light = 0, sphere = 0;
  std::string angle;
  ZoneRanges zones;
  std::optional<Point> plane_of_incidence;
  ProfileCurve curve;
  Named<HighlightShape> images;
  Named<ZoneErrors> differences;
  std::optional<Highlight> lobe;
  std::optional<Subtracted> subtracted;
};

struct Profiles {
  std::vector<Profile> profiles;
};

struct ZoneEnds {
  double epicentre = 0, flank = 0, blooming = 0;
};

struct AxisPair {
  double major = 0, minor = 0;
};

/// A figure with its standard error.
struct Estimate {
  double value = 0, standard_error = 0;
};

struct Falloff {
  std::string family;
  Estimate peak;
  Estimate half_width_major, half_width_minor;
  Point place;
  double rms_of_peak = 0;
  std::size_t pixels = 0;
  std::string because;
};

struct Clipping {
  std::size_t pixels = 0;
  std::string channels;
  double peak_at_least = 0;
  Falloff flank;
};

struct BlobErrors {
  double background = 0, peak = 0, energy = 0;
  Point place, centroid;
  AxisPair half_width_pixels;
};

struct Colour {
  double red = 0, green = 0, blue = 0;
};

struct BlobFigures {
  Peak peak;
  double background = 0;
  std::size_t pixels = 0;
  Point centroid, major_axis;
  AxisPair half_width_pixels, gaussian_sigma_pixels;
  double energy = 0;
  std::size_t nonfinite = 0;
  std::string because, remark;
  std::optional<BlobErrors> standard_errors;
  std::optional<double> noise_of_peak;
  std::optional<Colour> colour;
  std::optional<Clipping> clipped;
  std::vector<Falloff> falloff;
};

struct BlobCurve {
  std::vector<double> offset_pixels;
  Named<std::vector<double>> radiance;
};

struct Blob {
  std::string reference;
  ZoneEnds zones;
  Named<BlobFigures> images;
  Named<BlobCurve> curves;
  Named<ZoneErrors> differences;
  std::optional<std::size_t> id;
};

struct BlobPicture {
  std::string standard_errors_from;
  std::vector<Speck> specks;
  std::size_t more_specks = 0, more_highlights = 0;
  bool may_have_more = false;
};

struct Blobs {
  double least_share = 0;
  Named<BlobPicture> pictures;
  std::vector<Blob> highlights;
};

void define_profile_tables(Tables& tables);

}  // namespace lobelia::records

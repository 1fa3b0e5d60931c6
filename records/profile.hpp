// Profiles: a highlight as curves and figures, with or without its scene.
#pragma once

#include "records/highlight.hpp"
#include "records/struct_type.hpp"

namespace lobelia::records {

/// The name of the formula's curves and pictures, and of the engine that evaluates it.
inline constexpr char kAnalytic[] = "analytic";

/// How a peak was found.
inline constexpr std::string_view kPeakFound[] = {"fitted", "pixel", "plateau", "edge", "none"};

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

struct HighlightFigures {
  Peak peak;
  Point centroid;
  HalfWidth half_width_along, half_width_across;
  double energy = 0;
  CosineLobe cosine_lobe;
  std::string because;
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

struct BlobFigures {
  Peak peak;
  double background = 0;
  std::size_t pixels = 0;
  Point centroid, major_axis;
  AxisPair half_width_pixels, gaussian_sigma_pixels;
  double energy = 0;
  std::size_t nonfinite = 0;
  std::string because, remark;
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
};

void define_profile_tables(Tables& tables);

}  // namespace lobelia::records

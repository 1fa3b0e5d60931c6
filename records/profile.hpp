// Profiles: a highlight as curves and figures, with the scene that it is of and without.
#pragma once

#include "records/highlight.hpp"
#include "records/struct_type.hpp"

namespace lobelia::records {

/// The formula's name among curves and pictures; also of the engine that evaluates it.
inline constexpr char kAnalytic[] = "analytic";

/// How a peak was found.
inline constexpr std::string_view kPeakFound[] = {"fitted", "pixel", "plateau", "edge", "none"};

struct Point {
  double x = 0, y = 0;
  static const Struct& type();
};

struct Peak {
  double x = 0, y = 0, radiance = 0;
  std::string found;
  static const Struct& type();
};

struct HalfWidth {
  double pixels = 0, degrees = 0;
  static const Struct& type();
};

struct CosineLobe {
  std::optional<double> exponent, standard_error, coefficient, rms_of_peak;
  std::optional<std::size_t> pixels;
  std::string because;
  static const Struct& type();
};

struct HighlightFigures {
  Peak peak;
  Point centroid;
  HalfWidth half_width_along, half_width_across;
  double energy = 0;
  CosineLobe cosine_lobe;
  std::string because;
  static const Struct& type();
};

struct HighlightShape {
  double peak = 0, peak_angle_degrees = 0, half_width_degrees = 0, energy = 0;
  std::optional<HighlightFigures> highlight;
  static const Struct& type();
};

struct ZoneError {
  std::size_t pixels = 0;
  double max_abs = 0, rms = 0, max_rel_peak = 0;
  static const Struct& type();
};

/// One for each zone.
struct ZoneErrors {
  ZoneError epicentre, flank, blooming;
  static const Struct& type();
};

struct ZoneRanges {
  std::array<double, 2> epicentre_degrees{}, flank_degrees{}, blooming_degrees{};
  static const Struct& type();
};

struct ProfileCurve {
  std::vector<double> angle_degrees;
  std::vector<std::size_t> pixels;
  Named<std::vector<double>> radiance;
  static const Struct& type();
};

struct Subtracted {
  double diffuse_of_peak = 0, other_lights_of_peak = 0;
  static const Struct& type();
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
  static const Struct& type();
};

struct Profiles {
  std::vector<Profile> profiles;
  static const Struct& type();
};

struct ZoneEnds {
  double epicentre = 0, flank = 0, blooming = 0;
  static const Struct& type();
};

struct AxisPair {
  double major = 0, minor = 0;
  static const Struct& type();
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
  static const Struct& type();
};

struct BlobCurve {
  std::vector<double> offset_pixels;
  Named<std::vector<double>> radiance;
  static const Struct& type();
};

struct Blob {
  std::string reference;
  ZoneEnds zones;
  Named<BlobFigures> images;
  Named<BlobCurve> curves;
  Named<ZoneErrors> differences;
  static const Struct& type();
};

}  // namespace lobelia::records

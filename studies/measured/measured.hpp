// Measured materials in the files of MERL and RGL, by readers of our own.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/words/vec.hpp"

namespace lobelia::measured {

/// The BRDF of an isotropic material.
struct MeasuredBrdf {
  std::string format;  ///< "MERL", "RGL"
  /// Radiance per unit irradiance normal to the beam, f_r N.L, linear Rec. 709; none where nothing was measured. For unit
  /// vectors away from a surface with the normal +z; both have z > 0.
  std::function<std::optional<Rgb>(Vec3 to_eye, Vec3 to_light)> radiance;
  std::vector<std::string> remarks = {};  ///< sentences about the file
};

/// The bytes that are read of a file at most.
inline constexpr std::uint64_t kMostBytes = std::uint64_t{256} << 20;
/// No number of a BRDF is so large, and sums of their squares stay finite.
inline constexpr double kMostValue = 1e12;

/// Whether the file's name is that of MERL (.binary) or RGL (.bsdf).
bool is_measured(const std::filesystem::path& path);
/// Reads .bsdf as RGL, every other file as MERL. Throws Error(kInput) with one line.
MeasuredBrdf read_measured(const std::filesystem::path& path);

/// From the bytes of a file; `where` names it in messages. Both throw Error(kInput).
MeasuredBrdf parse_merl(const std::string& bytes, const std::string& where);
MeasuredBrdf parse_rgl(const std::string& bytes, const std::string& where);

/// A pair of directions by the half vector and the difference, radians: the light is at `theta_d` from the half vector,
/// which is at `theta_h` from the normal (Rusinkiewicz 1998).
struct HalfDifference {
  double theta_h, theta_d, phi_d;
};
struct Directions {
  Vec3 to_eye, to_light;
};
Directions directions(const HalfDifference& angles);
HalfDifference half_difference(const Directions& directions);

/// MERL's cells: theta_h is the square of an even scale, so that the highlight has small ones.
inline constexpr int kMerlThetaH = 90, kMerlThetaD = 90, kMerlPhiD = 180;
/// The angle at a place on that scale, 0 to kMerlThetaH; radians.
double merl_theta_h(double place);

}  // namespace lobelia::measured

// MERL's format (Matusik et al. 2003, "A Data-Driven Reflectance Model"): three int32 dimensions, 90 x 90 x 180 cells by
// theta_h, theta_d and phi_d, then red, green and blue of every cell as float64, little endian, each with a scale. As in the
// authors' reader a direction has the value of its cell, without interpolation. Negative values are not measured.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>

#include "base/system/files.hpp"
#include "base/words/constants.hpp"
#include "base/words/text.hpp"
#include "studies/measured/measured.hpp"

namespace lobelia::measured {
namespace {

constexpr std::size_t kCells = std::size_t{kMerlThetaH} * kMerlThetaD * kMerlPhiD;
constexpr std::size_t kHeader = 3 * sizeof(std::int32_t);
constexpr double kScales[] = {1 / 1500.0, 1.15 / 1500, 1.66 / 1500};

std::size_t cell_of(const HalfDifference& at) {
  const auto step = [](double place, int count) {
    return std::size_t(std::clamp(int(place), 0, count - 1));
  };
  const double turn = at.phi_d < 0 ? at.phi_d + kPi : at.phi_d;  // swapped directions are equal
  const std::size_t theta_h = step(kMerlThetaH * std::sqrt(at.theta_h / kRightAngle), kMerlThetaH);
  const std::size_t theta_d = step(kMerlThetaD * at.theta_d / kRightAngle, kMerlThetaD);
  return (theta_h * kMerlThetaD + theta_d) * kMerlPhiD + step(kMerlPhiD * turn / kPi, kMerlPhiD);
}

}  // namespace

double merl_theta_h(double place) {
  return kRightAngle * (place / kMerlThetaH) * (place / kMerlThetaH);
}

Directions directions(const HalfDifference& at) {
  const double sin_h = std::sin(at.theta_h), cos_h = std::cos(at.theta_h);
  const Vec3 half{sin_h, 0, cos_h}, tangent{cos_h, 0, -sin_h}, bitangent{0, 1, 0};
  const Vec3 aside =
      std::sin(at.theta_d) * (std::cos(at.phi_d) * tangent + std::sin(at.phi_d) * bitangent);
  const Vec3 along = std::cos(at.theta_d) * half;
  return {along - aside, along + aside};
}

HalfDifference half_difference(const Directions& to) {
  const Vec3 half = normalize(to.to_eye + to.to_light);
  const double azimuth = std::atan2(half.y, half.x), c = std::cos(azimuth), s = std::sin(azimuth);
  const double sin_h = std::hypot(half.x, half.y);
  const Vec3 tangent{half.z * c, half.z * s, -sin_h}, bitangent{-s, c, 0};
  return {angle_between(half, {0, 0, 1}), angle_between(half, to.to_light),
          std::atan2(dot(to.to_light, bitangent), dot(to.to_light, tangent))};
}

MeasuredBrdf parse_merl(const std::string& bytes, const std::string& where) {
  std::array<std::int32_t, 3> dimensions{};
  if (bytes.size() >= kHeader) std::memcpy(dimensions.data(), bytes.data(), kHeader);
  if (dimensions != std::array<std::int32_t, 3>{kMerlThetaH, kMerlThetaD, kMerlPhiD})
    throw Error(ExitCode::kInput, "{}: is no MERL file: its size is {} x {} x {}, not {} x {} x {}",
                where, dimensions[0], dimensions[1], dimensions[2], kMerlThetaH, kMerlThetaD,
                kMerlPhiD);
  constexpr std::size_t kSize = kHeader + 3 * kCells * sizeof(double);
  if (bytes.size() != kSize)
    throw Error(ExitCode::kInput, "{}: has {} bytes, where a MERL file has {}", where, bytes.size(),
                kSize);
  auto values = std::make_shared<std::vector<std::array<float, 3>>>(kCells);
  for (std::size_t cell = 0; cell < kCells; ++cell)
    for (std::size_t channel = 0; channel < 3; ++channel) {
      double stored = 0;
      std::memcpy(&stored, bytes.data() + kHeader + (channel * kCells + cell) * sizeof stored,
                  sizeof stored);
      if (!(std::abs(stored) <= kMostValue))
        throw Error(ExitCode::kInput, "{}: value {} of channel {} is {}; allowed: up to {:g}",
                    where, cell, channel, stored, kMostValue);
      if (stored < 0) stored = -1;
      (*values)[cell][channel] = float(kScales[channel] * stored);
    }
  const auto is_missing = [](const std::array<float, 3>& value) {
    return std::ranges::min(value) < 0;
  };
  const auto missing = std::size_t(std::ranges::count_if(*values, is_missing));
  MeasuredBrdf brdf{.format = "MERL", .radiance = [=](Vec3 to_eye, Vec3 to_light) {
                      const auto& value = (*values)[cell_of(half_difference({to_eye, to_light}))];
                      return is_missing(value)
                                 ? std::nullopt
                                 : std::optional(to_light.z * Rgb{value[0], value[1], value[2]});
                    }};
  if (missing > 0)
    brdf.remarks.push_back(fmt::format(
        "{:.2g} % of the cells are negative, so below the horizon or not measured: left "
        "out of the fit and black in pictures",
        100.0 * double(missing) / double(kCells)));
  return brdf;
}

bool is_measured(const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string());
  return ending == ".binary" || ending == ".bsdf";
}

MeasuredBrdf read_measured(const std::filesystem::path& path) {
  const std::string bytes = read_file(path, kMostBytes);
  const bool is_rgl = lower_case(path.extension().string()) == ".bsdf";
  return (is_rgl ? parse_rgl : parse_merl)(bytes, printable_path(path.string()));
}

}  // namespace lobelia::measured

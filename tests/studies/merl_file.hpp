// MERL files that tests make, by formulas of their own.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>

#include "base/words/constants.hpp"
#include "base/words/vec.hpp"

namespace lobelia {

/// The bytes of a file with this BRDF in the middle of each cell; cells below the horizon are negative.
inline std::string merl_bytes(const std::function<Rgb(Vec3 to_eye, Vec3 to_light)>& brdf) {
  constexpr std::int32_t kSizes[] = {90, 90, 180};
  constexpr std::size_t kCells = std::size_t{90} * 90 * 180;
  std::string bytes(sizeof kSizes + 3 * kCells * sizeof(double), '\0');
  std::memcpy(bytes.data(), kSizes, sizeof kSizes);
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    const double ring = (double(cell / (90 * 180)) + 0.5) / 90;
    const double h = ring * ring * kRightAngle;
    const double d = (double(cell / 180 % 90) + 0.5) * kPi / 180;
    const double p = (double(cell % 180) + 0.5) * kPi / 180;
    const Vec3 half{std::sin(h), 0, std::cos(h)};
    // The light's direction in the frame of the normal, turned by theta_h about y.
    const Vec3 own{std::sin(d) * std::cos(p), std::sin(d) * std::sin(p), std::cos(d)};
    const Vec3 to_light{std::cos(h) * own.x + std::sin(h) * own.z, own.y,
                        -std::sin(h) * own.x + std::cos(h) * own.z};
    const Vec3 to_eye = 2 * dot(half, to_light) * half - to_light;
    const bool is_above = to_eye.z > 0 && to_light.z > 0;
    const Rgb f = is_above ? brdf(to_eye, to_light) : Rgb{-1, -1, -1};
    const double stored[] = {f.r * 1500, f.g * 1500 / 1.15, f.b * 1500 / 1.66};
    for (std::size_t k = 0; k < 3; ++k)
      std::memcpy(bytes.data() + sizeof kSizes + (k * kCells + cell) * sizeof(double), &stored[k],
                  sizeof(double));
  }
  return bytes;
}

}  // namespace lobelia

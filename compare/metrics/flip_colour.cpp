// Source, agreement and why float: see flip_ldr.cpp. The order of operations is that of the
// formulas as the paper and the tool write them; another order gives other last digits.
#include "compare/metrics/flip_colour.hpp"

#include <algorithm>
#include <cmath>

namespace lobelia {
namespace {

// Section 4.1.3: exponent of the colour distance.
constexpr float kColourExponent = 0.7f;

struct Triple {
  float x, y, z;
};

// D65 as the tool has it: the row sums of its matrix, and their reciprocals.
constexpr Triple kWhite{0.950428545f, 1.0f, 1.088900371f};
constexpr Triple kInverseWhite{1.052156925f, 1.0f, 0.918357670f};

Triple relative_xyz_from_rgb(Triple rgb) {
  constexpr float kX = 24577794.0f, kY = 12288897.0f, kZ = 73733382.0f;
  constexpr Triple kRowX{10135552.0f / kX, 8788810.0f / kX, 4435075.0f / kX};
  constexpr Triple kRowY{2613072.0f / kY, 8788810.0f / kY, 887015.0f / kY};
  constexpr Triple kRowZ{1425312.0f / kZ, 8788810.0f / kZ, 70074185.0f / kZ};
  return {(kRowX.x * rgb.x + kRowX.y * rgb.y + kRowX.z * rgb.z) * kInverseWhite.x,
          (kRowY.x * rgb.x + kRowY.y * rgb.y + kRowY.z * rgb.z) * kInverseWhite.y,
          (kRowZ.x * rgb.x + kRowZ.y * rgb.y + kRowZ.z * rgb.z) * kInverseWhite.z};
}

Triple rgb_from_relative_xyz(Triple xyz) {
  const float x = xyz.x * kWhite.x, y = xyz.y * kWhite.y, z = xyz.z * kWhite.z;
  return {3.241003275f * x + -1.537398934f * y + -0.498615861f * z,
          -0.969224334f * x + 1.875930071f * y + 0.041554224f * z,
          0.055639423f * x + -0.204011202f * y + 1.057148933f * z};
}

/// Lab in which chroma is seen less in the dark (the Hunt effect).
Triple hunt_lab(Triple rgb) {
  const auto f = [](float t) {
    constexpr float kDelta = 6.0f / 29.0f;
    return t > kDelta * (kDelta * kDelta) ? std::pow(t, 1.0f / 3.0f)
                                          : 1.0f / (3.0f * (kDelta * kDelta)) * t + 4.0f / 29.0f;
  };
  const Triple xyz = relative_xyz_from_rgb(rgb);
  const float fx = f(xyz.x), fy = f(xyz.y), fz = f(xyz.z);
  const float l = 116.0f * fy - 16.0f;
  return {l, 0.01f * l * (500.0f * (fx - fy)), 0.01f * l * (200.0f * (fy - fz))};
}

Triple shown_rgb(FlipColour colour) {
  const float y = (colour.y + 16.0f) / 116.0f;
  const Triple rgb = rgb_from_relative_xyz({y + colour.cx / 500.0f, y, y - colour.cz / 200.0f});
  return {std::clamp(rgb.x, 0.0f, 1.0f), std::clamp(rgb.y, 0.0f, 1.0f),
          std::clamp(rgb.z, 0.0f, 1.0f)};
}

float hyab(Triple a, Triple b) {
  const float da = a.y - b.y, db = a.z - b.z;
  return std::pow(std::abs(a.x - b.x) + std::sqrt(da * da + db * db), kColourExponent);
}

}  // namespace

FlipColour flip_colour(Rgb shown) {
  const Triple xyz = relative_xyz_from_rgb({float(shown.r), float(shown.g), float(shown.b)});
  return {116.0f * xyz.y - 16.0f, 500.0f * (xyz.x - xyz.y), 200.0f * (xyz.y - xyz.z)};
}

float flip_distance(FlipColour a, FlipColour b) {
  if (a.y == b.y && a.cx == b.cx && a.cz == b.cz) return 0;
  return hyab(hunt_lab(shown_rgb(a)), hunt_lab(shown_rgb(b)));
}

float flip_largest_distance() { return hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})); }

}  // namespace lobelia

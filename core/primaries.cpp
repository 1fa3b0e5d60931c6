#include "core/primaries.hpp"

#include <algorithm>
#include <cmath>

namespace lobelia {
namespace {

using Column = std::array<double, 3>;

constexpr double kFarthest = 10;        // a damaged header rather than a colour
constexpr double kLargestFactor = 1e3;  // nearly on a line: rounding would be all that is left

// Bradford's cone responses of XYZ: ICC.1:2022, annex E.3.
constexpr RgbMatrix kBradford = {
    {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

RgbMatrix product(const RgbMatrix& a, const RgbMatrix& b) {
  RgbMatrix result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) result[i][j] += a[i][k] * b[k][j];
  return result;
}

Column product(const RgbMatrix& a, const Column& b) {
  Column result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) result[i] += a[i][k] * b[k];
  return result;
}

/// By cofactors; infinite or NaN where there is none.
RgbMatrix inverse(const RgbMatrix& m) {
  RgbMatrix result;
  const auto cofactor = [&](std::size_t i, std::size_t j) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  double determinant = 0;
  for (std::size_t j = 0; j < 3; ++j) determinant += m[0][j] * cofactor(0, j);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[j][i] = cofactor(i, j) / determinant;
  return result;
}

/// XYZ of the colour at x, y with Y = 1.
Column white_xyz(const Chromaticities& of) {
  return {of[6] / of[7], 1, (1 - of[6] - of[7]) / of[7]};
}

/// Columns are the XYZ of red, green and blue, which add up to white. Nothing if one of them had to be negative.
std::optional<RgbMatrix> to_xyz(const Chromaticities& of) {
  RgbMatrix primaries;
  for (std::size_t c = 0; c < 3; ++c) {
    const double x = of[2 * c], y = of[2 * c + 1];
    primaries[0][c] = x;
    primaries[1][c] = y;
    primaries[2][c] = 1 - x - y;
  }
  const Column amounts = product(inverse(primaries), white_xyz(of));
  for (std::size_t c = 0; c < 3; ++c) {
    if (!(amounts[c] > 0)) return std::nullopt;
    for (auto& row : primaries) row[c] *= amounts[c];
  }
  return primaries;
}

}  // namespace

bool are_rec709(const Chromaticities& chromaticities) {
  for (std::size_t i = 0; i < chromaticities.size(); ++i)
    if (!(std::abs(chromaticities[i] - kRec709Chromaticities[i]) <= 1e-4)) return false;
  return true;
}

std::optional<Chromaticities> chromaticities_of_code_point(int primaries) {
  switch (primaries) {
    case 1:
    case 2:  // unspecified
      return kRec709Chromaticities;
    case 5:
      return Chromaticities{0.64, 0.33, 0.29, 0.60, 0.15, 0.06, 0.3127, 0.3290};
    case 6:
    case 7:
      return Chromaticities{0.630, 0.340, 0.310, 0.595, 0.155, 0.070, 0.3127, 0.3290};
    case 9:
      return Chromaticities{0.708, 0.292, 0.170, 0.797, 0.131, 0.046, 0.3127, 0.3290};
    case 11:
      return Chromaticities{0.680, 0.320, 0.265, 0.690, 0.150, 0.060, 0.314, 0.351};
    case 12:
      return Chromaticities{0.680, 0.320, 0.265, 0.690, 0.150, 0.060, 0.3127, 0.3290};
    default:
      return std::nullopt;
  }
}

std::optional<RgbMatrix> to_rec709(const Chromaticities& from) {
  for (const double value : from)
    if (!(std::abs(value) <= kFarthest)) return std::nullopt;
  if (!(from[7] > 0)) return std::nullopt;
  const auto xyz = to_xyz(from);
  if (!xyz) return std::nullopt;
  const Column seen = product(kBradford, white_xyz(from)),
               ours = product(kBradford, white_xyz(kRec709Chromaticities));
  RgbMatrix adapt{};
  for (std::size_t i = 0; i < 3; ++i) adapt[i][i] = ours[i] / seen[i];
  const RgbMatrix to_d65 = product(inverse(kBradford), product(adapt, kBradford));
  const RgbMatrix result = product(inverse(*to_xyz(kRec709Chromaticities)), product(to_d65, *xyz));
  for (const auto& row : result)
    for (const double value : row)
      if (!(std::abs(value) <= kLargestFactor)) return std::nullopt;
  return result;
}

void apply(const RgbMatrix& matrix, Image& image) {
  const std::span<float> values = image.values();
  for (std::size_t i = 0; i < values.size(); i += 3) {
    const Column rgb = product(matrix, Column{values[i], values[i + 1], values[i + 2]});
    for (std::size_t c = 0; c < 3; ++c) values[i + c] = float(rgb[c]);
  }
}

}  // namespace lobelia

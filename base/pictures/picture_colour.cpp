#include "base/pictures/picture_colour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <vector>

#include "base/pictures/colour.hpp"
#include "base/system/error.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace {

/// Outside of these a header is damaged.
constexpr double kLeastGamma = 0.1, kMostGamma = 10;

using Kind = TransferCurve::Kind;

const TransferCurve kLinear{Kind::kLinear, 1, "linear"}, kSrgb{Kind::kSrgb, 1, "sRGB"},
    kRec709{Kind::kRec709, 1, "Rec709"}, kPq{Kind::kPq, 1, "PQ"}, kHlg{Kind::kHlg, 1, "HLG"};

[[noreturn]] void unknown_curve(const std::string& where, const std::string& what) {
  throw Error(ExitCode::kInput,
              "{}: not a readable picture: {}; sRGB, linear, Rec709, PQ, HLG and a gamma from "
              "{} to {} are read",
              where, what, kLeastGamma, kMostGamma);
}

TransferCurve gamma_curve(const std::string& where, double gamma) {
  if (!(gamma >= kLeastGamma && gamma <= kMostGamma))
    unknown_curve(where, fmt::format("its colour space has the gamma {:g}", gamma));
  if (gamma == 1) return kLinear;
  return {Kind::kPower, gamma, fmt::format("gamma {:g}", gamma)};
}

/// ITU-T H.273, table 3.
TransferCurve curve_of_code_point(const std::string& where, int transfer) {
  switch (transfer) {
    case 1:
    case 6:
    case 14:
    case 15:
      return kRec709;
    case 4:
      return gamma_curve(where, 2.2);
    case 5:
      return gamma_curve(where, 2.8);
    case 8:
      return kLinear;
    case 2:  // unspecified
    case 13:
      return kSrgb;
    case 16:
      return kPq;
    case 18:
      return kHlg;
    default:
      unknown_curve(where,
                    fmt::format("its cICP chunk says transfer characteristics {}", transfer));
  }
}

using Column = std::array<double, 3>;

/// A larger chromaticity comes from a damaged header. Primaries with a larger factor are nearly on a line, so that only
/// rounding is left.
constexpr double kFarthest = 10, kLargestFactor = 1e3;

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

/// XYZ of the colour at x, y with Y = 1.
Column white_xyz(const Chromaticities& of) {
  return {of[6] / of[7], 1, (1 - of[6] - of[7]) / of[7]};
}

// ITU-R BT.2100-2, tables 4 and 5; ITU-R BT.2408-7, 2.1 for the white.
constexpr double kHdrWhite = 203, kPqPeak = 10000, kHlgPeak = 1000;  // cd/m^2

float pq_decoded(float code) {
  constexpr double m1 = 2610.0 / 16384, m2 = 2523.0 / 4096 * 128, c1 = 3424.0 / 4096,
                   c2 = 2413.0 / 4096 * 32, c3 = 2392.0 / 4096 * 32;
  const double power = std::pow(std::clamp(double(code), 0.0, 1.0), 1 / m2);
  return float(kPqPeak / kHdrWhite *
               std::pow(std::max(power - c1, 0.0) / (c2 - c3 * power), 1 / m1));
}

/// The light of the scene, from 0 to 1.
double hlg_scene_light(double code) {
  constexpr double a = 0.17883277, b = 1 - 4 * a, c = 0.55991073;
  return code <= 0.5 ? code * std::max(code, 0.0) / 3 : (std::exp((code - c) / a) + b) / 12;
}

/// By the OOTF of a display of 1000 cd/m^2.
void decode_hlg(std::span<float> values, const std::array<double, 3>& luminance) {
  constexpr double kSystemGamma = 1.2;
  for (std::size_t i = 0; i < values.size(); i += 3) {
    double light[3], y = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      light[c] = hlg_scene_light(double(values[i + c]));
      y += luminance[c] * light[c];
    }
    const double gain = y > 0 ? kHlgPeak / kHdrWhite * std::pow(y, kSystemGamma - 1) : 0;
    for (std::size_t c = 0; c < 3; ++c) values[i + c] = float(gain * light[c]);
  }
}

/// Puts each value through the curve. A picture of 8 or 16 bits has few values, and a power takes longer than a look at
/// what the same bits gave before.
template <class Curve>
void decode_each(Image& image, const Curve& curve) {
  struct Known {
    std::uint32_t bits;
    float light;
  };
  constexpr int kIndexBits = 13;
  std::vector<Known> known(std::size_t{1} << kIndexBits, Known{0, curve(0)});
  for (float& value : image.values()) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    Known& one = known[bits * 2654435761u >> (32 - kIndexBits)];
    if (one.bits != bits) one = {bits, curve(value)};
    value = one.light;
  }
}

}  // namespace

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

std::array<double, 3> luminance_weights(const Chromaticities& of) {
  const auto xyz = to_xyz(of);
  return xyz ? (*xyz)[1] : luminance_weights(kRec709Chromaticities);
}

TransferCurve transfer_curve(const std::string& where, const StatedEncoding& stated) {
  constexpr std::string_view kFormatsWithField[] = {"dpx", "cineon", "targa", "hdr", "rla"};
  const std::string_view space = stated.space;
  if (std::ranges::count(kFormatsWithField, stated.format) == 0 || space.empty() ||
      space == "Unknown")
    return stated.is_float || stated.format == "openexr" ? kLinear : kSrgb;
  if (space == "Linear" || space == "linear") return kLinear;
  if (space == "sRGB") return kSrgb;
  if (space == "Rec709") return kRec709;
  if (space.starts_with("Gamma")) return gamma_curve(where, stated.gamma);
  unknown_curve(where, fmt::format("its colour space is '{}'", printable(space)));
}

TransferCurve transfer_curve(const std::string& where, const PngColour& colour) {
  if (colour.cicp) return curve_of_code_point(where, colour.cicp->transfer);
  if (colour.has_icc_profile || colour.is_srgb || !colour.gamma) return kSrgb;
  // ImageMagick and POV-Ray write this for sRGB: the chunk sRGB is younger than gAMA.
  if (std::abs(*colour.gamma - 2.2) < 0.05) return {Kind::kSrgb, 1, "sRGB (gAMA 1/2.2)"};
  return gamma_curve(where, *colour.gamma);
}

std::optional<TransferCurve> named_curve(std::string_view name) {
  for (const TransferCurve& curve : {kLinear, kSrgb, kRec709, kPq, kHlg})
    if (name == curve.name) return curve;
  double gamma = 0;
  constexpr std::string_view kGamma = "gamma ";
  if (name.starts_with(kGamma) && parse_number(name.substr(kGamma.size()), gamma))
    return TransferCurve{Kind::kPower, gamma, std::string(name)};
  return std::nullopt;
}

void decode(const TransferCurve& curve, Image& image, const std::array<double, 3>& luminance) {
  switch (curve.kind) {
    case Kind::kLinear:
      return;
    case Kind::kSrgb:
      decode_each(image, srgb_decoded);
      return;
    case Kind::kRec709:
      // ITU-R BT.709-6, item 1.2, inverted.
      decode_each(image, [](float value) {
        return value < 0.081f ? value / 4.5f : std::pow((value + 0.099f) / 1.099f, 1 / 0.45f);
      });
      return;
    case Kind::kPower:
      decode_each(image, [gamma = float(curve.gamma)](float value) {
        return value <= 0 ? value : std::pow(value, gamma);
      });
      return;
    case Kind::kPq:
      decode_each(image, pq_decoded);
      return;
    case Kind::kHlg:
      decode_hlg(image.values(), luminance);
  }
}

bool are_equal(const Chromaticities& some, const Chromaticities& others) {
  for (std::size_t i = 0; i < some.size(); ++i)
    if (!(std::abs(some[i] - others[i]) <= 1e-4)) return false;
  return true;
}

std::optional<Chromaticities> chromaticities_of_code_point(int primaries) {
  static const std::map<int, Chromaticities> known{
      {1, kRec709Chromaticities},
      {2, kRec709Chromaticities},  // unspecified
      {5, {0.64, 0.33, 0.29, 0.60, 0.15, 0.06, 0.3127, 0.3290}},
      {6, {0.630, 0.340, 0.310, 0.595, 0.155, 0.070, 0.3127, 0.3290}},
      {7, {0.630, 0.340, 0.310, 0.595, 0.155, 0.070, 0.3127, 0.3290}},
      {9, {0.708, 0.292, 0.170, 0.797, 0.131, 0.046, 0.3127, 0.3290}},
      {11, {0.680, 0.320, 0.265, 0.690, 0.150, 0.060, 0.314, 0.351}},
      {12, {0.680, 0.320, 0.265, 0.690, 0.150, 0.060, 0.3127, 0.3290}}};
  const auto found = known.find(primaries);
  return found == known.end() ? std::nullopt : std::optional(found->second);
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
  const bool is_xyz = are_equal(from, kXyzChromaticities);
  for (std::size_t i = 0; i < 3; ++i) adapt[i][i] = is_xyz ? 1 : ours[i] / seen[i];
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

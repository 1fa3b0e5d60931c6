#include "core/picture_colour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/colour.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace lobelia {
namespace {

/// Outside of these a header is damaged.
constexpr double kLeastGamma = 0.1, kMostGamma = 10;

using Kind = TransferCurve::Kind;

const TransferCurve kLinear{Kind::kLinear, 1, "linear"}, kSrgb{Kind::kSrgb, 1, "sRGB"},
    kRec709{Kind::kRec709, 1, "Rec709"};

[[noreturn]] void unknown_curve(const std::string& where, const std::string& what) {
  throw Error(
      ExitCode::kInput,
      fmt::format("{}: not a readable picture: {}; sRGB, linear, Rec709 and a gamma from {} "
                  "to {} are read",
                  where, what, kLeastGamma, kMostGamma));
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
    default:
      unknown_curve(where,
                    fmt::format("its cICP chunk says transfer characteristics {}", transfer));
  }
}

// ICC.1:2022: header 7.2, tags 7.3, XYZ 10.31, curves 10.6 and 10.18.

std::uint64_t icc_number(std::string_view bytes, std::size_t at, std::size_t size = 4) {
  return number_at(bytes, at, false, size);
}

double fixed(std::string_view bytes, std::size_t at) {
  return double(std::int32_t(icc_number(bytes, at))) / 65536;
}

bool is_at(std::string_view bytes, std::size_t at, std::string_view name) {
  return at < bytes.size() && bytes.substr(at).starts_with(name);
}

std::optional<std::string_view> find_tag(std::string_view profile, std::string_view name) {
  constexpr std::size_t kTags = 128, kMostTags = 1000;
  const std::size_t count = icc_number(profile, kTags);
  for (std::size_t i = 0; i < count && i < kMostTags; ++i) {
    const std::size_t entry = kTags + 4 + 12 * i;
    if (!is_at(profile, entry, name)) continue;
    const std::size_t at = icc_number(profile, entry + 4), size = icc_number(profile, entry + 8);
    if (at > profile.size() || size > profile.size() - at || size < 12) return std::nullopt;
    return profile.substr(at, size);
  }
  return std::nullopt;
}

bool is_near_primary(std::string_view profile, std::string_view name, double x, double y,
                     double z) {
  const auto tag = find_tag(profile, name);
  if (!tag || !is_at(*tag, 0, "XYZ ") || tag->size() < 20) return false;
  constexpr double kNear = 0.003;
  return std::abs(fixed(*tag, 8) - x) < kNear && std::abs(fixed(*tag, 12) - y) < kNear &&
         std::abs(fixed(*tag, 16) - z) < kNear;
}

/// NaN for an unknown type of curve.
double parametric(std::string_view tag, double value) {
  const std::size_t type = icc_number(tag, 8, 2);
  constexpr std::size_t kParameters[] = {1, 3, 4, 5, 7};
  if (type >= std::size(kParameters) || tag.size() < 12 + 4 * kParameters[type]) return NAN;
  double p[7] = {1, 1, 0, 0, 0, 0, 0};  // g, a, b, c, d, e, f
  for (std::size_t i = 0; i < kParameters[type]; ++i) p[i] = fixed(tag, 12 + 4 * i);
  const auto [g, a, b, c, d, e, f] = p;
  if (type == 0) return std::pow(value, g);
  if (type <= 2)
    return value >= -b / a ? std::pow(a * value + b, g) + (type == 2 ? c : 0) : type == 2 ? c : 0;
  return value >= d ? std::pow(a * value + b, g) + (type == 4 ? e : 0)
                    : c * value + (type == 4 ? f : 0);
}

double curve(std::string_view tag, double value) {
  if (is_at(tag, 0, "para")) return parametric(tag, value);
  if (!is_at(tag, 0, "curv")) return NAN;
  const std::size_t count = icc_number(tag, 8);
  if (count == 0) return value;
  if (count == 1) return std::pow(value, double(icc_number(tag, 12, 2)) / 256);
  if ((tag.size() - 12) / 2 < count) return NAN;
  const double place = value * double(count - 1);
  const auto below = std::size_t(place);
  const auto low = double(icc_number(tag, 12 + 2 * below, 2)),
             high = double(icc_number(tag, 14 + 2 * below, 2));
  return (low + (high - low) * (place - double(below))) / 65535;
}

bool is_srgb_curve(std::string_view profile, std::string_view name) {
  const auto tag = find_tag(profile, name);
  if (!tag) return false;
  constexpr double kNear = 0.002;
  for (const float value : {0.1f, 0.5f, 0.9f})
    if (!(std::abs(curve(*tag, value) - srgb_decoded(value)) < kNear)) return false;
  return true;
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

/// By cofactors; infinite or NaN if there is no inverse.
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

/// Columns are the XYZ of red, green and blue, which add up to white. Nothing if one would be negative.
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
  if (colour.is_srgb || !colour.gamma) return kSrgb;
  // ImageMagick and POV-Ray write this for sRGB: the chunk sRGB is younger than gAMA.
  if (std::abs(*colour.gamma - 2.2) < 0.05) return {Kind::kSrgb, 1, "sRGB (gAMA 1/2.2)"};
  return gamma_curve(where, *colour.gamma);
}

void decode(const TransferCurve& curve, Image& image) {
  switch (curve.kind) {
    case Kind::kLinear:
      return;
    case Kind::kSrgb:
      decode_srgb(image);
      return;
    case Kind::kRec709:
      // ITU-R BT.709-6, item 1.2, inverted.
      for (float& value : image.values())
        value = value < 0.081f ? value / 4.5f : std::pow((value + 0.099f) / 1.099f, 1 / 0.45f);
      return;
    case Kind::kPower:
      for (float& value : image.values())
        if (!(value <= 0)) value = std::pow(value, float(curve.gamma));
  }
}

bool is_srgb_profile(std::string_view profile) {
  if (is_at(profile, 16, "GRAY")) return is_srgb_curve(profile, "kTRC");
  return is_at(profile, 16, "RGB ") && is_near_primary(profile, "rXYZ", 0.4360, 0.2225, 0.0139) &&
         is_near_primary(profile, "gXYZ", 0.3851, 0.7169, 0.0971) &&
         is_near_primary(profile, "bXYZ", 0.1431, 0.0606, 0.7141) &&
         is_srgb_curve(profile, "rTRC") && is_srgb_curve(profile, "gTRC") &&
         is_srgb_curve(profile, "bTRC");
}

bool are_rec709(const Chromaticities& chromaticities) {
  for (std::size_t i = 0; i < chromaticities.size(); ++i)
    if (!(std::abs(chromaticities[i] - kRec709Chromaticities[i]) <= 1e-4)) return false;
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

#include "core/transfer_curve.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/colour.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace lobelia {
namespace {

using Kind = TransferCurve::Kind;

/// Beyond, it is a damaged header rather than an encoding.
constexpr double kLeastGamma = 0.1, kMostGamma = 10;

bool says_gamma(std::string_view space) { return space.starts_with("Gamma"); }

[[noreturn]] void unknown(const std::string& where, const std::string& what) {
  throw Error(
      ExitCode::kInput,
      fmt::format("{}: not a readable picture: {}; sRGB, linear, Rec709 and a gamma from {} "
                  "to {} are read",
                  where, what, kLeastGamma, kMostGamma));
}

TransferCurve linear() { return {Kind::kLinear, 1, "linear"}; }

TransferCurve power(const std::string& where, double gamma) {
  if (!(gamma >= kLeastGamma && gamma <= kMostGamma))
    unknown(where, fmt::format("its colour space has the gamma {:g}", gamma));
  if (gamma == 1) return linear();
  return {Kind::kPower, gamma, fmt::format("gamma {:g}", gamma)};
}

bool has_field_for_curve(std::string_view format) {
  for (const std::string_view one : {"dpx", "cineon", "targa", "hdr", "rla"})
    if (format == one) return true;
  return false;
}

/// ITU-T H.273, table 3.
TransferCurve curve_of_code_point(const std::string& where, int transfer) {
  switch (transfer) {
    case 1:
    case 6:
    case 14:
    case 15:
      return {Kind::kRec709, 1, "Rec709"};
    case 4:
      return power(where, 2.2);
    case 5:
      return power(where, 2.8);
    case 8:
      return linear();
    case 2:  // unspecified
    case 13:
      return {Kind::kSrgb, 1, "sRGB"};
    default:
      unknown(where, fmt::format("its cICP chunk says transfer characteristics {}", transfer));
  }
}

}  // namespace

TransferCurve transfer_curve(const std::string& where, const EncodingStatement& statement) {
  const std::string space(statement.space);
  if (!has_field_for_curve(statement.format) || space.empty() || space == "Unknown")
    return statement.is_float || statement.format == "openexr"
               ? linear()
               : TransferCurve{Kind::kSrgb, 1, "sRGB"};
  if (space == "Linear" || space == "linear") return linear();
  if (space == "sRGB") return {Kind::kSrgb, 1, "sRGB"};
  if (space == "Rec709") return {Kind::kRec709, 1, "Rec709"};
  if (says_gamma(space)) return power(where, statement.gamma);
  unknown(where, fmt::format("its colour space is '{}'", printable(space)));
}

TransferCurve transfer_curve(const std::string& where, const PngColour& colour) {
  if (colour.cicp) return curve_of_code_point(where, colour.cicp->transfer);
  if (colour.is_srgb || !colour.gamma) return {Kind::kSrgb, 1, "sRGB"};
  // ImageMagick and POV-Ray say so of sRGB: the chunk of that name is younger than this one.
  if (std::abs(*colour.gamma - 2.2) < 0.05) return {Kind::kSrgb, 1, "sRGB (gAMA 1/2.2)"};
  return power(where, *colour.gamma);
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

}  // namespace lobelia

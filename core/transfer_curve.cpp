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

}  // namespace

TransferCurve transfer_curve(const std::string& where, const EncodingStatement& statement) {
  const std::string space(statement.space);
  if (space == "Linear" || space == "linear" || space == "scene_linear" || space == "lin_srgb")
    return {Kind::kLinear, 1, "linear"};
  if (space == "sRGB") return {Kind::kSrgb, 1, "sRGB"};
  // The library says Rec709 of every Netpbm file, as the page of the format does; what writes PPM writes
  // sRGB, and PFM light.
  if (space.empty() || space == "Unknown" || (space == "Rec709" && statement.format == "pnm"))
    return statement.is_float ? TransferCurve{Kind::kLinear, 1, "linear"}
                              : TransferCurve{Kind::kSrgb, 1, "sRGB"};
  if (space == "Rec709") return {Kind::kRec709, 1, "Rec709"};
  if (says_gamma(space) && statement.gamma >= kLeastGamma && statement.gamma <= kMostGamma) {
    // ImageMagick and POV-Ray say so of sRGB: the chunk of that name is younger than this one.
    if (statement.format == "png" && std::abs(statement.gamma - 2.2) < 0.05)
      return {Kind::kSrgb, 1, "sRGB (gAMA 1/2.2)"};
    if (statement.gamma == 1) return {Kind::kLinear, 1, "linear"};
    return {Kind::kPower, statement.gamma, fmt::format("gamma {:g}", statement.gamma)};
  }
  throw Error(ExitCode::kInput,
              fmt::format("{}: not a readable picture: its colour space is '{}'{}; sRGB, linear, "
                          "Rec709 and a gamma from {} to {} are read",
                          where, printable(space),
                          says_gamma(space) ? fmt::format(", gamma {:g}", statement.gamma) : "",
                          kLeastGamma, kMostGamma));
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

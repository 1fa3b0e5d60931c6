// From the values of a file to linear light with Rec. 709 primaries.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "core/image.hpp"
#include "core/picture_file.hpp"

namespace lobelia {

/// The curve that a file's values were encoded with.
struct TransferCurve {
  enum class Kind { kLinear, kSrgb, kRec709, kPower };
  Kind kind = Kind::kLinear;
  double gamma = 1;  ///< for kPower: light = value^gamma
  std::string name;  ///< for the record: "linear", "sRGB", "Rec709", "gamma 1.8", ...
};

/// The encoding that a file states, as OpenImageIO reports it.
struct StatedEncoding {
  std::string_view format;  ///< "dpx"
  std::string_view space;   ///< "oiio:ColorSpace"; empty if there is none
  double gamma = 1;         ///< "oiio:Gamma"
  bool is_float = false;    ///< half, float or double values
};

/// The curve of any format but PNG. Formats with a field for it (DPX, Cineon, TGA, Radiance, RLA) state it. In others
/// `space` is any text or OpenImageIO's assumption and does not count: floats and EXRs are linear, integers sRGB.
/// Throws Error(kInput) with the file's name `where` for a curve that is not read.
TransferCurve transfer_curve(const std::string& where, const StatedEncoding& stated);

/// The curve of a PNG, by its chunks: cICP, else sRGB, else gAMA, else sRGB.
TransferCurve transfer_curve(const std::string& where, const PngColour& colour);

/// In place. Negative values stay as they are, except on the straight pieces of sRGB and Rec. 709.
void decode(const TransferCurve& curve, Image& image);

/// Whether an ICC profile is that of sRGB, by its colours and curves, not by its name: primaries within 0.003 of sRGB's
/// in ICC profiles (D50), curves within 0.002 of sRGB's at three places. A grey profile has a curve only. False for a
/// damaged profile and for one with tables of colours.
bool is_srgb_profile(std::string_view profile);

/// CIE 1931 x, y of red, green, blue and white.
using Chromaticities = std::array<double, 8>;

/// ITU-R BT.709-6, item 1.3 and 1.4.
inline constexpr Chromaticities kRec709Chromaticities = {0.64, 0.33, 0.30,   0.60,
                                                         0.15, 0.06, 0.3127, 0.3290};

/// Within 1e-4 each, because published chromaticities are rounded.
bool are_rec709(const Chromaticities& chromaticities);

/// ITU-T H.273, table 2; Rec. 709 for "unspecified", nothing for unknown code points.
std::optional<Chromaticities> chromaticities_of_code_point(int primaries);

/// By rows: linear RGB of `from` to linear Rec. 709. As OpenEXR's AcesInputFile converts (ImfAcesFile.cpp): to XYZ by
/// RGBtoXYZ (ImfChromaticities.cpp), from the file's white to D65 by Bradford's cone responses, to RGB. Grey stays as
/// it is. Nothing for impossible primaries: not finite, far away, on a line, or with the white outside. Imaginary
/// primaries such as those of ACES are allowed.
using RgbMatrix = std::array<std::array<double, 3>, 3>;
std::optional<RgbMatrix> to_rec709(const Chromaticities& from);

/// In place.
void apply(const RgbMatrix& matrix, Image& image);

}  // namespace lobelia

// From the values of a file to linear light with Rec. 709 primaries.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "base/pictures/image.hpp"
#include "base/pictures/picture_file.hpp"

namespace lobelia {

/// CIE 1931 x, y of red, green, blue and white.
using Chromaticities = std::array<double, 8>;

/// The primaries of files that hold CIE XYZ.
inline constexpr Chromaticities kXyzChromaticities = {1, 0, 0, 1, 0, 0, 1.0 / 3, 1.0 / 3};

/// ITU-R BT.709-6, item 1.3 and 1.4.
inline constexpr Chromaticities kRec709Chromaticities = {0.64, 0.33, 0.30,   0.60,
                                                         0.15, 0.06, 0.3127, 0.3290};

/// By rows.
using RgbMatrix = std::array<std::array<double, 3>, 3>;

/// The curve that a file's values were encoded with.
struct TransferCurve {
  enum class Kind { kLinear, kSrgb, kRec709, kPower, kPq, kHlg };
  Kind kind = Kind::kLinear;
  double gamma = 1;  ///< for kPower: light = value^gamma
  std::string name;  ///< for the record: "linear", "sRGB", "Rec709", "gamma 1.8", "PQ", "HLG"
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

/// The curve of a PNG, by its chunks: cICP, else sRGB for a profile or the chunk sRGB, else gAMA, else sRGB.
TransferCurve transfer_curve(const std::string& where, const PngColour& colour);

/// The curve of that TransferCurve::name, if its name alone tells it.
std::optional<TransferCurve> named_curve(std::string_view name);

/// Y of red, green and blue, which add up to 1; those of Rec. 709 for impossible primaries.
std::array<double, 3> luminance_weights(const Chromaticities& of);

/// In place. Negative values stay as they are, except on the straight pieces of sRGB and Rec. 709, and with PQ and HLG,
/// where they become 0. PQ and HLG become the light of the display, 1 for 203 cd/m^2: the white of ITU-R BT.2408. An HLG
/// display has 1000 cd/m^2 and the system gamma 1.2 (ITU-R BT.2100), by the `luminance` of the picture's primaries.
void decode(const TransferCurve& curve, Image& image,
            const std::array<double, 3>& luminance = luminance_weights(kRec709Chromaticities));

/// Within 1e-4 each, because published chromaticities are rounded.
bool are_equal(const Chromaticities& some, const Chromaticities& others);

/// ITU-T H.273, table 2; Rec. 709 for "unspecified", nothing for unknown code points.
std::optional<Chromaticities> chromaticities_of_code_point(int primaries);

/// By rows: linear RGB of `from` to linear Rec. 709. As OpenEXR's AcesInputFile converts (ImfAcesFile.cpp): to XYZ by
/// RGBtoXYZ (ImfChromaticities.cpp), from the file's white to D65 by Bradford's cone responses, to RGB. Grey stays as it
/// is. CIE XYZ is not adapted: its white is that of the numbers, not of the picture, as in OpenEXR's pair XYZ.exr and
/// Rec709.exr (openexr-images, Chromaticities). Nothing for impossible primaries: not finite, far away, on a line, or
/// with the white outside. Imaginary primaries such as those of ACES are allowed.
std::optional<RgbMatrix> to_rec709(const Chromaticities& from);

/// Linear RGB to XYZ, without adaptation: columns are the XYZ of red, green and blue, which add up to white with Y = 1.
/// Nothing if one would be negative.
std::optional<RgbMatrix> to_xyz(const Chromaticities& from);

/// Infinite or NaN if there is none.
RgbMatrix inverse(const RgbMatrix& matrix);

/// In place.
void apply(const RgbMatrix& matrix, Image& image);

}  // namespace lobelia

// From the primaries of a file to ours.
#pragma once

#include <array>
#include <optional>

#include "core/image.hpp"

namespace lobelia {

/// CIE 1931 x, y of red, green, blue and white.
using Chromaticities = std::array<double, 8>;

/// ITU-R BT.709-6, item 1.3 and 1.4: what an Image has.
inline constexpr Chromaticities kRec709Chromaticities = {0.64, 0.33, 0.30,   0.60,
                                                         0.15, 0.06, 0.3127, 0.3290};

/// Within 1e-4 each, as far as published ones are rounded.
bool are_rec709(const Chromaticities& chromaticities);

/// ITU-T H.273, table 2; those that are unspecified are Rec. 709's. Nothing for others.
std::optional<Chromaticities> chromaticities_of_code_point(int primaries);

/// By rows: linear RGB of `from` to linear Rec. 709. As OpenEXR's AcesInputFile converts (ImfAcesFile.cpp): to XYZ by
/// RGBtoXYZ (ImfChromaticities.cpp), from the file's white to D65 by Bradford's cone responses, to RGB. Grey stays as
/// it is. Nothing if they are no primaries: not finite, far away, on a line, or with the white outside.
/// Primaries that no light has, as those of ACES, are fine.
using RgbMatrix = std::array<std::array<double, 3>, 3>;
std::optional<RgbMatrix> to_rec709(const Chromaticities& from);

/// In place.
void apply(const RgbMatrix& matrix, Image& image);

}  // namespace lobelia

// How the stored rows and columns of a picture lie in what it shows.
#pragma once

#include <string>
#include <string_view>

#include "base/pictures/picture.hpp"

namespace lobelia {

/// As TIFF 6.0 (page 36) and Exif number it: 1 for a picture that is stored as it is shown, up to 8. It is stored
/// mirrored for 2, 4, 5 and 7, and with rows and columns exchanged from 5 on.
inline constexpr int kUpright = 1, kMostOrientation = 8;

/// The orientation that the file states for page `page` (0 but in a TIFF): by the Exif of a JPEG, a PNG (chunk eXIf) or a
/// WebP, the tag of a TIFF, the line of a Radiance file that names its axes, and the header of a DPX. kUpright for other
/// formats, if nothing is stated, and for numbers without a meaning. `format` is OpenImageIO's name. XMP and texts do not
/// count. OpenImageIO itself undoes the orientation of a TGA.
int stated_orientation(std::string_view file, std::string_view format, std::size_t page = 0);

/// Whether the lines of a DPX are columns of what it shows. OpenImageIO 2.4 exchanges width and height of such a file.
bool is_dpx_in_columns(std::string_view file);

/// The orientation of a TIFF's page that remains after OpenImageIO has read it. It reads YCbCr and some JPEGs by
/// libtiff's RGBA interface, which mirrors rows and columns, but does not exchange them.
int orientation_left_by_libtiff(std::string_view file, int orientation, std::size_t page);

/// Makes a picture without overscan, which is stored in that orientation, what is shown. States its windows and the
/// orientation in its source.
void turn_upright(Picture& picture, int orientation);

/// The change that was made to the stored picture: "turned by 180 degrees". Empty for kUpright.
std::string_view orientation_text(int orientation);

}  // namespace lobelia

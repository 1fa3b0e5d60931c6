// The same highlight by the textbook's float32 and by us, as pictures.
#pragma once

#include <filesystem>
#include <vector>

#include "records/stability.hpp"

namespace lobelia::stability {

/// Writes a modified Phong highlight cos^n, so close that it fills the picture, for n = 1e3, 1e5, 1e6:
/// stability-nN-naive.exr, .png, -error.png and the same of ours, and stability.png: all in one, a row for each
/// exponent. Error pictures show log10 of the error over the peak as a colour: black at 1e-8 and below, then blue, red,
/// yellow, white at 1 and above; magenta is no number. The files' names begin with `from_record`, the path from the
/// record to the directory.
std::vector<records::StabilityPictures> write_pictures(const std::filesystem::path& directory,
                                                       const std::filesystem::path& from_record);

}  // namespace lobelia::stability

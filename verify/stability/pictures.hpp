// The same highlight by the textbook's float32 and by us, as pictures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/image.hpp"

namespace lobelia::stability {

struct PicturePair {
  double exponent = 0;
  double peak = 0;
  Image truth, naive, ours;
  double naive_error = 0, ours_error = 0;  ///< largest, of the peak
};

/// A modified Phong highlight cos^n, so close that it fills the picture, for n = 1e3, 1e5, 1e6.
std::vector<PicturePair> make_pictures();

/// log10 of |picture - truth| / peak as a colour: black at 1e-8 and below, then blue, red, yellow, white
/// at 1 and above. What is no number is magenta.
DisplayImage error_picture(const Image& picture, const Image& truth, double peak);

/// "stability-n1000-naive": what the files of a picture begin with.
std::string picture_stem(double exponent, const char* name);

/// stability-nN-naive.exr, .png, -error.png and the same of ours, and stability.png: all in one, a
/// row for each exponent.
void write_pictures(const std::filesystem::path& directory,
                    const std::vector<PicturePair>& pictures);

}  // namespace lobelia::stability

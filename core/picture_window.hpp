// The data window of a file and the display window, which is the picture.
#pragma once

#include <string>

#include "core/picture.hpp"

namespace lobelia {

/// Why a window cannot be read, in words; empty if it can: at least one pixel, at most kMaxImageSide a side,
/// kMaxImagePixels in all, corners no farther than 2^30 from 0. `what` begins the sentence.
std::string window_problem(const std::string& what, const PixelWindow& window);

/// Whether they have no pixel in common.
bool are_apart(const PixelWindow& a, const PixelWindow& b);

/// Whether all of `inner` is in `outer`.
bool is_inside(const PixelWindow& inner, const PixelWindow& outer);

/// `image` lies on `data`; the result on `display`: 0 where there are no data, without what lies outside.
Image place(Image image, const PixelWindow& data, const PixelWindow& display);

}  // namespace lobelia

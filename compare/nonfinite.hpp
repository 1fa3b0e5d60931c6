// NaN and infinity: the first place of one in a picture, and those that two pictures share.
#pragma once

#include "base/pictures/picture.hpp"
#include "base/records/comparison.hpp"

namespace lobelia {

/// The first value in reading order that is not finite; its channel is "R", "G" or "B".
std::optional<records::NonfinitePlace> first_nonfinite(const Image& image);

/// "nan in a.exr at x 3, y 4, channel R"
std::string place_text(const records::NonfinitePlace& place, std::string_view file);

/// Gives the channel its name in the file. A grey picture has only one.
void name_channel(records::NonfinitePlace& place, const PictureSource& source);

/// Sets values to 0 where both pictures have a NaN, or infinities of one sign, in the same channel. Returns the number
/// of pixels changed. Throws Error(kInput) if the sizes differ.
std::int64_t clear_equal_nonfinite(Image& a, Image& b);

/// Whether infinities may mean something in this layer: it, or a part of its name between dots, is "Z", "ZBack",
/// "depth", "distance" or "position", in any case.
bool is_depth_like(std::string_view layer);

}  // namespace lobelia

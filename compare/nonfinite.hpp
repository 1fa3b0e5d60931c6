// NaN and infinity: where the first one is, and which of them two pictures share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/image.hpp"
#include "core/picture.hpp"

namespace lobelia {

/// The first value in reading order that is not finite.
struct NonfinitePlace {
  int x = 0, y = 0;     ///< from the picture's left and top
  std::string channel;  ///< "R", "G", "B", or its name in the file
  float value = 0;
};
std::optional<NonfinitePlace> first_nonfinite(const Image& image);

/// "nan", "inf" or "-inf" of the file at a place, in words.
std::string place_text(const NonfinitePlace& place, std::string_view file);

/// Names the channel as the file does; of grey all three are the one that it has.
void name_channel(NonfinitePlace& place, const PictureSource& source);

/// Where both have the same in a channel, two NaN or two infinities of one sign, both become 0: no difference.
/// Returns how many pixels that happened in. Throws Error(kInput) if the sizes differ.
std::int64_t clear_equal_nonfinite(Image& a, Image& b);

/// Whether a layer of that name may hold infinities that mean something: it, or a part of its name between dots,
/// is "Z", "ZBack", "depth", "distance" or "position", in any case.
bool is_depth_like(std::string_view layer);

}  // namespace lobelia

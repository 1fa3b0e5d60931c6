// Whether an ICC profile is that of sRGB.
#pragma once

#include <cstdint>
#include <span>

namespace lobelia {

/// By its colours and curves, not by its name: primaries within 0.003 of sRGB's as ICC profiles have them (D50), and
/// curves within 0.002 of sRGB's at three places. Of a grey profile the curve alone. False of a damaged one, and of
/// one that works by tables of colours.
bool is_srgb_profile(std::span<const std::uint8_t> profile);

}  // namespace lobelia

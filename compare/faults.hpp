// Kinds of difference that the values themselves tell: "clipped at 1", "encoded as sRGB", "one bright pixel".
//
// A name has to explain the pictures, not only fit a figure, so that it is seldom wrong:
//   clipped           every value of one picture is the other's, cut off at a level: at least 5 values lie exactly at it where
//                     the other's go on and differ among themselves by 5 %; all below the level agree within
//                     1 % + 0.002, which includes the rounding of 8 bits, and at least 5 of them are 5 % darker and not 0;
//   encoded as sRGB   every value of one picture is the other's by sRGB's curve, within 0.003: at least 32 values, from
//                     0.02 to 0.9 and spread by a factor of 2;
//   one bright pixel  of one picture is 20 times as far from the other as every other pixel is, and 5 times as bright as its
//                     neighbours and as the other picture there.
// A few values may be off where a filter mixed neighbours: kMostOff of those that tell. Noise that the pictures do not share
// hides all but the bright pixel.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/pictures/image.hpp"
#include "base/records/comparison.hpp"

namespace lobelia {

/// The faults that tell two finite pictures of the same size apart, at most one of each kind.
std::vector<records::Fault> find_faults(const Image& a, const Image& b);

/// "a is clipped at 1 where b goes up to 12", with the names of the pictures.
std::string fault_text(const records::Fault& fault, std::string_view a, std::string_view b);

}  // namespace lobelia

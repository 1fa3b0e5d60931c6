// Channels of a highlight that end at the picture's largest value.
#pragma once

#include <array>
#include <span>
#include <string>

#include "profile/find_blobs.hpp"
#include "profile/stored_steps.hpp"

namespace lobelia {

/// The largest finite value of each channel, without the specks.
std::array<float, 3> largest_values(const Image& image, const std::vector<Speck>& specks);

struct ClippedChannels {
  std::array<float, 3> largest{};
  std::array<bool, 3> is_clipped{};

  std::string names() const;  ///< "R", "RGB"; empty for none
  bool holds(const Image& image, std::size_t pixel) const;
};
/// "R or G" of "RG".
std::string either_of(const std::string& channels);

/// A channel is clipped if so many of these pixels have the picture's largest value that it is no peak, whose rounding
/// leaves as many in each step.
ClippedChannels find_clipping(const Image& image, const std::array<float, 3>& largest,
                              const StoredSteps& steps, std::span<const std::size_t> pixels);

}  // namespace lobelia

#include "profile/clipping.hpp"

#include <algorithm>
#include <cmath>

namespace lobelia {

std::array<float, 3> largest_values(const Image& image, const std::vector<Speck>& specks) {
  std::vector<bool> is_speck(image.pixel_count(), false);
  for (const Speck& speck : specks)
    for (const std::size_t i : speck.pixels) is_speck[i] = true;
  std::array<float, 3> largest{};
  for (std::size_t i = 0; i < is_speck.size(); ++i)
    for (std::size_t c = 0; c < 3 && !is_speck[i]; ++c)
      if (const float value = image.values()[3 * i + c]; std::isfinite(value))
        largest[c] = std::max(largest[c], value);
  return largest;
}

std::string ClippedChannels::names() const {
  std::string names;
  for (std::size_t c = 0; c < 3; ++c)
    if (is_clipped[c]) names += "RGB"[c];
  return names;
}

bool ClippedChannels::holds(const Image& image, std::size_t pixel) const {
  for (std::size_t c = 0; c < 3; ++c)
    if (is_clipped[c] && image.values()[3 * pixel + c] == largest[c]) return true;
  return false;
}

std::string either_of(const std::string& channels) {
  std::string text;
  for (const char channel : channels)
    text += (text.empty() ? "" : " or ") + std::string(1, channel);
  return text;
}

ClippedChannels find_clipping(const Image& image, const std::array<float, 3>& largest,
                              const StoredSteps& steps, std::span<const std::size_t> pixels) {
  // As locate_peak() has it for a plateau.
  constexpr std::size_t kFewest = 5;
  constexpr double kOfCap = 0.1, kCap = 0.8;
  // The top of a smooth peak has an area in proportion to its height, so no step has twice the pixels of the next one.
  constexpr std::size_t kOfNext = 2;
  ClippedChannels clipping{largest, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    std::size_t equal = 0, cap = 0, next = 0;
    const double below = double(largest[c]) - 1.5 * steps.at(double(largest[c]));
    for (const std::size_t i : pixels) {
      const float value = image.values()[3 * i + c];
      equal += value == largest[c];
      next += value < largest[c] && double(value) > below;
      cap += double(value) >= kCap * double(largest[c]);
    }
    clipping.is_clipped[c] = largest[c] > 0 && equal >= kFewest && equal > kOfNext * next &&
                             double(equal) >= kOfCap * double(cap);
  }
  return clipping;
}

}  // namespace lobelia

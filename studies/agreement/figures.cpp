#include "studies/agreement/figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "studies/agreement/cases.hpp"

namespace lobelia::agreement {
namespace {

/// So that no comparison forgets a NaN.
double or_infinite(double value) {
  return std::isfinite(value) ? value : std::numeric_limits<double>::infinity();
}

}  // namespace

Picture picture_of(const Image& image) {
  Picture picture(image.pixel_count());
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const float* const rgb = image.values().data() + 3 * i;
    picture[i] = {rgb[0], rgb[1], rgb[2]};
  }
  return picture;
}

Figures difference_from(const Picture& reference, const Image& image,
                        std::span<const std::uint8_t> ring) {
  Figures f;
  double peak = 0, squares = 0;
  for (const Rgb& value : reference) peak = std::max(peak, max_component(value));
  std::size_t lit = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const float* const rgb = image.values().data() + 3 * i;
    const double values[] = {reference[i].r, reference[i].g, reference[i].b};
    double of_peak = 0, relative = 0;
    bool black = true;
    for (int c = 0; c < 3; ++c) {
      const double apart = std::abs(double(rgb[c]) - values[c]);
      black = black && values[c] == 0 && rgb[c] == 0;
      of_peak = std::max(of_peak, apart == 0 ? 0 : or_infinite(apart / peak));
      if (values[c] > kRelativeFrom * peak)
        relative = std::max(relative, or_infinite(apart / values[c]));
      if (ring[i] == 0) squares += apart * apart;
    }
    if (ring[i] != 0) {
      ++f.ring_pixels;
      f.ring_over += of_peak > kRingOfPeak;
      f.ring_max_of_peak = std::max(f.ring_max_of_peak, of_peak);
      continue;
    }
    lit += !black;
    f.max_of_peak = std::max(f.max_of_peak, of_peak);
    f.max_relative = std::max(f.max_relative, relative);
  }
  if (lit > 0) f.rms_of_peak = or_infinite(std::sqrt(squares / (3 * double(lit))) / peak);
  return f;
}

void widen(Figures& worst, const Figures& other) {
  worst.max_of_peak = std::max(worst.max_of_peak, other.max_of_peak);
  worst.rms_of_peak = std::max(worst.rms_of_peak, other.rms_of_peak);
  worst.max_relative = std::max(worst.max_relative, other.max_relative);
  worst.ring_max_of_peak = std::max(worst.ring_max_of_peak, other.ring_max_of_peak);
  worst.ring_pixels = std::max(worst.ring_pixels, other.ring_pixels);
  worst.ring_over = std::max(worst.ring_over, other.ring_over);
}

}  // namespace lobelia::agreement

#include <algorithm>
#include <cmath>

#include "base/system/scratch_memory.hpp"
#include "compare/compare.hpp"
#include "profile/require_same_size.hpp"

namespace lobelia {

DisplayImage difference_picture(const Image& a, const Image& b, double white_at) {
  require_same_size(a, b);
  DisplayImage picture{a.width(), a.height(), std::vector<std::uint8_t>(3 * a.pixel_count())};
  const std::span<const float> va = a.values(), vb = b.values();
  const auto show_pixel = [&](std::size_t i) {
    bool finite = true;
    for (std::size_t j = i; j < i + 3; ++j) {
      const double difference = std::abs(double(va[j]) - double(vb[j]));
      finite = finite && std::isfinite(difference);
      if (finite && difference > 0)
        picture.rgb[j] = difference < white_at
                             ? std::uint8_t(std::lround(255 * difference / white_at))
                             : std::uint8_t{255};
    }
    if (!finite) {
      picture.rgb[i] = picture.rgb[i + 2] = 255;
      picture.rgb[i + 1] = 0;
    }
  };
  in_parts(a.pixel_count(), 6 * sizeof(float), [&](std::size_t begin, std::size_t end) {
    for (; begin < end; ++begin) show_pixel(3 * begin);
  });
  return picture;
}

}  // namespace lobelia

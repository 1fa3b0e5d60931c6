#include "compare/metrics/code_values.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lobelia {
namespace {

/// Finds the code of a light without a power.
class Encoder {
 public:
  Encoder() {
    for (int code = 1; code < 256; ++code) {
      const double encoded = (code - 0.5) / 255;
      least_[std::size_t(code)] =
          float(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
    }
    least_[256] = 2;  // brighter than white
    std::size_t code = 0;
    for (std::size_t i = 0; i <= kSteps; ++i) {
      while (least_[code + 1] <= float(i) / kSteps) ++code;
      start_[i] = std::uint8_t(code);
    }
  }
  std::uint8_t code(float light) const {
    std::size_t code = start_[std::size_t(light * kSteps)];
    while (light >= least_[code + 1]) ++code;
    return std::uint8_t(code);
  }

 private:
  static constexpr std::size_t kSteps = 4096;
  std::array<float, 257> least_{};  ///< light from which on a code is the nearest
  std::array<std::uint8_t, kSteps + 1> start_;
};

/// difference(codes of a, codes of b) of each pixel.
template <class Difference>
std::vector<float> differences(const DisplayLight& a, const DisplayLight& b,
                               Difference difference) {
  const auto width = std::size_t(a.width());
  std::vector<float> map(a.pixel_count());
  oneapi::tbb::parallel_for(0, a.height(), [&](int y) {
    const std::vector<std::uint8_t> codes_a = code_values(a, y), codes_b = code_values(b, y);
    for (std::size_t x = 0; x < width; ++x)
      map[std::size_t(y) * width + x] =
          float(difference(codes_a.data() + 3 * x, codes_b.data() + 3 * x));
  });
  return map;
}

}  // namespace

std::vector<std::uint8_t> code_values(const DisplayLight& shown, int y) {
  static const Encoder encoder;
  std::vector<float> rgb(3 * std::size_t(shown.width()));
  shown.fill(y, 0, rgb);
  std::vector<std::uint8_t> codes(rgb.size());
  std::ranges::transform(rgb, codes.begin(), [](float light) { return encoder.code(light); });
  return codes;
}

std::vector<std::uint8_t> code_values(const DisplayLight& shown) {
  std::vector<std::uint8_t> codes(3 * shown.pixel_count());
  oneapi::tbb::parallel_for(0, shown.height(), [&](int y) {
    const std::vector<std::uint8_t> row = code_values(shown, y);
    std::ranges::copy(row, codes.begin() + std::ptrdiff_t(row.size() * std::size_t(y)));
  });
  return codes;
}

std::vector<float> code_differences(const DisplayLight& a, const DisplayLight& b) {
  return differences(a, b, [](const std::uint8_t* one, const std::uint8_t* other) {
    int largest = 0;
    for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(int(one[c]) - int(other[c])));
    return largest;
  });
}

std::vector<float> yiq_differences(const DisplayLight& a, const DisplayLight& b) {
  return differences(a, b, [](const std::uint8_t* one, const std::uint8_t* other) {
    const double r = int(one[0]) - int(other[0]), g = int(one[1]) - int(other[1]),
                 blue = int(one[2]) - int(other[2]);
    const double y = r * 0.29889531 + g * 0.58662247 + blue * 0.11448223;
    const double i = r * 0.59597799 - g * 0.27417610 - blue * 0.32180189;
    const double q = r * 0.21147017 - g * 0.52261711 + blue * 0.31114694;
    return std::sqrt((0.5053 * y * y + 0.299 * i * i + 0.1957 * q * q) / 35215);
  });
}

}  // namespace lobelia

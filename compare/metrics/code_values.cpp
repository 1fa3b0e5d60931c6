#include "compare/metrics/code_values.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/system/scratch_memory.hpp"
#include "compare/metrics/shared_work.hpp"

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
    const std::size_t code = start_[std::size_t(light * kSteps)];
    // A step is narrower than a code's light, so it has at most one end of a code.
    return std::uint8_t(code + (light >= least_[code + 1]));
  }

 private:
  static constexpr std::size_t kSteps = 4096;
  std::array<float, 257> least_{};  ///< light from which on a code is the nearest
  std::array<std::uint8_t, kSteps + 1> start_;
};

/// difference(codes of a, codes of b) of each pixel.
template <class Difference>
PixelValues differences(const CodePair& codes, Difference difference) {
  PixelValues map(codes.a.size() / 3);
  constexpr std::size_t kPart = std::size_t{1} << 14;
  oneapi::tbb::parallel_for(
      oneapi::tbb::blocked_range<std::size_t>(0, map.size(), kPart), [&](const auto& part) {
        for (std::size_t i = part.begin(); i < part.end(); ++i)
          map[i] = float(difference(codes.a.data() + 3 * i, codes.b.data() + 3 * i));
        looked_at(part.size() * (6 + sizeof(float)));
      });
  return map;
}

}  // namespace

CodeValues code_values(const DisplayLight& shown) {
  static const Encoder encoder;
  CodeValues codes(3 * shown.pixel_count());
  const auto values = 3 * std::size_t(shown.width());
  oneapi::tbb::parallel_for(0, shown.height(), [&](int y) {
    std::vector<float> rgb(values);
    shown.fill(y, 0, rgb);
    std::ranges::transform(rgb, codes.begin() + std::ptrdiff_t(values * std::size_t(y)),
                           [](float light) { return encoder.code(light); });
    looked_at(values);
  });
  return codes;
}

std::shared_ptr<const CodePair> code_pair(const MetricInput& input) {
  return shared(input, kCodeWork, [&] {
    return CodePair{code_values(input.shown_a), code_values(input.shown_b)};
  });
}

PixelValues code_differences(const CodePair& codes) {
  return differences(codes, [](const std::uint8_t* one, const std::uint8_t* other) {
    int largest = 0;
    for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(int(one[c]) - int(other[c])));
    return largest;
  });
}

PixelValues yiq_differences(const CodePair& codes) {
  return differences(codes, [](const std::uint8_t* one, const std::uint8_t* other) {
    const int r = int(one[0]) - int(other[0]), g = int(one[1]) - int(other[1]),
              blue = int(one[2]) - int(other[2]);
    if ((r | g | blue) == 0) return 0.0;
    const double y = r * 0.29889531 + g * 0.58662247 + blue * 0.11448223;
    const double i = r * 0.59597799 - g * 0.27417610 - blue * 0.32180189;
    const double q = r * 0.21147017 - g * 0.52261711 + blue * 0.31114694;
    return std::sqrt((0.5053 * y * y + 0.299 * i * i + 0.1957 * q * q) / 35215);
  });
}

}  // namespace lobelia

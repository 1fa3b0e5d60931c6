#include "compare/metrics/flip_tile.hpp"

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "compare/metrics/weighted_sum.hpp"

namespace lobelia {

FlipTileRows::FlipTileRows(const DisplayLight& shown, const FlipFilters& filters,
                           const FlipTile& tile)
    : shown_(shown),
      filters_(filters),
      tile_(tile),
      radius_(std::max(filters.contrast_radius, filters.feature_radius)),
      filtered_(std::max(0, tile.top - radius_)),
      next_(tile.top),
      padded_(flip_padded(std::size_t(tile.width))),
      extended_(flip_padded(padded_ + 2 * std::size_t(radius_))) {
  const std::size_t kept = padded_ * (2 * std::size_t(radius_) + 1);
  constexpr std::size_t kIn = 3 + sizeof(in_) / sizeof(float*),
                        kOut = sizeof(out_) / sizeof(float*);
  const std::size_t size = kIn * extended_ + kPlanes * kept + kOut * padded_;
  memory_ = hwy::AllocateAligned<float>(size);
  float* free = memory_.get();
  const auto take = [&](std::size_t count) { return std::exchange(free, free + count); };
  rgb_ = take(3 * extended_);
  for (float** in : {&in_.y, &in_.cx, &in_.cz, &in_.grey}) *in = take(extended_);
  planes_ = take(kPlanes * kept);
  for (float** out :
       {&out_.y, &out_.cx, &out_.cz_1, &out_.cz_2, &out_.dx, &out_.dy, &out_.ddx, &out_.ddy})
    *out = take(padded_);
}

float* FlipTileRows::row(Plane plane, int y) {
  const int kept = 2 * radius_ + 1;
  return planes_ + padded_ * std::size_t(plane * kept + y % kept);
}

void FlipTileRows::filter_along(int y) {
  // A row of the picture, extended by its border pixels, so that no tap needs a test.
  const int first = tile_.left - radius_, count = int(extended_);
  const int left = std::clamp(-first, 0, count),
            right = std::clamp(shown_.width() - first, left, count);
  shown_.fill(y, first + left, {rgb_ + 3 * left, 3 * std::size_t(right - left)});
  for (int i = 0; i < left; ++i) std::copy_n(rgb_ + 3 * left, 3, rgb_ + 3 * i);
  for (int i = right; i < count; ++i) std::copy_n(rgb_ + 3 * (right - 1), 3, rgb_ + 3 * i);
  flip_colours(rgb_, in_, extended_);

  const auto filter = [&](const float* in, std::initializer_list<WeightedSum> sums) {
    const std::size_t taps = sums.begin()->weights.size(), radius = taps / 2;
    taps_.resize(taps);
    for (std::size_t k = 0; k < taps; ++k) taps_[k] = in + std::size_t(radius_) - radius + k;
    weighted_sums(sums, taps_.data(), padded_);
  };
  filter(in_.y, {{filters_.luminance, row(kY, y)}});
  filter(in_.cx, {{filters_.red_green, row(kCx, y)}});
  filter(in_.cz, {{filters_.blue_yellow_1, row(kCz1, y)}, {filters_.blue_yellow_2, row(kCz2, y)}});
  filter(in_.grey, {{filters_.gaussian, row(kSmooth, y)},
                    {filters_.edge, row(kEdge, y)},
                    {filters_.point, row(kPoint, y)}});
}

const FlipFiltered& FlipTileRows::next() {
  const int y = next_++, height = shown_.height();
  for (const int last = std::min(y + radius_, height - 1); filtered_ <= last; ++filtered_)
    filter_along(filtered_);

  const auto filter = [&](Plane plane, std::initializer_list<WeightedSum> sums) {
    const int taps = int(sums.begin()->weights.size()), radius = taps / 2;
    taps_.resize(std::size_t(taps));
    for (int k = 0; k < taps; ++k)
      taps_[std::size_t(k)] = row(plane, std::clamp(y + k - radius, 0, height - 1));
    weighted_sums(sums, taps_.data(), padded_);
  };
  filter(kY, {{filters_.luminance, out_.y}});
  filter(kCx, {{filters_.red_green, out_.cx}});
  filter(kCz1, {{filters_.blue_yellow_1, out_.cz_1}});
  filter(kCz2, {{filters_.blue_yellow_2, out_.cz_2}});
  filter(kEdge, {{filters_.gaussian, out_.dx}});
  filter(kPoint, {{filters_.gaussian, out_.ddx}});
  filter(kSmooth, {{filters_.edge, out_.dy}, {filters_.point, out_.ddy}});
  return out_;
}

}  // namespace lobelia

#include "renderer/scene/lights/envmap_table.hpp"

namespace lobelia {
namespace {

/// The most that the smooth part of a sky exceeds its mean.
constexpr double kSmoothContrast = 4;

/// A step of a cumulative table, and the fraction within it.
struct Drawn {
  int step;
  double within;
};
/// The step that u falls in, from `first` to `last`.
Drawn draw_step(const double* cumulative, int first, int last, double u) {
  const int step =
      int(std::upper_bound(cumulative + first + 1, cumulative + last + 1, u) - cumulative) - 1;
  const double width = cumulative[step + 1] - cumulative[step];
  return {step, width > 0 ? std::clamp((u - cumulative[step]) / width, 0.0, 1.0) : 0.5};
}

/// From 0 to 1, with a density that goes linearly from a to b.
double draw_linear(double u, double a, double b) {
  const double sum = a + std::sqrt(a * a + u * (b * b - a * a));
  return sum > 0 ? std::min(1.0, u * (a + b) / sum) : u;
}

/// Turns sums of weights into a cumulative distribution; returns the last.
double normalise(std::span<double> cumulative) {
  const double total = cumulative.back();
  if (total > 0)
    for (double& sum : cumulative) sum /= total;
  return total;
}

double between(const std::array<double, 4>& corners, double across, double down) {
  return (1 - down) * ((1 - across) * corners[0] + across * corners[1]) +
         down * ((1 - across) * corners[2] + across * corners[3]);
}

}  // namespace

double smooth_luminance(const Image& sky) {
  const int width = sky.width(), height = sky.height();
  // From above the fixed point is reached without passing it. A few steps come near enough.
  double limit = kInfinity;
  for (int step = 0; step < 8; ++step) {
    double mean = 0;
    for (int y = 0; y < height; ++y) {
      double sum = 0;
      for (int x = 0; x < width; ++x) sum += std::min(limit, sky_luminance(sky.pixel(x, y)));
      mean += sum / width * 0.5 * (std::cos(kPi * y / height) - std::cos(kPi * (y + 1) / height));
    }
    const double next = kSmoothContrast * mean;
    if (!(next < 0.99 * limit)) break;
    limit = next;
  }
  return limit;
}

EnvmapTable::EnvmapTable(std::shared_ptr<const Image> picture, Rgb scale, double floor)
    : image_(std::move(picture)),
      scale_(scale),
      floor_(floor),
      width_(image_->width()),
      height_(image_->height()) {
  const std::size_t stride = std::size_t(width_) + 1;
  columns_.assign(stride * (std::size_t(height_) + 1), 0);
  rows_.assign(std::size_t(height_) + 2, 0);
  sines_.assign(std::size_t(height_) + 2, 0);
  for (int row = 1; row <= height_; ++row)
    sines_[std::size_t(row)] = std::sin(kPi * (row - 0.5) / height_);
  // Sums of two neighbours in the row above and below a row of patches.
  const auto sum_pairs = [&](int y, std::vector<double>& sums) {
    const auto above = [&](int x) {
      return std::max(0.0, sky_luminance(image_->pixel(x, y)) - floor_);
    };
    double left = above(0);
    const double first = left;
    for (int x = 0; x < width_; ++x) {
      const double right = x + 1 < width_ ? above(x + 1) : first;
      sums[std::size_t(x)] = left + right;
      left = right;
    }
  };
  const std::size_t across = std::size_t(width_);
  std::vector<double> top(across), bottom(across);
  sum_pairs(0, bottom);
  for (int row = 0; row <= height_; ++row) {
    std::swap(top, bottom);
    sum_pairs(std::min(row, height_ - 1), bottom);
    const double top_sine = sines_[std::size_t(row)], bottom_sine = sines_[std::size_t(row) + 1];
    const std::span cumulative(columns_.data() + stride * std::size_t(row), stride);
    for (std::size_t x = 0; x < across; ++x)
      cumulative[x + 1] = cumulative[x] + top_sine * top[x] + bottom_sine * bottom[x];
    rows_[std::size_t(row) + 1] =
        rows_[std::size_t(row)] + height_of(row) * 0.25 * normalise(cumulative);
  }
  total_ = normalise(rows_);
  if (is_black()) {
    rows_ = {};
    columns_ = {};
    return;
  }
  row_steps_ = growing(rows_);
  for (int row = 0; row <= height_; ++row)
    column_steps_.push_back(growing({columns_.data() + stride * std::size_t(row), stride}));
}

EnvmapTable::Steps EnvmapTable::growing(std::span<const double> cumulative) {
  Steps steps{0, int(cumulative.size()) - 2};
  const auto at = [&](int i) { return cumulative[std::size_t(i)]; };
  while (steps.first < steps.last && at(steps.first + 1) == at(steps.first)) ++steps.first;
  while (steps.first < steps.last && at(steps.last + 1) == at(steps.last)) --steps.last;
  return steps;
}

EnvmapTable::Place EnvmapTable::place(Vec3 d) const {
  // The error of the row near the poles is 1e-8, far less than a pixel.
  return {(0.5 + std::atan2(d.x, -d.z) / (2 * kPi)) * width_,
          std::acos(std::clamp(d.y, -1.0, 1.0)) / kPi * height_};
}

EnvmapTable::Patch EnvmapTable::patch(int column, int row) const {
  const int next = column + 1 < width_ ? column + 1 : 0;
  const int top = std::max(0, row - 1), bottom = std::min(height_ - 1, row);
  const Image& image = *image_;
  return {0,
          0,
          {image.pixel(column, top), image.pixel(next, top), image.pixel(column, bottom),
           image.pixel(next, bottom)},
          sines_[std::size_t(row)],
          sines_[std::size_t(row) + 1]};
}

std::array<double, 4> EnvmapTable::weights(const Patch& p) const {
  std::array<double, 4> all;
  for (std::size_t i = 0; i < 4; ++i)
    all[i] =
        (i < 2 ? p.top_sine : p.bottom_sine) * std::max(0.0, sky_luminance(p.pixels[i]) - floor_);
  return all;
}

double EnvmapTable::density(const Patch& p) const {
  return between(weights(p), p.across, p.down) / total_ * (width_ / (2 * kPi)) * (height_ / kPi);
}

EnvironmentLook EnvmapTable::look(const Patch& p, double squared_sine) const {
  Rgb smooth, bright;
  bool is_smooth = true;
  for (std::size_t i = 0; i < 4; ++i) {
    const double share = (i % 2 == 0 ? 1 - p.across : p.across) * (i < 2 ? 1 - p.down : p.down);
    const Rgb pixel{p.pixels[i][0], p.pixels[i][1], p.pixels[i][2]};
    const double luminance = sky_luminance(p.pixels[i]);
    if (luminance > floor_) {
      is_smooth = false;
      const double below = floor_ / luminance;
      smooth = smooth + share * below * pixel;
      bright = bright + share * (1 - below) * pixel;
    } else {
      smooth = smooth + share * pixel;
    }
  }
  if (is_smooth || is_black() || !(squared_sine > 0)) return {scale_ * smooth, scale_ * bright};
  return {scale_ * smooth, scale_ * bright, density(p) / std::sqrt(squared_sine)};
}

EnvironmentLook EnvmapTable::look(Place place, double squared_sine) const {
  const double x = place.column - 0.5, x0 = std::floor(x);
  const int column = int(x0), row = std::clamp(int(place.row + 0.5), 0, height_);
  Patch at = patch(column < 0 ? column + width_ : std::min(column, width_ - 1), row);
  at.across = x - x0;
  at.down = (place.row - std::max(0.0, row - 0.5)) / height_of(row);
  return look(at, squared_sine);
}

void EnvmapTable::prefetch(Place place) const {
  const int column = std::clamp(int(place.column - 0.5), 0, width_ - 1);
  const int row = std::clamp(int(place.row + 0.5), 0, height_);
  for (const int y : {std::max(0, row - 1), std::min(height_ - 1, row)})
    __builtin_prefetch(image_->pixel(column, y).data());
}

EnvmapTable::Draw EnvmapTable::draw(double u, double v) const {
  if (is_black()) return {{}, 0, {}};
  const Drawn row = draw_step(rows_.data(), row_steps_.first, row_steps_.last, v);
  const Steps steps = column_steps_[std::size_t(row.step)];
  const double* cumulative = columns_.data() + (std::size_t(width_) + 1) * std::size_t(row.step);
  const Drawn column = draw_step(cumulative, steps.first, steps.last, u);
  Patch at = patch(column.step, row.step);
  const auto w = weights(at);
  at.down = draw_linear(row.within, w[0] + w[1], w[2] + w[3]);
  at.across = draw_linear(column.within, (1 - at.down) * w[0] + at.down * w[2],
                          (1 - at.down) * w[1] + at.down * w[3]);
  return {{column.step + 0.5 + at.across,
           std::max(0.0, row.step - 0.5) + height_of(row.step) * at.down},
          density(at),
          look(at, 0).bright};
}

DirectionSample EnvmapTable::sample(double u, double v) const {
  const Draw drawn = draw(u, v);
  const double polar = polar_angle(drawn.place), turned = turn(drawn.place);
  const double sine = std::sin(polar);
  return {{sine * std::sin(turned), std::cos(polar), -sine * std::cos(turned)},
          sine > 0 ? drawn.density / sine : 0,
          drawn.radiance};
}

}  // namespace lobelia

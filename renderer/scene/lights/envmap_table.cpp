#include "renderer/scene/lights/envmap_table.hpp"

namespace lobelia {
namespace {

double luminance(std::span<const float, 3> p) {
  return 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
}

/// The step of a cumulative table that u falls in, and the fraction within it.
struct Draw {
  std::size_t step;
  double within;
};
Draw draw(std::span<const double> cumulative, double u) {
  const auto above = std::upper_bound(cumulative.begin() + 1, cumulative.end() - 1, u);
  const std::size_t step = std::size_t(above - cumulative.begin()) - 1;
  const double width = cumulative[step + 1] - cumulative[step];
  return {step, width > 0 ? std::clamp((u - cumulative[step]) / width, 0.0, 1.0) : 0.5};
}

/// Turns sums of weights into a cumulative distribution; zeros into an even one.
void normalise(std::span<double> cumulative) {
  const double total = cumulative.back();
  for (std::size_t i = 0; i < cumulative.size(); ++i)
    cumulative[i] = total > 0 ? cumulative[i] / total : double(i) / double(cumulative.size() - 1);
}

}  // namespace

EnvmapTable::EnvmapTable(std::shared_ptr<const Image> picture, Rgb scale)
    : image_(std::move(picture)),
      scale_(scale),
      width_(image_->width()),
      height_(image_->height()) {
  const Image& image = *image_;
  const std::size_t stride = std::size_t(width_) + 1;
  columns_.assign(stride * std::size_t(height_), 0);
  rows_.assign(std::size_t(height_) + 1, 0);
  for (int y = 0; y <= height_; ++y) cosines_.push_back(std::cos(kPi * y / height_));
  std::vector<double> row(stride);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      // The weight includes the neighbours, which interpolation takes light from.
      double sum = 0;
      for (int v = std::max(0, y - 1); v <= std::min(height_ - 1, y + 1); ++v)
        for (const int u : {x - 1, x, x + 1})
          sum += luminance(image.pixel((u + width_) % width_, v));
      row[std::size_t(x) + 1] = row[std::size_t(x)] + sum;
    }
    rows_[std::size_t(y) + 1] = rows_[std::size_t(y)] + row.back() * row_solid_angle(y);
    normalise(row);
    std::copy(row.begin(), row.end(), columns_.begin() + std::ptrdiff_t(stride * std::size_t(y)));
  }
  normalise(rows_);
}

/// The solid angle of one pixel of the row.
double EnvmapTable::row_solid_angle(int row) const {
  return 2 * kPi / width_ * (cosines_[std::size_t(row)] - cosines_[std::size_t(row) + 1]);
}

EnvmapTable::Place EnvmapTable::place(Vec3 d) const {
  const double turn = 0.5 + std::atan2(d.x, -d.z) / (2 * kPi);
  // The error near the poles is 1e-8, far less than a pixel.
  const double down = std::acos(std::clamp(d.y, -1.0, 1.0)) / kPi;
  return {turn * width_, down * height_};
}

/// The interpolated radiance.
Rgb EnvmapTable::at(Place p) const {
  const double x = p.column - 0.5, y = p.row - 0.5, fx = x - std::floor(x), fy = y - std::floor(y);
  const auto column = [&](double c) {
    const int i = int(c);
    return i < 0 ? i + width_ : i >= width_ ? i - width_ : i;
  };
  const auto row = [&](double r) { return std::clamp(int(r), 0, height_ - 1); };
  const auto pixel_at = [&](double c, double r) {
    const auto pixel = image_->pixel(column(c), row(r));
    return Rgb{pixel[0], pixel[1], pixel[2]};
  };
  const double x0 = std::floor(x), y0 = std::floor(y);
  return scale_ * ((1 - fy) * ((1 - fx) * pixel_at(x0, y0) + fx * pixel_at(x0 + 1, y0)) +
                   fy * ((1 - fx) * pixel_at(x0, y0 + 1) + fx * pixel_at(x0 + 1, y0 + 1)));
}

EnvironmentLook EnvmapTable::look(Vec3 direction) const {
  const Place p = place(direction);
  return {at(p), pdf(std::size_t(std::clamp(int(p.column), 0, width_ - 1)),
                     std::size_t(std::clamp(int(p.row), 0, height_ - 1)))};
}

/// Constant within a pixel.
double EnvmapTable::pdf(std::size_t column, std::size_t row) const {
  const double* cumulative = columns_.data() + (std::size_t(width_) + 1) * row;
  return (rows_[row + 1] - rows_[row]) * (cumulative[column + 1] - cumulative[column]) /
         row_solid_angle(int(row));
}

DirectionSample EnvmapTable::sample(double u, double v) const {
  const Draw row = draw(rows_, v);
  const std::size_t stride = std::size_t(width_) + 1;
  const Draw column = draw({columns_.data() + stride * row.step, stride}, u);
  // Linear in the cosine: evenly in solid angle within the row.
  const double top = cosines_[row.step], bottom = cosines_[row.step + 1];
  const double c = top + row.within * (bottom - top), s = std::sqrt(std::max(0.0, 1 - c * c));
  const double x = double(column.step) + column.within;
  const double turn = 2 * kPi * (x / width_ - 0.5);
  const Vec3 direction{s * std::sin(turn), c, -s * std::cos(turn)};
  const Place place{x, std::acos(std::clamp(c, -1.0, 1.0)) / kPi * height_};
  return {direction, pdf(column.step, row.step), at(place)};
}

}  // namespace lobelia

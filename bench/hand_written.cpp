#include "bench/hand_written.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "bench/inputs.hpp"
#include "core/timing.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::bench {
namespace {

/// 1 - R.V at a point of the film, as the loop has it.
double one_minus_cosine(double radius_squared, double distance) {
  const double d2 = 1 + radius_squared;
  const double q = std::sqrt(distance * distance - (distance * distance - 1) * d2);
  const double t = (distance - q) / d2;
  return 1 - (2 * (distance - t) * q - 1) / std::sqrt(d2);
}

}  // namespace

HandWritten::HandWritten(Set set, int side) : set_(set), rgb_(std::size_t(3) * side * side) {
  Scene scene = read_scene(scene_file("head_on"));
  scene.film.width = scene.film.height = side;
  Highlight& highlight = scene.materials[0].highlight;
  highlight.lobe = *find_lobe("cs16");
  picture_.side = side;
  picture_.half_width = std::tan(scene.camera.fov_degrees * 0.5 * 3.14159265358979 / 180);
  picture_.peak = radiance_coefficient(highlight);
  picture_.slope = highlight.exponent / 16;
  picture_.rgb = rgb_.data();
  // Where the lobe ends, and the sphere at the latest.
  double low = 0, high = 1 / (picture_.distance * picture_.distance - 1);
  for (int step = 0; step < 60; ++step) {
    const double middle = (low + high) / 2;
    (picture_.slope * one_minus_cosine(middle, picture_.distance) < 1 ? low : high) = middle;
  }
  picture_.lit_radius_squared = high;
  const Image truth = render(scene, {}).image;
  seconds();
  for (std::size_t i = 0; i < rgb_.size(); ++i)
    if (std::abs(rgb_[i] - truth.values()[i]) > 1e-5 * picture_.peak)
      throw std::runtime_error(
          fmt::format("the picture of the loop written by hand is wrong: {} in place of {} at {}",
                      rgb_[i], truth.values()[i], i / 3));
}

double HandWritten::seconds() {
  return warm_seconds(
      [&] { set_ == Set::kAvx2 ? avx2::render(picture_) : avx512::render(picture_); });
}

}  // namespace lobelia::bench

// What the benchmarks of light transport measure with.
#pragma once

#include <vector>

#include "core/image.hpp"
#include "renderer/render.hpp"

namespace lobelia::bench {

double median(std::vector<double> values);

/// Root mean square over all values, and of a difference.
double rms(const Image& image);
double rms_of_difference(const Image& a, const Image& b);
double mean(const Image& image);

/// Throws Error(kInternal) unless all values are finite and not all are black.
void require_picture(const Image& image, const char* what);

/// Half of each.
Image mean_of(const Image& a, const Image& b);

/// Slope of a line by least squares.
double slope(const std::vector<double>& x, const std::vector<double>& y);

/// Plan and picture in seconds; the picture is checked.
struct Timed {
  double seconds = 0;
  RenderResult result;
};
Timed render_timed(Scene scene, int samples, std::uint64_t seed, RenderOptions options = {});

int processors();

}  // namespace lobelia::bench

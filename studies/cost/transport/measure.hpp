// What light transport is measured with.
#pragma once

#include <cstdint>

#include "core/image.hpp"
#include "renderer/render.hpp"

namespace lobelia::cost {

/// Root mean square over all values, and of a difference.
double rms(const Image& image);
double rms_of_difference(const Image& a, const Image& b);
double mean(const Image& image);

/// Throws Error(kInternal) unless all values are finite and not all are black.
void require_picture(const Image& image, const char* what);

/// Half of each.
Image mean_of(const Image& a, const Image& b);

/// Plan and picture in seconds; the picture is checked.
struct Timed {
  double seconds = 0;
  RenderResult result;
};
Timed render_timed(Scene scene, int samples, std::uint64_t seed, RenderOptions options = {});

}  // namespace lobelia::cost

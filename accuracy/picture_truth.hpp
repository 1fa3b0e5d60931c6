// The truth that a picture is compared with: the scene as its file has it, with its own lobe and coefficient.
#pragma once

#include <string>
#include <string_view>

#include "core/image.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::accuracy {

struct PictureTruth {
  Image image;
  std::string how;  ///< in words
  double seconds = 0;
};

/// By the formulas for each pixel, in double, if they can evaluate the scene; else our own picture in float64 with
/// `samples` of another seed, 1 or more.
PictureTruth picture_truth(const Scene& scene, int samples);

/// With exactly so many random samples. A pixel stays a point or an area, as in the scene.
RenderOptions with_samples(int samples);

/// A metric's value by its id, with the truth's peak at display white.
double measure_at_peak(std::string_view metric, const Image& picture, const Image& truth);

/// Root mean square of the difference over all values, by the truth's peak; 0 for equal pictures.
double rms_of_peak(const Image& picture, const Image& truth);

/// The same scene with a film of every k-th pixel of every k-th row, k odd, about `side` on the longer side. With one ray
/// a pixel, its pixels are the picture's own. Fewer than k rows and columns are left out at the end.
Scene pixel_subset(const Scene& scene, int side);

}  // namespace lobelia::accuracy

// What a picture is held against: the scene as its file has it, lobe, coefficient and all.
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

/// By formulas for each pixel, in double, where the scene can be evaluated so; else our own picture in
/// float64 with `samples` of another seed, 1 or more.
PictureTruth picture_truth(const Scene& scene, int samples);

/// With just so many samples of what is random: whether a pixel is its centre or an area stays as the scene has
/// it.
RenderOptions with_samples(int samples);

/// A metric's value by its id, seen with the truth's peak at display white.
double measure_at_peak(std::string_view metric, const Image& picture, const Image& truth);

/// Root mean square of the difference over all values, by the truth's peak; 0 for equal pictures.
double rms_of_peak(const Image& picture, const Image& truth);

}  // namespace lobelia::accuracy

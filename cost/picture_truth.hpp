// What a picture is held against: the scene as its file has it, lobe, coefficient and all.
#pragma once

#include <string>

#include "compare/compare.hpp"
#include "core/image.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::cost {

struct PictureTruth {
  Image image;
  std::string how;  ///< in words
  double seconds = 0;
};

/// By formulas for each pixel, in double, where the scene can be evaluated so; else our own picture in
/// float64 with `samples` of another seed, 1 or more.
PictureTruth picture_truth(const Scene& scene, int samples);

/// Ours in float64, by another seed than the scene's.
Image float64_picture(const Scene& scene, int samples);

/// How far a picture is from its truth, seen with the truth's peak at display white.
Comparison compare_at_peak(const Image& picture, const Image& truth);

/// Root mean square of the difference over all values, by the truth's peak; 0 for equal pictures.
double rms_of_peak(const Image& picture, const Image& truth);

}  // namespace lobelia::cost

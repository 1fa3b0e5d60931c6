// Noise that a renderer wrote into the picture's own file, as layers.
//
// | layer                     | written by           | holds                             | standard error of the picture  |
// |---------------------------|----------------------|-----------------------------------|--------------------------------|
// | P.StandardError           | anyone               | the standard error                | as it is                       |
// | m2_P, beside P of X, Y, Z | Mitsuba 3, moment    | mean of the samples' squares      | sqrt((m2 - P^2) / (n - 1))     |
// | Variance                  | pbrt-v4, gbuffer     | variance of samples, by n - 1     | sqrt(Variance / n), see below  |
// | Denoising Image Variance  | Cycles 2.79 and 2.80 | mean of squares less squared mean | sqrt(variance / (n - 1))       |
//
// Sources: mitsuba3 src/integrators/moment.cpp; pbrt-v4 src/pbrt/film.cpp (GBufferFilm) and util/math.h (VarianceEstimator);
//          Blender 2.79 intern/cycles/render/buffers.cpp (get_denoising_pass_rect).
// n:       samples per pixel. pbrt and Cycles 2.80 write it into the file.
// pbrt:    its variance is that of the sensor: of X, Y and Z for the default sensor, where the picture is R, G and B. How they
//          vary together is not in the file. So the error of R is the upper bound sum |M| error(X, Y, Z), by the rows of the
//          matrix M from XYZ to Rec. 709: for grey noise too large by 5.2 in R, 2.8 in G and 1.4 in B. Samples that hit no
//          surface are left out of it.
// Assumes: independent samples, and pixels that share none: Mitsuba needs the box filter.
// Rounding: m2 - P^2 is a small difference of large numbers. The rounding of the stored numbers is added to it, half an ulp
//          each, so that half floats give an error that is too large rather than too small.
#pragma once

#include <filesystem>

#include "base/pictures/picture.hpp"
#include "profile/noise.hpp"

namespace lobelia {

struct NoiseLayerOptions {
  double samples = 0;   ///< of a pixel; 0: as the file says
  double freedom = 15;  ///< of a layer StandardError; of the others it is samples - 1
  bool shared = false;  ///< as PictureNoise::shared
};

/// The noise of `picture`, a layer of `file`, by the layers beside it. Throws Error(kInput) if there is none that is known,
/// naming what is, and Error(kUsage) if the number of samples is not known or below 2.
PictureNoise noise_of_layers(const std::filesystem::path& file, const Picture& picture,
                             const NoiseLayerOptions& options);

}  // namespace lobelia

// The noise of a Monte-Carlo picture: how far each of its values may be from what endless samples would give.
//
// Source:       the standard error of a mean; Student's t for its estimate from few replicates.
// Two estimates, for two uses:
//   standard_error  is right on the average: for figures, sums over many values. Up to eight degrees of freedom
//                   it is the root mean square over what varies in the 5 x 5 pixels around, as the root of a
//                   variance from few replicates is too small (of two by a fifth); with more the value's
//                   own, without that bias: times 1 + 1 / (4 freedom). Where all replicates agree it is 0.
//   cautious        is not too small where it counts: for single values far in the tail of a distribution,
//                   where half the error is a million times the chance. It is the larger of the value's
//                   own, and of what the windows of the pixel and its eight neighbours say: the largest of
//                   the root mean squares over eight windows, lines of 17 pixels in four directions, which follow
//                   a thin silhouette, and the four squares of 5 x 5 with the pixel in a corner, of which
//                   one lies wholly on the noisy side of any straight edge. Channels are not pooled: where
//                   light is white their noise is one and the same. It counts as 17 degrees of freedom, those
//                   of the shortest window, or as many as the value's own has.
// Assumes:      replicates are independent, of equal weight and of one expectation; noise is near normal in
//               the means. Windows are pooled as independent pixels; a picture whose pixels share their
//               points is `shared` and gets no freedom from its windows.
// Errs:         from few replicates standard_error blurs a lone noisy pixel, and error bars of a largest error
//               are too short for it. Where a single pixel is much noisier than all lines and squares around it and its
//               replicates happen to agree, the error is too small and a difference may be found that is
//               none. On the quiet side of an edge of noise it is too large, and a difference there is
//               overlooked. A value that is rare but large may be in no replicate at all: what is not
//               known to vary does not. One that is in a single replicate is in its own error too, so
//               fireflies are not taken for differences. tests/compare/uncertainty_test.cpp has the
//               levels that are really held.
#pragma once

#include <span>

#include "core/image.hpp"

namespace lobelia {

struct PictureNoise {
  Image standard_error;       ///< of the mean, in radiance
  Image cautious;             ///< at least 0; see above
  double freedom = 0;         ///< degrees of freedom of one value by itself, at least 1
  double pooled_freedom = 0;  ///< of a value of `cautious`
  bool shared = false;        ///< pixels err together: they share their points, or were filtered
};

/// Noise from a picture of standard errors. Throws Error(kInput) where it is negative or not finite, or has no
/// pixels, and Error(kUsage) if there is not at least one degree of freedom.
PictureNoise noise_of_standard_errors(const Image& standard_error, double freedom, bool shared);

struct NoisyPicture {
  Image image;
  PictureNoise noise;
};

/// The mean of pictures that are each an estimate of the same, from as many samples each, and its noise, with
/// one degree of freedom fewer than pictures. Two half-sample pictures are the least. Throws Error(kInput)
/// if there are fewer or the sizes differ. A value that is not finite in one of them is not in the mean, and
/// has no error.
NoisyPicture mean_of_replicates(std::span<const Image> replicates, bool shared);

}  // namespace lobelia

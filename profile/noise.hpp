// The noise of a Monte-Carlo picture: the distance of its values from those that endless samples would give.
//
// Source:       the standard error of a mean; Student's t for its estimate from few replicates.
// Two estimates, for two uses:
//   standard_error  is right on average: for figures, which sum over many values. Below eight degrees of freedom
//                   it is the root mean square over the noisy ones of the 5 x 5 pixels around, as the root of
//                   a variance from few replicates is too small (for two, by a fifth). With more it is the
//                   value's own, times 1 + 1 / (4 freedom) to remove the bias. It is 0 if all replicates agree.
//   cautious        is not too small where it matters: for single values far in the tail of a distribution,
//                   where half the error is a million times the chance. It is the larger of the value's own
//                   error and the windows of the pixel and its eight neighbours. A pixel's windows give the
//                   largest of eight root mean squares: over lines of 17 pixels in four directions, which
//                   follow a thin silhouette, and over the four squares of 5 x 5 with the pixel in a corner,
//                   one of which lies wholly on the noisy side of any straight edge. Channels are not pooled:
//                   under white light they share their noise. It has 17 degrees of freedom, those of the
//                   shortest window, or the value's own if it has more. With heavy tails it has the value's own.
// Assumes:      replicates are independent, of equal weight and of one expectation; their means are nearly
//               normal. Windows are pooled as independent pixels. A picture whose pixels share their sample
//               points is `shared` and gets no freedom from its windows.
// Errs:         from few replicates standard_error blurs a lone noisy pixel, which makes the error bar of a
//               largest error too short. If a single pixel is much noisier than all lines and squares around
//               it and its replicates happen to agree, the error is too small and may give a false
//               difference. On the quiet side of an edge of noise it is too large and hides differences. A rare
//               large value that no replicate has is not known as noise. A value in a single replicate is
//               part of its error, so fireflies do not count as differences.
//               tests/compare/uncertainty_test.cpp measures the levels.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/pictures/image.hpp"

namespace lobelia {

struct PictureNoise {
  Image standard_error;       ///< of the mean, in radiance
  Image cautious;             ///< at least 0; see above
  double freedom = 0;         ///< degrees of freedom of one value by itself, at least 1
  double pooled_freedom = 0;  ///< of a value of `cautious`
  bool shared = false;        ///< pixels err together: they share their points, or were filtered
  std::string layer = {};     ///< of the picture's file that says it; empty for other files
  /// The difference from the mean of each replicate but the last: their sum is less than that of the last one. They show
  /// how the channels of a pixel err together, and how heavy the tails are. Empty for noise of another source.
  std::vector<Image> deviations = {};
  /// The share of pixels with a firefly: an error of more than kFireflyFactor times those of all eight neighbours.
  double fireflies = 0;

  bool has_heavy_tails() const;
  /// The squared standard error of a value, by its own replicates alone.
  double own_variance(std::size_t value) const;
  /// The same of the weighted sum of the values from `first` on. Standard errors tell nothing of how values err together, so
  /// they count as erring together, which is the upper bound.
  double own_variance(std::size_t first, std::span<const double> weights) const;
  /// All its pictures, each of the size of the picture, 0 where it has no noise.
  std::vector<Image*> images();
};

/// With fewer degrees of freedom a value's own error is not reliable.
inline constexpr double kFewFreedom = 8;

/// Normal noise has a firefly in a hundred million pixels, exponential noise in 3000.
inline constexpr double kFireflyFactor = 6;
/// From this share on the tails of the noise count as heavy.
inline constexpr double kHeavyTails = 0.001;
inline bool PictureNoise::has_heavy_tails() const { return fireflies >= kHeavyTails; }

/// Degrees of freedom of the standard errors that `lobelia reference --standard-error` writes.
inline constexpr double kFreedomOfErrors = 15;

/// Noise from a picture of standard errors. Throws Error(kInput) if a value is negative or not finite, or there are no
/// pixels, and Error(kUsage) for less than one degree of freedom.
PictureNoise noise_of_standard_errors(const Image& standard_error, double freedom, bool shared);

/// Noise from a picture of the variance of one of the `samples` that each value is the mean of. With one sample it is
/// that of the value itself, of `freedom` degrees of freedom; otherwise there is one fewer than samples. Throws as
/// noise_of_standard_errors(), Error(kUsage) for fewer than one sample.
PictureNoise noise_of_variances(const Image& variance, double samples, double freedom, bool shared);

struct NoisyPicture {
  Image image;
  PictureNoise noise;
};

/// The mean of independent pictures of the same scene with equally many samples, and its noise, with one degree of
/// freedom fewer than pictures. Copies the pictures as their deviations. If a value is not finite in one picture, its
/// mean is not finite either and has no error. Throws Error(kInput) for fewer than two pictures or different sizes.
NoisyPicture mean_of_replicates(std::span<const Image> replicates, bool shared);

}  // namespace lobelia

// Pictures with one more draw of the known noise.
//
// Replicates:   their deviations from the mean are the noise. Of n replicates, a draw takes half of them against the
//               other half, chosen for each pixel by itself: half the difference of the two means has the variance of
//               the mean of all, the same tails, and channels that err together as they do in the file (the wild
//               bootstrap of C. F. J. Wu, "Jackknife, Bootstrap and Other Resampling Methods in Regression Analysis",
//               Annals of Statistics 14, 1986, with balanced signs). Few replicates would give every draw errors of
//               the same size; below nine, a pixel takes the deviations of a noisy one of the 3 x 3 around.
// Errors:       standard errors alone say neither the tails nor what errs together. The draws are normal.
// Together:     pixels that share their sample points take the same half everywhere, or the same normal number.
// Expectation:  the hypothesis of equal pictures needs one picture that both are draws of. It is the mean of both,
//               weighted by their variances, smoothed where noise is all there is (J.-S. Lee, "Digital Image
//               Enhancement and Noise Filtering by Use of Local Statistics", IEEE PAMI 2, 1980): on a picture that
//               is already noisy, more noise moves the figures of dark pixels too little.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/uncertainty/z_test.hpp"
#include "profile/gaussian.hpp"

namespace lobelia {

/// The values that err together in a draw.
enum class Together : std::uint8_t {
  kNothing,   ///< each value errs by itself; replicates tell better, and are drawn as kChannels
  kChannels,  ///< the three values of a pixel
  kPicture,   ///< all values of a picture with shared noise; of another one as kChannels
};

/// The candidates for a pair of pictures. Which one holds is not known, so the worst counts.
std::vector<Together> what_may_err_together(const NoiseOfPair& noise);

/// `image` with one draw of the noise, of its size; as it is where `noise` is null.
Image with_noise(const Image& image, const PictureNoise* noise, std::uint64_t stream,
                 Together together);

/// The picture that both would be draws of if they had one expectation. Finite pictures of one size.
Image common_expectation(const Image& a, const Image& b, const NoiseOfPair& noise);

}  // namespace lobelia

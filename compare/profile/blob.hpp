// The brightest blob of a picture of which nothing else is known: where it is, how wide along its own axes, and
// where two pictures of it differ. docs/profiles.md defines every figure. What angles its pixels see is not
// known, so there is no exponent: the width is that of a Gaussian of the same half-width.
#pragma once

#include "compare/profile/profile.hpp"

namespace lobelia {

struct BlobFigures {
  std::size_t not_finite = 0;  ///< pixels of the picture; they are holes
  double background = 0;       ///< radiance around the blob
  Peak peak;                   ///< over the background
  std::size_t pixels = 0;      ///< that hang together above half of the peak
  Axes axes;  ///< of these, weighted by radiance over the background; their centre is the centroid
  double major_half_width = 0,
         minor_half_width = 0;  ///< pixels; NaN where it does not fall to half
  double energy = 0;    ///< radiance over the background times pixels, in a disc of 3 half-widths
  std::string why_not;  ///< a sentence where there is no blob; then the figures are NaN
  std::string remark;   ///< a sentence on what makes it doubtful, or ""
};

/// Along one axis of the reference's blob, through its peak.
struct BlobCurve {
  std::string axis;                           ///< "major", "minor"
  std::vector<double> offset;                 ///< pixels
  std::vector<std::vector<double>> radiance;  ///< [picture][offset]
};

struct BlobProfile {
  std::vector<std::string> names;
  std::vector<BlobFigures> blobs;  ///< [picture]
  std::vector<BlobCurve> curves;   ///< none where the reference has no blob
  std::optional<std::array<ZoneError, kZoneCount>> difference;  ///< of the first from the second
};

/// One picture, or two of the same size, of which the second is the reference; else Error(kInput).
BlobProfile measure_blob(const NamedImages& images);

records::Blob blob_record(const BlobProfile& profile);

}  // namespace lobelia

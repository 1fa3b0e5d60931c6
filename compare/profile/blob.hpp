// The brightest blob of a picture without a scene: its place, its widths along its own axes, and the differences of
// two pictures of it. docs/profiles.md defines every figure. The angles of its pixels are unknown, so instead of an
// exponent it has the width of a Gaussian of the same half-width.
#pragma once

#include "compare/profile/profile.hpp"

namespace lobelia {

struct BlobFigures {
  std::size_t not_finite = 0;  ///< pixels of the picture; they are holes
  double background = 0;       ///< radiance around the blob
  Peak peak;                   ///< over the background
  std::size_t pixels = 0;      ///< connected, above half of the peak
  Axes axes;  ///< of these, weighted by radiance over the background; their centre is the centroid
  double major_half_width = 0;  ///< pixels; NaN if the blob does not fall to half
  double minor_half_width = 0;  ///< likewise
  double energy = 0;    ///< radiance over the background times pixels, in a disc of 3 half-widths
  std::string why_not;  ///< a sentence if there is no blob; then the figures are NaN
  std::string remark;   ///< a sentence if the blob is doubtful
};

/// Along one axis of the reference's blob, through its peak.
struct BlobCurve {
  std::string axis;                           ///< "major", "minor"
  std::vector<double> offset;                 ///< pixels
  std::vector<std::vector<double>> radiance;  ///< [picture][offset]
};

struct BlobProfile {
  std::vector<std::string> names;
  std::vector<BlobFigures> blobs;        ///< [picture]
  std::vector<BlobCurve> curves;         ///< none if the reference has no blob
  std::optional<ZoneErrors> difference;  ///< of the first from the second
};

/// One picture, or two of which the second is the reference. Throws Error(kInput) if the sizes differ.
BlobProfile measure_blob(const NamedImages& images);

records::Blob blob_record(const BlobProfile& profile);

}  // namespace lobelia

// The highlights of a picture without a scene: of each its place, its widths along its own axes, its colour, how it falls
// off, and the differences of two pictures of it, all with standard errors. docs/profiles.md defines every figure. The
// angles of its pixels are unknown, so instead of an exponent it has the width of a Gaussian of the same half-width.
#pragma once

#include "base/pictures/picture.hpp"
#include "base/words/constants.hpp"
#include "profile/falloff_fit.hpp"
#include "profile/find_blobs.hpp"
#include "profile/profile.hpp"

namespace lobelia {

using records::BlobErrors;

struct Clipping {
  std::size_t pixels = 0;  ///< with a value at the file's maximum
  std::string channels;    ///< "R", "RGB"
  FalloffFit flank;        ///< through the pixels that are not clipped
};

struct BlobFigures {
  std::size_t not_finite = 0;  ///< pixels of the picture; they are holes
  double background = 0;       ///< radiance under the peak: of a level or of a plane
  Peak peak;                   ///< over the background
  std::size_t pixels = 0;      ///< connected, above half of the peak
  Axes axes;  ///< of these, weighted by radiance over the background; their centre is the centroid
  double major_half_width = 0;  ///< pixels; NaN if the blob does not fall to half
  double minor_half_width = 0;  ///< likewise
  double energy = 0;    ///< radiance over the background times pixels, in a disc of 3 half-widths
  BlobErrors errors;    ///< NaN where unknown
  double noise = kNaN;  ///< of a pixel near the peak, of the peak
  std::array<double, 3> colour{kNaN, kNaN,
                               kNaN};  ///< R, G and B over their backgrounds; the largest is 1
  std::optional<Clipping> clipped;     ///< then the half-widths are those of the flank
  std::vector<FalloffFit>
      falloff;          ///< the better family first; none for a clipped or unresolved blob
  std::string why_not;  ///< a sentence if there is no blob; then the figures are NaN
  std::string remark;   ///< a sentence if the blob is doubtful
};

/// One highlight in one or two pictures.
struct BlobProfile {
  std::size_t id = 0;  ///< 1 for the brightest
  std::vector<std::string> names;
  std::vector<BlobFigures> blobs;  ///< [picture]
  /// Through the peak of the reference's blob, along its axes: "major", "minor". None if no picture has the blob.
  records::Named<records::BlobCurve> curves;
  std::optional<ZoneErrors> difference;  ///< of the first from the second, if both have the blob
};

struct BlobOptions {
  BlobSearch search;
  std::optional<PixelWindow> region;       ///< nothing outside is looked at
  std::vector<const PictureNoise*> noise;  ///< [picture]; null or missing: unknown
};

/// A picture's findings that are not measured highlights.
struct BlobPicture {
  std::string name;
  std::vector<Speck> specks;  ///< the brightest first
  std::size_t left_out = 0;   ///< highlights beyond kMostBlobs
  bool cut = false;           ///< too many peaks to look at each
  bool noise_is_given = false;
};

struct BlobProfiles {
  std::vector<BlobPicture> pictures;
  /// Those of the first picture, the brightest first, then those that only the second picture has. Never empty: without
  /// any highlight there is one whose `why_not` says so.
  std::vector<BlobProfile> highlights;
};

/// One picture, or two of which the second is the reference. Throws Error(kInput) if the sizes differ, or if the place or
/// the region lies outside.
BlobProfiles measure_blobs(const NamedImages& images, const BlobOptions& options);

records::Blob blob_record(const BlobProfile& profile);
/// Lists 16 specks of each picture.
records::Blobs blobs_record(const BlobProfiles& profiles, double least_share);

}  // namespace lobelia

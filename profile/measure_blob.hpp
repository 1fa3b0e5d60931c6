// The figures of one blob.
#pragma once

#include "profile/blob.hpp"
#include "profile/stored_steps.hpp"

namespace lobelia {

/// The input that one picture gives to the measurement of each of its blobs.
struct BlobSource {
  const Image* image;
  const FoundBlobs* found;
  PixelWindow film;                ///< the pixels that are looked at
  const Field* error;              ///< standard errors of the pixels; null: unknown
  bool shared = false;             ///< whether these have the same sign
  std::array<float, 3> largest{};  ///< of each channel, without the specks
  StoredSteps steps;               ///< of the picture's file
};

BlobFigures measure_blob(const BlobSource& source, const FoundBlob& blob, std::uint64_t seed);
/// Figures that are NaN, for a picture without the blob.
BlobFigures no_blob(std::string why);

}  // namespace lobelia

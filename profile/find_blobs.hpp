// Where the highlights of a picture without a scene are.
//
// A blob is a peak with the pixels that connect to it above half of its height. The height is over the blob's own
// background: the pixels of a ring around it. Going down from a peak, the first level that is half of the height over the
// ring around the pixels above it counts, so a highlight on a lit object is found, and not the object. A blob stands out
// from the spread of its ring, so a bump of noise or texture is none.
#pragma once

#include <limits>
#include <optional>

#include "profile/peak.hpp"

namespace lobelia {

/// A blob's height is at least this share of the highest one's, unless asked otherwise.
inline constexpr double kLeastShare = 0.1;
/// No more than these are measured.
inline constexpr std::size_t kMostBlobs = 32;

/// A few connected pixels of which no neighbour has a fifth of their height: a firefly, a dead pixel, or a highlight smaller
/// than a pixel.
struct Speck {
  FilmPoint place;  ///< of its brightest pixel
  double value = 0;
  std::vector<std::size_t> pixels;  ///< 1 to 3
};

/// Takes the specks out of a field, the brightest first: a polynomial through their neighbours fills them.
std::vector<Speck> take_specks(Field& field);

/// The radiance beneath a blob: a plane where the ring around it has a slope, otherwise level.
struct BlobBackground {
  FilmPoint middle;
  double value = 0;   ///< there
  FilmPoint slope;    ///< per pixel
  double spread = 0;  ///< of the ring around the plane: 1.4826 times the median deviation
  std::vector<std::size_t> ring;

  double at(FilmPoint place) const {
    return value + slope.x * (place.x - middle.x) + slope.y * (place.y - middle.y);
  }
};

/// In half-widths of a blob. A Gaussian falls to 1/512 at 3 of them.
inline constexpr double kRingFrom = 3, kRingTo = 4.5;

/// The background of a blob of that centre and long semi-axis; nothing if fewer than 16 pixels of its ring are there. The
/// value is a median, so that other highlights and texture in less than half of the ring do not count. A ring of more
/// than `most` pixels is thinned.
std::optional<BlobBackground> background_around(
    const Field& field, FilmPoint centre, double semi_axis,
    std::size_t most = std::numeric_limits<std::size_t>::max());
double median(std::vector<double> values);

struct FoundBlob {
  std::vector<std::size_t> region;  ///< above half of the height, its brightest first
  Axes axes;
  double background = 0, height = 0;
};

struct BlobSearch {
  double least_share = kLeastShare;
  std::optional<FilmPoint> at;  ///< only the blob at this place, or the nearest one
};

struct FoundBlobs {
  Field field;                   ///< the picture without its specks
  std::vector<FoundBlob> blobs;  ///< the highest first
  std::size_t left_out = 0;      ///< blobs beyond kMostBlobs
  bool cut = false;           ///< too many peaks to look at each, so that there may be more blobs
  std::vector<Speck> specks;  ///< at least as high as a blob has to be, the brightest first
};

/// Finite values; NaN is a hole.
FoundBlobs find_blobs(Field field, const BlobSearch& search);

}  // namespace lobelia

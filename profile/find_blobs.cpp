#include "profile/find_blobs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/words/constants.hpp"
#include "profile/least_squares.hpp"
#include "profile/outline.hpp"

namespace lobelia {
namespace {

constexpr double kDeviation = 1.4826;  // of a normal distribution over its median deviation
constexpr std::size_t kFewestRingPixels = 16;
// Noise has peaks of 3 of its deviations everywhere; 5 are rare even among millions of pixels.
constexpr double kStandsOut = 5, kRounding = 1e-6;
constexpr std::size_t kMostSpeck = 3;
constexpr double kSpeckLevel = 0.2, kSpeckStandsOut = 8;
// A bound on the time: so many visits of pixels, for each pixel of the picture and in all.
constexpr std::size_t kVisitsPerPixel = 60, kVisits = 10'000'000, kVisitsOfARing = 5000;
constexpr std::size_t kMostOfARing = 2000;
constexpr double kFirstDepth = 1.0 / 256, kDeeper = 1.3;

template <class Visit>
void for_neighbours(const Field& field, std::size_t index, int reach, Visit visit) {
  const int x = int(index % std::size_t(field.width)), y = int(index / std::size_t(field.width));
  for (int j = std::max(0, y - reach); j <= std::min(field.height - 1, y + reach); ++j)
    for (int i = std::max(0, x - reach); i <= std::min(field.width - 1, x + reach); ++i)
      if (i != x || j != y) visit(field.index(i, j));
}

bool is_local_maximum(const Field& field, std::size_t index) {
  const double value = field.values[index];
  if (std::isnan(value)) return false;
  bool highest = true, lower = false;
  for_neighbours(field, index, 1, [&](std::size_t i) {
    highest = highest && !(field.values[i] > value);
    lower = lower || field.values[i] < value;
  });
  return highest && lower;
}

/// The pixels of a speck at a local maximum; none if it is not one.
std::vector<std::size_t> speck_at(const Field& field, std::size_t index) {
  std::vector<double> around;
  for_neighbours(field, index, 2, [&](std::size_t i) {
    if (!std::isnan(field.values[i])) around.push_back(field.values[i]);
  });
  if (around.size() < 3) return {};
  const double value = field.values[index], base = median(around);
  for (double& one : around) one = std::abs(one - base);
  if (!(value - base > kSpeckStandsOut * kDeviation * median(around))) return {};
  const double level = base + kSpeckLevel * (value - base);
  std::vector<std::size_t> speck{index};
  for (std::size_t next = 0; next < speck.size(); ++next) {
    for_neighbours(field, speck[next], 1, [&](std::size_t i) {
      if (field.values[i] >= level && std::ranges::find(speck, i) == speck.end())
        speck.push_back(i);
    });
    if (speck.size() > kMostSpeck) return {};
  }
  return speck;
}

/// A quadratic through the pixels around a hole, or their median where it has too few.
double filled(const Field& field, std::size_t hole) {
  const FilmPoint middle = pixel_centre(field, hole);
  NormalEquations<6> normal(6);
  std::vector<double> around;
  for_neighbours(field, hole, 2, [&](std::size_t i) {
    if (std::isnan(field.values[i])) return;
    const FilmPoint place = pixel_centre(field, i);
    const double x = place.x - middle.x, y = place.y - middle.y;
    normal.add({1, x, y, x * x, x * y, y * y}, 1, field.values[i]);
    around.push_back(field.values[i]);
  });
  if (around.empty()) return kNaN;
  constexpr std::size_t kEnough = 12;
  return around.size() >= kEnough && normal.factorise() ? normal.solution()[0] : median(around);
}

/// Grows regions again and again without clearing a whole picture each time.
class Regions {
 public:
  explicit Regions(const Field& field) : field_(field), seen_(field.values.size(), 0) {}

  struct Region {
    std::vector<std::size_t> pixels;
    std::optional<std::size_t>
        brighter;  ///< a pixel brighter than the start: then it is not complete
  };
  Region grow(std::size_t start, double level) {
    ++round_;
    Region region{{start}, {}};
    seen_[start] = round_;
    for (std::size_t next = 0; next < region.pixels.size() && !region.brighter; ++next)
      for_neighbours(field_, region.pixels[next], 1, [&](std::size_t i) {
        if (!(field_.values[i] >= level) || seen_[i] == round_) return;
        seen_[i] = round_;
        region.pixels.push_back(i);
        // The first of equal pixels is the peak.
        if (field_.values[i] > field_.values[start] ||
            (field_.values[i] == field_.values[start] && i < start))
          region.brighter = i;
      });
    visits_ += region.pixels.size();
    return region;
  }
  std::size_t visits() const { return visits_; }

 private:
  const Field& field_;
  std::vector<std::uint32_t> seen_;
  std::uint32_t round_ = 0;
  std::size_t visits_ = 0;
};

/// Looks for blobs from their peaks downward.
class Search {
 public:
  /// `finite` are the values of the field, `noise` is that of its brighter pixels.
  Search(const Field& soft, std::vector<double> finite, double noise)
      : soft_(soft), regions_(soft), noise_(noise) {
    typical_ = median(finite);
    const auto dark = finite.begin() + std::ptrdiff_t(finite.size() / 10);
    std::nth_element(finite.begin(), dark, finite.end());
    dark_ = *dark;
  }
  double typical() const { return typical_; }
  double dark() const { return dark_; }  ///< a tenth of the picture is darker
  bool has_worked_enough() const {
    return regions_.visits() + kVisitsOfARing * rings_ >
           kVisits + kVisitsPerPixel * soft_.values.size();
  }

  /// Nothing if the peak is a part of a brighter one, which then is `brighter`, or does not stand out.
  std::optional<FoundBlob> down_from(std::size_t peak, std::optional<std::size_t>& brighter) {
    // Above that depth there are the bumps of noise.
    const double top = soft_.values[peak], whole = top - dark_;
    for (double depth = std::max(whole * kFirstDepth, 3 * noise_); depth <= whole;
         depth *= kDeeper) {
      const double level = top - depth;
      const auto region = regions_.grow(peak, level);
      brighter = region.brighter;
      if (brighter) return std::nullopt;
      const auto background = around(region.pixels);
      if (!(level <= (top + background.value) / 2)) continue;
      if (auto blob = settled(peak, background.value)) return blob;
    }
    return std::nullopt;
  }

 private:
  BlobBackground around(const std::vector<std::size_t>& region) {
    ++rings_;
    const Axes axes = principal_axes_of(region);
    auto background =
        background_around(soft_, axes.centre, std::max(1.0, 2 * axes.major_sigma), kMostOfARing);
    if (background) return *background;
    BlobBackground level;
    level.value = typical_;
    return level;
  }
  Axes principal_axes_of(const std::vector<std::size_t>& region) const {
    double lowest = kInfinity, highest = -kInfinity;
    for (const std::size_t i : region) {
      lowest = std::min(lowest, soft_.values[i]);
      highest = std::max(highest, soft_.values[i]);
    }
    // Counts the lowest pixels too, and a level plateau.
    return principal_axes(soft_, region,
                          lowest - std::max(highest - lowest, 1e-9 * std::abs(highest) + 1e-300));
  }

  /// The region above half of the height; its background and its half define each other.
  std::optional<FoundBlob> settled(std::size_t peak, double base) {
    const double top = soft_.values[peak];
    FoundBlob blob;
    double spread = 0;
    for (int round = 0; round < 4; ++round) {
      if (!(top > base)) return std::nullopt;
      auto region = regions_.grow(peak, (top + base) / 2);
      if (region.brighter) return std::nullopt;
      blob.region = std::move(region.pixels);
      blob.axes = principal_axes(soft_, blob.region, base);
      const BlobBackground background = around(blob.region);
      base = background.value;
      spread = background.spread;
    }
    blob.background = base;
    blob.height = top - base;
    if (!(blob.height > kStandsOut * spread + kRounding * std::abs(top))) return std::nullopt;
    return blob;
  }

  const Field& soft_;
  Regions regions_;
  double noise_ = 0, typical_ = 0, dark_ = 0;
  std::size_t rings_ = 0;
};

struct Brighter {
  double height;  ///< the highest value over the typical one
  double noise;   ///< of the pixels above a quarter of that
};
Brighter brighter_pixels(const Field& field, double typical) {
  double highest = typical;
  for (const double value : field.values)
    if (value > highest) highest = value;
  std::vector<std::size_t> bright;
  for (std::size_t i = 0; i < field.values.size(); ++i)
    if (field.values[i] > typical + (highest - typical) / 4) bright.push_back(i);
  const double noise = scatter_of(field, bright);
  return {highest - typical, std::isnan(noise) ? 0 : noise};
}

std::size_t index_at(const Field& field, FilmPoint place) {
  const int x = std::clamp(int(std::floor(place.x)), 0, field.width - 1);
  const int y = std::clamp(int(std::floor(place.y)), 0, field.height - 1);
  return field.index(x, y);
}

/// From a pixel up to a local maximum, and on to the highest peak of the same blob.
std::optional<FoundBlob> blob_above(const Field& soft, Search& search, std::size_t pixel) {
  for (;;) {
    std::size_t highest = pixel;
    for_neighbours(soft, pixel, 1, [&](std::size_t i) {
      if (soft.values[i] > soft.values[highest]) highest = i;
    });
    if (highest != pixel) {
      pixel = highest;
      continue;
    }
    std::optional<std::size_t> brighter;
    auto blob = search.down_from(pixel, brighter);
    if (!brighter) return blob;
    pixel = *brighter;
  }
}

bool holds(const Field& field, const FoundBlob& blob, FilmPoint place) {
  return std::ranges::find(blob.region, index_at(field, place)) != blob.region.end();
}

/// All blobs, the highest first.
std::vector<FoundBlob> all_blobs(const Field& soft, Search& search, double least_share, bool& cut) {
  std::vector<std::size_t> peaks;
  for (std::size_t i = 0; i < soft.values.size(); ++i)
    if (is_local_maximum(soft, i)) peaks.push_back(i);
  std::ranges::sort(peaks, [&](std::size_t a, std::size_t b) {
    return soft.values[a] != soft.values[b] ? soft.values[a] > soft.values[b] : a < b;
  });
  std::vector<FoundBlob> blobs;
  std::vector<bool> taken(soft.values.size(), false);
  double highest = 0;
  for (const std::size_t peak : peaks) {
    if (!(soft.values[peak] - search.dark() > least_share * highest)) break;
    if (taken[peak]) continue;
    if ((cut = search.has_worked_enough())) break;
    std::optional<std::size_t> brighter;
    auto blob = search.down_from(peak, brighter);
    if (!blob) continue;
    for (const std::size_t i : blob->region) taken[i] = true;
    highest = std::max(highest, blob->height);
    blobs.push_back(std::move(*blob));
  }
  std::erase_if(blobs,
                [&](const FoundBlob& blob) { return !(blob.height >= least_share * highest); });
  std::ranges::stable_sort(blobs, std::ranges::greater{}, &FoundBlob::height);
  return blobs;
}

}  // namespace

std::vector<Speck> take_specks(Field& field) {
  std::vector<Speck> specks;
  std::vector<std::size_t> holes;
  std::vector<bool> is_hole(field.values.size(), false);
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    if (is_hole[i] || !is_local_maximum(field, i)) continue;
    const std::vector<std::size_t> pixels = speck_at(field, i);
    if (pixels.empty()) continue;
    specks.push_back({pixel_centre(field, i), field.values[i], pixels});
    for (const std::size_t pixel : pixels) {
      if (!is_hole[pixel]) holes.push_back(pixel);
      is_hole[pixel] = true;
    }
  }
  for (const std::size_t hole : holes) field.values[hole] = kNaN;
  std::vector<double> values;
  for (const std::size_t hole : holes) values.push_back(filled(field, hole));
  for (std::size_t k = 0; k < holes.size(); ++k) field.values[holes[k]] = values[k];
  std::ranges::sort(specks, std::ranges::greater{}, &Speck::value);
  return specks;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::optional<BlobBackground> background_around(const Field& field, FilmPoint centre,
                                                double semi_axis, std::size_t most) {
  BlobBackground background;
  background.middle = centre;
  const double to = kRingTo * semi_axis;
  const auto bound = [](double value, int end) { return int(std::clamp(value, 0.0, double(end))); };
  const double area = kPi * (kRingTo * kRingTo - kRingFrom * kRingFrom) * semi_axis * semi_axis;
  const int step = std::max(1, int(std::sqrt(area / double(most))));
  std::vector<double> values;
  for (int j = bound(centre.y - to, field.height); j < bound(centre.y + to + 1, field.height);
       j += step)
    for (int i = bound(centre.x - to, field.width); i < bound(centre.x + to + 1, field.width);
         i += step) {
      const double away = distance({i + 0.5, j + 0.5}, centre);
      if (!(away >= kRingFrom * semi_axis && away < to) || std::isnan(field.at(i, j))) continue;
      background.ring.push_back(field.index(i, j));
      values.push_back(field.at(i, j));
    }
  if (values.size() < kFewestRingPixels) return std::nullopt;
  const auto spread_about = [](std::vector<double> deviations, double middle) {
    for (double& one : deviations) one = std::abs(one - middle);
    return kDeviation * median(std::move(deviations));
  };
  background.value = median(values);
  background.spread = spread_about(values, background.value);
  // A ring that the border cuts does not tell the slope beneath its middle.
  FilmPoint mean;
  for (const std::size_t i : background.ring) {
    mean.x += pixel_centre(field, i).x / double(values.size());
    mean.y += pixel_centre(field, i).y / double(values.size());
  }
  if (!(background.spread > 0) || distance(mean, centre) > semi_axis / 2) return background;

  // Tukey's biweight: what is far from the plane has no weight.
  constexpr double kTukey = 4.685;
  constexpr int kRounds = 8;
  std::array<double, 3> plane{background.value, 0, 0};
  double spread = background.spread;
  const auto residual = [&](std::size_t k) {
    const FilmPoint place = pixel_centre(field, background.ring[k]);
    return values[k] - plane[0] - plane[1] * (place.x - centre.x) / to -
           plane[2] * (place.y - centre.y) / to;
  };
  std::vector<double> flat(values.size());
  for (int round = 0; round < kRounds && spread > 0; ++round) {
    NormalEquations<3> normal(3);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double share = residual(k) / (kTukey * spread);
      if (std::abs(share) >= 1) continue;
      const FilmPoint place = pixel_centre(field, background.ring[k]);
      const double weight = (1 - share * share) * (1 - share * share);
      normal.add({1, (place.x - centre.x) / to, (place.y - centre.y) / to}, weight, values[k]);
    }
    if (!normal.factorise()) return background;
    plane = normal.solution();
    for (std::size_t k = 0; k < values.size(); ++k) flat[k] = residual(k);
    spread = spread_about(flat, median(flat));
  }
  // A plane that explains little is noise itself.
  constexpr double kWorthwhile = 0.8;
  if (!(spread < kWorthwhile * background.spread)) return background;
  background.value = plane[0] + median(flat);
  background.slope = {plane[1] / to, plane[2] / to};
  background.spread = spread;
  return background;
}

FoundBlobs find_blobs(Field field, const BlobSearch& search) {
  FoundBlobs found;
  found.specks = take_specks(field);
  found.field = std::move(field);
  std::vector<double> finite;
  for (const double value : found.field.values)
    if (!std::isnan(value)) finite.push_back(value);
  if (finite.empty()) return found;
  const Brighter bright = brighter_pixels(found.field, median(finite));
  const int passes = bright.height > 0 ? passes_for(bright.noise / bright.height) : 0;
  const Field soft = softened(found.field, passes);
  Search down(soft, std::move(finite), bright.noise / std::sqrt(2 * kPi * std::max(passes, 1)));
  if (search.at) {
    auto blob = blob_above(soft, down, index_at(soft, *search.at));
    if (!blob || !holds(soft, *blob, *search.at)) {
      std::vector<FoundBlob> blobs = all_blobs(soft, down, 0, found.cut);
      if (blob) blobs.push_back(std::move(*blob));
      const auto nearest = std::ranges::min_element(blobs, {}, [&](const FoundBlob& one) {
        return distance(pixel_centre(soft, one.region.front()), *search.at);
      });
      if (nearest != blobs.end()) blob = std::move(*nearest);
    }
    if (blob) found.blobs.push_back(std::move(*blob));
  } else {
    found.blobs = all_blobs(soft, down, search.least_share, found.cut);
  }
  const double highest = found.blobs.empty() ? 0 : found.blobs.front().height;
  std::erase_if(found.specks, [&](const Speck& speck) {
    return !(speck.value - down.typical() > search.least_share * highest);
  });
  if (found.blobs.size() > kMostBlobs) {
    found.left_out = found.blobs.size() - kMostBlobs;
    found.blobs.resize(kMostBlobs);
  }
  return found;
}

}  // namespace lobelia

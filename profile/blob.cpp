#include "profile/blob.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/system/error.hpp"
#include "profile/clipping.hpp"
#include "profile/measure_blob.hpp"
#include "profile/measure_noise.hpp"

namespace lobelia {
namespace {

// In half-widths. A Gaussian falls to 1/1000 there.
const double kZoneReach = std::sqrt(-std::log2(kZoneShares.back()));
constexpr double kCurveStep = 0.5;
constexpr double kMostOffsets = 500;  // on each side

/// A picture while it is measured.
struct Measured {
  std::size_t not_finite = 0;
  FoundBlobs found;
  std::vector<BlobFigures> blobs;
};

void leave_only(Field& field, const PixelWindow& region) {
  for (int y = 0; y < field.height; ++y)
    for (int x = 0; x < field.width; ++x)
      if (x < region.x || y < region.y || x >= region.x + region.width ||
          y >= region.y + region.height)
        field.values[field.index(x, y)] = kNaN;
}

Measured measure_picture(const Image& image, const BlobOptions& options,
                         const PictureNoise* noise) {
  Measured measured;
  Field field = radiance_field(image);
  measured.not_finite = std::size_t(
      std::ranges::count_if(field.values, [](double value) { return std::isnan(value); }));
  if (options.region) leave_only(field, *options.region);
  measured.found = find_blobs(std::move(field), options.search);
  std::optional<Field> errors;
  if (noise) errors = radiance_errors(*noise);
  const BlobSource source{&image,
                          &measured.found,
                          options.region.value_or(PixelWindow{0, 0, image.width(), image.height()}),
                          errors ? &*errors : nullptr,
                          noise && noise->shared,
                          largest_values(image, measured.found.specks),
                          StoredSteps(image)};
  for (std::size_t k = 0; k < measured.found.blobs.size(); ++k) {
    measured.blobs.push_back(measure_blob(source, measured.found.blobs[k], k));
    measured.blobs.back().not_finite = measured.not_finite;
  }
  return measured;
}

std::string why_nothing(const Measured& measured, std::size_t pixels) {
  if (measured.not_finite == pixels) return "no pixel is finite";
  if (measured.found.specks.empty())
    return "nothing stands out: no pixel is brighter than its surroundings";
  const Speck& speck = measured.found.specks.front();
  return fmt::format(
      "nothing stands out but {} at ({:g}, {:g}): a fault of the picture, or a highlight smaller "
      "than a pixel",
      speck.pixels.size() == 1 ? "a single pixel" : fmt::format("{} pixels", speck.pixels.size()),
      speck.place.x, speck.place.y);
}

/// The long semi-axis.
double size_of(const BlobFigures& blob) {
  return std::isnan(blob.major_half_width) ? 2 * blob.axes.major_sigma : blob.major_half_width;
}

/// How little a blob of b looks like one of a; nothing if they are too far apart. A distance of their size counts as much as
/// a brightness that is e times another.
std::optional<double> mismatch(const BlobFigures& a, const BlobFigures& b) {
  constexpr double kFarthest = 2, kPixels = 2;
  const double away = distance(a.peak.place, b.peak.place);
  const double size = kPixels + std::max(size_of(a), size_of(b));
  if (!(away <= kFarthest * size)) return std::nullopt;
  return away / size + std::abs(std::log(a.peak.value / b.peak.value));
}

/// The place in `b` of each blob of `a`. The closest pairs come first.
std::vector<std::optional<std::size_t>> matches(const std::vector<BlobFigures>& a,
                                                const std::vector<BlobFigures>& b) {
  struct Pair {
    double mismatch;
    std::size_t a, b;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      if (const auto apart = mismatch(a[i], b[j])) pairs.push_back({*apart, i, j});
  std::ranges::stable_sort(pairs, {}, &Pair::mismatch);
  std::vector<std::optional<std::size_t>> result(a.size());
  std::vector<bool> taken(b.size(), false);
  for (const Pair& pair : pairs) {
    if (result[pair.a] || taken[pair.b]) continue;
    result[pair.a] = pair.b;
    taken[pair.b] = true;
  }
  return result;
}

/// The reach of the zones from the peak, pixels.
double reach_of(const BlobFigures& blob) { return kZoneReach * size_of(blob); }

records::Named<records::BlobCurve> curves_along(const BlobFigures& blob, const NamedImages& images,
                                                const std::vector<const Field*>& fields) {
  const double reach = reach_of(blob), step = std::max(kCurveStep, reach / kMostOffsets);
  const FilmPoint major = blob.axes.major, minor{-major.y, major.x};
  records::Named<records::BlobCurve> curves;
  for (const auto& [axis, direction] : {std::pair{"major", major}, std::pair{"minor", minor}}) {
    records::BlobCurve& curve = curves.emplace_back(axis, records::BlobCurve{}).second;
    for (const auto& [name, image] : images)
      curve.radiance.emplace_back(name, std::vector<double>());
    const int steps = int(std::ceil(reach / step));
    for (int k = -steps; k <= steps; ++k) {
      curve.offset_pixels.push_back(k * step);
      for (std::size_t image = 0; image < fields.size(); ++image)
        curve.radiance[image].second.push_back(
            sample(*fields[image], {blob.peak.place.x + k * step * direction.x,
                                    blob.peak.place.y + k * step * direction.y}));
    }
  }
  return curves;
}

/// A pixel near the peak belongs to a zone by the reference's share of its peak there.
ZoneErrors difference_of(const Field& a, const Field& b, const BlobFigures& reference) {
  ZoneErrorSums sums;
  const double reach = reach_of(reference);
  for (std::size_t i = 0; i < b.values.size(); ++i) {
    if (distance(pixel_centre(b, i), reference.peak.place) > reach) continue;
    const double share = (b.values[i] - reference.background) / reference.peak.value;
    const auto zone =
        std::ranges::find_if(kZoneShares, [&](double least) { return share >= least; });
    if (zone != kZoneShares.end())
      sums.add(std::size_t(zone - kZoneShares.begin()), a.values[i] - b.values[i]);
  }
  return sums.errors(reference.peak.value);
}

void require_in_picture(const BlobOptions& options, const Image& image) {
  const auto size = [&] { return fmt::format("{} x {}", image.width(), image.height()); };
  if (const auto& at = options.search.at;
      at && !(at->x >= 0 && at->y >= 0 && at->x <= image.width() && at->y <= image.height()))
    throw Error(ExitCode::kInput,
                "the place ({:g}, {:g}) is outside of the picture, "
                "which has {} pixels",
                at->x, at->y, size());
  if (const auto& r = options.region;
      r && !(r->x >= 0 && r->y >= 0 && r->width >= 1 && r->height >= 1 && r->x < image.width() &&
             r->y < image.height() && r->width <= image.width() - r->x &&
             r->height <= image.height() - r->y))
    throw Error(ExitCode::kInput,
                "the region {},{},{},{} is not inside the picture, which has {} pixels", r->x, r->y,
                r->width, r->height, size());
}

}  // namespace

BlobProfiles measure_blobs(const NamedImages& images, const BlobOptions& options) {
  const Image& first = *images.front().second;
  require_in_picture(options, first);
  BlobProfiles all;
  std::vector<Measured> pictures;
  std::vector<const Field*> fields;
  pictures.reserve(images.size());
  for (const auto& [name, image] : images) {
    if (image->width() != first.width() || image->height() != first.height())
      throw Error(ExitCode::kInput, "{} has {} x {} pixels, {} has {} x {}", images.front().first,
                  first.width(), first.height(), name, image->width(), image->height());
    const std::size_t k = pictures.size();
    const PictureNoise* noise = k < options.noise.size() ? options.noise[k] : nullptr;
    pictures.push_back(measure_picture(*image, options, noise));
    const FoundBlobs& found = pictures.back().found;
    fields.push_back(&found.field);
    all.pictures.push_back({name, found.specks, found.left_out, found.cut, noise != nullptr});
  }

  // By picture, the place of the highlight among its own.
  std::vector<std::vector<std::optional<std::size_t>>> places;
  for (std::size_t i = 0; i < pictures[0].blobs.size(); ++i) places.push_back({i});
  if (pictures.size() > 1) {
    const auto found = matches(pictures[0].blobs, pictures[1].blobs);
    for (std::size_t i = 0; i < found.size(); ++i) places[i].push_back(found[i]);
    for (std::size_t j = 0; j < pictures[1].blobs.size(); ++j)
      if (std::ranges::find(found, std::optional(j)) == found.end())
        places.push_back({std::nullopt, j});
  }
  if (places.empty()) places.emplace_back(pictures.size());

  for (const auto& place : places) {
    BlobProfile profile;
    profile.id = all.highlights.size() + 1;
    const BlobFigures* reference = nullptr;
    bool everywhere = pictures.size() > 1;
    for (std::size_t k = 0; k < pictures.size(); ++k) {
      profile.names.push_back(images[k].first);
      const Measured& picture = pictures[k];
      if (!place[k]) {
        profile.blobs.push_back(no_blob(picture.blobs.empty()
                                            ? why_nothing(picture, first.pixel_count())
                                            : "no highlight of it is near and as bright"));
        profile.blobs.back().not_finite = picture.not_finite;
        everywhere = false;
        continue;
      }
      profile.blobs.push_back(picture.blobs[*place[k]]);
      reference = &picture.blobs[*place[k]];
    }
    if (reference) profile.curves = curves_along(*reference, images, fields);
    if (everywhere) profile.difference = difference_of(*fields[0], *fields[1], *reference);
    all.highlights.push_back(std::move(profile));
  }
  return all;
}

}  // namespace lobelia

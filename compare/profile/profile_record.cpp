// Profiles with and without a scene as their records.
#include <cmath>
#include <numbers>

#include "compare/profile/blob.hpp"
#include "core/constants.hpp"

namespace lobelia {
namespace {

constexpr double kDegrees = 180 / kPi;
static_assert(kZoneCount == 3, "records/profile.hpp names the zones");

std::vector<double> scaled(std::vector<double> values, double scale) {
  for (double& value : values) value *= scale;
  return values;
}

records::Point point_record(FilmPoint point) { return {point.x, point.y}; }

records::Peak peak_record(const Peak& peak) {
  return {peak.place.x, peak.place.y, peak.value,
          std::string(records::kPeakFound[std::size_t(peak.found)])};
}

records::ZoneErrors zones_record(const ZoneErrors& zones) { return {zones[0], zones[1], zones[2]}; }

records::HalfWidth half_width_record(const HalfWidth& width) {
  return {width.pixels, width.angle * kDegrees};
}

records::HighlightFigures figures_record(const HighlightFigures& figures) {
  records::HighlightFigures record;
  record.peak = peak_record(figures.peak);
  record.centroid = point_record(figures.centroid);
  record.half_width_along = half_width_record(figures.along);
  record.half_width_across = half_width_record(figures.across);
  record.energy = figures.energy;
  const CosineFit& cosine = figures.cosine;
  records::CosineLobe& lobe = record.cosine_lobe;
  lobe.because = cosine.why_not;
  if (cosine.why_not.empty()) {
    lobe.exponent = cosine.exponent;
    lobe.standard_error = cosine.standard_error;
    lobe.coefficient = cosine.coefficient;
    lobe.rms_of_peak = cosine.residual;
    lobe.pixels = cosine.pixels;
  }
  record.because = figures.why_not;
  return record;
}

// Standard deviation of a Gaussian over its half-width.
const double kSigma = 1 / std::sqrt(2 * std::numbers::ln2);

records::BlobFigures figures_record(const BlobFigures& blob) {
  records::BlobFigures record;
  record.peak = peak_record(blob.peak);
  record.background = blob.background;
  record.pixels = blob.pixels;
  record.centroid = point_record(blob.axes.centre);
  record.major_axis = point_record(blob.axes.major);
  record.half_width_pixels = {blob.major_half_width, blob.minor_half_width};
  record.gaussian_sigma_pixels = {kSigma * blob.major_half_width, kSigma * blob.minor_half_width};
  record.energy = blob.energy;
  record.nonfinite = blob.not_finite;
  record.because = blob.why_not;
  record.remark = blob.remark;
  return record;
}

}  // namespace

records::Profile profile_record(const Profile& profile, int light, int sphere,
                                const std::string& angle_name) {
  records::Profile record;
  record.light = light;
  record.sphere = sphere;
  record.angle = angle_name;
  const auto range = [&](std::size_t zone) {
    return std::array{zone == 0 ? 0 : profile.ends[zone - 1] * kDegrees,
                      profile.ends[zone] * kDegrees};
  };
  record.zones = {range(0), range(1), range(2)};
  if (profile.incidence) record.plane_of_incidence = point_record(*profile.incidence);
  record.curve.angle_degrees = scaled(profile.angle, kDegrees);
  record.curve.pixels = profile.pixels;
  for (std::size_t k = 0; k < profile.names.size(); ++k) {
    const HighlightShape& shape = profile.shapes[k];
    record.curve.radiance.emplace_back(profile.names[k], profile.radiance[k]);
    records::HighlightShape& one =
        record.images.emplace_back(profile.names[k], records::HighlightShape{}).second;
    one.peak = shape.peak;
    one.peak_angle_degrees = shape.peak_angle * kDegrees;
    one.half_width_degrees = shape.half_width * kDegrees;
    one.energy = shape.energy;
    if (!profile.figures.empty()) one.highlight = figures_record(profile.figures[k]);
  }
  for (const ProfileDifference& difference : profile.differences)
    record.differences.emplace_back(difference.a + "-" + difference.b,
                                    zones_record(difference.zones));
  return record;
}

records::Blob blob_record(const BlobProfile& profile) {
  records::Blob record;
  record.reference = profile.names.back();
  record.zones = {kZoneShares[0], kZoneShares[1], kZoneShares[2]};
  for (std::size_t k = 0; k < profile.names.size(); ++k)
    record.images.emplace_back(profile.names[k], figures_record(profile.blobs[k]));
  for (const BlobCurve& curve : profile.curves) {
    records::BlobCurve& columns =
        record.curves.emplace_back(curve.axis, records::BlobCurve{}).second;
    columns.offset_pixels = curve.offset;
    for (std::size_t k = 0; k < profile.names.size(); ++k)
      columns.radiance.emplace_back(profile.names[k], curve.radiance[k]);
  }
  if (profile.difference)
    record.differences.emplace_back(profile.names[0] + "-" + profile.names[1],
                                    zones_record(*profile.difference));
  return record;
}

}  // namespace lobelia

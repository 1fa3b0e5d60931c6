// A profile without a scene as its record.
#include <cmath>
#include <numbers>

#include "compare/profile/blob.hpp"
#include "compare/profile/record_parts.hpp"

namespace lobelia {
namespace {

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

records::Blob blob_record(const BlobProfile& profile) {
  records::Blob record;
  record.reference = profile.names.back();
  record.zones = {kZones[0].lobe, kZones[1].lobe, kZones[2].lobe};
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

// A profile without a scene as its record, docs/records.md.
#include <cmath>
#include <numbers>
#include <utility>

#include "compare/profile/blob.hpp"
#include "compare/profile/record_parts.hpp"

namespace lobelia {
namespace {

// Standard deviation of a Gaussian over its half-width.
const double kSigma = 1 / std::sqrt(2 * std::numbers::ln2);

Json pair_json(double major, double minor) {
  return {{"major", number_or_name(major)}, {"minor", number_or_name(minor)}};
}

Json blob_json(const BlobFigures& blob) {
  Json record = {{"peak", peak_json(blob.peak)},
                 {"background", number_or_name(blob.background)},
                 {"pixels", blob.pixels},
                 {"centroid", point_json(blob.axes.centre)},
                 {"majorAxis", point_json(blob.axes.major)},
                 {"halfWidthPixels", pair_json(blob.major_half_width, blob.minor_half_width)},
                 {"gaussianSigmaPixels",
                  pair_json(kSigma * blob.major_half_width, kSigma * blob.minor_half_width)},
                 {"energy", number_or_name(blob.energy)},
                 {"nonfinite", blob.not_finite}};
  if (!blob.why_not.empty()) record["because"] = blob.why_not;
  if (!blob.remark.empty()) record["remark"] = blob.remark;
  return record;
}

}  // namespace

Json blob_record(const BlobProfile& profile) {
  Json record = make_record("blob");
  record["reference"] = profile.names.back();
  for (const Zone& zone : kZones) record["zones"][zone.name] = zone.lobe;
  Json images = Json::object(), curves = Json::object();
  for (std::size_t k = 0; k < profile.names.size(); ++k)
    images[profile.names[k]] = blob_json(profile.blobs[k]);
  for (const BlobCurve& curve : profile.curves) {
    Json& columns = curves[curve.axis];
    columns["offsetPixels"] = curve.offset;
    for (std::size_t k = 0; k < profile.names.size(); ++k) {
      columns[profile.names[k]] = Json::array();
      for (const double value : curve.radiance[k])
        columns[profile.names[k]].push_back(number_or_name(value));
    }
  }
  record["images"] = std::move(images);
  record["curves"] = std::move(curves);
  record["differences"] = Json::object();
  if (profile.difference)
    record["differences"][profile.names[0] + "-" + profile.names[1]] =
        zones_json(*profile.difference);
  return record;
}

}  // namespace lobelia

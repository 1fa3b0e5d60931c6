// Profiles with and without a scene as their records.
#include <cmath>
#include <numbers>

#include "base/words/constants.hpp"
#include "profile/blob.hpp"

namespace lobelia {
namespace {

constexpr double kDegrees = 180 / kPi;
static_assert(kZoneCount == 3, "base/records/profile.hpp names the zones");

std::vector<double> scaled(std::vector<double> values, double scale) {
  for (double& value : values) value *= scale;
  return values;
}

records::Peak peak_record(const Peak& peak) {
  return {peak.place.x, peak.place.y, peak.value,
          std::string(records::kPeakFound[std::size_t(peak.found)])};
}

records::ZoneErrors zones_record(const ZoneErrors& zones) { return {zones[0], zones[1], zones[2]}; }

records::HalfWidth half_width_record(const HalfWidth& width) {
  return {width.pixels, width.angle * kDegrees};
}

records::LobeExplanation explanation_record(const FamilyFit& family) {
  records::LobeExplanation record;
  record.family = records::kLobeFamilies[std::size_t(family.family)];
  record.times_n_dot_l = family.times_n_dot_l;
  record.because = family.fit.why_not;
  if (!family.fit.why_not.empty()) return record;
  if (family.family == FittedFamily::kGgx || family.family == FittedFamily::kBeckmann) {
    record.alpha = family.fit.width;
    record.roughness = std::sqrt(family.fit.width);
  } else {
    record.exponent = family.fit.width;
  }
  record.standard_error = family.fit.standard_error;
  record.coefficient = family.fit.coefficient;
  record.rms_of_peak = family.fit.residual;
  if (!std::isnan(family.noise_share)) record.rms_of_noise = family.noise_share;
  record.deviations_from_best = family.apart;
  return record;
}

records::HighlightFigures figures_record(const HighlightFigures& figures) {
  records::HighlightFigures record;
  record.peak = peak_record(figures.peak);
  record.centroid = figures.centroid;
  record.half_width_along = half_width_record(figures.along);
  record.half_width_across = half_width_record(figures.across);
  record.energy = figures.energy;
  const LobeFit& cosine = figures.cosine;
  records::CosineLobe& lobe = record.cosine_lobe;
  lobe.because = cosine.why_not;
  if (cosine.why_not.empty()) {
    lobe.exponent = cosine.width;
    lobe.standard_error = cosine.standard_error;
    lobe.coefficient = cosine.coefficient;
    lobe.rms_of_peak = cosine.residual;
    lobe.pixels = cosine.pixels;
  }
  record.because = figures.why_not;
  for (const FamilyFit& family : figures.explanations)
    record.explanations.push_back(explanation_record(family));
  if (!figures.explanations.empty())
    record.pixels_show = records::kPixelsShow[std::size_t(figures.pixels)];
  record.standard_errors = figures.errors;
  return record;
}

records::Falloff falloff_record(const FalloffFit& fit) {
  return {std::string(records::kFalloffs[std::size_t(fit.family)]),
          fit.peak,
          fit.major_half_width,
          fit.minor_half_width,
          fit.place,
          fit.residual,
          fit.pixels,
          fit.why_not};
}

// Standard deviation of a Gaussian over its half-width.
const double kSigma = 1 / std::sqrt(2 * std::numbers::ln2);

records::BlobFigures figures_record(const BlobFigures& blob) {
  records::BlobFigures record;
  record.peak = peak_record(blob.peak);
  record.background = blob.background;
  record.pixels = blob.pixels;
  record.centroid = blob.axes.centre;
  record.major_axis = blob.axes.major;
  record.half_width_pixels = {blob.major_half_width, blob.minor_half_width};
  record.gaussian_sigma_pixels = {kSigma * blob.major_half_width, kSigma * blob.minor_half_width};
  record.energy = blob.energy;
  record.nonfinite = blob.not_finite;
  record.because = blob.why_not;
  record.remark = blob.remark;
  if (!blob.why_not.empty()) return record;
  record.standard_errors = blob.errors;
  if (std::isfinite(blob.noise)) record.noise_of_peak = blob.noise;
  record.colour = records::Colour{blob.colour[0], blob.colour[1], blob.colour[2]};
  if (blob.clipped)
    record.clipped = records::Clipping{blob.clipped->pixels, blob.clipped->channels,
                                       blob.peak.value, falloff_record(blob.clipped->flank)};
  for (const FalloffFit& fit : blob.falloff) record.falloff.push_back(falloff_record(fit));
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
  record.plane_of_incidence = profile.incidence;
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
  record.id = profile.id;
  record.reference = profile.names.back();
  record.zones = {kZoneShares[0], kZoneShares[1], kZoneShares[2]};
  for (std::size_t k = 0; k < profile.names.size(); ++k)
    record.images.emplace_back(profile.names[k], figures_record(profile.blobs[k]));
  record.curves = profile.curves;
  if (profile.difference)
    record.differences.emplace_back(profile.names[0] + "-" + profile.names[1],
                                    zones_record(*profile.difference));
  return record;
}

records::Blobs blobs_record(const BlobProfiles& profiles, double least_share) {
  constexpr std::size_t kMostSpecks = 16;
  records::Blobs record;
  record.least_share = least_share;
  for (const BlobPicture& picture : profiles.pictures) {
    records::BlobPicture& one =
        record.pictures.emplace_back(picture.name, records::BlobPicture{}).second;
    one.standard_errors_from = noise_source(picture.noise_is_given);
    for (const Speck& speck : picture.specks) {
      if (one.specks.size() == kMostSpecks) break;
      one.specks.push_back({speck.place, speck.value, speck.pixels.size()});
    }
    one.more_specks = picture.specks.size() - one.specks.size();
    one.more_highlights = picture.left_out;
    one.may_have_more = picture.cut;
  }
  for (const BlobProfile& profile : profiles.highlights)
    record.highlights.push_back(blob_record(profile));
  return record;
}

}  // namespace lobelia

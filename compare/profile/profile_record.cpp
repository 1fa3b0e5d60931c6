// A profile as its record, docs/records.md.
#include <fmt/format.h>

#include <numbers>
#include <utility>

#include "compare/profile/profile.hpp"
#include "compare/profile/record_parts.hpp"

namespace lobelia {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

Json numbers(const std::vector<double>& values, double scale) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number_or_name(value * scale));
  return list;
}

Json zone_json(const ZoneError& zone) {
  return {{"pixels", zone.pixels},
          {"maxAbs", number_or_name(zone.max_abs)},
          {"rms", number_or_name(zone.rms)},
          {"maxRelPeak", number_or_name(zone.max_rel_peak)}};
}

Json half_width_json(const HalfWidth& width) {
  return {{"pixels", number_or_name(width.pixels)},
          {"degrees", number_or_name(width.angle * kDegrees)}};
}

Json figures_json(const HighlightFigures& figures) {
  Json record = {{"peak", peak_json(figures.peak)},
                 {"centroid", point_json(figures.centroid)},
                 {"halfWidthAlong", half_width_json(figures.along)},
                 {"halfWidthAcross", half_width_json(figures.across)},
                 {"energy", number_or_name(figures.energy)}};
  const CosineFit& cosine = figures.cosine;
  if (cosine.why_not.empty())
    record["cosineLobe"] = {{"exponent", number_or_name(cosine.exponent)},
                            {"standardError", number_or_name(cosine.standard_error)},
                            {"coefficient", number_or_name(cosine.coefficient)},
                            {"rmsOfPeak", number_or_name(cosine.residual)},
                            {"pixels", cosine.pixels}};
  else
    record["cosineLobe"] = {{"because", cosine.why_not}};
  if (!figures.why_not.empty()) record["because"] = figures.why_not;
  return record;
}

}  // namespace

Json point_json(FilmPoint point) {
  return {{"x", number_or_name(point.x)}, {"y", number_or_name(point.y)}};
}

Json peak_json(const Peak& peak) {
  Json record = point_json(peak.place);
  record["radiance"] = number_or_name(peak.value);
  record["found"] = name(peak.found);
  return record;
}

Json zones_json(const std::array<ZoneError, kZoneCount>& zones) {
  Json record;
  for (std::size_t zone = 0; zone < kZoneCount; ++zone)
    record[kZones[zone].name] = zone_json(zones[zone]);
  return record;
}

Json profile_record(const Profile& profile, int light, int sphere, const std::string& angle_name) {
  Json record = make_record("profile");
  record["light"] = light;
  record["sphere"] = sphere;
  record["angle"] = angle_name;
  for (std::size_t zone = 0; zone < kZoneCount; ++zone)
    record["zones"][fmt::format("{}Degrees", kZones[zone].name)] = Json::array(
        {zone == 0 ? 0 : profile.ends[zone - 1] * kDegrees, profile.ends[zone] * kDegrees});
  if (profile.incidence) record["planeOfIncidence"] = point_json(*profile.incidence);
  Json curve = Json::object(), images = Json::object();
  curve["angleDegrees"] = numbers(profile.angle, kDegrees);
  curve["pixels"] = profile.pixels;
  for (std::size_t k = 0; k < profile.names.size(); ++k) {
    const HighlightShape& shape = profile.shapes[k];
    curve[profile.names[k]] = numbers(profile.radiance[k], 1);
    images[profile.names[k]] = {{"peak", number_or_name(shape.peak)},
                                {"peakAngleDegrees", number_or_name(shape.peak_angle * kDegrees)},
                                {"halfWidthDegrees", number_or_name(shape.half_width * kDegrees)},
                                {"energy", number_or_name(shape.energy)}};
    if (!profile.figures.empty())
      images[profile.names[k]]["highlight"] = figures_json(profile.figures[k]);
  }
  record["curve"] = std::move(curve);
  record["images"] = std::move(images);
  record["differences"] = Json::object();
  for (const ProfileDifference& difference : profile.differences)
    record["differences"][difference.a + "-" + difference.b] = zones_json(difference.zones);
  return record;
}

}  // namespace lobelia

// A profile as its record, docs/records.md.
#include <numbers>
#include <utility>

#include "compare/profile/profile.hpp"

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

}  // namespace

Json profile_record(const Profile& profile, int light, int sphere, const std::string& angle_name) {
  Json record = make_record("profile");
  record["light"] = light;
  record["sphere"] = sphere;
  record["angle"] = angle_name;
  const double epicentre = profile.epicentre_end * kDegrees;
  record["zones"]["epicentreDegrees"] = Json::array({0.0, epicentre});
  record["zones"]["bloomingDegrees"] = Json::array({epicentre, profile.blooming_end * kDegrees});
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
  }
  record["curve"] = std::move(curve);
  record["images"] = std::move(images);
  record["differences"] = Json::object();
  for (const ProfileDifference& difference : profile.differences)
    record["differences"][difference.a + "-" + difference.b] = {
        {"epicentre", zone_json(difference.epicentre)},
        {"blooming", zone_json(difference.blooming)}};
  return record;
}

}  // namespace lobelia

#include "gallery/cell_json.hpp"

#include "gallery/names.hpp"

namespace lobelia::gallery {
namespace {

Json picture_json(const Picture& picture) {
  if (!picture.shown()) return nullptr;
  const std::string& file = picture.is_published ? picture.file : picture.small.file;
  return {{"src", link_to({file})},
          {"small", link_to({picture.first_look().file})},
          {"width", picture.width},
          {"height", picture.height}};
}

Json optional_number(const std::optional<double>& value) {
  return value ? number_or_name(*value) : Json(nullptr);
}

Json numbers_json(const std::vector<double>& values) {
  Json result = Json::array();
  for (const double value : values) result.push_back(number_or_name(value));
  return result;
}

Json maps_json(const std::vector<PublishedMap>& maps) {
  Json result = Json::array();
  for (const PublishedMap& map : maps)
    result.push_back({{"id", map.id},
                      {"title", map.title},
                      {"meaning", map.meaning},
                      {"script", link_to({map.script})}});
  return result;
}

Json profile_json(const ProfileData& profile) {
  if (profile.degrees.empty() || !profile.problem.empty()) return nullptr;
  Json result = {{"angle", profile.angle}, {"degrees", numbers_json(profile.degrees)}};
  result["zones"] = Json::array();
  for (const ProfileZone& zone : profile.zones)
    result["zones"].push_back({{"title", zone.title},
                               {"from", number_or_name(zone.from)},
                               {"to", number_or_name(zone.to)}});
  result["curves"] = Json::array();
  for (const NamedCurve& curve : profile.curves)
    result["curves"].push_back({{"name", curve.name}, {"values", numbers_json(curve.values)}});
  return result;
}

}  // namespace

Json cell_json(const FarmData& farm, const CellEntry& entry, const CellData& cell) {
  Json data = {{"id", cell.id},
               {"label", entry.label},
               {"exposureStops", optional_number(cell.exposure_stops)}};
  data["engines"] = Json::array();
  for (const EngineEntry& engine : farm.engines) {
    const CellImage* image = cell.find_image(engine.name);
    data["engines"].push_back({{"name", engine.name},
                               {"title", engine.title},
                               {"shortTitle", engine.short_title},
                               {"picture", image ? picture_json(image->png) : Json(nullptr)},
                               {"floatScript", image && !image->float_script.empty()
                                                   ? Json(link_to({image->float_script}))
                                                   : Json(nullptr)}});
  }
  data["comparisons"] = Json::array();
  for (const CellComparison& comparison : cell.comparisons) {
    const auto x = comparison.metric("max_abs.x"), y = comparison.metric("max_abs.y");
    data["comparisons"].push_back({{"a", comparison.a},
                                   {"b", comparison.b},
                                   {"picture", picture_json(comparison.png)},
                                   {"whiteAt", optional_number(comparison.white_at)},
                                   {"relativeToPeak", optional_number(comparison.relative_to_peak)},
                                   {"maps", maps_json(comparison.maps)},
                                   {"worstX", optional_number(x)},
                                   {"worstY", optional_number(y)}});
  }
  data["profile"] = profile_json(cell.profile);
  return data;
}

}  // namespace lobelia::gallery

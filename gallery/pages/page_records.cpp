#include <algorithm>

#include "gallery/cells/cell_page.hpp"

namespace lobelia::gallery {
namespace {

std::optional<records::ShownPicture> shown_picture(const Picture& picture) {
  if (!picture.shown()) return std::nullopt;
  const std::string& file = picture.is_published ? picture.file : picture.small.file;
  return records::ShownPicture{link_to({file}), link_to({picture.preview().file}), picture.width,
                               picture.height};
}

records::ShownComparison shown_comparison(const CheckedComparison& comparison) {
  records::ShownComparison data;
  data.a = comparison.entry.a;
  data.b = comparison.entry.b;
  data.picture = shown_picture(comparison.png);
  data.white_at = comparison.entry.difference.white_at;
  data.maps = comparison.maps;
  for (records::ShownMap& map : data.maps) map.script = link_to({map.script});
  if (!comparison.region.empty()) data.region = link_to({comparison.region});
  data.worst_x = comparison.metric("max_abs.x");
  data.worst_y = comparison.metric("max_abs.y");
  return data;
}

std::optional<records::ShownProfile> shown_profile(const CheckedCell& cell) {
  if (!cell.profile || cell.profile->curve.angle_degrees.empty()) return std::nullopt;
  records::ShownProfile data{
      cell.profile->angle, cell.profile->curve.angle_degrees, zones_of(*cell.profile), {}, {}};
  for (const auto& [name, values] : cell.profile->curve.radiance)
    data.curves.push_back({name, values});
  return data;
}

}  // namespace

records::CellPage cell_page_data(const ShownFarm& farm, const CellEntry& entry,
                                 const CheckedCell& cell, const CheckedCell* before) {
  records::CellPage data;
  data.id = cell.id;
  data.label = entry.label;
  data.is_report = farm.is_report;
  data.exposure_stops = cell.record.exposure_stops;
  for (const records::FarmEngine& engine : farm.record.engines) {
    const EnginePicture* image = cell.find_image(engine.name);
    data.engines.push_back({engine.name, engine.title, farm.short_title(engine),
                            image ? shown_picture(image->png) : std::nullopt,
                            image ? link_to({image->float_script}) : "", ""});
  }
  // After all others, whose places are keys of the viewer.
  for (const EnginePicture& image : before ? before->images : std::vector<EnginePicture>()) {
    const auto now = std::ranges::find(data.engines, image.engine, &records::ShownEngine::name);
    if (now == data.engines.end() || !now->picture) continue;
    records::ShownEngine old{now->name + ".before",         now->title + ", before",
                             now->short_title + ", before", shown_picture(image.png),
                             link_to({image.float_script}), now->name};
    data.engines.push_back(std::move(old));
  }
  for (const CheckedComparison& comparison : cell.comparisons)
    data.comparisons.push_back(shown_comparison(comparison));
  data.profile = shown_profile(cell);
  return data;
}

}  // namespace lobelia::gallery

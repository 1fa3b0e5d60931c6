#include "gallery/grid_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "gallery/grid_layout.hpp"
#include "gallery/metric_notes.hpp"
#include "gallery/names.hpp"

namespace lobelia::gallery {
namespace {

/// Enough for a colour and a number on a page; 2000 cells of forty metrics stay under a megabyte or two.
double four_digits(double value) {
  return std::strtod(fmt::format("{:.4g}", value).c_str(), nullptr);
}

}  // namespace

Json grid_json(const FarmData& farm, const std::vector<CellSummary>& cells) {
  Json data = {{"axes", Json::array()}, {"engines", Json::array()}};
  for (const GridAxis& axis : farm.axes) {
    Json values = Json::array();
    for (const AxisValue& value : axis.values) values.push_back(value.label);
    data["axes"].push_back({{"name", axis.name}, {"values", values}});
  }
  for (const EngineEntry& engine : farm.engines) {
    if (engine.name == kOurEngine || !engine.available) continue;
    data["engines"].push_back(
        {{"name", engine.name}, {"title", engine.title}, {"shortTitle", engine.short_title}});
  }
  const GridLayout layout = lay_out(farm);
  data["layout"] = {{"rows", layout.rows}, {"groups", layout.groups}, {"columns", layout.columns}};
  data["statuses"] = Json::array();
  for (const CellStatus status : kCellStatuses) {
    const StatusInfo& s = info(status);
    data["statuses"].push_back({{"name", std::string(s.name)},
                                {"word", std::string(s.word)},
                                {"mark", std::string(s.mark)}});
  }
  // Metrics by column: a name stands once, not once a cell.
  std::map<std::string, std::size_t> column;
  Json metrics = Json::array();
  const auto column_of = [&](const std::string& id) {
    const auto [at, is_new] = column.emplace(id, column.size());
    if (is_new) {
      const MetricNote note = metric_note(id);
      metrics.push_back({{"id", id},
                         {"title", note.title},
                         {"meaning", std::string(note.meaning)},
                         {"unit", unit_name(note.unit)},
                         {"moreIsBetter", note.more_is_better}});
    }
    return at->second;
  };
  Json& list = data["cells"] = Json::array();
  for (const CellSummary& cell : cells) {
    Json values = Json::object();
    for (const auto& [engine, numbers] : cell.metrics) {
      Json row = Json::array();
      for (const auto& [id, value] : numbers) {
        const std::size_t at = column_of(id);
        while (row.size() <= at) row.push_back(nullptr);
        row[at] = std::isfinite(value) ? Json(four_digits(value)) : number_or_name(value);
      }
      values[engine] = row;
    }
    Json one = {{"id", cell.entry->id},
                {"label", cell.entry->label},
                {"href", link_to({"cells", cell.entry->id, "index.html"})},
                {"status", std::string(info(cell.status).name)},
                {"at", cell.entry->at},
                {"metrics", values}};
    if (cell.picture.shown()) {
      const SmallPicture picture = cell.picture.first_look();
      one["picture"] = {{"src", link_to({"cells", cell.entry->id, picture.file})},
                        {"width", picture.width},
                        {"height", picture.height}};
    }
    list.push_back(std::move(one));
  }
  data["metrics"] = std::move(metrics);
  return data;
}

}  // namespace lobelia::gallery

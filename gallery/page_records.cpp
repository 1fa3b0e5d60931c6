#include <fmt/format.h>

#include <cmath>

#include "gallery/cell_page.hpp"
#include "gallery/grid_layout.hpp"
#include "gallery/index_page.hpp"

namespace lobelia::gallery {
namespace {

/// Enough for a colour and a number on a page: 2000 cells of forty metrics stay under two megabytes.
double four_digits(double value) {
  return std::isfinite(value) ? std::strtod(fmt::format("{:.4g}", value).c_str(), nullptr) : value;
}

/// Metrics by column, so that each name is written once, not once per cell.
class MetricColumns {
 public:
  MetricColumns(const Metrics& metrics, std::vector<records::GridMetric>& list)
      : metrics_(metrics), list_(list) {}

  std::vector<std::optional<double>> row_of(const records::Named<double>& numbers) {
    std::vector<std::optional<double>> row;
    for (const auto& [id, value] : numbers) {
      const std::size_t at = column_of(id);
      if (row.size() <= at) row.resize(at + 1);
      row[at] = four_digits(value);
    }
    return row;
  }

 private:
  std::size_t column_of(const std::string& id) {
    const auto [at, is_new] = column_.emplace(id, column_.size());
    if (is_new) {
      const MetricInfo info = metrics_.info(id);
      list_.push_back({id, info.title, info.meaning, info.unit, info.more_is_better});
    }
    return at->second;
  }

  const Metrics& metrics_;
  std::vector<records::GridMetric>& list_;
  std::map<std::string, std::size_t> column_;
};

records::GridCell grid_cell(const CellSummary& cell, MetricColumns& columns) {
  const CellEntry& entry = *cell.entry;
  records::GridCell data;
  data.id = entry.id;
  data.label = entry.label;
  data.href = link_to({"cells", entry.id, "index.html"});
  data.status = info(cell.status).name;
  data.at = entry.at;
  for (const auto& [engine, numbers] : cell.metrics)
    data.metrics.emplace_back(engine, columns.row_of(numbers));
  const auto grid_picture = [&](const Picture& picture) {
    const SmallPicture small = picture.preview();
    return records::GridPicture{link_to({"cells", entry.id, small.file}), small.width,
                                small.height};
  };
  if (cell.picture.shown()) data.picture = grid_picture(cell.picture);
  for (const Picture& picture : cell.beside)
    if (picture.shown()) data.beside.push_back(grid_picture(picture));
  if (!cell.beside.empty() && !cell.reasons.empty()) data.finding = cell.reasons.front();
  return data;
}

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
  data.relative_to_peak = comparison.entry.difference.relative_to_peak;
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
      cell.profile->angle, cell.profile->curve.angle_degrees, zones_of(*cell.profile), {}};
  for (const auto& [name, values] : cell.profile->curve.radiance)
    data.curves.push_back({name, values});
  return data;
}

}  // namespace

records::GridPage grid_page_data(const ShownFarm& farm, const std::vector<CellSummary>& cells) {
  records::GridPage data;
  data.noun = farm.noun();
  for (const records::Axis& axis : farm.record.axes) {
    data.axes.push_back({axis.name, {}});
    for (const records::AxisValue& value : axis.values)
      data.axes.back().values.push_back(value.label);
  }
  for (const records::FarmEngine& engine : farm.record.engines)
    if (engine.name != farm.hub && engine.available)
      data.engines.push_back({engine.name, engine.title, farm.short_title(engine)});
  const GridLayout layout = lay_out(farm);
  data.layout = {layout.rows, layout.groups, layout.columns};
  for (const CellStatus status : kCellStatuses) {
    const StatusInfo& s = info(status);
    data.statuses.push_back({std::string(s.name), std::string(s.word), std::string(s.mark)});
  }
  MetricColumns columns(farm.metrics, data.metrics);
  for (const CellSummary& cell : cells) data.cells.push_back(grid_cell(cell, columns));
  return data;
}

records::CellPage cell_page_data(const ShownFarm& farm, const CellEntry& entry,
                                 const CheckedCell& cell) {
  records::CellPage data;
  data.id = cell.id;
  data.label = entry.label;
  data.is_report = farm.is_report;
  data.exposure_stops = cell.record.exposure_stops;
  for (const records::FarmEngine& engine : farm.record.engines) {
    const EnginePicture* image = cell.find_image(engine.name);
    data.engines.push_back({engine.name, engine.title, farm.short_title(engine),
                            image ? shown_picture(image->png) : std::nullopt,
                            image ? link_to({image->float_script}) : ""});
  }
  for (const CheckedComparison& comparison : cell.comparisons)
    data.comparisons.push_back(shown_comparison(comparison));
  data.profile = shown_profile(cell);
  return data;
}

}  // namespace lobelia::gallery

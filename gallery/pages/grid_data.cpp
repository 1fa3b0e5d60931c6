#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "base/words/base64.hpp"
#include "gallery/pages/grid_layout.hpp"
#include "gallery/pages/index_page.hpp"

namespace lobelia::gallery {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Beyond that a page waits for values that it may never show.
constexpr std::size_t kMaxInlinedValues = 250'000;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

std::string packed(const std::vector<float>& values) {
  return base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)});
}

/// An engine's values of a metric, and their limits.
struct Column {
  std::vector<float> values, limits;
};

class Columns {
 public:
  Columns(const ShownFarm& farm, const std::vector<CellSummary>& cells,
          const std::vector<records::GridEngine>& engines)
      : metrics_(farm.metrics), cells_(cells), engines_(engines) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      for (const auto& [engine, numbers] : cells[i].metrics)
        for (const auto& [id, value] : numbers)
          if (Column* column = column_of(engine, id)) column->values[i] = float(value);
      for (const auto& [engine, limits] : cells[i].limits)
        for (const auto& [id, limit] : limits)
          if (Column* column = column_of(engine, id)) column->limits[i] = float(limit);
    }
  }

  std::vector<records::GridMetric> list() const {
    std::vector<records::GridMetric> list;
    for (const std::string& id : ids_) {
      const MetricInfo info = metrics_.info(id);
      list.push_back({id, info.title, info.meaning, info.unit, info.more_is_better});
    }
    return list;
  }

  std::size_t value_count() const { return cells_.size() * columns_.size(); }

  records::GridColumns of_metric(int metric) const {
    records::GridColumns columns{metric, {}};
    for (const auto& [place, column] : columns_) {
      if (place.first != metric) continue;
      // One limit is the same in all cells, as a rule, or there is none.
      std::vector<float> limits = column.limits;
      std::erase_if(limits, [](float limit) { return std::isnan(limit); });
      const bool is_one = std::ranges::all_of(limits, [&](float l) { return l == limits.front(); });
      if (is_one && !limits.empty()) limits.resize(1);
      columns.engines.push_back(
          {place.second, packed(column.values), is_one ? packed(limits) : packed(column.limits)});
    }
    return columns;
  }

 private:
  /// Null if the engine is not on the page.
  Column* column_of(const std::string& engine, const std::string& id) {
    const auto at = std::ranges::find(engines_, engine, &records::GridEngine::name);
    if (at == engines_.end()) return nullptr;
    const auto [metric, is_new] = metric_.emplace(id, int(metric_.size()));
    if (is_new) ids_.push_back(id);
    Column& column = columns_[{metric->second, int(at - engines_.begin())}];
    if (column.values.empty())
      column = {std::vector(cells_.size(), kNone), std::vector(cells_.size(), kNone)};
    return &column;
  }

  const Metrics& metrics_;
  const std::vector<CellSummary>& cells_;
  const std::vector<records::GridEngine>& engines_;
  std::map<std::string, int, std::less<>> metric_;
  std::vector<std::string> ids_;  ///< in the order of their first cell
  std::map<std::pair<int, int>, Column> columns_;
};

class Pictures {
 public:
  Pictures(std::vector<records::GridPicture>& list, bool has_files)
      : list_(list), has_files_(has_files) {}

  int place_of(const Picture& picture) {
    if (!picture.shown()) return -1;
    SmallPicture small = picture.preview();
    if (!has_files_) small.file.clear();
    const auto [at, is_new] =
        place_.emplace(std::tuple(small.file, small.width, small.height), int(place_.size()));
    if (is_new) list_.push_back({link_to({small.file}), small.width, small.height});
    return at->second;
  }

 private:
  std::vector<records::GridPicture>& list_;
  const bool has_files_;
  std::map<std::tuple<std::string, int, int>, int> place_;
};

records::GridPage frame_of(const ShownFarm& farm) {
  records::GridPage page;
  page.noun = farm.noun();
  for (const records::Axis& axis : farm.record.axes) {
    page.axes.push_back({axis.name, {}});
    for (const records::AxisValue& value : axis.values)
      page.axes.back().values.push_back(value.label);
  }
  for (const records::FarmEngine& engine : farm.record.engines)
    if (engine.name != farm.hub && engine.available)
      page.engines.push_back({engine.name, engine.title, farm.short_title(engine)});
  const GridLayout layout = lay_out(farm);
  page.layout = {layout.rows, layout.groups, layout.columns};
  for (const CellStatus status : kWorstFirst) {
    const StatusInfo s = farm.words_of(status);
    page.statuses.push_back({std::string(s.name), std::string(s.word), std::string(s.mark)});
  }
  return page;
}

void add_cell(const ShownFarm& farm, const CellSummary& cell, Pictures& pictures,
              records::GridPage& page) {
  const CellEntry& entry = *cell.entry;
  // The script makes the others itself.
  if (farm.is_report || std::ranges::count(entry.at, -1) > 0)
    page.labels.push_back({int(page.ids.size()), entry.label});
  page.ids.push_back(entry.id);
  page.at.insert(page.at.end(), entry.at.begin(), entry.at.end());
  page.status.push_back(rank_of(cell.status));
  page.picture.push_back(pictures.place_of(cell.picture));
  if (cell.place >= 0) page.place.push_back(cell.place);
  if (!cell.change) return;
  page.change.push_back(int(std::ranges::find(kChanges, cell.change->change) - kChanges.begin()));
}

}  // namespace

GridData grid_data(const ShownFarm& farm, const std::vector<CellSummary>& cells) {
  GridData data{frame_of(farm), {}};
  records::GridPage& page = data.page;
  if (std::ranges::any_of(cells, [](const CellSummary& cell) { return cell.change.has_value(); }))
    for (const Change change : kChanges) {
      const ChangeInfo& c = info(change);
      page.changes.push_back({std::string(c.name), std::string(c.word), std::string(c.mark)});
    }
  Pictures pictures(page.pictures, cells.empty() || cells.front().place < 0);
  for (const CellSummary& cell : cells) {
    add_cell(farm, cell, pictures, page);
    if (!farm.is_report) continue;
    page.findings.push_back(cell.reasons.empty() ? "" : cell.reasons.front());
    page.beside.emplace_back();
    for (const Picture& picture : cell.beside)
      if (const int place = pictures.place_of(picture); place >= 0)
        page.beside.back().push_back(place);
  }
  const Columns columns(farm, cells, page.engines);
  page.metrics = columns.list();
  for (int metric = 0; metric < int(page.metrics.size()); ++metric) {
    if (columns.value_count() <= kMaxInlinedValues)
      page.columns.push_back(columns.of_metric(metric));
    else
      data.columns.emplace("grid." + std::to_string(metric), columns.of_metric(metric));
  }
  return data;
}

}  // namespace lobelia::gallery

#include "gallery/farm_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "core/text.hpp"
#include "gallery/names.hpp"

namespace lobelia::gallery {
namespace {

constexpr char kFile[] = "farm.json";

std::string first_word(const std::string& title) { return title.substr(0, title.find(' ')); }

std::vector<GridAxis> read_axes(const Fields& farm) {
  std::vector<GridAxis> axes;
  for (const Fields& entry : farm.objects("axes")) {
    GridAxis axis{entry.text("name"), {}};
    for (const Fields& item : entry.objects("values")) {
      AxisValue value{item.text("value"), item.text("label")};
      if (value.label.empty()) value.label = value.value;
      axis.values.push_back(std::move(value));
    }
    if (axis.values.empty()) entry.fail("values", "must not be empty");
    axes.push_back(std::move(axis));
  }
  if (axes.empty()) farm.fail("axes", "must not be empty");
  return axes;
}

std::vector<EngineEntry> read_engines(const Fields& farm) {
  std::vector<EngineEntry> engines;
  for (const Fields& entry : farm.objects("engines")) {
    EngineEntry engine{entry.plain_name("name"), entry.text("title"),     "",
                       entry.text("version"),    entry.flag("available"), entry.text("why"),
                       entry.text("install")};
    if (engine.name.empty()) entry.fail("name", "must not be empty");
    if (engine.title.empty()) engine.title = engine.name;
    engines.push_back(std::move(engine));
  }
  if (engines.empty()) farm.fail("engines", "must not be empty");
  for (EngineEntry& engine : engines) {
    const auto same = [&](const EngineEntry& other) {
      return first_word(other.title) == first_word(engine.title);
    };
    const bool unique = std::count_if(engines.begin(), engines.end(), same) == 1;
    engine.short_title = unique ? first_word(engine.title) : engine.title;
  }
  return engines;
}

/// A bare number says nothing without its axis: "exponent 16", but "Phong (RDF)".
std::string titled(const GridAxis& axis, const std::string& label) {
  const bool is_number = !label.empty() && label.front() >= '0' && label.front() <= '9';
  return is_number ? axis.name + " " + label : label;
}

CellEntry read_cell_entry(const Fields& entry, const std::vector<GridAxis>& axes) {
  CellEntry cell;
  cell.id = entry.plain_name("id");
  if (cell.id.empty()) entry.fail("id", "must not be empty");
  const std::string status = entry.text("status");
  if (const auto known = find_status(status)) {
    cell.status = *known;
  } else {
    entry.fail("status",
               "must be pass, differs, failed or missing, not '" + printable(status) + "'");
  }
  const auto values = entry.object("axes");
  for (const GridAxis& axis : axes) {
    const std::string value = values ? values->text(axis.name) : "";
    const auto at = std::find_if(axis.values.begin(), axis.values.end(),
                                 [&](const AxisValue& v) { return v.value == value; });
    const bool known = at != axis.values.end();
    cell.at.push_back(known ? static_cast<int>(at - axis.values.begin()) : -1);
    if (!cell.label.empty()) cell.label += " · ";
    cell.label += titled(axis, known ? at->label : value);
  }
  return cell;
}

}  // namespace

const EngineEntry* FarmData::find_engine(const std::string& name) const {
  const auto at = std::find_if(engines.begin(), engines.end(),
                               [&](const EngineEntry& engine) { return engine.name == name; });
  return at == engines.end() ? nullptr : &*at;
}

std::string FarmData::engine_title(const std::string& name) const {
  const EngineEntry* engine = find_engine(name);
  return engine ? engine->title : name;
}

const CellEntry* FarmData::find_cell(const std::vector<int>& at) const {
  const auto found = cell_at.find(at);
  return found == cell_at.end() ? nullptr : &cells[found->second];
}

FarmData read_farm(const std::filesystem::path& directory) {
  const auto path = directory / kFile;
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    throw Error(
        ExitCode::kInput,
        fmt::format("{}: no such file; a gallery is made of a directory that 'lobelia farm' "
                    "wrote",
                    path.string()));
  }
  const Json record = read_record(path, "farm");
  const Fields fields(record, path.string());
  FarmData farm;
  farm.title = fields.text("title");
  if (farm.title.empty()) farm.title = "Sphere grid";
  farm.grid = fields.text("grid");
  farm.command = fields.text("command");
  farm.made_by = fields.text("madeBy");
  if (const auto host = fields.object("host")) farm.host = host->described_members();
  farm.axes = read_axes(fields);
  farm.engines = read_engines(fields);
  std::set<std::string> ids;
  for (const Fields& entry : fields.objects("cells")) {
    farm.cells.push_back(read_cell_entry(entry, farm.axes));
    farm.cell_at.emplace(farm.cells.back().at, farm.cells.size() - 1);
    if (!ids.insert(farm.cells.back().id).second) {
      entry.fail("id", "stands there twice: '" + printable(farm.cells.back().id) + "'");
    }
  }
  return farm;
}

}  // namespace lobelia::gallery

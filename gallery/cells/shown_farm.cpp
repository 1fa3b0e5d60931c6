#include "gallery/cells/shown_farm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/records/record.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/words/text.hpp"

namespace lobelia::gallery {
namespace {

/// A name that changes nothing beside it: marks of direction are written out, and one with letters from right to left is
/// isolated (UAX 9, FSI and PDI).
std::string contained(const std::string& name) {
  // Lead bytes in UTF-8 of Hebrew, Arabic and their relatives, and of a few others, which lose nothing.
  const bool may_run_left =
      std::ranges::any_of(name,
                          [](char c) {
                            const auto byte = static_cast<unsigned char>(c);
                            return (byte >= 0xD6 && byte <= 0xE0) || byte == 0xEF;
                          }) ||
      name.find("\xF0\x90") != name.npos || name.find("\xF0\x9E") != name.npos;
  const std::string shown = printable_path(name);
  return may_run_left ? "\u2068" + shown + "\u2069" : shown;
}

void fill_titles(records::Farm& farm) {
  farm.title = farm.title.empty() ? "Sphere grid" : contained(farm.title);
  for (records::Axis& axis : farm.axes)
    for (records::AxisValue& value : axis.values)
      value.label = contained(value.label.empty() ? value.value : value.label);
  for (records::FarmEngine& engine : farm.engines)
    engine.title = contained(engine.title.empty() ? engine.name : engine.title);
}

/// A bare number says nothing without its axis: "exponent 16", but "Phong (RDF)".
std::string titled(const records::Axis& axis, const std::string& label) {
  const bool is_number = !label.empty() && label.front() >= '0' && label.front() <= '9';
  return is_number ? contained(axis.name) + " " + label : label;
}

CellEntry entry_of(const records::FarmCell& record, const std::vector<records::Axis>& axes) {
  CellEntry cell{record.id, *find_status(record.status), {}, ""};
  for (const records::Axis& axis : axes) {
    const std::string* named = records::find(record.axes, axis.name);
    const std::string value = named ? *named : "";
    const auto at = std::ranges::find(axis.values, value, &records::AxisValue::value);
    const bool known = at != axis.values.end();
    cell.at.push_back(known ? static_cast<int>(at - axis.values.begin()) : -1);
    if (!cell.label.empty()) cell.label += " · ";
    cell.label += titled(axis, known ? at->label : contained(value));
  }
  return cell;
}

std::string first_word(const std::string& title) { return title.substr(0, title.find(' ')); }

}  // namespace

std::string_view ShownFarm::noun() const {
  if (!is_report) return "cell";
  const bool are_pairs = std::ranges::none_of(cells, [](const CellEntry& cell) {
    return cell.status == CellStatus::kMissing || cell.status == CellStatus::kUnchecked;
  });
  return are_pairs ? "pair" : "name";
}

std::string ShownFarm::engine_title(const std::string& name) const {
  const auto at = std::ranges::find(record.engines, name, &records::FarmEngine::name);
  return at == record.engines.end() ? name : at->title;
}

std::string ShownFarm::short_title(const records::FarmEngine& engine) const {
  const std::string word = first_word(engine.title);
  const bool is_unique = std::ranges::count(record.engines, word, [](const auto& other) {
                           return first_word(other.title);
                         }) == 1;
  return is_unique ? word : engine.title;
}

const CellEntry* ShownFarm::find_cell(const std::vector<int>& at) const {
  const auto found = cell_at.find(at);
  return found == cell_at.end() ? nullptr : &cells[found->second];
}

ShownFarm show(records::Farm record, const Metrics& metrics) {
  ShownFarm farm;
  farm.record = std::move(record);
  farm.metrics = metrics;
  if (!farm.record.reference.empty()) farm.hub = farm.record.reference;
  fill_titles(farm.record);
  for (const records::FarmCell& cell : farm.record.cells) {
    farm.cells.push_back(entry_of(cell, farm.record.axes));
    farm.cell_at.emplace(farm.cells.back().at, farm.cells.size() - 1);
  }
  return farm;
}

ShownFarm read_farm(const std::filesystem::path& directory, const Metrics& metrics,
                    std::shared_ptr<const PublishedTexts> texts) {
  const auto path = directory / "farm.json";
  if (file_type_at(path) == std::filesystem::file_type::not_found)
    throw Error(ExitCode::kInput,
                path.string() +
                    ": no such file; a gallery is made of a directory that 'lobelia farm' wrote");
  records::Origin origin;
  ShownFarm farm =
      show(read_published<records::Farm>(path, texts.get(), path.string(), &origin), metrics);
  farm.texts = std::move(texts);
  farm.made_by = origin.made_by;
  std::set<std::string> ids;
  for (std::size_t i = 0; i < farm.cells.size(); ++i)
    if (!ids.insert(farm.cells[i].id).second)
      throw Error(ExitCode::kInput, "{}: cells[{}].id: '{}' stands there twice", path.string(), i,
                  printable(farm.cells[i].id));
  return farm;
}

}  // namespace lobelia::gallery

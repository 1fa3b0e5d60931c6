#include "base/records/farm_file.hpp"

#include <nlohmann/json.hpp>

#include "base/records/record.hpp"
#include "base/system/error.hpp"

namespace lobelia::records {
namespace {

constexpr std::size_t kPieceBytes = 1 << 20;

/// An item of the list, on lines of its own.
void append_item(std::string& text, const std::string& item) {
  for (std::size_t line = 0; line < item.size();) {
    const std::size_t end = item.find('\n', line);
    text.append("\n    ").append(item, line, end - line);
    line = end + 1;
  }
}

}  // namespace

void write_farm(const std::filesystem::path& path, Farm farm, std::size_t count,
                const std::function<FarmCell(std::size_t)>& cell) {
  farm.cells.clear();
  std::string text = record_text(farm);
  if (count > 0) {
    // The cells are the last key.
    constexpr std::string_view kEmpty = "[]\n}\n";
    if (!text.ends_with(kEmpty)) throw Error(ExitCode::kInternal, "farm.json: its end");
    text.resize(text.size() - kEmpty.size());
    text += '[';
  }
  PartFile file(path, AtLink::kReplace);
  for (std::size_t i = 0; i < count; ++i) {
    append_item(text, record_text(cell(i)));
    text += i + 1 < count ? "," : "\n  ]\n}\n";
    if (text.size() < kPieceBytes) continue;
    file.append(text);
    text.clear();
  }
  file.append(text);
  file.finish();
}

Farm read_farm(const std::filesystem::path& path) {
  return parse_farm(read_file(path, kMaxRecordBytes), path.string());
}

Farm parse_farm(std::string_view text, const std::string& where) {
  Farm farm;
  std::vector<FarmCell> cells;
  std::exception_ptr bad_cell;  // what is wrong with the record itself is said first
  bool in_cells = false;
  const auto take_cell = [&](int depth, Json::parse_event_t event, const Json& json) {
    using Event = Json::parse_event_t;
    if (event == Event::key && depth == 1) in_cells = json == "cells";
    if (!in_cells || event != Event::object_end || depth != 2) return true;
    const Place root, list(root, "cells"), here(list, cells.size());
    try {
      if (!bad_cell) struct_type<FarmCell>().read(json, {}, here, &cells.emplace_back());
    } catch (...) {
      bad_cell = std::current_exception();
    }
    return false;  // not kept
  };
  try {
    const Json json = Json::parse(text, take_cell);
    struct_type<Farm>().read(json, {}, Place(), &farm);
    if (bad_cell) std::rethrow_exception(bad_cell);
  } catch (const Json::exception& error) {
    throw Error(ExitCode::kInput, where + ": not a record: " + error.what());
  } catch (const Error& error) {
    throw Error(error.code(), where + ": " + error.what());
  }
  farm.cells = std::move(cells);
  return farm;
}

}  // namespace lobelia::records

// farm.json a cell at a time: that of a large farm, as one JSON, takes ten times the memory of its text.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "base/records/farm.hpp"

namespace lobelia::records {

/// Replaces the file by `farm` with `count` cells in place of its own, in one step: the bytes that write_record() would
/// write. `cell` is called in order.
void write_farm(const std::filesystem::path& path, Farm farm, std::size_t count,
                const std::function<FarmCell(std::size_t)>& cell);

/// As read_record() and parse_record().
Farm read_farm(const std::filesystem::path& path);
Farm parse_farm(std::string_view text, const std::string& where);

}  // namespace lobelia::records

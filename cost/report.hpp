// A report of what accuracy costs, in the forms that people and programs read.
#pragma once

#include <filesystem>
#include <string>

#include "cost/table.hpp"

namespace lobelia::cost {

records::Cost cost_record(const Report& report);

/// A line for each way and error.
std::string cost_csv(const Report& report);

/// Each table with its front and what that says in words; `all` also has the ways that are dominated.
std::string cost_text(const Report& report, bool all);

/// Error over time of a table, both logarithmic, with the front and error bars. A file of its own.
std::string cost_chart(const Table& table, std::size_t error);

/// cost.json, cost.csv and TABLE-ERROR.svg. Throws Error(kOutput).
void write_cost(const Report& report, const std::filesystem::path& directory);

/// "3.14 ns", or "1408 bit operations" where a table counts those.
std::string cost_value_text(const Table& table, double value);

}  // namespace lobelia::cost

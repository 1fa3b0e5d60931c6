// A report of what accuracy costs, in the forms that people and programs read. Its tables have their fronts.
#pragma once

#include <filesystem>
#include <string>

#include "studies/cost/table.hpp"

namespace lobelia::cost {

/// A line for each variant and error.
std::string cost_csv(const records::Cost& report);

/// Each table with its front and what that says in words; `all` also has the variants that are dominated.
std::string cost_text(const records::Cost& report, bool all);

/// Error over time of a table, both logarithmic, with the front and error bars. A file of its own.
std::string cost_chart(const Table& table, std::size_t error);

/// cost.json, cost.csv and TABLE-ERROR.svg. Throws Error(kOutput).
void write_cost(const records::Cost& report, const std::filesystem::path& directory);

}  // namespace lobelia::cost

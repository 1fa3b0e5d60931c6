// Tables of what accuracy costs: variants of one thing with their times and errors, all of one run.
#pragma once

#include <filesystem>
#include <string>

#include "base/records/cost.hpp"
#include "base/system/timing.hpp"

namespace lobelia::cost {

/// Its id is unique in its report and a file's name. Times are of one `per`; without times the unit is of the count:
/// "bit operations". Remarks are sentences: fits, findings and omissions.
using Table = records::CostTable;
/// Its name is unique in its table. Errors are in the order of the table's kinds, not negative, NaN where not known;
/// spreads are standard deviations over repeats.
using Variant = records::CostVariant;

inline bool is_timed(const Table& table) { return table.unit == "s"; }
/// A variant's seconds, or its count where there is nothing to time.
records::MeasuredRounds cost_of(const Variant& variant);
double setting(const Variant& variant, std::string_view name);  ///< as a number; NaN without
/// 1 if b is slower than a by more than the spread of both, -1 if faster by more, else 0.
int clearly_slower(const Variant& a, const Variant& b);

/// The Pareto front by one of a table's errors: the variants of which none is both as fast and as accurate. Medians
/// decide; of variants that are equal in both, the first counts. Variants without a known error are neither on the
/// front nor dominated.
///
/// In words: along the front, "from cs16 to cosine: 1.8 times the time, 170 times less error", and for each variant
/// that is dominated, by what: "cs64 takes 1.2 times the time of cosine and has 17 times its error".
records::CostFront pareto_front(const Table& table, std::size_t error);
/// Adds the front of each error to a table that has all its variants.
void add_fronts(Table& table);

// The tables of reports have their fronts.

/// A line for each variant and error.
std::string cost_csv(const records::Cost& report);
/// Each table with its front and its remarks; `all` also has the dominated variants.
std::string cost_text(const records::Cost& report, bool all);
/// Error over time of a table, both logarithmic, with the front and error bars. A file of its own.
std::string cost_chart(const Table& table, std::size_t error);
/// cost.json, cost.csv and TABLE-ERROR.svg. Throws Error(kOutput).
void write_cost(const records::Cost& report, const std::filesystem::path& directory);

}  // namespace lobelia::cost

// Tables of what accuracy costs: variants of one thing, each with its time and its errors, all of one run.
#pragma once

#include <string>
#include <vector>

#include "core/timing.hpp"
#include "records/cost.hpp"

namespace lobelia::cost {

/// Its id is unique in its report and a file's name. Times are of one of what `per` says; without times the unit is
/// what is counted: "bit operations". Remarks say what was fitted, found and left out.
using Table = records::CostTable;
/// Its name is unique in its table. Errors are in the order of the table's kinds, not negative, NaN where not known;
/// spreads are standard deviations over repeats.
using Variant = records::CostWay;

inline bool is_timed(const Table& table) { return table.unit == "s"; }
records::CostSeconds seconds_record(const Times& times);
/// A variant's seconds, or its count where there is nothing to time.
records::CostSeconds cost_of(const Variant& variant);
double setting(const Variant& variant, std::string_view name);  ///< as a number; NaN without
/// b is slower than a by more than the spread of both: 1, faster: -1, or else 0.
int clearly_slower(const Variant& a, const Variant& b);

/// The Pareto front by one of a table's errors: the variants of which none is both as fast and as accurate. Medians
/// decide; of variants that are equal in both, the first counts. Variants without a known error are neither on the
/// front nor dominated.
///
/// In words: along the front, "from cs16 to cosine: 1.8 times the time, 170 times less error", and for each variant
/// that is dominated, by what: "cs64 takes 1.2 times the time of cosine and has 17 times its error".
records::CostFront pareto_front(const Table& table, std::size_t error);
/// Of all errors of a table that has all its variants.
void add_fronts(Table& table);

}  // namespace lobelia::cost

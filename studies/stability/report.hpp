// The study of the hard cases: its rows and their worst, and its text.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/stability/cases.hpp"

namespace lobelia::stability {

/// Every case of these lobes, on all processors. `on_progress` gets the fraction done, from any thread.
/// Throws Error(kInterrupted) on Ctrl-C.
Rows all_rows(const std::vector<LobeId>& lobes, const std::function<void(double)>& on_progress);

/// Modified Phong's cos^n, from the peak to a thousandth of it, for n = 16 to 1e8. Ours is in the precision that a plan
/// would choose.
std::vector<records::StabilityCurve> error_curves();

/// Fills in the counts and the worst of the rows.
void summarise(records::VerifyStability& report);
/// Drops every row that is not outside its bound.
void keep_rows_outside(records::VerifyStability& report);

/// `all`: every row, instead of the worst for each lobe and case. The report still has all rows.
std::string report_text(const records::VerifyStability& report, bool all);

}  // namespace lobelia::stability

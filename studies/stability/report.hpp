// The study of the hard cases: its rows and their worst, pictures, and its text.
#pragma once

#include <filesystem>
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

/// Writes a modified Phong highlight cos^n, so close that it fills the picture, for n = 1e3, 1e5, 1e6:
/// stability-nN-naive.exr, .png, -error.png and the same of ours, and stability.png: all in one, a row for each
/// exponent. Error pictures show log10 of the error over the peak as a colour: black at 1e-8 and below, then blue, red,
/// yellow, white at 1 and above; magenta is no number. The files' names begin with `from_record`, the path from the
/// record to the directory.
std::vector<records::StabilityPictures> write_pictures(const std::filesystem::path& directory,
                                                       const std::filesystem::path& from_record);

/// Fills in the counts and the worst of the rows.
void summarise(records::VerifyStability& report);
/// Drops every row that is not outside its bound.
void keep_rows_outside(records::VerifyStability& report);

/// `all`: every row, instead of the worst for each lobe and case. The report still has all rows.
std::string report_text(const records::VerifyStability& report, bool all);

}  // namespace lobelia::stability

// A claim of the paper and its measurement. To add one: write its function in a file of claims/ and add it to the list
// in claim.cpp. Table, record, docs/errata.md and tests find it there.
#pragma once

#include <string>
#include <vector>

#include "base/records/paper.hpp"
#include "reference_scenes/engines/analytic/formulas/printed.hpp"

namespace lobelia::paper {

/// The statement is in our words, and `printed` is as the paper has it. The verdict is about the first figure.
using Claim = records::Claim;
/// A value with the digits that are the same on every machine, and where it was found.
using Figure = records::Measured;

/// Verdicts. Found: not in the paper.
inline constexpr char kConfirmed[] = "confirmed", kNotReproduced[] = "not reproduced",
                      kFound[] = "found";

/// Where the paper makes the claims called more-accurate.
inline constexpr char kConclusions[] =
    "conclusions: the models are more accurate than the classical ones";

/// "0.0907", "1.70e-2", "36.8": significant digits, no locale, nothing that is not ASCII.
std::string figure_text(double value, int digits);

Figure figure(std::string what, long double value, int digits, std::string at = "");
/// With a number of decimals, for values near 1.
Figure fixed(std::string what, long double value, int decimals, std::string at = "");
/// For values that should be 0 but for rounding: "below 1e-15", or the value itself if it is not.
Figure vanishing(std::string what, long double value, double bound, std::string at = "");

/// "n = 208"
std::string at_exponent(long double n);

/// Whether `measured`, rounded as `printed` is, gives `printed`; `unit` is that of its last digit.
bool rounds_to(long double measured, double printed, double unit);
std::string confirmed_if(bool holds);

/// All claims, measured, in the order of the list: takes 15 to 35 s on one processor.
std::vector<Claim> measure_all();

}  // namespace lobelia::paper

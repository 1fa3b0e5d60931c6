// The tables, CSV files and charts of `lobelia profile`.
#pragma once

#include <span>
#include <string>

#include "base/records/profile.hpp"
#include "base/words/svg_chart.hpp"

namespace lobelia::cli {

/// With the sentence on what each picture's highlight is first.
std::string profile_text(const records::Profile& profile);
/// A line per angle of each: sphere, light, and the columns of its curve. All have the same columns.
std::string profile_csv(std::span<const records::Profile> profiles);
std::string profile_svg(const records::Profile& profile);

std::string blobs_text(const records::Blobs& blobs);
/// A line per offset of each: highlight, axis, and the columns of its curve.
std::string blobs_csv(const records::Blobs& blobs);
/// Both axes of a single highlight, or the long axes of the brightest ones.
std::string blobs_svg(const records::Blobs& blobs);

// Parts that both share.

/// "-" for NaN.
std::string shown(double x);
std::string three_digits(double x);
/// "124.3 +- 0.2": to the first digit of the error, to its second where that is a 1; no finer than a millionth of the value,
/// because float32 pictures tell no more. The value alone if the error is NaN.
std::string with_error(double value, double error);
/// "7.5 %": two digits.
std::string percent(double share);
/// A remark on a peak that could not be fitted; empty for a fitted one.
std::string peak_remark(const records::Peak& peak);
/// A line for each.
std::string specks_text(const std::string& name, std::span<const records::Speck> specks);
std::string differences_table(const records::Named<records::ZoneErrors>& differences);
std::string csv_head(const records::Named<std::vector<double>>& columns);
std::string csv_values(const records::Named<std::vector<double>>& columns, std::size_t line);
/// Styles 1 to 5; 0 is the broad line beneath them.
int style_of(std::size_t line);
/// Lets the radiance axis reach over all curves.
void set_top(Chart& chart);

}  // namespace lobelia::cli

// All of it: the rows, their worst cases as tables for people, and the record.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "records/stability.hpp"
#include "verify/stability/error_curves.hpp"
#include "verify/stability/pictures.hpp"
#include "verify/stability/row.hpp"
#include "verify/stability/timing.hpp"

namespace lobelia::stability {

struct Report {
  Rows rows;
  std::vector<Stall> stalls;  ///< empty: not measured
  std::vector<Price> prices;
  std::vector<PicturePair> pictures;  ///< empty: not made
  std::vector<ErrorCurve> curves;
  std::size_t count(Outcome outcome) const;  ///< of rows
};

/// Every case of these lobes, on all processors. `on_progress` gets the fraction done, from any thread.
/// Throws Error(kInterrupted) on Ctrl-C.
Rows all_rows(const std::vector<LobeId>& lobes, const std::function<void(double)>& on_progress);

/// The worst of several rows.
struct Summary {
  std::string group, name;
  int cases = 0, outside = 0, not_compared = 0;
  Answer naive = {}, ours = {};  ///< the largest error of each kind; no value
  double of_bound = 0;           ///< the largest part of a bound that is used up
  double exponent = 0;           ///< of by_exponent alone
};
std::vector<Summary> by_lobe(const Rows& rows);
std::vector<Summary> by_case(const Rows& rows);
/// The worst of each group, lobe and exponent; the name is the lobe's.
std::vector<Summary> by_exponent(const Rows& rows);

/// `all`: every row, instead of the worst for each lobe and case.
std::string report_text(const Report& report, bool all);
/// With `all` or not, every row that is outside. `pictures` is the way from the record to their directory.
records::VerifyStability report_record(const Report& report,
                                       const std::vector<std::string>& command,
                                       const std::filesystem::path& pictures, bool all);

}  // namespace lobelia::stability

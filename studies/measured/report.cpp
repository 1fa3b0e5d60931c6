#include <fmt/format.h>

#include <algorithm>

#include "studies/measured/fit.hpp"
#include "studies/table.hpp"

namespace lobelia::measured {
namespace {

std::string reflectance_text(const records::Triple& value) {
  return fmt::format("{:.3g} {:.3g} {:.3g}", value[0], value[1], value[2]);
}

}  // namespace

std::vector<records::MeasuredFit> best_by_model(const records::MeasuredFits& fits) {
  std::vector<records::MeasuredFit> best;
  for (const records::MeasuredFit& fit : fits.fits)
    if (std::ranges::find(best, fit.model, &records::MeasuredFit::model) == best.end())
      best.push_back(fit);
  return best;
}

std::string fits_text(const records::MeasuredFits& fits) {
  studies::Table table;
  table.columns = {{"model", -23},
                   {"lobe", -18, "{}", 1},
                   {"exponent", 9, "{:.4g}", 1},
                   {"alpha", 7, "{:.3g}", 1},
                   {"diffuse", 20, "{}", 1},
                   {"specular", 20, "{}", 1},
                   {"rms %", 8, "{:.3g}", 1},
                   {"max %", 8, "{:.3g}", 1},
                   {"dE2000", 6, "{:.3g}", 1},
                   {"max", 6, "{:.3g}", 1}};
  std::vector<std::string_view> seen;
  for (const records::MeasuredFit& fit : fits.fits) {
    const bool is_best = std::ranges::count(seen, fit.model) == 0;
    if (is_best) seen.push_back(fit.model);
    if (!is_best && fit.lobe != "cosine") continue;
    table.rows.push_back({fit.model, fit.lobe, fit.exponent,
                          fit.alpha ? studies::Cell(*fit.alpha) : studies::Cell("-"),
                          reflectance_text(fit.diffuse), reflectance_text(fit.specular),
                          100 * fit.rms_of_measured, 100 * fit.largest_of_measured,
                          fit.mean_ciede2000, fit.largest_ciede2000});
    if (fit.is_end_of_range)
      table.remarks.push_back(
          fmt::format("{}, {}: this exponent is the end of the range", fit.model, fit.lobe));
  }
  for (const std::string& remark : fits.remarks) table.remarks.push_back(remark);
  return fmt::format(
      "{} ({}), best fits by root mean square of f_r N.L, {} pairs of directions\n{}", fits.file,
      fits.format, fits.direction_pairs, table_text(table));
}

}  // namespace lobelia::measured

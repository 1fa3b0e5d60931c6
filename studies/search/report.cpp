#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/search/search.hpp"
#include "studies/table.hpp"

namespace lobelia::search {
namespace {

std::string range_text(const records::LobeSearch& found) {
  if (!found.most_exponent) return fmt::format("n = {:g} to infinity", found.least_exponent);
  if (*found.most_exponent == found.least_exponent)
    return fmt::format("n = {:g}", found.least_exponent);
  return fmt::format("n = {:g} to {:g}", found.least_exponent, *found.most_exponent);
}

std::string error_text(double error) { return fmt::format("{:.4g}", error); }

std::string price_text(const records::SearchedLobe& lobe) {
  const int divisions = lobe.operations.divisions;
  return fmt::format("{} operations{}", lobe.price - 5 * divisions,
                     divisions > 0 ? ", one of them a division" : "");
}

std::string certificate_text(const records::SearchedLobe& lobe) {
  if (!lobe.lower_bound) return fmt::format("{}: no certificate\n", lobe.name);
  studies::Table table;
  table.title = fmt::format("{}: no lobe of this shape has a smaller error than {}", lobe.name,
                            error_text(*lobe.lower_bound));
  table.columns = {{"t = n s", 14, "{:.10g}"},
                   {"1/n", 14, "{:.10g}"},
                   {"error", 14, "{:.5g}"},
                   {"weight", 14, "{:.10g}"}};
  for (const records::LobeTouch& touch : lobe.touches)
    table.rows.push_back({touch.ns, touch.per_exponent, touch.error, touch.weight});
  return table_text(table) + "\n";
}

/// What was asked for: found, or the best that there is.
std::string answer(const records::LobeSearch& found, const Request& request) {
  if (!request.error && !request.price) return "";
  const auto chosen = std::ranges::find(found.lobes, found.chosen, &records::SearchedLobe::name);
  if (chosen != found.lobes.end())
    return fmt::format("{}, {}: {} = {}\n  {}\n\n", chosen->name, price_text(*chosen), found.metric,
                       error_text(error_of(*chosen, found.metric)), chosen->formula);
  if (!request.error)
    return fmt::format("No lobe of the family has {} operations or fewer.\n\n", *request.price);
  const auto best = std::ranges::min_element(
      found.lobes, {}, [&](const auto& lobe) { return error_of(lobe, found.metric); });
  return fmt::format(
      "No lobe of at most {} operations is within {}. The best possible is {}: {}.\n\n",
      most_price(request), error_text(*request.error), error_text(error_of(*best, found.metric)),
      best->name);
}

}  // namespace

std::string search_text(const records::LobeSearch& found, const Request& request,
                        bool certificates) {
  studies::Table table;
  table.title = fmt::format("Lobes for cos^n, {}, in {}, coefficients {}", range_text(found),
                            found.precision, found.coefficients);
  table.columns = {{"lobe", -8},
                   {"operations", 10, "{}", 1},
                   {"error at most", 14, "{:.4g}", 1},
                   {"at least", 10, "{:.4g}", 1},
                   {"ns", 8, "{:.3f}", 1},
                   {"rounding", 10, "{:.2g}", 1},
                   {"rms", 10, "{:.3g}", 1},
                   {"energy", 10, "{:.3g}", 1},
                   {"dE2000", 9, "{:.3g}", 1},
                   {"front", 6, "{}", 1},
                   {"formula", -1, "{}", 2}};
  for (const records::SearchedLobe& lobe : found.lobes) {
    studies::Cell lower("-");
    if (lobe.lower_bound) lower = studies::Cell(*lobe.lower_bound);
    table.rows.push_back({lobe.name, double(lobe.price), lobe.errors.max, lower,
                          1e9 * lobe.seconds.median, lobe.errors.rounding, lobe.errors.rms,
                          lobe.errors.energy, lobe.errors.de2000, lobe.is_on_front ? "*" : "",
                          lobe.formula});
  }
  table.remarks = {
      "t = n s, s = 1 - cos. Operations: multiply-adds, products, maxima and conversions; a division counts as 6.",
      "ns: one value, as SIMD code in float32 on this machine, median of interleaved rounds.",
      "'error at most' is proved for every s and n, 'at least' for every lobe of the shape. That of schlick is not proved."};
  std::string text = answer(found, request) + table_text(table);
  if (certificates) {
    text += "\n";
    for (const records::SearchedLobe& lobe : found.lobes)
      if (lobe.is_on_front) text += certificate_text(lobe);
  }
  return text;
}

}  // namespace lobelia::search

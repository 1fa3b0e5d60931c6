#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/words/error_time_chart.hpp"
#include "base/words/numbers.hpp"

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
  return fmt::format("{} operations{}", lobe.price,
                     lobe.operations.divide > 0 ? ", a division counted as six" : "");
}

std::string certificate_text(const records::SearchedLobe& lobe) {
  if (!lobe.lower_bound) return fmt::format("{}: no certificate\n", lobe.name);
  studies::Table table;
  table.title = fmt::format("{}: no lobe of this shape has a smaller error than {}", lobe.name,
                            error_text(*lobe.lower_bound));
  table.columns = {{"t = n s", 16, "{:.10g}"},
                   {"1/n", 16, "{:.10g}"},
                   {"error", 14, "{:.5g}"},
                   {"weight", 16, "{:.10g}"}};
  for (const records::LobeTouch& touch : lobe.touches)
    table.rows.push_back({touch.ns, touch.per_exponent, touch.error, touch.weight});
  return table_text(table) + "\n";
}

/// The lobe that was asked for, or else the best that there is.
std::string answer(const records::LobeSearch& found, const Request& request) {
  if (!request.error && !request.price) {
    std::string text;
    for (const std::string& sentence : found.answers) text += sentence + "\n";
    return text + (text.empty() ? "" : "Code: the same with --error, or lobelia export.\n\n");
  }
  const auto chosen = std::ranges::find(found.lobes, found.chosen, &records::SearchedLobe::name);
  if (chosen != found.lobes.end()) {
    const bool of_peak = found.metric == "max";
    const double error = error_of(*chosen, found.metric);
    std::string text =
        fmt::format("Use {}, {} a value, {}: {} = {}{}.\n\n{}\n", chosen->name,
                    short_time_text(chosen->seconds.median), price_text(*chosen), found.metric,
                    error_text(error), of_peak ? " (" + percent_text(error) + " of the peak)" : "",
                    chosen->code);
    for (const records::SearchedLobe& lobe : found.lobes)
      if (request.error && found.metric == "max" && lobe.price < chosen->price &&
          lobe.lower_bound.value_or(1) <= *request.error)
        text += fmt::format(
            "  {} is cheaper, and whether a lobe of its shape is within {} is not decided: "
            "the best has {} to {}.\n",
            lobe.name, error_text(*request.error), error_text(*lobe.lower_bound),
            error_text(error_of(lobe, found.metric)));
    return text + "\n";
  }
  if (!request.error)
    return fmt::format("No lobe of the family '{}' has so few operations: {}.\n\n", found.family,
                       *request.price);
  // The best of the lobes that were searched, without the paper's and Schlick's.
  const records::SearchedLobe* best = nullptr;
  for (const records::SearchedLobe& lobe : found.lobes)
    if (lobe.bound && !lobe.name.starts_with("cs") &&
        (!best || error_of(lobe, found.metric) < error_of(*best, found.metric)))
      best = &lobe;
  if (!best)
    return fmt::format("No lobe of the family '{}' was found with {} operations or fewer.\n\n",
                       found.family, most_price(request));
  return fmt::format(
      "No lobe of the family '{}' with at most {} operations is within {}. The best possible is {}: "
      "{}.\n\n",
      found.family, most_price(request), error_text(*request.error),
      error_text(error_of(*best, found.metric)), best->name);
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
      "'error at most' is proved for every s and n, 'at least' for every lobe of the shape. That of schlick is not proved.",
      "front: nearer than all that are cheaper by 0.5 %, what the proofs may add; nearer by less counts as equal."};
  if (!found.not_proved.empty())
    table.remarks.push_back(
        fmt::format("Not proved, and so not listed: {}.", fmt::join(found.not_proved, ", ")));
  std::string text = answer(found, request) + table_text(table);
  if (certificates) {
    text += "\n";
    for (const records::SearchedLobe& lobe : found.lobes)
      if (lobe.is_on_front) text += certificate_text(lobe);
  }
  return text;
}

}  // namespace lobelia::search

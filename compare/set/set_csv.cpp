// A set of comparisons as a table.
#include <fmt/format.h>

#include <algorithm>

#include "compare/metrics/catalogue.hpp"
#include "compare/set/report.hpp"
#include "core/text.hpp"

namespace lobelia {
namespace {

std::string field(const std::string& text) { return csv_field(printable_path(text)); }

/// Ids measured for at least one pair, in the catalogue's order.
std::vector<std::string_view> measured_ids(const SetReport& report) {
  std::vector<std::string_view> ids;
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs) {
      const auto has = [&](const PairReport& pair) {
        return pair.comparison && records::find(pair.comparison->metrics, output.id);
      };
      if (std::ranges::any_of(report.pairs, has)) ids.push_back(output.id);
    }
  return ids;
}

}  // namespace

std::string set_csv(const SetReport& report) {
  const std::vector<std::string_view> ids = measured_ids(report);
  std::string text = "name,verdict,why";
  for (const std::string_view id : ids) text += fmt::format(",{}", id);
  text += "\r\n";
  const std::string no_values(ids.size(), ',');
  for (const PairReport& pair : report.pairs) {
    if (!pair.comparison) {
      text += fmt::format("{},error,{}{}\r\n", field(pair.name), field(pair.error), no_values);
      continue;
    }
    std::string why = why_not_pass(pair);
    if (pair.known) why += fmt::format("{}{}", why.empty() ? "" : "; ", known_text(pair));
    text += fmt::format("{},{},{}", field(pair.name), verdict_name(pair.verdict()), field(why));
    for (const std::string_view id : ids) {
      const double* value = records::find(pair.comparison->metrics, id);
      text += value ? fmt::format(",{}", *value) : ",";
    }
    text += "\r\n";
  }
  for (const std::string& name : report.missing)
    text += fmt::format("{},missing,there is only a reference{}\r\n", field(name), no_values);
  for (const std::string& name : report.extra)
    text += fmt::format("{},extra,there is no reference{}\r\n", field(name), no_values);
  for (const std::string& name : report.not_followed)
    text += fmt::format("{},not followed,{}{}\r\n", field(name), kNotFollowed, no_values);
  for (const std::string& name : report.misnamed)
    text +=
        fmt::format("{},misnamed,{}{}\r\n", field(name), field(std::string(kMisnamed)), no_values);
  return text;
}

}  // namespace lobelia

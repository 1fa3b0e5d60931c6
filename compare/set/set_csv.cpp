// A set of comparisons as a table.
#include <fmt/format.h>

#include <algorithm>

#include "base/words/text.hpp"
#include "compare/metrics/catalogue.hpp"
#include "compare/set/report.hpp"

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

/// "layer Z (depth): pass; layer crypto (identifier): differs": what was compared besides the picture.
std::string layers_text(const PairReport& pair) {
  std::string text;
  if (!pair.layers) return text;
  for (const LayerComparison& layer : pair.layers->compared)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", layer.title(),
                        verdict_name(layer.verdict()));
  return text;
}

}  // namespace

std::string set_csv(const SetReport& report) {
  const std::vector<std::string_view> ids = measured_ids(report);
  const bool has_layers = std::ranges::any_of(
      report.pairs, [](const PairReport& pair) { return !layers_text(pair).empty(); });
  std::string text = "name,verdict,why";
  for (const std::string_view id : ids) text += fmt::format(",{}", id);
  text += has_layers ? ",layers\r\n" : "\r\n";
  for (const NameOutcome& one : outcomes(report)) {
    std::string why = one.why();
    const PairReport* const pair = one.pair;
    if (pair && pair->known) why += fmt::format("{}{}", why.empty() ? "" : "; ", known_text(*pair));
    // A known difference is told by its reason: its verdict stays what it is.
    const std::string_view word =
        pair && pair->comparison ? verdict_name(pair->verdict()) : one.word();
    text += fmt::format("{},{},{}", field(one.name), word, field(why));
    for (const std::string_view id : ids) {
      const double* value =
          pair && pair->comparison ? records::find(pair->comparison->metrics, id) : nullptr;
      text += value ? fmt::format(",{}", *value) : ",";
    }
    if (has_layers) text += pair ? "," + field(layers_text(*pair)) : ",";
    text += "\r\n";
  }
  return text;
}

}  // namespace lobelia

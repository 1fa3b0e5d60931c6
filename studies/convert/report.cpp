#include "studies/convert/convert.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "studies/table.hpp"

namespace lobelia::conversion {
namespace {

using records::ConvertedHighlight;

/// "exponent 32", "alpha 0.2425, roughness 0.4925".
std::string parameter_text(const ConvertedHighlight& highlight) {
  return highlight.alpha
             ? fmt::format("alpha {:.4g}, roughness {:.4g}", *highlight.alpha, *highlight.roughness)
             : fmt::format("exponent {:.6g}", *highlight.exponent);
}

std::string_view measure_title(std::string_view measure) {
  return measure == "max"      ? "largest difference"
         : measure == "width"  ? "half-width"
         : measure == "energy" ? "misplaced energy"
                               : "CIEDE2000";
}

/// A table whose columns after the first are filled by add().
class ConversionTable {
 public:
  explicit ConversionTable(bool to_ggx) {
    table_.columns.push_back({"", -20});
    if (to_ggx) {
      table_.columns.push_back({"alpha", 10, "{:.4g}", 1});
      table_.columns.push_back({"roughness", 10, "{:.4g}", 1});
    } else {
      table_.columns.push_back({"exponent", 11, "{:.6g}", 1});
    }
    for (const char* title : {"max %", "peak", "width", "energy"})
      table_.columns.push_back({title, 8, "{:.3g}", 1});
    table_.columns.push_back({"misplaced %", 12, "{:.3g}", 1});
    table_.columns.push_back({"dE2000", 8, "{:.3g}", 1});
  }

  void heading(const char* text) { table_.rows.push_back({text}); }
  void remark(std::string text) { table_.remarks.push_back(std::move(text)); }
  void add(std::string_view name, const ConvertedHighlight& highlight,
           const records::ConversionErrors& errors) {
    std::vector<studies::Cell>& cells = begin_row(name);
    for (const auto& parameter : {highlight.exponent, highlight.alpha, highlight.roughness})
      if (parameter) cells.emplace_back(*parameter);
    cells.insert(cells.end(),
                 {100 * errors.largest_of_peak, errors.peak_ratio, errors.half_width_ratio,
                  errors.energy_ratio, 100 * errors.misplaced_energy, errors.largest_ciede2000});
  }
  void add_empty(std::string_view name) {
    begin_row(name).resize(table_.columns.size(), studies::Cell("-"));
  }
  std::string text() const { return table_text(table_); }

 private:
  std::vector<studies::Cell>& begin_row(std::string_view name) {
    return table_.rows.emplace_back(std::vector<studies::Cell>{fmt::format("  {}", name)});
  }

  studies::Table table_;
};

}  // namespace

std::string conversion_text(const records::Conversion& conversion) {
  ConversionTable table(conversion.to == "ggx");
  table.heading("best by");
  for (const records::ConversionBest& best : conversion.best) {
    table.add(measure_title(best.measure), best.highlight, best.errors);
    if (best.is_end_of_range)
      table.remark(fmt::format("{}: this is the end of the range", measure_title(best.measure)));
  }
  if (!conversion.rules.empty()) table.heading("rules of thumb");
  for (const records::ConversionRule& rule : conversion.rules)
    if (rule.highlight) {
      table.add(rule.name, *rule.highlight, *rule.errors);
    } else {
      table.add_empty(rule.name);
      table.remark(fmt::format("{}: {}", rule.name, rule.because));
    }
  for (const records::ConversionRule& rule : conversion.rules) {
    table.remark(fmt::format("{}: {}", rule.name, rule.formula));
    table.remark(fmt::format("  {}", rule.source));
  }
  const auto chosen =
      std::ranges::find(conversion.best, conversion.measure, &records::ConversionBest::measure);
  return fmt::format("{}, {}\nis best matched by {}, {} (by {})\n\n{}", conversion.from.model,
                     parameter_text(conversion.from), conversion.to,
                     parameter_text(chosen->highlight), measure_title(conversion.measure),
                     table.text());
}

Chart conversion_chart(const records::Conversion& conversion) {
  constexpr double kMostShown = 1.6;  // a rule may have many times the peak
  Chart chart;
  chart.id = "conversion";
  chart.title = fmt::format("{}, {}, as {}", conversion.from.model, parameter_text(conversion.from),
                            conversion.to);
  chart.description =
      "The light that leaves by the angle of the eye from the mirror direction, under light along the normal.";
  chart.width = 900;
  chart.height = 420;
  chart.x = {"angle of the eye (degrees)", 0, conversion.curves.front().x.back()};
  chart.y = {"light per steradian, of the peak", 0, kMostShown};
  for (const records::ChartSeries& curve : conversion.curves)
    chart.series.push_back({curve.name, curve.x, curve.y, curve.style});
  return chart;
}

}  // namespace lobelia::conversion

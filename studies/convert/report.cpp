#include "studies/convert/convert.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/words/text.hpp"
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
  /// The parameters that have columns: of models with an exponent, of GGX, or of both.
  enum class Shown : std::uint8_t { kExponent = 1, kGgx = 2, kBoth = 3 };

  explicit ConversionTable(Shown shown) : shown_(shown) {
    table_.columns.push_back({"", -20});
    if (shows(Shown::kExponent)) table_.columns.push_back({"exponent", 11, "{:.6g}", 1});
    if (shows(Shown::kGgx)) {
      table_.columns.push_back({"alpha", 10, "{:.4g}", 1});
      table_.columns.push_back({"roughness", 10, "{:.4g}", 1});
    }
    for (const char* title : {"max %", "peak", "width", "energy"})
      table_.columns.push_back({title, 8, "{:.3g}", 1});
    table_.columns.push_back({"misplaced %", 12, "{:.3g}", 1});
    table_.columns.push_back({"dE2000", 8, "{:.3g}", 1});
  }

  void heading(std::string_view text) { table_.rows.push_back({text}); }
  void remark(std::string text) { table_.remarks.push_back(std::move(text)); }
  void add(std::string_view name, const ConvertedHighlight& highlight,
           const records::ConversionErrors& errors) {
    std::vector<studies::Cell>& cells = begin_row(name);
    if (shows(Shown::kExponent)) add_parameter(cells, highlight.exponent);
    for (const auto& parameter : {highlight.alpha, highlight.roughness})
      if (shows(Shown::kGgx)) add_parameter(cells, parameter);
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

  bool shows(Shown parameter) const { return (int(shown_) & int(parameter)) != 0; }
  static void add_parameter(std::vector<studies::Cell>& cells, std::optional<double> parameter) {
    cells.push_back(parameter ? studies::Cell(*parameter) : studies::Cell("-"));
  }

  Shown shown_;
  studies::Table table_;
};

/// The material's highlight, what it is in other models, and all remarks.
void add_material(const records::ConvertedMaterial& material, ConversionTable& table) {
  table.heading(material.from ? fmt::format("{}: {}, {}", material.name, material.from->model,
                                            parameter_text(*material.from))
                              : fmt::format("{}: not converted", material.name));
  for (const records::ConversionBest& best : material.best)
    table.add(best.highlight.model + (best.is_end_of_range ? " (end)" : ""), best.highlight,
              best.errors);
  for (const records::ConversionRule& rule : material.rules)
    if (rule.highlight)
      table.add("  " + rule.name, *rule.highlight, *rule.errors);
    else
      table.heading(fmt::format("    {}: {}", rule.name, rule.because));
  for (const std::string& remark : material.remarks) table.heading("  " + remark);
}

}  // namespace

std::string materials_text(const records::ConvertedMaterials& converted) {
  int shown = 0;
  for (const records::ConvertedMaterial& material : converted.materials)
    for (const records::ConversionBest& best : material.best)
      shown |= int(best.highlight.alpha ? ConversionTable::Shown::kGgx
                                        : ConversionTable::Shown::kExponent);
  ConversionTable table{ConversionTable::Shown(shown)};
  for (const records::ConvertedMaterial& material : converted.materials)
    add_material(material, table);
  table.remark(converted.meaning);
  for (const std::string& remark : converted.remarks) table.remark(remark);
  const std::size_t count = converted.materials.size();
  return fmt::format("{}: {} material{}, best by {}\n\n{}", printable_path(converted.file), count,
                     count == 1 ? "" : "s", measure_title(converted.measure), table.text());
}

std::string conversion_text(const records::Conversion& conversion) {
  ConversionTable table(conversion.to == "ggx" ? ConversionTable::Shown::kGgx
                                               : ConversionTable::Shown::kExponent);
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

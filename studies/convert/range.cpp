#include "studies/convert/convert.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "base/words/constants.hpp"
#include "studies/table.hpp"

namespace lobelia::conversion {
namespace {

constexpr std::string_view kRoughness = "roughness", kExponent = "exponent";

std::string_view scale_of(ShadingModel model) { return model.is_ggx() ? kRoughness : kExponent; }

/// A parameter on the scale that people type: roughness in place of alpha.
double on_scale(ShadingModel model, double parameter) {
  return model.is_ggx() ? std::sqrt(parameter) : parameter;
}

/// Half octaves of the exponent, or twentieths of roughness.
std::vector<double> range_of(ShadingModel model) {
  constexpr int kExponents = 21, kRoughnesses = 20;
  std::vector<double> range;
  for (int i = 0; i < (model.is_ggx() ? kRoughnesses : kExponents); ++i)
    range.push_back(model.is_ggx() ? (i + 1.0) / kRoughnesses : std::exp2(i / 2.0));
  return range;
}

}  // namespace

records::ConversionTable convert_range(const Request& request) {
  records::ConversionTable table;
  table.reflectance = request.f0;
  table.from = request.from.name();
  table.to = request.to.name();
  table.measure = records::kConversionMeasures[std::size_t(request.measure)];
  table.from_parameter = scale_of(request.from);
  table.to_parameter = scale_of(request.to);
  const std::vector<double> range = range_of(request.from);
  const auto parameter_at = [&](std::size_t i) {
    return request.from.is_ggx() ? range[i] * range[i] : range[i];
  };
  const auto column = [&](std::string_view name, const auto& converted) {
    records::ChartSeries& series = table.columns.emplace_back();
    series.name = name;
    series.x = range;
    series.y.resize(range.size());
    oneapi::tbb::parallel_for(std::size_t{0}, range.size(), [&](std::size_t i) {
      series.y[i] = on_scale(request.to, converted(parameter_at(i)));
    });
  };
  for (std::size_t m = 0; m < std::size(records::kConversionMeasures); ++m)
    column(records::kConversionMeasures[m], [&](double parameter) {
      Request one = request;
      one.parameter = parameter;
      return best_parameter(one, Measure(m)).parameter;
    });
  for (const Rule& rule : rules(request.from, request.to))
    column(rule.name, [&](double parameter) { return rule.convert(parameter).value_or(kNaN); });
  return table;
}

std::string range_text(const records::ConversionTable& table) {
  studies::Table shown;
  shown.title = fmt::format("{} of {} for {}", table.to_parameter, table.to, table.from);
  shown.columns.push_back({table.from_parameter, 10, "{:.4g}"});
  for (const records::ChartSeries& column : table.columns)
    shown.columns.push_back({column.name, 10, "{:.4g}"});
  shown.columns[1].above = "best by";
  const std::size_t first_rule = 1 + std::size(records::kConversionMeasures);
  if (first_rule < shown.columns.size()) shown.columns[first_rule].above = "by the rule of";
  const std::size_t rows = table.columns.front().x.size();
  // Every second one: whole octaves, or tenths.
  for (std::size_t i = table.from_parameter == kRoughness ? 1 : 0; i < rows; i += 2) {
    auto& cells = shown.rows.emplace_back();
    cells.emplace_back(table.columns.front().x[i]);
    for (const records::ChartSeries& column : table.columns)
      if (std::isfinite(column.y[i]))
        cells.emplace_back(column.y[i]);
      else
        cells.emplace_back("-");
  }
  return table_text(shown).substr(1);
}

Chart range_chart(const records::ConversionTable& table) {
  Chart chart;
  chart.id = "conversion-table";
  chart.title = fmt::format("The {} of {} that is best for {}, and rules of thumb",
                            table.to_parameter, table.to, table.from);
  chart.description = "The parameter by the one that is converted.";
  chart.width = 900;
  chart.height = 420;
  const std::vector<double>& range = table.columns.front().x;
  chart.x = {fmt::format("{} of {}", table.from_parameter, table.from), range.front(), range.back(),
             table.from_parameter == kExponent};
  const bool is_logarithmic = table.to_parameter == kExponent;
  chart.y = {fmt::format("{} of {}", table.to_parameter, table.to), is_logarithmic ? 0.1 : 0.0,
             is_logarithmic ? 1e4 : 1.0, is_logarithmic};
  for (const records::ChartSeries& column : table.columns) {
    const bool is_measure = std::ranges::count(records::kConversionMeasures, column.name) > 0;
    if (is_measure && column.name != table.measure) continue;
    chart.series.push_back({is_measure ? fmt::format("best by {}", column.name) : column.name,
                            column.x, column.y, int(chart.series.size())});
  }
  return chart;
}

}  // namespace lobelia::conversion

#include "gallery/highlight_tables_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lobelia::gallery {
namespace {

constexpr std::size_t kMostExponents = 1000, kMostPoints = 1000;
constexpr double kLargestDrawn = 1e250;

/// As docs/records.md defines them: 0 to `reach`.
std::vector<double> spread(double reach, double exponent, std::size_t count) {
  const double most = std::asinh(reach * std::sqrt(exponent));
  std::vector<double> result;
  for (std::size_t i = 0; i < count; ++i)
    result.push_back(reach * std::sinh(most * double(i) / double(count - 1)) / std::sinh(most));
  return result;
}

void require_drawable(const Fields& fields, const char* key, const std::vector<double>& values,
                      std::size_t count, double least) {
  if (values.size() != count)
    fields.fail(key, fmt::format("must have {} numbers, not {}", count, values.size()));
  for (const double value : values)
    if (!(value >= least && value <= kLargestDrawn))
      fields.fail(key, "has a number that cannot be drawn");
}

std::vector<double> read_positive(const Fields& fields, const char* key, std::size_t count) {
  std::vector<double> values = fields.numbers(key);
  require_drawable(fields, key, values, count, 1 / kLargestDrawn);
  return values;
}

Rows read_rows(const Fields& fields, const char* key, std::size_t count) {
  Rows rows = fields.rows(key);
  if (rows.size() != count)
    fields.fail(key, fmt::format("must have {} arrays, not {}", count, rows.size()));
  const std::size_t points = rows.empty() ? 0 : rows[0].size();
  if (points < 2 || points > kMostPoints)
    fields.fail(key, fmt::format("must have arrays of 2 to {} numbers", kMostPoints));
  for (const auto& row : rows) require_drawable(fields, key, row, points, -kLargestDrawn);
  return rows;
}

double read_unit(const Fields& fields) {
  const double unit = fields.number("unit").value_or(0);
  if (!(unit > 0 && unit <= 1)) fields.fail("unit", "must be above 0 and at most 1");
  return unit;
}

}  // namespace

double LobeTable::value(double number) const {
  const double scaled = number * unit;
  return order > 0 ? std::pow(std::max(0.0, scaled), order) : std::exp(scaled);
}

std::vector<double> LobeTable::angles(std::size_t exponent, double n) const {
  return spread(reach[exponent], n, curves[exponent].size());
}

double HighlightTable::albedo(double number) const { return std::exp(number * unit); }

std::vector<double> HighlightTable::beam(std::size_t exponent,
                                         const std::vector<double>& incidences) const {
  std::vector<double> result;
  for (std::size_t i = 0; i < incidences.size(); ++i)
    result.push_back(lit.empty() ? albedo(seen[exponent][i])
                                 : albedo(lit[exponent][i]) / std::cos(incidences[i]));
  return result;
}

std::vector<double> HighlightTables::incidences(double n, std::size_t count) const {
  std::vector<double> result = spread(most_grazing, n, count);
  for (double& incidence : result) incidence = most_grazing - incidence;
  return result;
}

HighlightTables read_highlight_tables(const Fields& record) {
  HighlightTables tables{record.numbers("exponents"),
                         record.number("perOctave").value_or(0),
                         record.number("mostGrazing").value_or(0),
                         {},
                         {},
                         {},
                         {}};
  const std::size_t count = tables.exponents.size();
  if (count < 2 || count > kMostExponents || !std::ranges::is_sorted(tables.exponents) ||
      !(tables.exponents.front() > 0) || !(tables.exponents.back() <= kLargestDrawn))
    record.fail("exponents", "must be numbers above 0 that ascend");
  const double per = tables.per_octave;
  if (!(per >= 1 && per <= 16) || per != std::floor(per) || (count - 1) % std::size_t(per) != 0)
    record.fail("perOctave", "must divide the exponents into octaves");
  if (!(tables.most_grazing > 0 && tables.most_grazing < 1.5708))
    record.fail("mostGrazing", "must be an angle below a right one");
  if (const auto errors = record.object("error")) tables.errors = errors->number_members();
  for (const Fields& lobe : record.objects("lobes")) {
    tables.lobes.push_back(
        {lobe.text("name"), lobe.text("title"), lobe.text("formula"),
         lobe.number("order").value_or(0), read_unit(lobe), read_positive(lobe, "reach", count),
         read_positive(lobe, "halfWidth", count), read_rows(lobe, "curves", count)});
  }
  for (const Fields& model : record.objects("models"))
    tables.models.push_back({model.text("name"), model.text("title"), model.text("angle"),
                             model.text("normalised"), model.text("coefficient"),
                             model.flag("appliesCosine")});
  for (const Fields& one : record.objects("highlights")) {
    HighlightTable table{one.text("model"),
                         one.text("lobe"),
                         read_positive(one, "exact", count),
                         {},
                         read_unit(one),
                         read_rows(one, "seen", count),
                         {}};
    if (!one.numbers("paper").empty()) table.paper = read_positive(one, "paper", count);
    if (!one.rows("lit").empty()) {
      table.lit = read_rows(one, "lit", count);
      if (table.lit[0].size() != table.seen[0].size()) one.fail("lit", "must be as long as 'seen'");
    }
    tables.highlights.push_back(std::move(table));
  }
  return tables;
}

}  // namespace lobelia::gallery

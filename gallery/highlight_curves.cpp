#include "gallery/highlight_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/svg_chart.hpp"

namespace lobelia::gallery {
namespace {

constexpr std::size_t kMostExponents = 1000, kMostPoints = 1000;
/// So large that neither a number nor a second difference of rows overflows.
constexpr std::int64_t kLargestNumber = 1'000'000'000'000'000;

/// As docs/records.md defines them: 0 to `reach`.
std::vector<double> spread(double reach, double exponent, std::size_t count) {
  const double most = std::asinh(reach * std::sqrt(exponent));
  std::vector<double> result;
  for (std::size_t i = 0; i < count; ++i)
    result.push_back(reach * std::sinh(most * double(i) / double(count - 1)) / std::sinh(most));
  return result;
}

class Checker {
 public:
  Checker(const std::string& file, std::size_t count) : file_(file), count_(count) {}

  void require(bool condition, const char* what) const {
    if (!condition) throw Error(ExitCode::kInput, fmt::format("{}: {}", file_, what));
  }
  void require_unit(double unit) const {
    require(unit > 0 && unit <= 1, "a unit must be above 0 and at most 1");
  }
  void require_positive(const std::vector<double>& values) const {
    require(values.size() == count_, "a table must have a number for each exponent");
    for (const double value : values)
      require(value >= kSmallestDrawn && value <= kLargestDrawn,
              "a table has a number that cannot be drawn");
  }
  void require_rows(const Rows& rows, std::size_t points) const {
    require(rows.size() == count_, "a table must have a row for each exponent");
    require(points >= 2 && points <= kMostPoints, "a row must have 2 to 1000 numbers");
    for (const auto& row : rows) {
      require(row.size() == points, "all rows of a table must be equally long");
      for (const std::int64_t number : row)
        require(number >= -kLargestNumber && number <= kLargestNumber,
                "a row has a number that cannot be drawn");
    }
  }

 private:
  const std::string& file_;
  std::size_t count_;
};

std::size_t width_of(const Rows& rows) { return rows.empty() ? 0 : rows[0].size(); }

}  // namespace

void require_drawable(const records::HighlightTables& tables, const std::string& file) {
  const std::size_t count = tables.exponents.size();
  const Checker check(file, count);
  check.require(count >= 2 && count <= kMostExponents && std::ranges::is_sorted(tables.exponents) &&
                    tables.exponents.front() > 0 && tables.exponents.back() <= kLargestDrawn,
                "exponents must be numbers above 0 that ascend");
  check.require(tables.per_octave >= 1 && tables.per_octave <= 16 &&
                    (count - 1) % std::size_t(tables.per_octave) == 0,
                "perOctave must divide the exponents into octaves");
  check.require(tables.most_grazing > 0 && tables.most_grazing < 1.5708,
                "mostGrazing must be an angle below a right one");
  for (const records::LobeTable& lobe : tables.lobes) {
    check.require_unit(lobe.unit);
    check.require_positive(lobe.reach);
    check.require_positive(lobe.half_width);
    check.require_rows(lobe.curves, width_of(lobe.curves));
  }
  for (const records::HighlightTable& highlight : tables.highlights) {
    check.require_unit(highlight.unit);
    check.require_positive(highlight.exact);
    check.require_rows(highlight.seen, width_of(highlight.seen));
    if (!highlight.paper.empty()) check.require_positive(highlight.paper);
    if (!highlight.lit.empty()) check.require_rows(highlight.lit, width_of(highlight.seen));
  }
}

double lobe_value(const records::LobeTable& lobe, std::int64_t number) {
  const double scaled = double(number) * lobe.unit;
  return lobe.order > 0 ? std::pow(std::max(0.0, scaled), lobe.order) : std::exp(scaled);
}

std::vector<double> curve_angles(const records::LobeTable& lobe, std::size_t exponent, double n) {
  return spread(lobe.reach[exponent], n, lobe.curves[exponent].size());
}

double albedo_of(const records::HighlightTable& highlight, std::int64_t number) {
  return std::exp(double(number) * highlight.unit);
}

std::vector<double> incidences_of(const records::HighlightTables& tables, double n,
                                  std::size_t count) {
  std::vector<double> result = spread(tables.most_grazing, n, count);
  for (double& incidence : result) incidence = tables.most_grazing - incidence;
  return result;
}

std::vector<double> beam_of(const records::HighlightTable& highlight, std::size_t exponent,
                            const std::vector<double>& incidences) {
  std::vector<double> result;
  for (std::size_t i = 0; i < incidences.size(); ++i)
    result.push_back(highlight.lit.empty() ? albedo_of(highlight, highlight.seen[exponent][i])
                                           : albedo_of(highlight, highlight.lit[exponent][i]) /
                                                 std::cos(incidences[i]));
  return result;
}

}  // namespace lobelia::gallery

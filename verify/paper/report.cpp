#include "verify/paper/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lobelia::paper {
namespace {

std::size_t count(std::span<const Claim> claims, Verdict verdict) {
  return std::size_t(std::ranges::count(claims, verdict, &Claim::verdict));
}

/// More digits than a drawing shows would only make the record long.
std::vector<double> rounded(std::vector<double> values) {
  for (double& value : values)
    if (std::isfinite(value)) value = std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
  return values;
}

records::ChartAxis axis_record(const ChartAxis& axis) {
  return {axis.label, axis.from, axis.to, axis.logarithmic ? std::optional(true) : std::nullopt,
          axis.ticks};
}

records::PaperFigure figure_record(const Plot& plot) {
  const Chart& chart = plot.chart;
  records::PaperFigure record;
  record.id = chart.id;
  record.title = chart.title;
  record.description = chart.description;
  record.x = axis_record(chart.x);
  record.y = axis_record(chart.y);
  for (const ChartBand& band : chart.bands)
    record.bands.push_back({band.label, band.from, band.to});
  for (const ChartSeries& series : chart.series)
    record.series.push_back({series.label, series.style, rounded(series.x), rounded(series.y)});
  record.claims.assign(plot.claims.begin(), plot.claims.end());
  return record;
}

records::Claim claim_record(const Claim& claim) {
  records::Claim record;
  record.name = claim.name;
  record.where = claim.where;
  record.statement = claim.statement;
  record.printed = claim.printed;
  for (const Figure& figure : claim.measured)
    record.measured.push_back({figure.what, figure.value, figure.text, figure.at});
  record.definition = claim.definition;
  record.verdict = name(claim.verdict);
  record.reason = claim.reason;
  return record;
}

}  // namespace

std::string text_of(const Figure& figure) {
  return figure.text + (figure.at.empty() ? "" : " (" + figure.at + ")");
}

std::string counts_text(std::span<const Claim> claims) {
  return fmt::format("{} confirmed, {} not reproduced, {} found beyond the paper",
                     count(claims, Verdict::kConfirmed), count(claims, Verdict::kNotReproduced),
                     count(claims, Verdict::kFound));
}

std::string table_text(std::span<const Claim> claims) {
  static constexpr char kLine[] = "{:<16}{:<30}{:<28}{}\n";
  std::string text = fmt::format(kLine, "verdict", "claim", "the paper prints", "measured");
  for (const Claim& claim : claims) {
    const Figure& first = claim.measured.front();
    text += fmt::format(kLine, name(claim.verdict), claim.name,
                        claim.printed.empty() ? "-" : claim.printed,
                        first.what + ": " + text_of(first));
  }
  return text + "\n" + counts_text(claims) + "\n";
}

records::VerifyPaper paper_record(std::span<const Claim> claims,
                                  const std::vector<std::string>& command,
                                  std::span<const Plot> plots) {
  records::VerifyPaper record;
  record.command = command;
  record.confirmed = count(claims, Verdict::kConfirmed);
  record.not_reproduced = count(claims, Verdict::kNotReproduced);
  record.found = count(claims, Verdict::kFound);
  for (const Claim& claim : claims) record.claims.push_back(claim_record(claim));
  for (const Plot& plot : plots) record.figures.push_back(figure_record(plot));
  return record;
}

}  // namespace lobelia::paper

#include "verify/paper/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/chart_record.hpp"

namespace lobelia::paper {
namespace {

long count(std::span<const Claim> claims, Verdict verdict) {
  return std::count_if(claims.begin(), claims.end(),
                       [verdict](const Claim& claim) { return claim.verdict == verdict; });
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

Json paper_record(std::span<const Claim> claims, const std::vector<std::string>& command,
                  std::span<const Plot> plots) {
  Json record = make_record("verify-paper");
  if (!command.empty()) record["command"] = command;
  record["confirmed"] = count(claims, Verdict::kConfirmed);
  record["notReproduced"] = count(claims, Verdict::kNotReproduced);
  record["found"] = count(claims, Verdict::kFound);
  record["claims"] = Json::array();
  for (const Claim& claim : claims) {
    Json measured = Json::array();
    for (const Figure& figure : claim.measured) {
      Json one = {{"what", figure.what}, {"value", figure.value}, {"text", figure.text}};
      if (!figure.at.empty()) one["at"] = figure.at;
      measured.push_back(one);
    }
    record["claims"].push_back({{"name", claim.name},
                                {"where", claim.where},
                                {"statement", claim.statement},
                                {"printed", claim.printed},
                                {"measured", measured},
                                {"definition", claim.definition},
                                {"verdict", name(claim.verdict)},
                                {"reason", claim.reason}});
  }
  for (const Plot& plot : plots) {
    Json figure = chart_record(plot.chart);
    figure["claims"] = plot.claims;
    record["figures"].push_back(figure);
  }
  return record;
}

}  // namespace lobelia::paper

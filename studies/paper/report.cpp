#include "studies/paper/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "studies/table.hpp"

namespace lobelia::paper {
namespace {

std::size_t count(std::span<const Claim> claims, std::string_view verdict) {
  return std::size_t(std::ranges::count(claims, verdict, &Claim::verdict));
}

/// "13 confirmed, 9 not reproduced, 9 found beyond the paper"
std::string counts_text(std::span<const Claim> claims) {
  return fmt::format("{} confirmed, {} not reproduced, {} found beyond the paper",
                     count(claims, kConfirmed), count(claims, kNotReproduced),
                     count(claims, kFound));
}

/// "largest difference: 1.70e-2 (n = 1024, x = 3.54 degrees)"
std::string first_figure(const Claim& claim) {
  const Figure& first = claim.measured.front();
  return fmt::format("{}: {}{}", first.what, first.text,
                     first.at.empty() ? "" : " (" + first.at + ")");
}

constexpr char kHead[] = R"(# The paper, measured

<!-- Made by `lobelia verify paper --errata`; a test keeps the two the same. -->

For anyone who uses the paper: which of its claims and figures hold.

O. N. Romanyuk, I. V. Abramchuk, S. A. Kyrylashchuk, S. O. Romanyuk, *Modelling of a specular component of
colour by using energy-correct models of surface reflectivity* (Vinnytsia National Technical University).
Every figure is recomputed from the printed formulas by quadrature in long double, apart from the renderer's
code. `lobelia verify paper` does this again in 15 to 35 s on one processor. `--json` gives all digits,
`--plots` the curves.

)";

std::string section(const char* title, const char* lead, std::span<const Claim> claims,
                    std::string_view verdict) {
  std::string text = fmt::format("\n## {}\n\n{}\n", title, lead);
  for (const Claim& claim : claims) {
    if (claim.verdict != verdict) continue;
    text += fmt::format("\n### {}\n\n*{}* ({}): {}.", claim.name,
                        verdict == kFound ? "Looked at" : "Claim", claim.where, claim.statement);
    if (!claim.printed.empty()) text += fmt::format(" Printed: {}.", claim.printed);
    studies::Table figures{"", {{"measured"}, {"value"}, {"where"}}, {}};
    for (const Figure& figure : claim.measured)
      figures.rows.push_back({figure.what, figure.text, figure.at});
    text += "\n\n" + table_markdown(figures);
    text += fmt::format("\n*How*: {}.\n", claim.definition);
    if (!claim.reason.empty()) text += fmt::format("\n*Why*: {}.\n", claim.reason);
  }
  return text;
}

}  // namespace

std::string table_text(std::span<const Claim> claims) {
  studies::Table table{
      "", {{"verdict", -16}, {"claim", -30}, {"the paper prints", -28}, {"measured"}}, {}};
  for (const Claim& claim : claims)
    table.rows.push_back({claim.verdict, claim.name, claim.printed.empty() ? "-" : claim.printed,
                          first_figure(claim)});
  return studies::table_text(table) + "\n" + counts_text(claims) + "\n";
}

std::string errata_document(std::span<const Claim> claims) {
  studies::Table table{"", {{"claim"}, {"printed"}, {"measured"}, {"verdict"}}, {}};
  for (const Claim& claim : claims) {
    std::string anchor = claim.name;
    std::erase(anchor, '.');  // as in the anchors of headings
    table.rows.push_back({fmt::format("[{}](#{})", claim.name, anchor), claim.printed,
                          first_figure(claim), claim.verdict});
  }
  return kHead + counts_text(claims) + ".\n\n" + table_markdown(table) +
         section("Not reproduced", "Claims that the measurement contradicts.", claims,
                 kNotReproduced) +
         section("Confirmed", "Claims that hold, with the definition under which they hold.",
                 claims, kConfirmed) +
         section("Found beyond the paper",
                 "What the paper does not mention and its users should know.", claims, kFound);
}

records::VerifyPaper paper_record(std::vector<Claim> claims, std::vector<std::string> command,
                                  std::vector<records::PaperFigure> figures) {
  records::VerifyPaper record;
  record.command = std::move(command);
  record.confirmed = count(claims, kConfirmed);
  record.not_reproduced = count(claims, kNotReproduced);
  record.found = count(claims, kFound);
  record.claims = std::move(claims);
  record.figures = std::move(figures);
  return record;
}

}  // namespace lobelia::paper

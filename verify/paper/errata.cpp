#include "verify/paper/errata.hpp"

#include <fmt/format.h>

#include "verify/paper/report.hpp"

namespace lobelia::paper {
namespace {

constexpr char kHead[] = R"(# The paper, measured

<!-- Made by `lobelia verify paper --errata`; a test keeps the two the same. -->

What is true of O. N. Romanyuk, I. V. Abramchuk, S. A. Kyrylashchuk, S. O. Romanyuk, *Modelling of a
specular component of colour by using energy-correct models of surface reflectivity* (Vinnytsia
National Technical University). Every figure and claim is recomputed from the formulas as they are
printed, by quadrature in long double, apart from the renderer's own code. `lobelia verify paper`
measures it again in about a second, `--json` gives all digits, `--plots` the curves.

)";

void add_section(std::string& text, const char* title, const char* lead,
                 std::span<const Claim> claims, Verdict verdict) {
  text += fmt::format("\n## {}\n\n{}\n", title, lead);
  for (const Claim& claim : claims) {
    if (claim.verdict != verdict) continue;
    text += fmt::format("\n### {}\n\n*{}* ({}): {}.", claim.name,
                        verdict == Verdict::kFound ? "Looked at" : "Claim", claim.where,
                        claim.statement);
    if (!claim.printed.empty()) text += fmt::format(" Printed: {}.", claim.printed);
    text += "\n\n| measured | value | where |\n|---|---|---|\n";
    for (const Figure& figure : claim.measured)
      text += fmt::format("| {} | {} | {} |\n", figure.what, figure.text, figure.at);
    text += fmt::format("\n*How*: {}.\n", claim.definition);
    if (!claim.reason.empty()) text += fmt::format("\n*Why*: {}.\n", claim.reason);
  }
}

}  // namespace

std::string errata_document(std::span<const Claim> claims) {
  std::string text =
      kHead + counts_text(claims) + ".\n\n| claim | printed | measured | verdict |\n";
  text += "|---|---|---|---|\n";
  for (const Claim& claim : claims)
    text += fmt::format("| [{0}](#{0}) | {1} | {2}: {3} | {4} |\n", claim.name, claim.printed,
                        claim.measured.front().what, text_of(claim.measured.front()),
                        name(claim.verdict));
  add_section(text, "Not reproduced", "Claims that a measurement does not bear out.", claims,
              Verdict::kNotReproduced);
  add_section(text, "Confirmed", "Claims that hold, with the definition under which they do.",
              claims, Verdict::kConfirmed);
  add_section(text, "Found beyond the paper",
              "What the paper does not speak of and whoever uses it should know.", claims,
              Verdict::kFound);
  return text;
}

}  // namespace lobelia::paper

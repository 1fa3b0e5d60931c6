#include <fmt/format.h>

#include <algorithm>

#include "studies/agreement/report.hpp"

namespace lobelia::agreement {
namespace {

constexpr char kHead[] = R"(# The references, compared

<!-- Made by `lobelia verify references --markdown`; `make references` makes it again. -->

How far each reference is from the analytic picture. The analytic picture is the formulas of
[conventions](conventions.md), evaluated pixel by pixel in double, in 50 digits from n = 1e5 on, with geometry of
their own ([decision 3](decisions/0003-references.md)).

- *Lobelia* is `lobelia render`.
- *Native*: the engine shades the model itself.
- *Expressed*: the model is reimplemented in the engine's language.
- *Half*: POV-Ray writes half floats. *Float*: a second pass adds what they round off.
- *POV-Ray against Blender Cycles*: both were told the same formula, POV-Ray in float. Smaller differences from us
  are not meaningful.

)";

std::string section(const Table& table) {
  std::string text = fmt::format("\n## {}\n\n", table.title);
  if (table.rows.empty()) return text + "None.\n";
  return text + table.remarks.at(0) + "\n\n" + table_markdown(table);
}

/// The meaning of the columns of figures.
Table column_table() {
  return {
      "",
      {{"column"}, {""}},
      {{"max, RMS",
        "of the difference, over the peak of the analytic picture; RMS over the lit pixels"},
       {"relative",
        fmt::format("largest difference over the value, where the value is above {} of the peak",
                    short_number(kRelativeFrom))},
       {"ring",
        "pixels beside a silhouette, a terminator, a shadow's or a checker's edge, where a "
        "rounding decides over a pixel's whole value; they are left out of the columns before. "
        "Most in one picture"},
       {"over",
        fmt::format("of those in the ring, farther off than {} of the peak; at most 3 may be, "
                    "{} beside checkers",
                    short_number(kRingOfPeak), kCheckerRing)},
       {"target", "what the largest difference of a picture is held to"}}};
}

/// The reasons of the variants that miss a target.
std::string reasons(const Agreement& agreement) {
  std::string text;
  const auto add = [&](const Variant& variant) {
    const bool missed = std::ranges::any_of(agreement.rows, [&](const Row& row) {
      return row.variant.name == variant.name && row.verdict == Verdict::kMissed;
    });
    if (missed) text += fmt::format("\n*{}*: the reason is not known.\n", variant.title);
  };
  add(ours());
  for (const Variant& variant : variants()) add(variant);
  return text;
}

}  // namespace

std::vector<std::string> markdown_headings() {
  std::vector<std::string> headings;
  for (const auto table : {headline_table, miss_table, lobe_table, model_table, effect_table,
                           soft_table, refusal_table})
    headings.push_back("## " + table({}).title);
  return headings;
}

std::string report_markdown(const Agreement& agreement, std::string_view command) {
  std::string text = kHead;
  text += fmt::format(
      "`{}`: pictures {} pixels wide, of the whole sphere below n = {:g} and from there on "
      "of the highlight alone, so that it is resolved. ",
      command, agreement.scope.size, kCloseUpExponent);
  for (const records::AgreementEngine& engine : agreement.engines)
    text += engine.available ? fmt::format("{} is {}. ", engine.title, engine.version)
                             : fmt::format("{} was not there. ", engine.title);
  text += "**" + verdict_sentence(agreement) + ".**\n";
  text += "\n" + table_markdown(column_table());
  for (const auto table : {headline_table, miss_table, lobe_table, model_table, effect_table,
                           soft_table, refusal_table}) {
    text += section(table(agreement));
    if (table == miss_table) text += reasons(agreement);
  }
  return text;
}

}  // namespace lobelia::agreement

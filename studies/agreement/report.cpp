#include <fmt/format.h>

#include <algorithm>

#include "studies/agreement/agreement.hpp"

namespace lobelia::agreement {
namespace {

records::AgreementRow row_record(const Agreement& agreement, const Row& row) {
  const Case& one = agreement.cases[row.index];
  records::AgreementRow record;
  record.group = kGroupNames[std::size_t(one.group)];
  record.what = one.what;
  record.model = one.highlight.model;
  record.lobe = one.highlight.lobe;
  record.normalisation = one.highlight.normalisation;
  record.exponent = one.highlight.exponent;
  record.view = one.close_up ? "close-up" : "whole";
  record.width = one.scene.film.width;
  record.height = one.scene.film.height;
  record.variant = row.variant.name;
  record.why = row.why;
  if (row.why.empty()) {
    const Figures& f = row.figures;
    record.max_of_peak = f.max_of_peak;
    record.rms_of_peak = f.rms_of_peak;
    record.max_relative = f.max_relative;
    record.ring = records::Ring{f.ring_pixels, f.ring_over, one.ring_allowed, f.ring_max_of_peak};
  }
  if (const auto target = target_of(row.variant, one)) {
    records::Target& asked = record.target.emplace();
    (target->relative ? asked.relative : asked.of_peak) = target->limit;
  }
  record.verdict = kVerdictNames[std::size_t(row.verdict)];
  return record;
}

records::SoftRow soft_record(const SoftRow& row) {
  records::SoftRow record;
  record.what = row.what;
  record.variant = row.variant.name;
  record.counts = row.counts;
  record.why = row.why;
  record.verdict = kVerdictNames[std::size_t(row.verdict)];
  return record;
}

}  // namespace

records::Agreement report_record(const Agreement& agreement,
                                 const std::vector<std::string>& command) {
  records::Agreement record;
  record.command = command;
  record.small = agreement.scope.small;
  record.engines = agreement.engines;
  for (std::size_t v = 0; v < std::size(kVerdictNames); ++v)
    record.verdicts.emplace_back(kVerdictNames[v], agreement.count(Verdict(v)));
  for (const Row& row : agreement.rows) record.rows.push_back(row_record(agreement, row));
  for (const SoftRow& row : agreement.soft) record.soft.push_back(soft_record(row));
  return record;
}

std::string verdict_sentence(const Agreement& agreement) {
  const std::size_t missed = agreement.count(Verdict::kMissed),
                    failed = agreement.count(Verdict::kFailed),
                    refused = agreement.count(Verdict::kNotComparable),
                    all = agreement.rows.size() + agreement.soft.size();
  std::string text = fmt::format("{} comparisons, ", all - refused - failed);
  if (missed > 0)
    text += fmt::format("{} MISSED their targets", missed);
  else
    text += failed == 0 ? "all within their targets" : "none misses its target";
  if (failed > 0) text += fmt::format(", {} FAILED", failed);
  return text + fmt::format(", {} not comparable", refused);
}

std::string report_text(const Agreement& agreement) {
  std::string text;
  for (const auto table : {lobe_table, model_table, effect_table, soft_table, refusal_table,
                           miss_table, headline_table}) {
    Table made = table(agreement);
    made.title += "\n";
    made.remarks.clear();
    if (!made.rows.empty()) text += table_text(made);
  }
  return text + "\n" + verdict_sentence(agreement) + "\n";
}

std::string report_csv(const Agreement& agreement) {
  Table lines;
  for (const char* column :
       {"group", "what", "model", "lobe", "normalisation", "exponent", "view", "width", "height",
        "witness", "max_of_peak", "rms_of_peak", "max_relative", "ring_pixels", "ring_over",
        "ring_max_of_peak", "target", "verdict", "why"})
    lines.columns.push_back({column});
  for (const Row& row : agreement.rows) {
    const Case& one = agreement.cases[row.index];
    const HighlightChoice& h = one.highlight;
    const Figures& f = row.figures;
    const auto target = target_of(row.variant, one);
    const bool none = row.verdict == Verdict::kNotComparable || row.verdict == Verdict::kFailed;
    const auto figure = [&](double value) { return none ? studies::Cell("") : value; };
    lines.rows.push_back({kGroupNames[std::size_t(one.group)], one.what, h.model, h.lobe,
                          h.normalisation, h.exponent, one.close_up ? "close-up" : "whole",
                          one.scene.film.width, one.scene.film.height, row.variant.name,
                          figure(f.max_of_peak), figure(f.rms_of_peak), figure(f.max_relative),
                          figure(f.ring_pixels), figure(f.ring_over), figure(f.ring_max_of_peak),
                          target ? target_text(*target) : "",
                          kVerdictNames[std::size_t(row.verdict)], row.why});
  }
  return table_csv(lines);
}

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

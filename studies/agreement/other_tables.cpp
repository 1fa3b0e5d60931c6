#include <map>

#include "studies/agreement/report.hpp"
#include "studies/agreement/table_parts.hpp"

namespace lobelia::agreement {

Table effect_table(const Agreement& agreement) {
  std::vector<std::string> head{"effect", "variant"};
  append(head, {kFigureHead.begin() + 1, kFigureHead.end()});
  append(head, {"target", "verdict"});
  Table table =
      words_table("Effects", "One picture each, n = 30; targets are those of n up to 1024.", head);
  for (std::size_t i = 0; i < agreement.cases.size(); ++i) {
    if (agreement.cases[i].group != Group::kEffect) continue;
    for (const Row& row : agreement.rows) {
      if (row.index != i || !is_shown(row)) continue;
      Worst worst;
      worst.add(row);
      const auto target = target_of(row.variant, agreement.cases[i].highlight.exponent);
      std::vector<std::string> words{std::string(agreement.cases[i].what),
                                     std::string(row.variant.title)};
      const auto figures = figure_words(worst);
      append(words, {figures.begin() + 1, figures.end()});
      append(words, {target ? target_text(*target) : "", verdict_text(worst, target.has_value())});
      add_row(table, words);
    }
  }
  return table;
}

Table soft_table(const Agreement& agreement) {
  Table table = words_table(
      "Effects that are averages",
      fmt::format(
          "An engine's mean over points of lights, lens and pixel against what our own sampling "
          "converges to. 'beyond' is the fraction of values farther off than chance allows any value "
          "of one picture in a thousand (Student's t over {} sets, Sidak's correction); at most {} "
          "values may be. All pixels share their points, so RMS is a single draw and its ratio scatters: "
          "from 0.6 to 15 over five seeds, for four times the points.",
          kReplicates, kBeyondAllowed),
      {"effect", "variant", "points", "beyond", "RMS of peak", "points", "beyond", "RMS of peak",
       "RMS ratio", "verdict"});
  for (const SoftRow& row : agreement.soft) {
    std::vector<std::string> words{std::string(row.what), std::string(row.variant.title)};
    for (const auto& count : row.counts)
      append(words, {std::to_string(count.points),
                     fmt::format("{}/{}", count.statistics.beyond, count.statistics.values),
                     short_number(count.rms_of_peak)});
    words.resize(8);
    words.push_back(row.counts.size() == 2 ? fmt::format("{:.1f}", row.counts[0].rms_of_peak /
                                                                       row.counts[1].rms_of_peak)
                                           : "");
    words.push_back(row.verdict == Verdict::kFailed   ? "FAILED: " + row.why
                    : row.verdict == Verdict::kMissed ? "MISSED"
                                                      : "met");
    add_row(table, words);
  }
  return table;
}

Table refusal_table(const Agreement& agreement) {
  Table table = words_table("Not comparable", "What a variant was not asked for.",
                            {"variant", "of", "pictures", "not comparable, because"});
  for (const EngineHere& engine : agreement.engines)
    if (!engine.status.available())
      add_row(table, {std::string(engine.info.title), "everything", "", engine.status.why});
  struct Line {
    int pictures = 0;
    Ordered<bool> of;
  };
  Ordered<Ordered<Line>> by_variant;
  for (const Row& row : agreement.rows) {
    if (row.verdict != Verdict::kNotComparable) continue;
    const Case& one = agreement.cases[row.index];
    Line& line = by_variant[std::string(row.variant.title)][row.why];
    ++line.pictures;
    line.of[one.group == Group::kHighlight ? "highlights" : std::string(one.what)] = true;
  }
  for (const auto& [variant, by_reason] : by_variant.entries)
    for (const auto& [why, line] : by_reason.entries) {
      std::string of;
      for (const auto& [name, is_there] : line.of.entries) of += (of.empty() ? "" : ", ") + name;
      add_row(table, {variant, of, std::to_string(line.pictures), why});
    }
  return table;
}

Table miss_table(const Agreement& agreement) {
  Table table = words_table(
      "Missed",
      "The worst of what is not within its target, or is none; agreement.csv has every "
      "picture. 'over' is the most in one.",
      {"variant", "n", "light or effect", "pictures", "max", "relative", "over", "target"});
  Ordered<std::map<double, Ordered<Worst>>> by_variant;
  std::map<std::pair<std::string, double>, std::string> targets;
  for (const Row& row : agreement.rows) {
    if (row.verdict != Verdict::kMissed && row.verdict != Verdict::kFailed) continue;
    const Case& one = agreement.cases[row.index];
    const std::string variant(row.variant.title);
    const double range = range_of(one.highlight.exponent);
    by_variant[variant][range][std::string(one.what)].add(row);
    if (row.verdict == Verdict::kFailed)
      targets[{variant, range}] = "FAILED: " + row.why;
    else if (const auto target = target_of(row.variant, one.highlight.exponent))
      targets.try_emplace({variant, range}, target_text(*target));
  }
  for (const auto& [variant, by_range] : by_variant.entries)
    for (const auto& [range, by_what] : by_range)
      for (const auto& [what, worst] : by_what.entries)
        add_row(table,
                {variant, range_text(range), what, std::to_string(worst.pictures + worst.failed),
                 short_number(worst.figures.max_of_peak), short_number(worst.figures.max_relative),
                 std::to_string(worst.figures.ring_over), targets[{variant, range}]});
  return table;
}

std::string verdict_sentence(const Agreement& agreement) {
  const std::size_t missed = agreement.count(Verdict::kMissed),
                    failed = agreement.count(Verdict::kFailed),
                    refused = agreement.count(Verdict::kNotComparable),
                    all = agreement.rows.size() + agreement.soft.size();
  std::string text = fmt::format("{} comparisons, ", all - refused - failed);
  text += missed == 0 ? "all within their targets" : fmt::format("{} MISSED their targets", missed);
  if (failed > 0) text += fmt::format(", {} FAILED", failed);
  return text + fmt::format(", {} not comparable", refused);
}

}  // namespace lobelia::agreement

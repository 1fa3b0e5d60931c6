#include <algorithm>
#include <functional>
#include <map>

#include "studies/agreement/report.hpp"
#include "studies/agreement/table_parts.hpp"

namespace lobelia::agreement {
namespace {

bool relative_counts(const Variant& variant) {
  const auto target = target_of(variant, 1);
  return target && target->relative;
}

/// By variant, then by what `name_of` says of a case; a column for each exponent.
Table worst_table(const Agreement& agreement, const std::string& title, const std::string& what,
                  const std::function<std::string(const Case&)>& name_of) {
  std::vector<double> exponents;
  for (const Case& one : agreement.cases)
    if (one.group == Group::kHighlight) exponents.push_back(one.highlight.exponent);
  std::ranges::sort(exponents);
  exponents.erase(std::ranges::unique(exponents).begin(), exponents.end());

  Ordered<Ordered<std::map<double, Worst>>> by_variant;
  std::map<std::string, bool> relative;
  for (const Row& row : agreement.rows) {
    const Case& one = agreement.cases[row.index];
    if (one.group != Group::kHighlight || !is_shown(row)) continue;
    const std::string variant(row.variant.title);
    by_variant[variant][name_of(one)][one.highlight.exponent].add(row);
    relative[variant] = relative_counts(row.variant);
  }
  std::vector<std::string> head{"variant", what, "of the"};
  for (const double n : exponents) head.push_back("n = " + exponent_text(n));
  Table table =
      words_table(title,
                  "The largest difference over all lights: of the value where the target is of the "
                  "value, otherwise of the peak.",
                  head);
  for (auto& [variant, by_name] : by_variant.entries)
    for (auto& [name, by_exponent] : by_name.entries) {
      std::vector<std::string> words{variant, name, relative[variant] ? "value" : "peak"};
      for (const double n : exponents) {
        const auto found = by_exponent.find(n);
        if (found == by_exponent.end()) {
          words.push_back("");
          continue;
        }
        const Worst& worst = found->second;
        if (worst.failed > 0) {
          words.push_back("FAILED");
          continue;
        }
        words.push_back(short_number(relative[variant] ? worst.figures.max_relative
                                                       : worst.figures.max_of_peak) +
                        (worst.missed > 0 ? " MISSED" : ""));
      }
      add_row(table, words);
    }
  return table;
}

std::string lobe_words(const HighlightChoice& h) {
  return fmt::format("{}{}", h.lobe, h.normalisation == "paper" ? ", paper" : "");
}

}  // namespace

Table headline_table(const Agreement& agreement) {
  std::vector<std::string> head{"variant", "n"};
  append(head, kFigureHead);
  append(head, {"target", "verdict"});
  Table table = words_table(
      "Highlights",
      "The worst over models, lobes and lights; max, RMS and ring max are of the peak.", head);
  struct Line {
    Worst worst;
    std::string target;
  };
  Ordered<std::map<double, Line>> lines;
  for (const Row& row : agreement.rows) {
    const Case& one = agreement.cases[row.index];
    if (one.group != Group::kHighlight || !is_shown(row)) continue;
    Line& line = lines[std::string(row.variant.title)][range_of(one.highlight.exponent)];
    line.worst.add(row);
    if (const auto target = target_of(row.variant, one.highlight.exponent))
      line.target = target_text(*target);
  }
  for (const auto& [variant, by_range] : lines.entries)
    for (const auto& [range, line] : by_range) {
      std::vector<std::string> words{variant, range_text(range)};
      append(words, figure_words(line.worst));
      append(words, {line.target, verdict_text(line.worst, !line.target.empty())});
      add_row(table, words);
    }
  return table;
}

Table lobe_table(const Agreement& agreement) {
  return worst_table(agreement, "By lobe", "lobe",
                     [](const Case& one) { return lobe_words(one.highlight); });
}

Table model_table(const Agreement& agreement) {
  return worst_table(agreement, "By model", "model", [](const Case& one) {
    return std::string(info(*find_model(one.highlight.model)).title);
  });
}

}  // namespace lobelia::agreement

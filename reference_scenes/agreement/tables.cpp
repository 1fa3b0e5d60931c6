#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "reference_scenes/agreement/report.hpp"

namespace lobelia::agreement {
namespace {

/// The worst of several pictures.
struct Worst {
  Figures figures;
  int pictures = 0, missed = 0, failed = 0;
  void add(const Row& row) {
    if (row.verdict == Verdict::kFailed) {
      ++failed;
      return;
    }
    ++pictures;
    missed += row.verdict == Verdict::kMissed;
    widen(figures, row.figures);
  }
};

bool is_shown(const Row& row) { return row.verdict != Verdict::kNotComparable; }

std::string verdict_text(const Worst& worst, bool has_target) {
  if (worst.failed > 0) return fmt::format("{} FAILED", worst.failed);
  if (worst.missed > 0) return fmt::format("{} MISSED", worst.missed);
  return has_target ? "met" : "no target";
}

/// Rows of a table of figures after what names them.
std::vector<std::string> figure_words(const Worst& worst) {
  const Figures& f = worst.figures;
  return {std::to_string(worst.pictures),  short_number(f.max_of_peak),
          short_number(f.rms_of_peak),     short_number(f.max_relative),
          std::to_string(f.ring_pixels),   std::to_string(f.ring_over),
          short_number(f.ring_max_of_peak)};
}
const std::vector<std::string> kFigureHead = {"pictures", "max",  "RMS",     "relative",
                                              "ring",     "over", "ring max"};

void append(std::vector<std::string>& words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
}

/// The end of the range of exponents that shares a line.
double range_of(double exponent) { return std::max(exponent, 1024.0); }
std::string exponent_text(double exponent) {
  return exponent < 1e5 ? fmt::format("{:g}", exponent) : short_number(exponent);
}

/// In the order in which they are first met.
template <class Value>
struct Ordered {
  std::vector<std::pair<std::string, Value>> entries;
  Value& operator[](const std::string& key) {
    const auto found = std::ranges::find(entries, key, &std::pair<std::string, Value>::first);
    if (found != entries.end()) return found->second;
    return entries.emplace_back(key, Value{}).second;
  }
};

bool relative_counts(const WitnessKind& witness) {
  const auto target = target_of(witness, 1);
  return target && target->relative;
}

/// By witness, then by what `name_of` says of a case; a column for each exponent.
Table worst_table(const Agreement& agreement, const std::string& title, const std::string& what,
                  const std::function<std::string(const Case&)>& name_of) {
  std::vector<double> exponents;
  for (const Case& one : agreement.cases)
    if (one.group == Group::kHighlight) exponents.push_back(one.highlight.exponent);
  std::ranges::sort(exponents);
  exponents.erase(std::ranges::unique(exponents).begin(), exponents.end());

  Ordered<Ordered<std::map<double, Worst>>> by_witness;
  std::map<std::string, bool> relative;
  for (const Row& row : agreement.rows) {
    const Case& one = agreement.cases[row.index];
    if (one.group != Group::kHighlight || !is_shown(row)) continue;
    const std::string witness(row.witness.title);
    by_witness[witness][name_of(one)][one.highlight.exponent].add(row);
    relative[witness] = relative_counts(row.witness);
  }
  Table table{title,
              "The largest difference over all lights: of the value where the target is of the "
              "value, otherwise of the peak.",
              {"witness", what, "of the"},
              {}};
  for (const double n : exponents) table.head.push_back("n = " + exponent_text(n));
  for (auto& [witness, by_name] : by_witness.entries)
    for (auto& [name, by_exponent] : by_name.entries) {
      std::vector<std::string> words{witness, name, relative[witness] ? "value" : "peak"};
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
        words.push_back(short_number(relative[witness] ? worst.figures.max_relative
                                                       : worst.figures.max_of_peak) +
                        (worst.missed > 0 ? " MISSED" : ""));
      }
      table.rows.push_back(std::move(words));
    }
  return table;
}

std::string lobe_words(const HighlightChoice& h) {
  return fmt::format("{}{}", h.lobe, h.normalisation == "paper" ? ", paper" : "");
}

}  // namespace

Table headline_table(const Agreement& agreement) {
  Table table{"Highlights",
              "The worst over models, lobes and lights; max, RMS and ring max are of the peak.",
              {"witness", "n"},
              {}};
  append(table.head, kFigureHead);
  append(table.head, {"target", "verdict"});
  struct Line {
    Worst worst;
    std::string target;
  };
  Ordered<std::map<double, Line>> lines;
  for (const Row& row : agreement.rows) {
    const Case& one = agreement.cases[row.index];
    if (one.group != Group::kHighlight || !is_shown(row)) continue;
    Line& line = lines[std::string(row.witness.title)][range_of(one.highlight.exponent)];
    line.worst.add(row);
    if (const auto target = target_of(row.witness, one.highlight.exponent))
      line.target = target_text(*target);
  }
  for (const auto& [witness, by_range] : lines.entries)
    for (const auto& [range, line] : by_range) {
      std::vector<std::string> words{witness, range <= 1024 ? "up to 1024" : short_number(range)};
      append(words, figure_words(line.worst));
      append(words, {line.target, verdict_text(line.worst, !line.target.empty())});
      table.rows.push_back(std::move(words));
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

Table effect_table(const Agreement& agreement) {
  Table table{"Effects",
              "One picture each, n = 30; targets are those of n up to 1024.",
              {"effect", "witness"},
              {}};
  append(table.head, {kFigureHead.begin() + 1, kFigureHead.end()});
  append(table.head, {"target", "verdict"});
  for (std::size_t i = 0; i < agreement.cases.size(); ++i) {
    if (agreement.cases[i].group != Group::kEffect) continue;
    for (const Row& row : agreement.rows) {
      if (row.index != i || !is_shown(row)) continue;
      Worst worst;
      worst.add(row);
      const auto target = target_of(row.witness, agreement.cases[i].highlight.exponent);
      std::vector<std::string> words{std::string(agreement.cases[i].what),
                                     std::string(row.witness.title)};
      const auto figures = figure_words(worst);
      append(words, {figures.begin() + 1, figures.end()});
      append(words, {target ? target_text(*target) : "", verdict_text(worst, target.has_value())});
      table.rows.push_back(std::move(words));
    }
  }
  return table;
}

Table soft_table(const Agreement& agreement) {
  Table table{
      "Effects that are averages",
      fmt::format(
          "An engine's mean over points of lights, lens and pixel against what our own sampling "
          "converges to. 'beyond' is the fraction of values farther off than chance allows any value "
          "of one picture in a thousand (Student's t over {} sets, Sidak's correction); at most {} "
          "values may be, for neighbours share points.",
          kReplicates, kBeyondAllowed),
      {"effect", "witness", "points", "beyond", "RMS of peak", "points", "beyond", "RMS of peak",
       "RMS ratio", "verdict"},
      {}};
  for (const SoftRow& row : agreement.soft) {
    std::vector<std::string> words{std::string(row.what), std::string(row.witness.title)};
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
    table.rows.push_back(std::move(words));
  }
  return table;
}

Table refusal_table(const Agreement& agreement) {
  Table table{"Not comparable",
              "What a witness was not asked for.",
              {"witness", "of", "pictures", "not comparable, because"},
              {}};
  for (const EngineHere& engine : agreement.engines)
    if (!engine.status.available)
      table.rows.push_back({std::string(engine.info.title), "everything", "", engine.status.why});
  struct Line {
    std::string witness, of;
    int pictures = 0;
    std::string why;
  };
  Ordered<Line> lines;
  for (const Row& row : agreement.rows) {
    if (row.verdict != Verdict::kNotComparable) continue;
    const Case& one = agreement.cases[row.index];
    const std::string of(one.group == Group::kHighlight ? "highlights" : one.what);
    Line& line = lines[fmt::format("{}|{}|{}", row.witness.name, of, row.why)];
    line = {std::string(row.witness.title), of, line.pictures + 1, row.why};
  }
  for (const auto& [key, line] : lines.entries)
    table.rows.push_back({line.witness, line.of, std::to_string(line.pictures), line.why});
  return table;
}

Table miss_table(const Agreement& agreement) {
  Table table{
      "Missed",
      "Every picture that is not within its target, or is none.",
      {"witness", "light or effect", "model", "lobe", "n", "max", "relative", "over", "target"},
      {}};
  for (const Row& row : agreement.rows) {
    if (row.verdict != Verdict::kMissed && row.verdict != Verdict::kFailed) continue;
    const Case& one = agreement.cases[row.index];
    const auto target = target_of(row.witness, one.highlight.exponent);
    table.rows.push_back(
        {std::string(row.witness.title), std::string(one.what), std::string(one.highlight.model),
         lobe_words(one.highlight), exponent_text(one.highlight.exponent),
         short_number(row.figures.max_of_peak), short_number(row.figures.max_relative),
         std::to_string(row.figures.ring_over),
         row.verdict == Verdict::kFailed ? row.why : (target ? target_text(*target) : "")});
  }
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

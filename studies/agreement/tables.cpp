#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

#include "reference_scenes/replicates.hpp"
#include "studies/agreement/agreement.hpp"

namespace lobelia::agreement {
namespace {

using Cells = std::vector<studies::Cell>;

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
    const auto widen = [](auto& worst, auto other) { worst = std::max(worst, other); };
    widen(figures.max_of_peak, row.figures.max_of_peak);
    widen(figures.rms_of_peak, row.figures.rms_of_peak);
    widen(figures.max_relative, row.figures.max_relative);
    widen(figures.ring_max_of_peak, row.figures.ring_max_of_peak);
    widen(figures.ring_pixels, row.figures.ring_pixels);
    widen(figures.ring_over, row.figures.ring_over);
  }
};

/// Entries in the order in which they are added.
template <class Value>
struct Ordered {
  std::vector<std::pair<std::string, Value>> entries;
  Value& operator[](std::string_view key) {
    const auto found = std::ranges::find(entries, key, &std::pair<std::string, Value>::first);
    if (found != entries.end()) return found->second;
    return entries.emplace_back(key, Value{}).second;
  }
};

/// Each column is as wide as its widest cell.
Table table_of(std::string title, std::string lead, const std::vector<std::string>& head) {
  Table table{std::move(title), {}, {}, {std::move(lead)}};
  for (const std::string& word : head)
    table.columns.push_back({.title = word, .width = -1, .margin = 2});
  return table;
}

bool is_shown(const Row& row) { return row.verdict != Verdict::kNotComparable; }

/// The columns "max" to "verdict".
void add_figures(Cells& cells, const Worst& worst, const std::string& target) {
  const Figures& f = worst.figures;
  const int all = worst.pictures + worst.failed;
  cells.insert(cells.end(), {short_number(f.max_of_peak), short_number(f.rms_of_peak),
                             short_number(f.max_relative), f.ring_pixels, f.ring_over,
                             short_number(f.ring_max_of_peak), target,
                             worst.failed > 0   ? fmt::format("{}/{} FAILED", worst.failed, all)
                             : worst.missed > 0 ? fmt::format("{}/{} MISSED", worst.missed, all)
                             : target.empty()   ? "no target"
                                                : "met"});
}

/// Exponents up to here share a line.
double range_of(double exponent) { return std::max(exponent, 1024.0); }
std::string range_text(double range) { return range <= 1024 ? "up to 1024" : short_number(range); }

std::string target_words(const Row& row, const Case& one) {
  const auto target = target_of(row.variant, one);
  return target ? target_text(*target) : "";
}

/// By variant, then by `name_of` a highlight; a column for each exponent.
Table worst_table(const Agreement& agreement, const std::string& title, const std::string& what,
                  std::string (*name_of)(const HighlightChoice&)) {
  struct OfVariant {
    bool relative = false;
    Ordered<std::map<double, Worst>> by_name;
  };
  Ordered<OfVariant> by_variant;
  for (const Row& row : agreement.rows) {
    const Case& one = agreement.cases[row.index];
    if (one.group != Group::kHighlight || !is_shown(row)) continue;
    OfVariant& of_variant = by_variant[row.variant.title];
    of_variant.relative = row.variant.floor.of_value > 0;
    of_variant.by_name[name_of(one.highlight)][one.highlight.exponent].add(row);
  }
  std::map<double, std::string> exponents;
  for (const Case& one : agreement.cases)
    if (const double n = one.highlight.exponent; one.group == Group::kHighlight)
      exponents[n] = "n = " + (n < 1e5 ? fmt::format("{:g}", n) : short_number(n));
  std::vector<std::string> head{"variant", what, "of the"};
  for (const auto& [n, heading] : exponents) head.push_back(heading);
  Table table =
      table_of(title,
               "The largest difference over all lights: of the value where the target is of the "
               "value, otherwise of the peak.",
               head);
  for (const auto& [variant, of_variant] : by_variant.entries)
    for (const auto& [name, by_exponent] : of_variant.by_name.entries) {
      Cells& cells =
          table.rows.emplace_back(Cells{variant, name, of_variant.relative ? "value" : "peak"});
      for (const auto& [n, heading] : exponents) {
        const auto found = by_exponent.find(n);
        if (found == by_exponent.end()) {
          cells.emplace_back("");
          continue;
        }
        const auto& [figures, pictures, missed, failed] = found->second;
        cells.emplace_back(failed > 0 ? "FAILED"
                                      : short_number(of_variant.relative ? figures.max_relative
                                                                         : figures.max_of_peak) +
                                            (missed > 0 ? " MISSED" : ""));
      }
    }
  return table;
}

}  // namespace

Table headline_table(const Agreement& agreement) {
  struct Line {
    Worst worst;
    double sharpest = 0;
    std::string target;  ///< at the sharpest exponent
  };
  Ordered<std::map<double, Line>> lines;
  for (const Row& row : agreement.rows) {
    const Case& one = agreement.cases[row.index];
    if (one.group != Group::kHighlight || !is_shown(row)) continue;
    Line& line = lines[row.variant.title][range_of(one.highlight.exponent)];
    line.worst.add(row);
    if (const double exponent = one.highlight.exponent; exponent >= line.sharpest) {
      line.sharpest = exponent;
      line.target = target_words(row, one);
    }
  }
  Table table =
      table_of("Highlights",
               "The worst over models, lobes and lights; max, RMS and ring max are of the peak.",
               {"variant", "n", "pictures", "max", "RMS", "relative", "ring", "over", "ring max",
                "target", "verdict"});
  for (const auto& [variant, by_range] : lines.entries)
    for (const auto& [range, line] : by_range)
      add_figures(table.rows.emplace_back(Cells{variant, range_text(range), line.worst.pictures}),
                  line.worst, line.target);
  return table;
}

Table lobe_table(const Agreement& agreement) {
  return worst_table(agreement, "By lobe", "lobe", [](const HighlightChoice& h) {
    return fmt::format("{}{}", h.lobe, h.normalisation == "paper" ? ", paper" : "");
  });
}

Table model_table(const Agreement& agreement) {
  return worst_table(agreement, "By model", "model", [](const HighlightChoice& h) {
    return std::string(info(*find_model(h.model)).title);
  });
}

Table effect_table(const Agreement& agreement) {
  Table table = table_of("Effects", "One picture each, n = 30; targets are those of n up to 1024.",
                         {"effect", "variant", "max", "RMS", "relative", "ring", "over", "ring max",
                          "target", "verdict"});
  for (std::size_t i = 0; i < agreement.cases.size(); ++i) {
    const Case& one = agreement.cases[i];
    if (one.group != Group::kEffect) continue;
    for (const Row& row : agreement.rows) {
      if (row.index != i || !is_shown(row)) continue;
      Worst worst;
      worst.add(row);
      add_figures(table.rows.emplace_back(Cells{one.what, row.variant.title}), worst,
                  target_words(row, one));
    }
  }
  return table;
}

Table soft_table(const Agreement& agreement) {
  Table table = table_of(
      "Effects that are averages",
      fmt::format(
          "An engine's mean over points of lights, lens and pixel against what our own sampling "
          "converges to. 'beyond' is the fraction of values farther off than chance allows any value "
          "of one picture in a thousand (Student's t over {} sets, Sidak's correction); at most {} "
          "values may be. All pixels share their points, so RMS is a single draw and its ratio scatters.",
          kReplicates, kBeyondAllowed),
      {"effect", "variant", "points", "beyond", "RMS of peak", "points", "beyond", "RMS of peak",
       "RMS ratio", "verdict"});
  for (const SoftRow& row : agreement.soft) {
    Cells cells{row.what, row.variant.title};
    for (const auto& [points, values, beyond, rms_of_peak] : row.counts)
      cells.insert(cells.end(),
                   {points, fmt::format("{}/{}", beyond, values), short_number(rms_of_peak)});
    cells.resize(8, "");
    cells.emplace_back(row.counts.size() == 2 ? fmt::format("{:.1f}", row.counts[0].rms_of_peak /
                                                                          row.counts[1].rms_of_peak)
                                              : "");
    cells.emplace_back(row.verdict == Verdict::kFailed   ? "FAILED: " + row.why
                       : row.verdict == Verdict::kMissed ? "MISSED"
                                                         : "met");
    table.rows.push_back(std::move(cells));
  }
  return table;
}

Table refusal_table(const Agreement& agreement) {
  Table table = table_of("Not comparable", "What a variant was not asked for.",
                         {"variant", "of", "pictures", "not comparable, because"});
  for (const records::AgreementEngine& engine : agreement.engines)
    if (!engine.available) table.rows.push_back({engine.title, "everything", "", engine.why});
  struct Line {
    int pictures = 0;
    std::vector<std::string_view> of;
  };
  Ordered<Ordered<Line>> by_variant;
  for (const Row& row : agreement.rows) {
    if (row.verdict != Verdict::kNotComparable) continue;
    const Case& one = agreement.cases[row.index];
    Line& line = by_variant[row.variant.title][row.why];
    ++line.pictures;
    const std::string_view name = one.group == Group::kHighlight ? "highlights" : one.what;
    if (std::ranges::count(line.of, name) == 0) line.of.push_back(name);
  }
  for (const auto& [variant, by_reason] : by_variant.entries)
    for (const auto& [why, line] : by_reason.entries)
      table.rows.push_back(
          {variant, fmt::format("{}", fmt::join(line.of, ", ")), line.pictures, why});
  return table;
}

Table miss_table(const Agreement& agreement) {
  struct Line {
    Ordered<Worst> by_what;
    std::string target;
  };
  Ordered<std::map<double, Line>> by_variant;
  for (const Row& row : agreement.rows) {
    if (row.verdict != Verdict::kMissed && row.verdict != Verdict::kFailed) continue;
    const Case& one = agreement.cases[row.index];
    Line& line = by_variant[row.variant.title][range_of(one.highlight.exponent)];
    line.by_what[one.what].add(row);
    if (row.verdict == Verdict::kFailed)
      line.target = "FAILED: " + row.why;
    else if (line.target.empty())
      line.target = target_words(row, one);
  }
  Table table = table_of(
      "Missed",
      "The worst of what is not within its target, or is none; agreement.csv has every "
      "picture. 'over' is the most in one.",
      {"variant", "n", "light or effect", "pictures", "max", "relative", "over", "target"});
  for (const auto& [variant, by_range] : by_variant.entries)
    for (const auto& [range, line] : by_range)
      for (const auto& [what, worst] : line.by_what.entries)
        table.rows.push_back({variant, range_text(range), what, worst.pictures + worst.failed,
                              short_number(worst.figures.max_of_peak),
                              short_number(worst.figures.max_relative), worst.figures.ring_over,
                              line.target});
  return table;
}

}  // namespace lobelia::agreement

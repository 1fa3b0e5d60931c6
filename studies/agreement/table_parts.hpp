// Parts of the tables of agreement, for the .cpp files of this folder.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "studies/agreement/agreement.hpp"
#include "studies/table.hpp"

namespace lobelia::agreement {

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

inline bool is_shown(const Row& row) { return row.verdict != Verdict::kNotComparable; }

inline std::string verdict_text(const Worst& worst, bool has_target) {
  const int all = worst.pictures + worst.failed;
  if (worst.failed > 0) return fmt::format("{}/{} FAILED", worst.failed, all);
  if (worst.missed > 0) return fmt::format("{}/{} MISSED", worst.missed, all);
  return has_target ? "met" : "no target";
}

/// Rows of a table of figures after what names them.
inline std::vector<std::string> figure_words(const Worst& worst) {
  const Figures& f = worst.figures;
  return {std::to_string(worst.pictures),  short_number(f.max_of_peak),
          short_number(f.rms_of_peak),     short_number(f.max_relative),
          std::to_string(f.ring_pixels),   std::to_string(f.ring_over),
          short_number(f.ring_max_of_peak)};
}
inline const std::vector<std::string> kFigureHead = {"pictures", "max",  "RMS",     "relative",
                                                     "ring",     "over", "ring max"};

/// A table of words, each column as wide as its widest.
inline studies::Table words_table(std::string title, std::string lead,
                                  const std::vector<std::string>& head) {
  studies::Table table{std::move(title), {}, {}, {std::move(lead)}};
  for (const std::string& word : head)
    table.columns.push_back({.title = word, .width = -1, .margin = 2});
  return table;
}
inline void add_row(studies::Table& table, const std::vector<std::string>& words) {
  table.rows.emplace_back(words.begin(), words.end());
}

inline void append(std::vector<std::string>& words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
}

/// The end of the range of exponents that shares a line.
inline double range_of(double exponent) { return std::max(exponent, 1024.0); }
inline std::string range_text(double range) {
  return range <= 1024 ? "up to 1024" : short_number(range);
}
inline std::string exponent_text(double exponent) {
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

}  // namespace lobelia::agreement

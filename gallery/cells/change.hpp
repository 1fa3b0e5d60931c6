// Whether a measured value, a comparison or a cell is better or worse than in an earlier run.
#pragma once

#include "gallery/cells/checked_cell.hpp"

namespace lobelia::gallery {

enum class Change { kWorse, kBetter, kNew, kUnknown, kSame };

/// In the order of sentences and choices.
inline constexpr std::array<Change, 5> kChanges = {Change::kWorse, Change::kBetter, Change::kNew,
                                                   Change::kUnknown, Change::kSame};

struct ChangeInfo {
  std::string_view name;  ///< for links, Find and style
  std::string_view word;  ///< for people
  std::string_view mark;
  std::string_view meaning;  ///< one sentence
};
const ChangeInfo& info(Change change);

/// A metric of a comparison, with what tells how exact it is.
struct Reading {
  double value = 0;
  std::optional<records::ErrorBar> bar;  ///< where the pictures have noise
  std::optional<double> limit;
  double rounding = 0;  ///< a difference up to this may be float32's
};

/// Empty if the record lacks the metric. `limits` are limits_of(comparison).
std::optional<Reading> reading_of(const records::Comparison& comparison,
                                  const records::Named<double>& limits, const std::string& id,
                                  const MetricInfo& metric);

/// kSame within the noise: overlapping error bars, 1 % of the larger value, 1 % of the limit, or the rounding.
Change change_of(const Reading& was, const Reading& now, bool more_is_better);

/// The metric that decides between two comparisons with the same verdict: the largest difference, else the first that
/// has a limit. With noise it must have an error bar. Empty: none does.
std::string main_metric(const records::Comparison& comparison);

struct MetricChange {
  std::string id;
  std::optional<double> was, now, limit;
  Change change = Change::kSame;
};

/// A comparison with one engine, then and now.
struct EngineChange {
  std::string engine;
  Change change = Change::kSame;
  std::string was, now;  ///< verdicts, in words
  std::string main;      ///< id of the main metric; may be empty
  std::vector<MetricChange> metrics;
  std::string reason;  ///< "pass became differs"; empty if nothing changed
};

struct CellChange {
  Change change = Change::kSame;
  std::optional<CellStatus> was;
  std::string reason;  ///< of a change, in words
  std::vector<EngineChange> engines;
};

/// Compares a cell with the same cell of the earlier run, `was`.
CellChange compare_cells(const CheckedCell& was, const CheckedCell& now, const ShownFarm& farm);

}  // namespace lobelia::gallery

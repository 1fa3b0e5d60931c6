// What accuracy costs: ways of making one thing, each with its time and its errors, measured in one run.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/timing.hpp"
#include "records/cost.hpp"

namespace lobelia::cost {

/// One way of making what a table is about.
struct Way {
  std::string name;  ///< "cs16, float32": unique in its table
  /// What it was made with: "lobe" is "cs16", "precision" is "float32", "samples" is "64".
  std::vector<std::pair<std::string, std::string>> settings;
  Times time;                  ///< of one of what the table counts, in its unit: seconds
  std::vector<double> errors;  ///< by the table's errors, not negative; NaN where not known
  std::vector<double>
      error_spreads;  ///< standard deviations over repeats; empty where nothing is random
  std::optional<records::CostFacts> facts = {};  ///< what else was counted
  /// Bounds of errors that are the largest of what was looked at; NaN or empty where an error is what it says.
  std::vector<double> errors_at_most = {};
  double setting(const std::string& name) const;  ///< as a number; NaN without
};

struct ErrorKind {
  std::string id;       ///< "max": unique in its table
  std::string meaning;  ///< with what it is relative to
};

struct Table {
  std::string id;     ///< "lobe-n64": unique in its report, and a file's name
  std::string level;  ///< name of a Level
  std::string title;  ///< for people
  std::string per;    ///< what times are of: "evaluation", "megapixel", "picture"
  std::vector<ErrorKind> errors;
  std::vector<Way> ways;
  std::vector<std::string> remarks;  ///< sentences: what was fitted, found and left out
  /// Of Way::time: seconds, or what is counted where there is nothing to time: "bit operations".
  std::string unit = "s";
  bool is_timed() const { return unit == "s"; }
};

struct Report {
  std::vector<std::string> command;
  records::Host host;
  std::string instruction_set;
  std::vector<Table> tables;
};

}  // namespace lobelia::cost

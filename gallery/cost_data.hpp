// What cost.json says, read with care.
#pragma once

#include <string>
#include <vector>

#include "gallery/fields.hpp"

namespace lobelia::gallery {

inline constexpr char kCostRecord[] = "cost/cost.json", kCostTable[] = "cost/cost.csv";

struct CostWay {
  std::string name;
  double median = 0, spread = 0;              ///< the spread is relative to the median
  std::vector<double> errors, error_spreads;  ///< by the table's errors; NaN where not known
};

struct CostError {
  std::string id, meaning;
  std::vector<std::string> front;     ///< names of ways
  std::vector<std::string> in_words;  ///< what the front says
};

struct CostTable {
  std::string level, title, per;
  std::string cost_unit;  ///< empty: seconds
  std::vector<CostError> errors;
  std::vector<CostWay> ways;
  std::vector<std::string> remarks;
};

struct CostData {
  std::string command;
  NamedTexts host;
  std::vector<CostTable> tables;
};

/// Throws Error(kInput) for a record that is not one.
CostData read_cost(const Fields& fields);

}  // namespace lobelia::gallery

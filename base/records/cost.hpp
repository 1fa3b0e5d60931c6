// The cost of accuracy.
#pragma once

#include "base/records/highlight.hpp"
#include "base/records/models.hpp"
#include "base/records/render.hpp"
#include "base/records/struct_type.hpp"

namespace lobelia::records {

struct CostError {
  std::string id, meaning;
};

struct LobeErrors {
  double max = 0, rms = 0, energy = 0;
  std::optional<double> max_at_most;
};

struct CostFacts {
  std::optional<Operations> operations;
  std::optional<LobeErrors> shape, rounding;
  std::optional<double> predicted_cost;
  std::optional<Rays> rays;
};

struct CostVariant {
  std::string name;
  Named<std::string> settings;
  Named<double> errors;
  std::optional<MeasuredRounds> seconds;
  std::optional<double> count;
  std::optional<Named<double>> error_spreads, errors_at_most;
  std::optional<CostFacts> facts;
};

struct CostFront {
  std::vector<std::string> variants;
  Named<std::string> dominated_by;
  std::optional<std::vector<std::string>> answers;
  std::vector<std::string> in_words;
  std::string chart;
};

struct CostTable {
  std::string id;
  std::string level;
  std::string title;
  std::string unit = "s";
  std::string per;
  std::vector<CostError> errors;
  std::vector<CostVariant> variants;
  Named<CostFront> fronts;
  std::vector<std::string> remarks;
};

struct Cost {
  std::vector<std::string> command;
  Host host;
  std::string instruction_set;
  std::vector<CostTable> tables;
};

void define_cost_tables(Tables& tables);

}  // namespace lobelia::records

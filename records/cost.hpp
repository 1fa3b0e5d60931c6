// What accuracy costs.
#pragma once

#include "records/highlight.hpp"
#include "records/models.hpp"
#include "records/render.hpp"
#include "records/struct_type.hpp"

namespace lobelia::records {

struct CostError {
  std::string id, meaning;
  static const Struct& type();
};

struct CostSeconds {
  double median = 0, spread = 0, least = 0, most = 0;
  int rounds = 0;
  static const Struct& type();
};

struct LobeErrors {
  double max = 0, rms = 0, energy = 0;
  std::optional<double> max_at_most;
  static const Struct& type();
};

struct CircuitErrors {
  double shape = 0, rounding = 0, quantisation = 0;
  std::size_t steps = 0, steps_looked_at = 0;
  static const Struct& type();
};

struct CostFacts {
  std::optional<Operations> operations;
  std::optional<LobeErrors> shape, rounding;
  std::optional<std::size_t> numbers_looked_at;
  std::optional<CircuitErrors> circuit;
  std::optional<int> samples;
  std::string kernel;
  std::optional<double> predicted_cost;
  std::optional<Rays> rays;
  std::optional<double> rays_saved, seconds_saved;
  std::optional<Named<Work>> work;
  std::optional<Named<double>> stage_seconds;
  std::optional<double> seconds_of_tiny_call;
  static const Struct& type();
};

struct CostWay {
  std::string name;
  Named<std::string> settings;
  Named<double> errors;
  std::optional<CostSeconds> seconds;
  std::optional<double> count;
  std::optional<Named<double>> error_spreads, errors_at_most;
  std::optional<CostFacts> facts;
  static const Struct& type();
};

struct CostFront {
  std::vector<std::string> ways;
  Named<std::string> dominated_by;
  std::vector<std::string> in_words;
  std::string chart;
  static const Struct& type();
};

struct CostTable {
  std::string id;
  std::string level;
  std::string title;
  std::string unit = "s";
  std::string per;
  std::vector<CostError> errors;
  std::vector<CostWay> ways;
  Named<CostFront> fronts;
  std::vector<std::string> remarks;
  static const Struct& type();
};

struct Cost {
  std::vector<std::string> command;
  Host host;
  std::string instruction_set;
  std::vector<CostTable> tables;
  static const Struct& type();
};

}  // namespace lobelia::records

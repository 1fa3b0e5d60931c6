// How numerically stable highlights are.
#pragma once

#include "base/records/struct_type.hpp"

namespace lobelia::records {

struct StabilityGroup {
  std::string name, meaning;
};

struct StabilityErrors {
  double of_peak = 0, ulp = 0;
  int wrong_pixels = 0;
};

struct StabilityAnswer {
  double value = 0, of_peak = 0, ulp = 0;
  int wrong_pixels = 0;
};

struct StabilityBound {
  double of_peak = 0, ulp = 0;
};

struct StabilityOfLobe {
  std::string group, lobe;
  std::optional<double> exponent;
  std::size_t cases = 0, outside = 0, not_compared = 0;
  StabilityErrors naive, ours;
  double of_bound = 0;
};

struct StabilityOfCase {
  std::string group, name, meaning;
  std::size_t cases = 0, outside = 0, not_compared = 0;
  StabilityErrors naive, ours;
  double of_bound = 0;
};

struct StabilityCurve {
  double exponent = 0;
  std::string model, lobe;
  std::vector<double> degrees, truth, naive, ours;
};

struct StabilityRow {
  std::string group, name, model, lobe;
  double exponent = 0, truth = 0;
  StabilityAnswer naive, ours;
  StabilityBound bound;
  std::string outcome;
};

struct StabilityPicture {
  std::string exr, png, error;
  double largest_error_of_peak = 0;
};

struct StabilityPictures {
  double exponent = 0;
  StabilityPicture naive, ours;
};

struct VerifyStability {
  std::vector<std::string> command;
  std::string instruction_set;
  std::size_t cases = 0, outside = 0, not_compared = 0;
  std::vector<StabilityGroup> groups;
  std::vector<StabilityOfLobe> by_lobe;
  std::vector<StabilityOfCase> by_case;
  std::vector<StabilityOfLobe> by_exponent;
  std::vector<StabilityCurve> curves;
  std::vector<StabilityRow> rows;
  std::vector<StabilityPictures> pictures;
};

void define_stability_tables(Tables& tables);

}  // namespace lobelia::records

// The cheapest lobes for an accuracy.
#pragma once

#include "base/records/models.hpp"
#include "base/records/struct_type.hpp"

namespace lobelia::records {

inline constexpr std::string_view kSearchMetrics[] = {"max", "rms", "energy", "de2000"};

inline constexpr std::string_view kSearchFamilies[] = {"all", "pk", "rk", "bk", "free"};

/// A point where the best lobe has its largest error.
struct LobeTouch {
  double ns = 0, per_exponent = 0, error = 0, weight = 0;
};

struct LobeSearchErrors {
  double max = 0, rms = 0, energy = 0, de2000 = 0;
  double rounding = 0;
};

struct LobeTime {
  double median = 0, spread = 0;
};

struct LobeErrorAt {
  double exponent = 0, error = 0;
};

struct SearchedLobe {
  std::string name, formula;
  std::string code;
  Operations operations;
  int price = 0, degree = 0, squarings = 0, by_exponent = 0;
  std::vector<double> coefficients;
  std::optional<double> bound, lower_bound;
  LobeSearchErrors errors;
  std::vector<LobeErrorAt> by_exponents;
  LobeTime seconds;
  bool is_on_front = false;
  std::vector<LobeTouch> touches;
};

struct LobeSearch {
  std::vector<std::string> command;
  double least_exponent = 0;
  std::optional<double> most_exponent;
  std::string family, metric, precision, coefficients;
  std::string chosen;
  std::vector<std::string> answers;
  std::vector<SearchedLobe> lobes;
  std::vector<std::string> not_proved;
};

void define_lobe_search_tables(Tables& tables);

}  // namespace lobelia::records

// How far all engines are from the formulas.
#pragma once

#include "base/records/struct_type.hpp"

namespace lobelia::records {

struct AgreementEngine {
  std::string name, title;
  bool available = false;
  std::string state, version, why;
};

struct Ring {
  int pixels = 0, over = 0, allowed = 0;
  double max_of_peak = 0;
};

struct Target {
  std::optional<double> relative, of_peak;
};

struct AgreementRow {
  std::string group, what, model, lobe, normalisation;
  double exponent = 0;
  std::string view;
  int width = 0, height = 0;
  std::string variant;
  std::optional<double> max_of_peak, rms_of_peak, max_relative;
  std::optional<Ring> ring;
  std::string why;
  std::optional<Target> target;
  std::string verdict;
};

struct SoftCount {
  int points = 0;
  std::size_t values = 0, beyond = 0;
  double rms_of_peak = 0;
};

struct SoftRow {
  std::string what, variant;
  std::vector<SoftCount> counts;
  std::string why, verdict;
};

struct Agreement {
  std::vector<std::string> command;
  bool small = false;
  std::vector<AgreementEngine> engines;
  Named<std::size_t> verdicts;
  std::vector<AgreementRow> rows;
  std::vector<SoftRow> soft;
};

void define_agreement_tables(Tables& tables);

}  // namespace lobelia::records

// How far all engines are from the formulas.
#pragma once

#include "records/struct_type.hpp"

namespace lobelia::records {

struct AgreementEngine {
  std::string name, title;
  bool available = false;
  std::string state, version, why;
  static const Struct& type();
};

struct Ring {
  int pixels = 0, over = 0, allowed = 0;
  double max_of_peak = 0;
  static const Struct& type();
};

struct Target {
  std::optional<double> relative, of_peak;
  static const Struct& type();
};

struct AgreementRow {
  std::string group, what, model, lobe, normalisation;
  double exponent = 0;
  std::string view;
  int width = 0, height = 0;
  std::string witness;
  std::optional<double> max_of_peak, rms_of_peak, max_relative;
  std::optional<Ring> ring;
  std::string why;
  std::optional<Target> target;
  std::string verdict;
  static const Struct& type();
};

struct SoftCount {
  int points = 0;
  std::size_t values = 0, beyond = 0;
  double rms_of_peak = 0;
  static const Struct& type();
};

struct SoftRow {
  std::string what, witness;
  std::vector<SoftCount> counts;
  std::string why, verdict;
  static const Struct& type();
};

struct Agreement {
  std::vector<std::string> command;
  bool small = false;
  std::vector<AgreementEngine> engines;
  Named<std::size_t> verdicts;
  std::vector<AgreementRow> rows;
  std::vector<SoftRow> soft;
  static const Struct& type();
};

}  // namespace lobelia::records

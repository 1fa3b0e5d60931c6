// How far all engines are from the formulas.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "records/struct_type.hpp"

namespace lobelia::records {

struct AgreementEngine {
  std::string name;
  std::string title;
  bool available = false;
  std::string state;
  std::string version;
  std::string why;
  static const Struct& type();
};

struct Ring {
  int pixels = 0;
  int over = 0;
  int allowed = 0;
  double max_of_peak = 0;
  static const Struct& type();
};

struct Target {
  std::optional<double> relative;
  std::optional<double> of_peak;
  static const Struct& type();
};

struct AgreementRow {
  std::string group;
  std::string what;
  std::string model;
  std::string lobe;
  std::string normalisation;
  double exponent = 0;
  std::string view;
  int width = 0;
  int height = 0;
  std::string witness;
  std::optional<double> max_of_peak;
  std::optional<double> rms_of_peak;
  std::optional<double> max_relative;
  std::optional<Ring> ring;
  std::string why;
  std::optional<Target> target;
  std::string verdict;
  static const Struct& type();
};

struct SoftCount {
  int points = 0;
  std::size_t values = 0;
  std::size_t beyond = 0;
  double rms_of_peak = 0;
  static const Struct& type();
};

struct SoftRow {
  std::string what;
  std::string witness;
  std::vector<SoftCount> counts;
  std::string why;
  std::string verdict;
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

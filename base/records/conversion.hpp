// The parameter with which one model looks most like another.
#pragma once

#include "base/records/chart.hpp"
#include "base/records/struct_type.hpp"

namespace lobelia::records {

inline constexpr std::string_view kConversionMeasures[] = {"max", "width", "energy", "de2000"};

struct ConvertedHighlight {
  std::string model;
  std::optional<double> exponent, alpha, roughness;
  double peak = 0, half_width_degrees = 0, energy = 0;
};

struct ConversionErrors {
  double largest_of_peak = 0, largest_at_degrees = 0;
  double peak_ratio = 0, half_width_ratio = 0, energy_ratio = 0;
  double misplaced_energy = 0, largest_ciede2000 = 0;
};

struct ConversionBest {
  std::string measure;
  ConvertedHighlight highlight;
  ConversionErrors errors;
  bool is_end_of_range = false;
};

struct ConversionRule {
  std::string name, formula, source;
  std::optional<ConvertedHighlight> highlight;
  std::optional<ConversionErrors> errors;
  std::string because;
};

struct Conversion {
  std::vector<std::string> command;
  double reflectance = 0;
  ConvertedHighlight from;
  std::string to, measure;
  std::vector<ConversionBest> best;
  std::vector<ConversionRule> rules;
  std::vector<ChartSeries> curves;
};

/// Converted parameters over a range. Of GGX they are roughness.
struct ConversionTable {
  std::vector<std::string> command;
  double reflectance = 0;
  std::string from, from_parameter, to, to_parameter, measure;
  std::vector<ChartSeries> columns;
};

/// A material of a file, converted.
struct ConvertedMaterial {
  std::string name;
  std::optional<ConvertedHighlight> from;
  std::optional<double> reflectance;
  std::vector<std::string> remarks;
  std::vector<ConversionBest> best;
  std::vector<ConversionRule> rules;
};

struct ConvertedMaterials {
  std::vector<std::string> command;
  std::string file, meaning, measure;
  std::vector<std::string> remarks;
  std::vector<ConvertedMaterial> materials;
};

void define_conversion_tables(Tables& tables);

}  // namespace lobelia::records

// The catalogues of models and lobes, and the tables that the explorer draws from.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "records/struct_type.hpp"

namespace lobelia::records {

struct Formulas {
  std::string exact;
  std::string exact_cosine;
  std::string paper_cosine;
  std::string paper_cs16;
  static const Struct& type();
};

struct Operations {
  int multiply = 0;
  int add = 0;
  int divide = 0;
  int root = 0;
  int transcendental = 0;
  int compare = 0;
  static const Struct& type();
};

struct Model {
  std::string name;
  std::string title;
  std::string angle;
  bool applies_cosine = false;
  std::string normalised;
  std::string integral;
  Formulas coefficient;
  Operations operations;
  std::string source;
  static const Struct& type();
};

struct Lobe {
  std::string name;
  std::string title;
  std::string formula;
  std::string moments;
  Operations operations;
  double float32_error_of_peak = 0;
  double half_width_degrees = 0;
  double support_degrees = 0;
  double above_cosine = 0;
  double below_cosine = 0;
  std::string source;
  static const Struct& type();
};

struct Normalisation {
  std::string name;
  std::string meaning;
  static const Struct& type();
};

struct Parameter {
  std::string name;
  std::string default_value;
  std::optional<double> min;
  std::optional<double> max;
  std::string allowed;
  std::string meaning;
  static const Struct& type();
};

struct AlbedoPeak {
  double largest = 0;
  double at_degrees = 0;
  std::optional<double> above_one_from_degrees;
  static const Struct& type();
};

struct CatalogueHighlight {
  std::string model;
  std::string lobe;
  std::string normalisation;
  double coefficient = 0;
  double energy_at_normal_incidence = 0;
  AlbedoPeak albedo;
  AlbedoPeak albedo_of_light;
  double reciprocity_gap = 0;
  static const Struct& type();
};

struct Models {
  double measured_at_exponent = 0;
  std::vector<Model> models;
  std::vector<Lobe> lobes;
  std::string lobe_families;
  std::vector<Normalisation> normalisations;
  std::vector<Parameter> parameters;
  std::vector<CatalogueHighlight> highlights;
  static const Struct& type();
};

struct TableErrors {
  double curve = 0;
  double albedo = 0;
  double half_width = 0;
  double coefficient = 0;
  static const Struct& type();
};

struct ModelTable {
  std::string name;
  std::string title;
  std::string angle;
  bool applies_cosine = false;
  std::string normalised;
  std::string coefficient;
  static const Struct& type();
};

struct LobeTable {
  std::string name;
  std::string title;
  std::string formula;
  int order = 0;
  double unit = 0;
  std::vector<double> reach;
  std::vector<double> half_width;
  std::vector<std::vector<std::int64_t>> curves;
  static const Struct& type();
};

struct HighlightTable {
  std::string model;
  std::string lobe;
  std::vector<double> exact;
  std::vector<double> paper;
  double unit = 0;
  std::vector<std::vector<std::int64_t>> seen;
  std::vector<std::vector<std::int64_t>> lit;
  static const Struct& type();
};

struct HighlightTables {
  std::vector<double> exponents;
  int per_octave = 0;
  double most_grazing = 0;
  TableErrors error;
  std::vector<ModelTable> models;
  std::vector<LobeTable> lobes;
  std::vector<HighlightTable> highlights;
  static const Struct& type();
};

}  // namespace lobelia::records

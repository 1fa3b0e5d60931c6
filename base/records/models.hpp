// The catalogues of models and lobes, and the tables that the explorer draws from.
#pragma once

#include "base/records/struct_type.hpp"

namespace lobelia::records {

struct Formulas {
  std::string exact, exact_cosine, paper_cosine, paper_cs16;
};

struct Operations {
  int multiply_add = 0, multiply = 0, add = 0, divide = 0, root = 0, transcendental = 0,
      compare = 0;
  double price = 0;
};

struct Model {
  std::string name, title, angle;
  bool applies_cosine = false, has_shadowing = false;
  std::string normalised, integral;
  Formulas normalisation_constant;
  Operations operations;
  std::string source;
};

struct Lobe {
  std::string name, title, formula, moments;
  Operations operations;
  double float32_error_of_peak = 0, half_width_degrees = 0, support_degrees = 0, above_cosine = 0,
         below_cosine = 0;
  std::string source;
};

struct Normalisation {
  std::string name, meaning;
};

struct Parameter {
  std::string name, default_value;
  std::optional<double> min, max;
  std::string allowed, meaning;
};

struct AlbedoPeak {
  double largest = 0, at_degrees = 0;
  std::optional<double> above_one_from_degrees;
};

struct CatalogueHighlight {
  std::string model, lobe, normalisation;
  double normalisation_constant = 0, coefficient = 0, energy_at_normal_incidence = 0;
  AlbedoPeak albedo, albedo_of_light;
  double reciprocity_gap = 0;
};

struct Models {
  double measured_at_exponent = 0;
  std::vector<Model> models;
  std::vector<Lobe> lobes;
  std::string lobe_families;
  std::vector<Normalisation> normalisations;
  std::vector<Parameter> parameters;
  std::vector<CatalogueHighlight> highlights;
};

struct TableErrors {
  double curve = 0, albedo = 0, half_width = 0, coefficient = 0;
};

struct ModelTable {
  std::string name, title, angle;
  bool applies_cosine = false, has_shadowing = false;
  std::string normalised, normalisation_constant;
  Operations operations;
  double s_max = 0;
  std::vector<double> weights;
};

struct LobeTable {
  std::string name, title, formula;
  Operations operations;
  int order = 0;
  double unit = 0;
  std::vector<double> reach, half_width;
  std::vector<std::vector<std::int64_t>> curves;
};

struct HighlightTable {
  std::string model, lobe;
  std::vector<double> exact, paper;
  double unit = 0;
  std::vector<std::vector<std::int64_t>> seen, lit;
  std::vector<std::int64_t> shader, paper_shader;
};

struct HighlightTables {
  std::vector<double> exponents;
  int per_octave = 0;
  double most_grazing = 0;
  TableErrors error;
  std::vector<ModelTable> models;
  std::vector<LobeTable> lobes;
  std::vector<HighlightTable> highlights;
  std::vector<std::string> shader_parts;
};

void define_model_tables(Tables& tables);

}  // namespace lobelia::records

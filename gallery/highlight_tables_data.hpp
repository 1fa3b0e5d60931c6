// Tables of highlights over the exponent (docs/records.md, highlight-tables), read with care.
#pragma once

#include <string>
#include <vector>

#include "gallery/fields.hpp"

namespace lobelia::gallery {

/// For each exponent as many numbers.
using Rows = std::vector<std::vector<double>>;

struct LobeTable {
  std::string name, title, formula;
  double order = 0, unit = 0;
  std::vector<double> reach, half_width;  ///< radians
  Rows curves;

  /// What a number of `curves` stands for.
  double value(double number) const;
  /// Radians, of every number of a curve.
  std::vector<double> angles(std::size_t exponent, double n) const;
};

struct ModelTable {
  std::string name, title, angle, normalised, coefficient;
  bool applies_cosine = false;
};

struct HighlightTable {
  std::string model, lobe;
  std::vector<double> exact, paper;  ///< the paper's may be missing
  double unit = 0;
  Rows seen,
      lit;  ///< `lit`, times the incidence's cosine, is missing where it is the same as `seen`

  double albedo(double number) const;
  /// What leaves of a beam at these incidences, those of the exponent's numbers.
  std::vector<double> beam(std::size_t exponent, const std::vector<double>& incidences) const;
};

struct HighlightTables {
  std::vector<double> exponents;
  double per_octave = 0, most_grazing = 0;
  NamedNumbers errors;
  std::vector<LobeTable> lobes;
  std::vector<ModelTable> models;
  std::vector<HighlightTable> highlights;

  /// Radians, of every number of an albedo, from grazing to normal.
  std::vector<double> incidences(double n, std::size_t count) const;
};

/// Throws Error(kInput) where tables do not fit together.
HighlightTables read_highlight_tables(const Fields& record);

}  // namespace lobelia::gallery

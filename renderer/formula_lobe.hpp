// The renderer's interface to a lobe that is given by its formula alone: values point by point in float64, integrals by
// quadrature, and random numbers from a table. Slow, and compiled once; renderer/lobes/expression.hpp makes it a lobe of
// the catalogue.
#pragma once

#include <cstddef>

#include "renderer/formula.hpp"

namespace lobelia {

class FormulaLobe {
 public:
  FormulaLobe(std::shared_ptr<const Formula> formula, double exponent);

  const Formula& formula() const { return *formula_; }

  /// The formula for s in [0, 1), else 0; within [0, 1]. 0 where it is not a number: why_not() refuses such formulas, but
  /// looks at some points only.
  double value(double s) const;
  /// `count` of them; the results may replace the arguments.
  void values(const double* s, double* value, std::size_t count) const;

  /// The integral of value(s) s^j over s from 0 to s_max. Relative error about 1e-10 where the formula bends sharply.
  double moment(int j, double s_max) const;

  /// By inverting the integral of a function of steps that is nowhere below the lobe.
  double sample(double xi) const;
  double density(double s) const;

  /// Why this is no lobe, in one line; empty if it is one: it has to be finite, 1 at s = 0, and to fall from there on
  /// without becoming negative.
  std::string why_not() const;

 private:
  struct Steps;
  const Steps& steps() const;
  /// The s below which the lobe is above `value`, at most s_max.
  double reach(double value, double s_max) const;

  std::shared_ptr<const Formula> formula_;
  double n_;
  std::shared_ptr<Steps> steps_;  ///< made when first asked for
};

}  // namespace lobelia

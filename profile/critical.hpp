// Critical values for tests of very many values.
//
// Source:       Z. Sidak, "Rectangular Confidence Regions for the Means of Multivariate Normal
//               Distributions", Journal of the American Statistical Association 62 (318), 1967: m tests at
//               1 - (1 - alpha)^(1/m) each have alpha together if they are independent, otherwise less. Used
//               by K. Subr, J. Arvo, "Statistical Hypothesis Testing for Assessing Monte Carlo Estimators",
//               Pacific Graphics 2007, and by Mitsuba's tests of renderers. Student, "The Probable Error of a
//               Mean", Biometrika 6 (1), 1908.
#pragma once

#include <vector>

namespace lobelia {

/// The level of each of `tests` tests that together have `significance`, in (0, 1). Without cancellation.
double sidak(double significance, double tests);

/// The normal z that is as rare as Student's t with `freedom` degrees of freedom (infinite: t itself), with the sign of
/// t. With `times` in (0, 1], as rare as that share of its chance. At most 38.4 for a finite t: a double cannot hold a rarer
/// tail.
double equivalent_z(double t, double freedom, double times = 1);

/// The |t| above which Student's t is rarer than `each`, two-sided. A table, fast enough for each pixel. Never less than
/// Student's quantile, and at most 3 % more for one degree of freedom or more.
class CriticalT {
 public:
  explicit CriticalT(double each);
  double operator()(double freedom) const;
  double normal() const { return normal_; }  ///< for infinitely many degrees of freedom: the least

 private:
  std::vector<double> values_;
  double normal_;
};

}  // namespace lobelia

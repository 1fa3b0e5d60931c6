// How far off is too far to be chance, where very many values are looked at.
//
// Source:       Z. Sidak, "Rectangular Confidence Regions for the Means of Multivariate Normal
//               Distributions", Journal of the American Statistical Association 62 (318), 1967: m tests at
//               1 - (1 - alpha)^(1/m) each have alpha in all where they are independent, and no more where
//               they are not. As K. Subr, J. Arvo, "Statistical Hypothesis Testing for Assessing Monte Carlo
//               Estimators", Pacific Graphics 2007, and Mitsuba's tests of renderers use it. Student, "The
//               Probable Error of a Mean", Biometrika 6 (1), 1908.
#pragma once

#include <vector>

namespace lobelia {

/// The level of each of `tests` tests, so that all have `significance`, in (0, 1). Without cancellation.
double sidak(double significance, double tests);

/// The z of a normal distribution that is as rare as a t of Student's with so many degrees of freedom
/// (infinite: the normal itself), with the sign of t. At most 38.4 for a finite t: rarer is not in a double.
double equivalent_z(double t, double freedom);

/// Above it a |t| is rarer than `each`, two-sided; a table, so that it may be asked for each pixel. Never less
/// than Student's own quantile, and at most 3 % more for one degree of freedom or more.
class CriticalT {
 public:
  explicit CriticalT(double each);
  double operator()(double freedom) const;
  double normal() const { return normal_; }  ///< with endless degrees of freedom: the least

 private:
  std::vector<double> values_;
  double normal_;
};

}  // namespace lobelia

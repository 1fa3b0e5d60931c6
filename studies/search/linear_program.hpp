// Linear programs, by GLPK: the interface of its module.
#pragma once

#include <vector>

namespace lobelia::search {

/// The x, none below 0, for which the sum of objective[i] x[i] is largest, where the sum of columns[i][k] x[i] is sums[k].
struct LinearProgram {
  std::vector<double> sums;
  std::vector<std::vector<double>> columns;  ///< each as long as `sums`
  std::vector<double> objective;
};

struct LinearSolution {
  std::vector<double> x, duals;  ///< a dual for each sum
};

}  // namespace lobelia::search

/// By the simplex method. False if it finds none. In the module glpk_module.
extern "C" bool lobelia_solve(const lobelia::search::LinearProgram& program,
                              lobelia::search::LinearSolution& solution);

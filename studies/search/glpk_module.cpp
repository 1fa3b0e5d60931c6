#include <glpk.h>

#include <algorithm>
#include <memory>

#include "studies/search/linear_program.hpp"

namespace {

/// The method may lose its way or go in circles where inequalities are far apart in size or many are met at once, and
/// then find it from another scale or by the dual method.
bool solve(glp_prob* lp) {
  constexpr int kMostSteps = 1000;  // ten times what is usual
  glp_smcp options;
  glp_init_smcp(&options);
  options.msg_lev = GLP_MSG_OFF;
  options.it_lim = kMostSteps;
  for (const double tolerance : {1e-10, 1e-8})
    for (const int method : {GLP_PRIMAL, GLP_DUALP})
      for (const bool is_scaled : {false, true}) {
        glp_unscale_prob(lp);
        if (is_scaled) glp_scale_prob(lp, GLP_SF_AUTO);
        glp_adv_basis(lp, 0);
        options.meth = method;
        options.tol_bnd = options.tol_dj = tolerance;
        if (glp_simplex(lp, &options) == 0 && glp_get_status(lp) == GLP_OPT) return true;
      }
  return false;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) bool lobelia_solve(
    const lobelia::search::LinearProgram& program, lobelia::search::LinearSolution& solution) {
  glp_term_out(GLP_OFF);
  const std::unique_ptr<glp_prob, decltype(&glp_delete_prob)> lp(glp_create_prob(),
                                                                 &glp_delete_prob);
  glp_set_obj_dir(lp.get(), GLP_MAX);
  const int rows = int(program.sums.size()), columns = int(program.columns.size());
  glp_add_rows(lp.get(), rows);
  std::vector<int> places{0};  // GLPK counts from 1
  std::vector<double> numbers(std::size_t(rows) + 1);
  for (int k = 1; k <= rows; ++k) {
    const double sum = program.sums[std::size_t(k - 1)];
    glp_set_row_bnds(lp.get(), k, GLP_FX, sum, sum);
    places.push_back(k);
  }
  glp_add_cols(lp.get(), columns);
  for (int i = 1; i <= columns; ++i) {
    std::ranges::copy(program.columns[std::size_t(i - 1)], numbers.begin() + 1);
    glp_set_mat_col(lp.get(), i, rows, places.data(), numbers.data());
    glp_set_col_bnds(lp.get(), i, GLP_LO, 0, 0);
    glp_set_obj_coef(lp.get(), i, program.objective[std::size_t(i - 1)]);
  }
  if (!solve(lp.get())) return false;
  for (int i = 1; i <= columns; ++i) solution.x.push_back(glp_get_col_prim(lp.get(), i));
  for (int k = 1; k <= rows; ++k) solution.duals.push_back(glp_get_row_dual(lp.get(), k));
  return true;
}

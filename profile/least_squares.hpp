// Small linear least squares by the normal equations and Cholesky's method.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace lobelia {

/// For up to kMost unknowns. Rows are added one by one.
template <std::size_t kMost>
class NormalEquations {
 public:
  using Vector = std::array<double, kMost>;

  explicit NormalEquations(std::size_t unknowns) : size_(unknowns) {}

  void add(const Vector& row, double weight, double value) {
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t j = 0; j <= i; ++j) matrix_[i][j] += weight * row[i] * row[j];
      right_[i] += weight * value * row[i];
    }
  }
  /// Multiplies the diagonal, as Levenberg and Marquardt do.
  void stiffen(double factor) {
    for (std::size_t i = 0; i < size_; ++i) matrix_[i][i] *= factor;
  }
  /// Factorises; false if the matrix is singular. To be called once, before the rest.
  bool factorise() {
    for (std::size_t i = 0; i < size_; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        double rest = matrix_[i][j];
        for (std::size_t k = 0; k < j; ++k) rest -= matrix_[i][k] * matrix_[j][k];
        if (i == j && !(rest > 1e-14 * matrix_[i][i])) return false;
        matrix_[i][j] = i == j ? std::sqrt(rest) : rest / matrix_[j][j];
      }
    return true;
  }
  Vector solution() const { return solve(right_); }
  /// The inverse of the matrix times `right`.
  Vector solve(Vector right) const {
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t k = 0; k < i; ++k) right[i] -= matrix_[i][k] * right[k];
      right[i] /= matrix_[i][i];
    }
    for (std::size_t i = size_; i-- > 0;) {
      for (std::size_t k = i + 1; k < size_; ++k) right[i] -= matrix_[k][i] * right[k];
      right[i] /= matrix_[i][i];
    }
    return right;
  }

 private:
  std::size_t size_;
  std::array<Vector, kMost> matrix_{};  ///< its lower half, or Cholesky's factor
  Vector right_{};
};

}  // namespace lobelia

// The laws of GGX: its shadowing is the textbook's, light is not directed one way, and none of it loses digits.
#include "renderer/ggx.hpp"
#include "tests/test.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace lobelia {
namespace {

using Big = boost::multiprecision::cpp_bin_float_50;

/// The formula as Walter et al. print it, by the cosine.
template <class Real>
Real textbook_distribution(Real alpha, Real cosine) {
  const Real bracket = cosine * cosine * (alpha * alpha - 1) + 1;
  return alpha * alpha / (boost::math::constants::pi<Real>() * bracket * bracket);
}

/// The formula as Heitz prints it.
Big textbook_visibility(Big alpha, Big n_dot_l, Big n_dot_v) {
  const auto lambda = [&](Big cosine) -> Big {
    return (sqrt(1 + alpha * alpha * (1 / (cosine * cosine) - 1)) - 1) / 2;
  };
  return 1 / ((1 + lambda(n_dot_l) + lambda(n_dot_v)) * 4 * n_dot_l * n_dot_v);
}

/// The largest relative error over alphas from 1e-4 to 1 and s from 1e-12 to 1.
template <class Real, class Function>
double largest_error(Function distribution) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform;
  double largest = 0;
  for (int i = 0; i < 20000; ++i) {
    const Real alpha = Real(std::pow(10, -4 * uniform(random))),
               s = Real(std::pow(10, -12 * uniform(random)));
    const Big truth = textbook_distribution<Big>(alpha, 1 - Big(s));
    largest = std::max(largest, std::abs(double((Big(distribution(alpha, s)) - truth) / truth)));
  }
  return largest;
}

TEST(GgxDistribution, LosesNoDigitsWhereTheTextbookFormulaLosesAll) {
  // Measured: 3.8 times epsilon, of both.
  EXPECT_LT(largest_error<double>(ggx_distribution<double>),
            6 * std::numeric_limits<double>::epsilon());
  EXPECT_LT(largest_error<float>(ggx_distribution<float>),
            6 * std::numeric_limits<float>::epsilon());
  EXPECT_GT(largest_error<float>(
                [](float alpha, float s) { return textbook_distribution<float>(alpha, 1 - s); }),
            0.99);
}

TEST(GgxVisibility, IsTheTextbookFormulaAndTheSameBothWays) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 20000; ++i) {
    const double alpha = std::pow(10, -4 * uniform(random)),
                 n_dot_l = std::pow(10, -6 * uniform(random)),
                 n_dot_v = std::pow(10, -6 * uniform(random));
    const double ours = ggx_visibility(alpha, n_dot_l, n_dot_v);
    EXPECT_EQ(ours, ggx_visibility(alpha, n_dot_v, n_dot_l));
    const Big truth = textbook_visibility(alpha, n_dot_l, n_dot_v);
    EXPECT_LT(std::abs(double((Big(ours) - truth) / truth)), 1e-15) << alpha << " " << n_dot_l;
  }
}

}  // namespace
}  // namespace lobelia

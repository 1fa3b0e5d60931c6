// The laws of GGX: its shadowing is that of its distribution, light is not directed one way, and none of it loses digits.
#include "renderer/ggx.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "core/constants.hpp"
#include "core/vec.hpp"
#include "renderer/highlight.hpp"

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

TEST(GgxModel, IsTheDistributionTimesItsShadowing) {
  const LobeId lobe = *find_lobe("ggx");
  const ModelId model = *find_model("microfacet_smith");
  for (const double alpha : {0.001, 0.01, 0.1, 0.25, 0.6, 0.99}) {
    const Highlight highlight{model, lobe, Normalisation::kExact, 2 / (alpha * alpha) - 2};
    for (const double s : {0.0, 1e-6, 1e-3, 0.1, 0.9})
      for (const double n_dot_l : {1e-6, 0.02, 1.0}) {
        const double truth =
            ggx_distribution(alpha, s) * ggx_visibility(alpha, n_dot_l, 0.4) * n_dot_l;
        EXPECT_NEAR(highlight_radiance(highlight, n_dot_l, 0.4, s) / truth, 1, 1e-9)
            << alpha << ", " << s;
      }
  }
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

/// The mean of a function over normals H with the density D (N.H), on a grid of 500 x 500.
template <class Function>
double mean_over_normals(double alpha, Function function) {
  constexpr int kGrid = 500;
  double sum = 0;
  for (int i = 0; i < kGrid; ++i) {
    // Crowded towards grazing normals, of which a share of sqrt(1 - u) is seen.
    const double v = (i + 0.5) / kGrid, u = 1 - v * v, weight = 2 * v;
    const double sine2 = alpha * alpha * u / (1 - u + alpha * alpha * u);
    const double sine = std::sqrt(sine2), cosine = std::sqrt(1 - sine2);
    for (int k = 0; k < kGrid; ++k) {
      const double phi = kPi * (k + 0.5) / kGrid;
      sum += weight * function(Vec3{sine * std::cos(phi), sine * std::sin(phi), cosine});
    }
  }
  return sum / kGrid / kGrid;
}

Vec3 eye_at(double degrees) {
  const double angle = degrees * kPi / 180;
  return {std::sin(angle), 0, std::cos(angle)};
}

TEST(GgxShadowing, ShowsTheEyeAsMuchOfTheFacetsAsOfThePlaneBelowThem) {
  for (const double alpha : {0.03, 0.3, 1.0})
    for (const double degrees : {0.0, 45.0, 80.0}) {
      const Vec3 to_eye = eye_at(degrees);
      // Light along the normal casts no shadow: what is left of G is the masking of the eye.
      const double masking = 4 * to_eye.z * ggx_visibility(alpha, 1.0, to_eye.z);
      const double seen = mean_over_normals(
          alpha, [&](Vec3 normal) { return std::max(0.0, dot(to_eye, normal)) / normal.z; });
      EXPECT_NEAR(masking * seen, to_eye.z, 1e-4) << alpha << ", " << degrees;
    }
}

}  // namespace
}  // namespace lobelia

#include "compare/uncertainty/z_test.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/pictures/image_values.hpp"
#include "base/words/constants.hpp"
#include "compare/uncertainty/patterns.hpp"
#include "profile/critical.hpp"

namespace lobelia {
namespace {

/// From this side of a square on, its own replicates tell the noise of its sum, if they have so many degrees of freedom.
constexpr int kOwnSide = 8;
constexpr double kEnoughFreedom = 16;

/// The sides of the squares: 1, 2, 4, ... up to the whole picture.
std::vector<int> sides_of(int width, int height) {
  std::vector<int> sides{1};
  while (sides.back() < std::max(width, height)) sides.push_back(2 * sides.back());
  return sides;
}

/// Its values, three for each square.
double count_of_values(int width, int height, int side) {
  const auto squares = [side](int pixels) {
    return double((std::int64_t{pixels} + side - 1) / side);
  };
  return 3 * squares(width) * squares(height);
}

/// The level of each of the tests of a size, which share that of the size. A pattern is a size of one test.
double level_of_each(int width, int height, double significance, double tests) {
  const double sizes = double(sides_of(width, height).size() + kPatterns);
  return sidak(sidak(significance, sizes), tests);
}

bool has_heavy_tails(const PictureNoise* noise) { return noise && noise->has_heavy_tails(); }

class Test {
 public:
  explicit Test(const MetricInput& input)
      : input_(input),
        noise_(*input.noise),
        width_(input.a.width()),
        height_(input.a.height()),
        floor_(input.tolerance ? input.tolerance->of_peak * peak_value(input.b) : 0),
        critical_(level_of_single_values(width_, height_, noise_.significance)),
        trusts_own_(!has_heavy_tails(noise_.a) && !has_heavy_tails(noise_.b)) {
    result_.critical = critical_.normal();
  }

  ZTest run() {
    for (std::size_t pixel = 0; pixel < input_.a.pixel_count(); ++pixel) look_at_pixel(pixel);
    const std::int64_t allowed = input_.tolerance ? input_.tolerance->allowed_outliers : 0;
    if (result_.beyond > allowed) outliers_.clear();
    look_at_regions();
    look_at_patterns();
    return result_;
  }

 private:
  double allowance(std::size_t i) const {
    return input_.tolerance
               ? input_.tolerance->relative * std::abs(double(input_.b.values()[i])) + floor_
               : 0;
  }

  double excess(std::size_t i) const {
    const double apart = double(input_.a.values()[i]) - double(input_.b.values()[i]);
    return std::copysign(std::max(0.0, std::abs(apart) - allowance(i)), apart);
  }

  NoisySum sum_of(std::size_t i, bool with_own) const {
    NoisySum sum;
    sum.excess = excess(i);
    add_noise(noise_.a, i, with_own, sum, sum.shared_a);
    add_noise(noise_.b, i, with_own, sum, sum.shared_b);
    return sum;
  }

  static void add_noise(const PictureNoise* noise, std::size_t i, bool with_own, NoisySum& sum,
                        double& shared) {
    if (!noise) return;
    const double error = noise->cautious.values()[i], variance = error * error;
    if (noise->shared) {
      shared = error;
      return;
    }
    sum.cautious += variance;
    sum.cautious_squares += variance * variance / noise->freedom;
    if (!with_own) return;
    const double own = noise->own_variance(i);
    sum.own += own;
    // The square of an estimated variance is on average too large by the factor 1 + 2 / freedom.
    sum.own_squares += own * own / (noise->freedom + 2);
  }

  /// The standard error of a sum, and Welch's degrees of freedom. Pooled windows overlap, so a sum by the cautious errors
  /// has at least their freedom, not a sum over pixels.
  ValueError error_of(const NoisySum& sum) const {
    double independent = sum.cautious, squares = sum.cautious_squares;
    if (sum.own > 0 && sum.own * sum.own >= kEnoughFreedom * sum.own_squares) {
      // Under heavy tails the replicates of few pixels seldom show how much their mean errs.
      const double variance =
          trusts_own_ ? sum.own : (sum.own + std::max(sum.own, sum.cautious)) / 2;
      independent = variance;
      squares = sum.own_squares * (variance / sum.own) * (variance / sum.own);
    } else if (independent > 0) {
      squares = std::min(squares, independent * independent / least_independent_freedom());
    }
    const double a = sum.shared_a * sum.shared_a, b = sum.shared_b * sum.shared_b;
    if (a > 0) squares += a * a / noise_.a->freedom;
    if (b > 0) squares += b * b / noise_.b->freedom;
    const double all = independent + a + b;
    return {std::sqrt(all), squares > 0 ? all * all / squares : kInfinity};
  }

  double least_independent_freedom() const {
    double least = kInfinity;
    for (const PictureNoise* noise : {noise_.a, noise_.b})
      if (noise && !noise->shared) least = std::min(least, noise->pooled_freedom);
    return least;
  }

  /// Begins a size of so many tests: a z of it counts as one of single values that is as rare among those.
  void begin_size(double tests) {
    const double single = level_of_single_values(width_, height_, noise_.significance);
    times_ = std::min(1.0, single / level_of_each(width_, height_, noise_.significance, tests));
  }

  /// Whether the sum is beyond chance. Remembers the rarest.
  bool look_at(const NoisySum& sum, int x, int y, int size) {
    if (sum.excess == 0) return false;
    const ValueError error = error_of(sum);
    const double t = error.size > 0 ? std::abs(sum.excess) / error.size : kInfinity;
    // z^2 is never more: Mills' ratio of the normal tail falls.
    const double most = t * t - 2 * std::log(times_);
    const double least = std::min(result_.critical, result_.largest);
    if (most <= least * least) return false;
    const double z = equivalent_z(t, error.freedom, times_);
    if (z > result_.largest) {
      result_.largest = z;
      result_.x = x;
      result_.y = y;
      result_.size = size;
    }
    return z > result_.critical;
  }

  void look_at_pixel(std::size_t pixel) {
    const int x = int(pixel % std::size_t(width_)), y = int(pixel / std::size_t(width_));
    bool beyond = false, open = false;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
      const NoisySum sum = sum_of(i, false);
      beyond |= look_at(sum, x, y, 1);
      const double apart = std::abs(double(input_.a.values()[i]) - double(input_.b.values()[i]));
      const ValueError error = error_of(sum);
      open |= apart + (error.size > 0 ? critical_(error.freedom) * error.size : 0) > allowance(i);
    }
    result_.beyond += beyond;
    result_.open += open || beyond;
    if (!beyond) return;
    if (input_.tolerance && !input_.tolerance->edges.empty() && input_.tolerance->edges[pixel] == 0)
      ++result_.off_edge;
    if (input_.tolerance && std::int64_t(outliers_.size()) < input_.tolerance->allowed_outliers)
      outliers_.push_back(pixel);
  }

  bool is_outlier(std::size_t pixel) const {
    return !outliers_.empty() && std::ranges::binary_search(outliers_, pixel);
  }

  /// The three sums over a square.
  std::array<NoisySum, 3> sums_over(int left, int top, int side) const {
    std::array<NoisySum, 3> sums;
    for (int y = top; y < std::min(top + side, height_); ++y)
      for (int x = left; x < std::min(left + side, width_); ++x) {
        const std::size_t pixel = std::size_t(y) * std::size_t(width_) + std::size_t(x);
        if (is_outlier(pixel)) continue;
        for (std::size_t c = 0; c < 3; ++c) sums[c] += sum_of(3 * pixel + c, side >= kOwnSide);
      }
    return sums;
  }

  void look_at_region(const std::array<NoisySum, 3>& sums, int x, int y, int side) {
    for (const NoisySum& sum : sums) result_.regions += look_at(sum, x, y, side);
  }

  void look_at_regions() {
    std::vector<std::array<NoisySum, 3>> sums;
    int columns = 0, rows = 0;
    for (const int side : sides_of(width_, height_)) {
      if (side == 1) continue;
      begin_size(count_of_values(width_, height_, side));
      const int fine_columns = columns, fine_rows = rows;
      columns = (width_ + side - 1) / side;
      rows = (height_ + side - 1) / side;
      std::vector<std::array<NoisySum, 3>> coarse;
      for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
          std::array<NoisySum, 3> sum;
          if (side <= kOwnSide) {
            sum = sums_over(side * i, side * j, side);
          } else {
            for (int v = 2 * j; v < std::min(2 * j + 2, fine_rows); ++v)
              for (int u = 2 * i; u < std::min(2 * i + 2, fine_columns); ++u)
                for (std::size_t c = 0; c < 3; ++c)
                  sum[c] += sums[std::size_t(v) * std::size_t(fine_columns) + std::size_t(u)][c];
          }
          look_at_region(sum, side * i, side * j, side);
          if (side >= kOwnSide) coarse.push_back(sum);
        }
      sums = std::move(coarse);
    }
  }

  void look_at_patterns() {
    begin_size(1);
    trusts_own_ = true;  // of all pixels
    const auto sums = sums_of_patterns(input_.a, input_.b, noise_, [&](std::size_t i) {
      return is_outlier(i / 3) ? 0.0 : excess(i);
    });
    for (const NoisySum& sum : sums)
      result_.regions += look_at(sum, 0, 0, std::max(width_, height_));
  }

  const MetricInput& input_;
  const NoiseOfPair& noise_;
  const int width_, height_;
  const double floor_;
  ZTest result_;
  const CriticalT critical_;
  bool trusts_own_;
  double times_ = 1;
  std::vector<std::size_t> outliers_;  ///< pixels allowed by the tolerance, in reading order
};

}  // namespace

double count_of_tests(int width, int height) {
  double tests = kPatterns;
  for (const int side : sides_of(width, height)) tests += count_of_values(width, height, side);
  return tests;
}

double level_of_single_values(int width, int height, double significance) {
  return level_of_each(width, height, significance, count_of_values(width, height, 1));
}

ValueError error_of_difference(const NoiseOfPair& noise, std::size_t value) {
  double all = 0, squares = 0;
  for (const PictureNoise* one : {noise.a, noise.b}) {
    if (!one) continue;
    const double error = double(one->cautious.values()[value]), variance = error * error;
    all += variance;
    squares += variance * variance / one->pooled_freedom;
  }
  return {std::sqrt(all), squares > 0 ? all * all / squares : kInfinity};
}

ZTest z_test(const MetricInput& input) { return Test(input).run(); }

}  // namespace lobelia

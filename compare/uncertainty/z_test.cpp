#include "compare/uncertainty/z_test.hpp"

#include "compare/uncertainty/critical.hpp"
#include "core/constants.hpp"
#include "core/image_values.hpp"

namespace lobelia {
namespace {

/// A sum of differences, and its error.
struct Sum {
  double excess = 0;
  double variance = 0,
         squares = 0;  ///< of independent values; squares: sum of variance^2 / freedom
  double shared_a = 0, shared_b = 0;  ///< standard errors of values that err together

  void operator+=(const Sum& other) {
    excess += other.excess;
    variance += other.variance;
    squares += other.squares;
    shared_a += other.shared_a;
    shared_b += other.shared_b;
  }
};

struct Size {
  int width, height;
  std::size_t values() const { return 3 * std::size_t(width) * std::size_t(height); }
  Size halved() const { return {(width + 1) / 2, (height + 1) / 2}; }
  bool is_one() const { return width == 1 && height == 1; }
};

class Test {
 public:
  explicit Test(const MetricInput& input)
      : input_(input),
        noise_(*input.noise),
        size_{input.a.width(), input.a.height()},
        floor_(input.tolerance ? input.tolerance->of_peak * peak_value(input.b) : 0),
        critical_(sidak(noise_.significance, count_of_tests(size_.width, size_.height))) {
    result_.critical = critical_.normal();
  }

  ZTest run() {
    for (std::size_t pixel = 0; pixel < input_.a.pixel_count(); ++pixel) look_at_pixel(pixel);
    const std::int64_t allowed = input_.tolerance ? input_.tolerance->allowed_outliers : 0;
    if (result_.beyond > allowed) outliers_.clear();
    if (!size_.is_one()) look_at_regions();
    return result_;
  }

 private:
  double allowance(std::size_t i) const {
    return input_.tolerance
               ? input_.tolerance->relative * std::abs(double(input_.b.values()[i])) + floor_
               : 0;
  }

  Sum sum_of(std::size_t i) const {
    Sum sum;
    const double apart = double(input_.a.values()[i]) - double(input_.b.values()[i]);
    sum.excess = std::copysign(std::max(0.0, std::abs(apart) - allowance(i)), apart);
    add_noise(noise_.a, i, sum, sum.shared_a);
    add_noise(noise_.b, i, sum, sum.shared_b);
    return sum;
  }

  static void add_noise(const PictureNoise* noise, std::size_t i, Sum& sum, double& shared) {
    if (!noise) return;
    const double error = noise->cautious.values()[i], variance = error * error;
    if (noise->shared) {
      shared = error;
      return;
    }
    sum.variance += variance;
    sum.squares += variance * variance / noise->freedom;
  }

  static double variance(const Sum& sum) {
    return sum.variance + sum.shared_a * sum.shared_a + sum.shared_b * sum.shared_b;
  }

  /// Welch's, for a region. Pooled windows overlap, so a region has at least their freedom, not a sum over pixels.
  double freedom(const Sum& sum) const {
    const double all = variance(sum);
    double squares = sum.squares;
    if (sum.variance > 0)
      squares = std::min(squares, sum.variance * sum.variance / least_independent_freedom());
    const double a = sum.shared_a * sum.shared_a, b = sum.shared_b * sum.shared_b;
    if (a > 0) squares += a * a / noise_.a->freedom;
    if (b > 0) squares += b * b / noise_.b->freedom;
    return squares > 0 ? all * all / squares : kInfinity;
  }

  double least_independent_freedom() const {
    double least = kInfinity;
    for (const PictureNoise* noise : {noise_.a, noise_.b})
      if (noise && !noise->shared) least = std::min(least, noise->pooled_freedom);
    return least;
  }

  /// Whether the sum is beyond chance. Remembers the rarest.
  bool look_at(const Sum& sum, int x, int y, int size) {
    if (sum.excess == 0) return false;
    const double error = std::sqrt(variance(sum));
    const double t = error > 0 ? std::abs(sum.excess) / error : kInfinity;
    const bool large = t > result_.critical;  // z is never more than t
    if (!large && t <= result_.largest) return false;
    const double degrees = freedom(sum), z = equivalent_z(t, degrees);
    if (z > result_.largest) {
      result_.largest = z;
      result_.x = x;
      result_.y = y;
      result_.size = size;
    }
    return large && t > critical_(degrees);
  }

  void look_at_pixel(std::size_t pixel) {
    const int x = int(pixel % std::size_t(size_.width)), y = int(pixel / std::size_t(size_.width));
    bool beyond = false, open = false;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
      const Sum sum = sum_of(i);
      beyond |= look_at(sum, x, y, 1);
      const double apart = std::abs(double(input_.a.values()[i]) - double(input_.b.values()[i]));
      const double error = std::sqrt(variance(sum));
      open |= apart + (error > 0 ? critical_(freedom(sum)) * error : 0) > allowance(i);
    }
    result_.beyond += beyond;
    result_.open += open || beyond;
    if (!beyond) return;
    if (input_.tolerance && !input_.tolerance->edges.empty() && input_.tolerance->edges[pixel] == 0)
      ++result_.off_edge;
    if (input_.tolerance && std::int64_t(outliers_.size()) < input_.tolerance->allowed_outliers)
      outliers_.push_back(pixel);
  }

  void look_at_regions() {
    Size size = size_.halved();
    std::vector<Sum> sums(size.values());
    std::size_t next_outlier = 0;
    for (std::size_t pixel = 0; pixel < input_.a.pixel_count(); ++pixel) {
      if (next_outlier < outliers_.size() && outliers_[next_outlier] == pixel) {
        ++next_outlier;
        continue;
      }
      const std::size_t x = pixel % std::size_t(size_.width), y = pixel / std::size_t(size_.width);
      for (std::size_t channel = 0; channel < 3; ++channel)
        sums[place(size, x / 2, y / 2) + channel] += sum_of(3 * pixel + channel);
    }
    for (int side = 2;; side *= 2) {
      for (std::size_t i = 0; i < sums.size(); ++i)
        result_.regions += look_at(sums[i], side * int(i / 3 % std::size_t(size.width)),
                                   side * int(i / 3 / std::size_t(size.width)), side);
      if (size.is_one()) return;
      const Size coarse = size.halved();
      std::vector<Sum> next(coarse.values());
      for (std::size_t i = 0; i < sums.size(); ++i) {
        const std::size_t x = i / 3 % std::size_t(size.width), y = i / 3 / std::size_t(size.width);
        next[place(coarse, x / 2, y / 2) + i % 3] += sums[i];
      }
      sums = std::move(next);
      size = coarse;
    }
  }

  static std::size_t place(Size size, std::size_t x, std::size_t y) {
    return 3 * (y * std::size_t(size.width) + x);
  }

  const MetricInput& input_;
  const NoiseOfPair& noise_;
  const Size size_;
  const double floor_;
  ZTest result_;
  const CriticalT critical_;
  std::vector<std::size_t> outliers_;  ///< pixels allowed by the tolerance, in reading order
};

}  // namespace

double count_of_tests(int width, int height) {
  Size size{width, height};
  auto tests = double(size.values());
  while (!size.is_one()) {
    size = size.halved();
    tests += double(size.values());
  }
  return tests;
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

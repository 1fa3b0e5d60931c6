// `lobelia search`: its optima by their certificates, its proofs by 50 digits on grids, its certificates by themselves.
#include <oneapi/tbb/cache_aligned_allocator.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "base/system/error.hpp"
#include "renderer/highlight.hpp"
#include "studies/search/minimax.hpp"
#include "studies/search/search.hpp"
#include "tests/more_samples.hpp"
#include "tests/test.hpp"

namespace lobelia::search {
namespace {

using Exact = boost::multiprecision::cpp_bin_float_50;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Exact exact_target(const Exact& t, const Exact& v) {
  if (v == 0) return exp(-t);
  return t * v < 1 ? Exact(exp(log1p(-t * v) / v)) : Exact(0);
}

/// By the definition of the shapes, written again.
Exact exact_value(const Lobe& lobe, const Exact& t, const Exact& v) {
  Exact y = lobe.shape.outer == Outer::kClamp ? 1 : lobe.shape.outer == Outer::kReciprocal ? -1 : 0;
  for (int r = 0; r <= lobe.shape.by_n; ++r)
    for (int j = lobe.shape.first(); j <= lobe.shape.degree; ++j) {
      const Exact power = j == 0 ? Exact(1) : Exact(pow(t, j));
      y += Exact(lobe.c[std::size_t(r * lobe.shape.terms() + j - lobe.shape.first())]) * power *
           pow(v, r);
    }
  Exact value;
  if (lobe.shape.outer == Outer::kClamp) {
    value = y > 0 ? y : Exact(0);
  } else if (lobe.shape.outer == Outer::kReciprocal) {
    value = -1 / y;
  } else {
    const int whole = int(floor(y < -126 ? Exact(-126) : y));
    value = ldexp(Exact(1), whole) * (1 + (y < -126 ? Exact(-126) : y) - whole);
  }
  return pow(value, lobe.shape.power());
}

/// The largest error over a grid, and over a finer one about where that was, in 50 digits.
double grid_error(const Lobe& lobe, const Range& range, int exponents, int points) {
  Exact most = 0, worst_t = 0, worst_v = 0;
  const auto look = [&](const Exact& t, const Exact& v) {
    if (v < range.v_min() || v > range.v_max() || t < 0 || t * v >= 1) return;
    const Exact error = abs(exact_value(lobe, t, v) - exact_target(t, v));
    if (error > most) most = error, worst_t = t, worst_v = v;
  };
  const Exact step = exponents > 1 ? Exact(range.v_max() - range.v_min()) / (exponents - 1) : 0;
  for (int k = 0; k < exponents; ++k)
    for (int i = 0; i < points; ++i) look(Exact(30) * i / points, range.v_min() + step * k);
  for (const double around : {1.0, 0.1}) {
    const Exact t = worst_t, v = worst_v;
    for (int k = -4; k <= 4; ++k)
      for (int i = -10; i <= 10; ++i)
        look(t + around * 30 / points * i / 10, v + around * step * k / 4);
  }
  return double(most);
}

class BestLobe : public testing::TestWithParam<Shape> {};

TEST_P(BestLobe, HasTheErrorThatIsProvedForIt) {
  for (const Range& range : {Range{16, kInfinity}, Range{32, 300}}) {
    const Minimax best = minimax(GetParam(), range);
    ASSERT_FALSE(best.lobe.c.empty());
    const Proof proof = prove(best.lobe, range);
    ASSERT_TRUE(proof.decreases);
    const double grid = grid_error(best.lobe, range, range.least_n == range.most_n ? 1 : 9, 300);
    EXPECT_LE(grid, proof.bound);
    EXPECT_GE(grid, 0.99 * proof.bound);
    EXPECT_LE(best.lower_bound, proof.bound);
  }
}

TEST_P(BestLobe, HasACertificateThatLeavesNoneBetter) {
  const Range range{16, kInfinity};
  const Minimax best = minimax(GetParam(), range);
  ASSERT_FALSE(best.touches.empty());
  Exact sum = 0;
  for (const Touch& touch : best.touches) {
    EXPECT_GT(touch.weight, 0);
    sum += touch.weight;
  }
  EXPECT_NEAR(double(sum), 1, 1e-9);
  for (int r = 0; r <= GetParam().by_n; ++r)
    for (int j = GetParam().first(); j <= GetParam().degree; ++j) {
      Exact signed_sum = 0, size = 0;
      for (const Touch& touch : best.touches) {
        const Exact term = touch.weight * (j == 0 ? Exact(1) : Exact(pow(Exact(touch.t), j))) *
                           (r == 0 ? Exact(1) : pow(Exact(touch.v), r));
        signed_sum += touch.error > 0 ? term : Exact(-term);
        size += term;
      }
      EXPECT_LE(abs(signed_sum), size * 1e-14) << j << " " << r;
    }
  // Random lobes of the shape near the best: at one of the touches each is at least as far off.
  std::mt19937 random(1);
  std::normal_distribution<double> step;
  for (int i = 0; i < 2000; ++i) {
    Lobe other = best.lobe;
    const double size = std::pow(10, -1 - i % 6);
    for (double& c : other.c) c *= 1 + size * step(random);
    double most = 0;
    for (const Touch& touch : best.touches)
      most =
          std::max(most, std::abs(other.value(touch.t, touch.v) - cosine_power(touch.t, touch.v)));
    EXPECT_GE(most, best.lower_bound * (1 - 1e-9));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, BestLobe,
    testing::Values(Shape{Outer::kClamp, 1, 4, 1}, Shape{Outer::kClamp, 3, 1, 1},
                    Shape{Outer::kClamp, 3, 2, 1}, Shape{Outer::kClamp, 3, 3, 2},
                    Shape{Outer::kReciprocal, 2, 1, 1}, Shape{Outer::kBits, 1, 0, 1},
                    Shape{Outer::kClamp, 3, 0, 1, true}, Shape{Outer::kClamp, 3, 3, 2, true},
                    Shape{Outer::kReciprocal, 2, 1, 1, true}, Shape{Outer::kBits, 1, 0, 1, true}),
    [](const auto& test) {
      std::string text = name(test.param);
      std::ranges::replace(text, '.', '_');
      return text;
    });

TEST(Search, FindsNoLobesNearerThanTheCatalogues) {
  for (const int squarings : some_of(std::vector{1, 2, 3, 4}, 2)) {
    const Shape shape{Outer::kClamp, 3, squarings, squarings < 3 ? 1 : 2};
    const Range range{16, kInfinity};
    const double found = prove(minimax(shape, range).lobe, range).bound;
    const LobeId id = *find_lobe(name(shape));
    double most = 0;
    for (const double n : {16.0, 17.3, 30.0, 64.0, 200.0, 1024.0, 1e6})
      for (int i = 0; i < 5000; ++i) {
        const double t = std::min(n, 30.0) * i / 5000;
        most = std::max(most, std::abs(lobe_value(id, t / n, n) - cosine_power(t, 1 / n)));
      }
    EXPECT_LE(most, 1.005 * found) << name(shape);
    EXPECT_GE(most, 0.95 * found) << name(shape);
  }
}

TEST(Search, TimesFoundLobes) {
  // The timed function is the lobe: its value in float32 is that in double.
  constexpr std::size_t kCount = 4096;
  std::vector<float, oneapi::tbb::cache_aligned_allocator<float>> s(kCount), value(kCount);
  for (std::size_t i = 0; i < kCount; ++i) s[i] = float(i) / kCount;
  for (const Shape& shape : {Shape{Outer::kClamp, 3, 2, 1}, Shape{Outer::kClamp, 3, 2, 1, true},
                             Shape{Outer::kReciprocal, 2, 1, 1}, Shape{Outer::kBits, 2, 0, 0}}) {
    const Lobe lobe = minimax(shape, {16, kInfinity}).lobe;
    evaluate(lobe, 20, kCount, s.data(), value.data());
    for (std::size_t i = 0; i < kCount; ++i)
      EXPECT_NEAR(value[i], lobe.value(20 * double(s[i]), 1.0 / 20), 2e-5)
          << name(shape) << " " << i;
    EXPECT_GT(times_of(std::vector{lobe}, *find_lobe("schlick"))[0].median, 0);
  }
}

TEST(Search, Is30TimesNearerThanCs16AtItsPriceAnd250TimesForOneOperationMore) {
  const Range range{16, 1024};
  const Lobe cs16{{Outer::kClamp, 1, 4, 0}, {-1.0 / 16}};
  const double paper = prove(cs16, range).bound;
  EXPECT_NEAR(paper, 1.70e-2, 1e-4) << "as the paper measured it";
  const Shape same{Outer::kClamp, 3, 2, 1}, one_more{Outer::kClamp, 3, 3, 2};
  ASSERT_EQ(price(operations(same)), price(operations(cs16.shape)));
  ASSERT_EQ(price(operations(one_more)), price(operations(cs16.shape)) + 1);
  // Measured 36 and 333 times.
  EXPECT_LE(30 * prove(minimax(same, range).lobe, range).bound, paper);
  EXPECT_LE(250 * prove(minimax(one_more, range).lobe, range).bound, paper);
}

TEST(Search, KnowsWhereALobeIsCosNItself) {
  // (1 - s)^16 is pk1.4 for n = 16; for a narrow range it nearly is.
  for (const char* exponents : {"16", "15.9999..16"}) {
    Request request;
    request.range = parse_range(exponents);
    request.family = "pk";
    request.error = 1e-6;
    const records::LobeSearch found = search(request);
    EXPECT_EQ(found.chosen, "pk1.4") << exponents;
  }
}

TEST(Search, CountsTheRoundingOfItsPrecisionAgainstTheError) {
  // In 8 bits pk3.0 is within 0.017 of cos^64 by its formula, and with its rounding not within 0.1.
  Request request;
  request.range = parse_range("64");
  request.rounding = parse_rounding("fixed:8");
  request.error = 0.02;
  const records::LobeSearch found = search(request);
  const auto lobe = [&](const std::string& name) {
    return std::ranges::find(found.lobes, name, &records::SearchedLobe::name);
  };
  ASSERT_NE(lobe("pk3.0"), found.lobes.end());
  ASSERT_LE(lobe("pk3.0")->errors.max, *request.error);
  ASSERT_NE(lobe(found.chosen), found.lobes.end());
  const records::SearchedLobe& chosen = *lobe(found.chosen);
  EXPECT_LE(chosen.errors.max + chosen.errors.rounding, *request.error);
  EXPECT_GT(chosen.price, lobe("pk3.0")->price);
}

TEST(Search, ProvesNoFalseBound) {
  const Range range{16, kInfinity};
  Lobe lobe = minimax({Outer::kClamp, 3, 2, 1}, range).lobe;
  const double best = prove(lobe, range).bound;
  lobe.c[1] *= 1.01;
  EXPECT_GT(prove(lobe, range).bound, 1.5 * best);
  lobe.c[2] = 1e-3;  // it rises
  EXPECT_FALSE(prove(lobe, range).decreases);
}

TEST(Search, RefusesUnreadableInput) {
  for (const char* text : {"", "x", "16..", "..16", "1024..16", "0..5", "nan", "16..nan", "-1",
                           "16..32..64", "1e9", "inf", "16,32"})
    EXPECT_THROW(parse_range(text), Error) << text;
  for (const char* text :
       {"", "float64", "fixed", "fixed:", "fixed:0", "fixed:33", "fixed:8.5", "fixed:nan"})
    EXPECT_THROW(parse_rounding(text), Error) << text;
}

}  // namespace
}  // namespace lobelia::search

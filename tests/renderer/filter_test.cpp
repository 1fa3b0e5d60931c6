// FilterSampler draws from what it says it draws from.
#include "renderer/filter.hpp"

#include "renderer/filters/catalogue.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// Calls check(filter, value of the filter at an offset in radii) for every filter of the catalogue.
template <class Check, class... Fs>
int for_each_filter(TypeList<Fs...>, Check check) {
  (check(*find_filter(Fs::kName), [](double x) { return double(Fs::value(x)); }), ...);
  return sizeof...(Fs);
}

/// Midpoint rule over [a, b] of the radius, far finer than the sampler's own steps.
template <class Function>
double integral(Function f, double a, double b) {
  constexpr int kParts = 20000;
  double sum = 0;
  for (int i = 0; i < kParts; ++i) sum += f(a + (b - a) * (i + 0.5) / kParts);
  return sum * (b - a) / kParts;
}

TEST(FilterSampler, DrawsEachPartOfAFilterAsItIsHigh) {
  const int count = for_each_filter(Filters{}, [](Filter filter, auto value) {
    SCOPED_TRACE(name(filter));
    constexpr int kBins = 32, kSide = 1 << 10;
    // For each bin along one axis: the integrals of the parts above 0 and below.
    std::vector<double> above, below;
    for (int b = 0; b < kBins; ++b) {
      const double from = -1 + 2.0 * b / kBins, to = -1 + 2.0 * (b + 1) / kBins;
      above.push_back(integral([&](double x) { return std::max(0.0, value(x)); }, from, to));
      below.push_back(integral([&](double x) { return std::max(0.0, -value(x)); }, from, to));
    }
    const FilterSampler sampler(filter);
    for (const bool negative : {false, true}) {
      if (negative && sampler.negative_weight() == 0) continue;
      std::vector<double> expected, found(kBins * kBins);
      double total = 0;
      for (int y = 0; y < kBins; ++y)
        for (int x = 0; x < kBins; ++x) {
          expected.push_back(negative ? above[x] * below[y] + below[x] * above[y]
                                      : above[x] * above[y] + below[x] * below[y]);
          total += expected.back();
        }
      const auto bin = [&](double offset) {
        return std::min(kBins - 1, int((offset / filter.radius + 1) / 2 * kBins));
      };
      for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
          const auto [x, y] = sampler(negative, (i + 0.5) / kSide, (j + 0.5) / kSide);
          found[bin(y) * kBins + bin(x)] += 1.0 / kSide / kSide;
        }
      // Along each axis stratified draws miss a bin's share by one of 2^10 at either end.
      for (int b = 0; b < kBins * kBins; ++b)
        EXPECT_NEAR(found[b], expected[b] / total, 2e-4) << negative << ", bin " << b;
    }
  });
  EXPECT_EQ(count, int(filter_names().size()));
}

TEST(FilterSampler, CountsTheNegativePartByItsShareOfTheFiltersIntegral) {
  for_each_filter(Filters{}, [](Filter filter, auto value) {
    const double above = integral([&](double x) { return std::max(0.0, value(x)); }, -1, 1);
    const double below = integral([&](double x) { return std::max(0.0, -value(x)); }, -1, 1);
    // 4e-9 for mitchell, 0 for the others.
    EXPECT_NEAR(FilterSampler(filter).negative_weight(),
                2 * above * below / ((above - below) * (above - below)), 1e-7)
        << name(filter);
  });
  EXPECT_GT(FilterSampler(*find_filter("mitchell")).negative_weight(), 0.07);
}

TEST(FilterSampler, GivesEachPartItsShareOfTheSamples) {
  for (const std::string_view filter_name : filter_names()) {
    const FilterSampler sampler(*find_filter(filter_name));
    const double weight = sampler.negative_weight(), share = weight / (1 + 2 * weight);
    std::uint32_t counts[2] = {};
    for (std::uint32_t k = 0; k < 5000; ++k) {
      const auto place = sampler.place(k);
      ASSERT_EQ(place.index, counts[place.negative]++) << filter_name << ", sample " << k;
      if (weight == 0) continue;
      ASSERT_EQ(counts[1] > 0, k > 0) << filter_name;
      // One more than its share at most, rounded to one of a whole number: mitchell's is 1 / 15.8.
      ASSERT_LE(std::abs(counts[1] - share * (k + 1)), 1 + 0.02 * share * (k + 1)) << k;
    }
    EXPECT_EQ(counts[1] == 0, weight == 0) << filter_name;
  }
}

}  // namespace
}  // namespace lobelia

// FilterSampler draws from what it says it draws from.
#include "renderer/filter.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/filters/catalogue.hpp"

namespace lobelia {
namespace {

constexpr int kSamples = 1 << 20;

/// Stratified: the middle of each of kSamples equal parts of [0, 1).
double stratum(int i) { return (i + 0.5) / kSamples; }

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

TEST(FilterSampler, DrawsOffsetsByTheFiltersAbsoluteValue) {
  const int count = for_each_filter(Filters{}, [](Filter filter, auto value) {
    SCOPED_TRACE(name(filter));
    const auto magnitude = [&](double x) { return std::abs(value(x)); };
    constexpr int kBins = 64;
    std::vector<double> found(kBins);
    const FilterSampler sampler(filter);
    for (int i = 0; i < kSamples; ++i) {
      const double x = sampler(stratum(i)).offset / filter.radius;
      found[std::min(kBins - 1, int((x + 1) / 2 * kBins))] += 1.0 / kSamples;
    }
    const double total = integral(magnitude, -1, 1);
    for (int b = 0; b < kBins; ++b)
      // Stratified samples miss a bin's share by one of 2^20 at either end: measured 8.6e-7 at most.
      EXPECT_NEAR(found[b],
                  integral(magnitude, -1 + 2.0 * b / kBins, -1 + 2.0 * (b + 1) / kBins) / total,
                  2e-6)
          << "bin " << b;
  });
  EXPECT_EQ(count, int(filter_names().size()));
}

TEST(FilterSampler, HasWeightsWithTheMeanOneAndTheSignOfTheFilter) {
  for_each_filter(Filters{}, [](Filter filter, auto value) {
    SCOPED_TRACE(name(filter));
    const FilterSampler sampler(filter);
    double sum = 0;
    int wrong = 0;
    for (int i = 0; i < kSamples; ++i) {
      const auto [offset, weight] = sampler(stratum(i));
      sum += weight;
      const double here = value(offset / filter.radius);
      if (std::abs(here) > 1e-3 && (here < 0) != (weight < 0)) ++wrong;
    }
    EXPECT_NEAR(sum / kSamples, 1, 1e-6);  // measured: 2.8e-7 for mitchell, 0 for the others
    EXPECT_EQ(wrong, 0);
  });
}

TEST(FilterSampler, StaysWithinTheRadiusWhateverItIs) {
  for (const std::string_view filter_name : filter_names())
    for (const double radius : {0.1, 0.5, 1.7, 16.0}) {
      Filter filter = *find_filter(filter_name);
      filter.radius = radius;
      const FilterSampler sampler(filter);
      double least = 0, most = 0;
      for (const double u : {0.0, 1e-300, 0.25, 0.5, 0.75, std::nextafter(1.0, 0.0)}) {
        const double offset = sampler(u).offset;
        EXPECT_LE(std::abs(offset), radius) << filter_name << " at " << u;
        least = std::min(least, offset);
        most = std::max(most, offset);
      }
      EXPECT_LT(least, -0.9 * radius) << filter_name;
      EXPECT_GT(most, 0.9 * radius) << filter_name;
    }
}

TEST(FilterSampler, ScalesItsOffsetsWithTheRadius) {
  for (const std::string_view filter_name : filter_names()) {
    Filter narrow = *find_filter(filter_name), wide = narrow;
    narrow.radius = 1;
    wide.radius = 3;
    const FilterSampler a(narrow), b(wide);
    for (int i = 0; i < 100; ++i) {
      EXPECT_NEAR(3 * a(i / 100.0).offset, b(i / 100.0).offset, 1e-14) << filter_name;
      EXPECT_EQ(a(i / 100.0).weight, b(i / 100.0).weight) << filter_name;
    }
  }
}

TEST(FilterSampler, GivesMitchellsNegativeLobesTheirShareOfNegativeWeights) {
  const Filter mitchell = *find_filter("mitchell");
  const auto value = [](double x) { return filters::Mitchell::value(x); };
  // For B = C = 1/3 the outer polynomial is proportional to (8/7 - t)(t - 2)^2, t twice the offset in
  // radii: it is negative from 4/7 of the radius on. The whole integrates to 1 over t, so to 1/2 here.
  const double negative = -2 * integral(value, 4.0 / 7, 1),
               positive = 2 * integral(value, 0, 4.0 / 7);
  EXPECT_NEAR(positive - negative, 0.5, 1e-8);
  const FilterSampler sampler(mitchell);
  int below = 0;
  double weight = 0;
  for (int i = 0; i < kSamples; ++i)
    if (const auto sample = sampler(stratum(i)); sample.weight < 0) {
      ++below;
      weight = sample.weight;
    }
  EXPECT_NEAR(double(below) / kSamples, negative / (positive + negative), 1e-6);  // 1.3e-7
  EXPECT_NEAR(weight, -(positive + negative) / (positive - negative), 1e-8);      // 9e-10
  EXPECT_GT(below, kSamples / 40);
}

TEST(FilterSampler, OfEveryOtherFilterHasNoNegativeWeight) {
  for (const std::string_view filter_name : filter_names()) {
    if (filter_name == "mitchell") continue;
    const FilterSampler sampler(*find_filter(filter_name));
    for (int i = 0; i < kSamples; i += 97) EXPECT_EQ(sampler(stratum(i)).weight, 1) << filter_name;
  }
}

}  // namespace
}  // namespace lobelia

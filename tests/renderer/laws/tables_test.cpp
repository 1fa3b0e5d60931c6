// Tables of highlights over the exponent: what a page interpolates is what the renderer computes.
#include "renderer/albedo.hpp"
#include "renderer/catalogue_record.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// Weights of the polynomial over log2 n through the exponents of the octave that n is in.
std::vector<double> weights(double n, std::size_t& first) {
  const double at = std::log2(n);
  const int octave = std::min(kTableOctaves - 1, int(at));
  first = std::size_t(octave) * kExponentsPerOctave;
  const double u = (at - octave) * kExponentsPerOctave;
  std::vector<double> result;
  for (int i = 0; i <= kExponentsPerOctave; ++i) {
    double weight = 1;
    for (int k = 0; k <= kExponentsPerOctave; ++k)
      if (k != i) weight *= (u - k) / (i - k);
    result.push_back(weight);
  }
  return result;
}

double interpolated(const Json& by_exponent, double n, auto&& value_of) {
  std::size_t first = 0;
  double sum = 0;
  for (const double weight : weights(n, first)) sum += weight * value_of(by_exponent[first++]);
  return sum;
}

double curve_value(const Json& lobe, double stored) {
  const double value = stored * lobe["unit"].get<double>();
  return lobe["order"] > 0 ? std::pow(std::max(0.0, value), lobe["order"].get<double>())
                           : std::exp(value);
}

class HighlightTables : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { table_ = new Json(as_json(highlight_tables(table_exponents()))); }
  static void TearDownTestSuite() { delete table_; }
  static std::vector<double> random_exponents(int count) {
    std::mt19937 random(20);
    std::vector<double> result;
    while (int(result.size()) < count)
      result.push_back(std::exp2(std::uniform_real_distribution<>(0, kTableOctaves)(random)));
    return result;
  }
  static Json* table_;
};
Json* HighlightTables::table_ = nullptr;

TEST_F(HighlightTables, AgreeWithTheRendererBetweenExponents) {
  const std::vector<double> exponents = random_exponents(12);
  const Json truth = as_json(highlight_tables(exponents));
  for (std::size_t e = 0; e < exponents.size(); ++e) {
    const double n = exponents[e];
    for (std::size_t l = 0; l < truth["lobes"].size(); ++l) {
      const Json &lobe = (*table_)["lobes"][l], &exact = truth["lobes"][l];
      const auto number = [](const Json& json) { return json.get<double>(); };
      const auto logarithm = [](const Json& json) { return std::log(json.get<double>()); };
      for (const char* key : {"halfWidth", "reach"})
        EXPECT_NEAR(interpolated(lobe[key], n, logarithm), logarithm(exact[key][e]),
                    kWidthTableError)
            << lobe["name"] << " at " << n;
      for (std::size_t i = 0; i < exact["curves"][e].size(); ++i)
        EXPECT_NEAR(curve_value(lobe, interpolated(lobe["curves"], n,
                                                   [&](const Json& at) { return number(at[i]); })),
                    curve_value(lobe, number(exact["curves"][e][i])), kCurveTableError)
            << lobe["name"] << " at " << n << ", point " << i;
    }
    for (std::size_t h = 0; h < truth["highlights"].size(); ++h) {
      const Json &highlight = (*table_)["highlights"][h], &exact = truth["highlights"][h];
      const std::string name =
          exact["model"].get<std::string>() + " " + exact["lobe"].get<std::string>();
      for (const char* how : {"exact", "paper"}) {
        ASSERT_EQ(highlight.contains(how), exact.contains(how));
        if (!exact.contains(how)) continue;
        const double value = interpolated(highlight[how], n,
                                          [](const Json& c) { return std::log(c.get<double>()); });
        EXPECT_NEAR(value, std::log(exact[how][e].get<double>()), kCoefficientTableError)
            << name << " at " << n;
      }
      for (const char* side : {"seen", "lit"}) {
        ASSERT_EQ(highlight.contains(side), exact.contains(side)) << name;
        if (!exact.contains(side)) continue;
        const double unit = exact["unit"].get<double>();
        for (std::size_t i = 0; i < exact[side][e].size(); ++i)
          EXPECT_NEAR(interpolated(highlight[side], n,
                                   [&](const Json& at) { return at[i].get<double>() * unit; }),
                      exact[side][e][i].get<double>() * unit, kAlbedoTableError)
              << name << " " << side << " at " << n << ", point " << i;
      }
    }
  }
}

/// Incidence of a place between the numbers of an albedo, counted from grazing.
double incidence(double place, double last, double n) {
  const double most = std::asinh(kMostGrazing * std::sqrt(n));
  return kMostGrazing * (1 - std::sinh(most * place / last) / std::sinh(most));
}

TEST_F(HighlightTables, AreDenseEnoughInIncidenceForACubicThroughFourNeighbours) {
  for (const Json& highlight : (*table_)["highlights"]) {
    const Highlight h{*find_model(highlight["model"].get<std::string>()),
                      *find_lobe(highlight["lobe"].get<std::string>())};
    for (const char* side : {"seen", "lit"}) {
      if (!highlight.contains(side)) continue;
      const auto albedo = side[0] == 's' ? directional_albedo : directional_albedo_of_light;
      for (const std::size_t e : {0u, 12u, 24u, 42u}) {
        const double n = (*table_)["exponents"][e];
        const auto row = highlight[side][e].get<std::vector<double>>();
        for (std::size_t i = 1; i + 2 < row.size(); ++i) {
          const double at = incidence(double(i) + 0.5, double(row.size() - 1), n);
          const double middle = (9 * (row[i] + row[i + 1]) - row[i - 1] - row[i + 2]) / 16 *
                                highlight["unit"].get<double>();
          const double truth = albedo({h.model, h.lobe, Normalisation::kExact, n}, at);
          const double drawn = std::exp(middle) / (side[0] == 'l' ? std::cos(at) : 1);
          EXPECT_NEAR(drawn, truth, kAlbedoDrawnError * std::max(1.0, truth))
              << highlight["model"] << " " << highlight["lobe"] << " " << side << " at " << n
              << ", point " << i;
        }
      }
    }
  }
}

}  // namespace
}  // namespace lobelia

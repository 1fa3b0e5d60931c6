// Claims of the paper: every figure that docs/errata.md leans on. Values come from an independent
// calculation or a closed form; tolerances are about half a unit of what is printed. And what is made of the
// measured claims: the errata, the record, the table, the plots, the command.
#include <regex>
#include <stdexcept>

#include <pugixml.hpp>

#include "lobelia_paths.hpp"
#include "studies/paper/claim.hpp"
#include "studies/paper/energy.hpp"
#include "studies/paper/report.hpp"
#include "studies/paper/search.hpp"
#include "tests/json.hpp"
#include "tests/program/run_lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia::paper {
namespace {

/// Measured once for all tests.
const std::vector<Claim>& measured_claims() {
  static const std::vector<Claim> claims = measure_all();
  return claims;
}

const Claim& claim(std::string_view name) {
  for (const Claim& candidate : measured_claims())
    if (candidate.name == name) return candidate;
  throw std::out_of_range("no claim " + std::string(name));
}

struct Pin {
  std::string_view claim;
  std::size_t figure;
  double value, tolerance;
};

TEST(PaperFindings, HaveTheMeasuredFiguresThatAreKnown) {
  const double pi_by_180 = std::acos(-1) / 180;
  const Pin pins[] = {
      {"cs16-largest-error", 0, 0.017012, 1e-6},
      {"cosine-of-reflection", 0, 2 * std::sin(15 * pi_by_180), 1e-12},
      {"cs16-smallest-error", 0, 0, 1e-15},
      {"cs16-smallest-error", 1, 10.369, 5e-3},
      {"cs16-operations", 0, 4, 0},
      {"cs16-normalised", 0, 1.063 * 1024 / 1025 - 1, 1e-12},
      {"cs16-tail", 0, 0.92053, 1e-5},
      {"cs16-tail", 2, 0.290, 5e-4},
      {"theta-cr", 0, 6 / 32.0 / std::acos(1008 / 1024.0) - 1, 1e-12},
      {"theta-cr", 1, 1 - 1.5 / (90 * pi_by_180), 1e-12},
      {"theta-cr-beyond", 0, std::pow(1 - 64 * (1 - std::cos(6 / 32.0)), 16), 1e-19},
      {"theta-cr-beyond", 1, std::pow(std::cos(1.5), 16), 1e-22},
      {"residual-phong-rdf", 0, 1.063 * 16 / 17 - 1, 1e-12},
      {"residual-modified-phong", 0, 1.27456e-3, 1e-8},
      {"residual-modified-phong", 1, 1.00044, 1e-5},
      {"residual-blinn-phong-rdf-cut", 0, 1.52910e-3, 1e-8},
      {"residual-blinn-phong-rdf-cut", 1, 1 - 9.56e-4, 1e-6},
      {"residual-blinn-phong-rdf", 0, 5.20784e-3, 1e-8},
      {"residual-modified-blinn-phong", 0, 5.6125e-2, 1e-6},
      {"residual-modified-blinn-phong", 2, 0.9677, 1e-4},
      {"residual-distributions", 0, 1.063 * 16 / 17 - 1, 1e-12},
      {"residual-distributions", 1, 1.27456e-3, 1e-8},
      {"cosine-modified-blinn-phong", 0, 2, 1e-12},
      {"factor-1.063", 0, 17 / 16.0, 1e-12},
      {"best-digits", 0, 4.4e-4, 1e-5},
      {"best-digits", 1, 1.3e-3, 5e-5},
      {"best-digits", 2, 5.4e-3, 5e-5},
      {"bounds-of-cs16", 0, 3.04 / 0.068, 1e-12},
      {"outside-the-range", 0, 1.063 * 16 / 17 * (1 - std::pow(15 / 16.0, 17)), 1e-12},
      // The relative error, which is the paper's word; as a share of the peak; and over the hemisphere.
      {"schlick-epicentre", 0, 0.181, 5e-4},
      {"schlick-epicentre", 2, 9.05e-2, 1e-4},
      {"schlick-epicentre", 3, 0.2034, 5e-4},
      {"schlick-epicentre-inflection", 0, 9.91e-2, 1e-4},
      // At n = 32 the base is -1 at a right angle, and theta_cr is 60 degrees.
      {"theta-cr-growth", 0, 1.5, 1e-12},
      {"theta-cr-growth", 1, std::asin(std::sqrt(1 / 64.0)) / std::asin(std::sqrt(1 / 128.0)),
       1e-12},
      {"theta-cr-growth", 3, std::pow(63, 16), 1e16},
      {"theta-cr-growth", 4, 32, 1e-12},
      {"schlick-cost", 0, 2, 0},
      {"schlick-cost", 2, 3, 0},
      {"schlick-cost", 4, 4, 0},   // n = 16: four squarings
      {"schlick-cost", 5, 18, 0},  // n = 1023: nine, and nine products
      {"gauss-angle", 0, std::exp(-8 * std::pow(45 * pi_by_180, 2)), 1e-15},
      {"gauss-angle", 1, 1, 0},
      // c - c^16 is largest where 16 c^15 = 1.
      {"cs16-without-power", 0, 15 / 16.0 * std::pow(16, -1 / 15.0), 1e-12},
      {"cs16-without-power", 1, 0.017012, 1e-6},
      {"more-accurate-lobe", 0, 0.017012, 1e-6},
      {"more-accurate-lobe", 1, 0.2034, 5e-4},
      {"more-accurate-lobe", 2, 1.15684e-2, 1e-7},
      {"more-accurate-lobe", 3, 26.4687, 1e-3},
      {"more-accurate-energy", 0, 5.6125e-2, 1e-6},
      {"more-accurate-energy", 1, 1 - 2 * std::acos(-1) / 1026, 1e-12},
      {"more-accurate-normalised", 0, 1.063 * 16 / 17 - 1, 1e-12},
      {"schlick-tail", 1, std::acos(16 / 270.0) / pi_by_180, 1e-9},
      {"schlick-tail", 5, 6.17, 5e-3},
      {"gauss-accuracy", 0, 1.15684e-2, 1e-7},
      {"gauss-accuracy", 3, 1.84, 5e-3},
      {"gauss-inverse-cosine", 3, 1.73e-2, 1e-4},
      {"reciprocity-rdf", 0, std::cos(5 * pi_by_180) / std::cos(85 * pi_by_180), 1e-9},
      {"energy-cs16", 0, 1.005208, 1e-6},
      {"energy-brdf", 0, 1, 1e-8},
      {"energy-brdf", 1, 0.50000, 1e-5},
      {"energy-brdf", 2, 0.27376, 1e-5},
      {"energy-rdf-seen", 0, 1, 1e-8},
      // Phong's lobe has the mean cosine (n+1)/(n+2) about its axis.
      {"energy-rdf-lit", 2, 17 / 18.0, 1e-8},
      {"energy-rdf-lit", 1, 74.3, 0.05},
      {"energy-rdf-lit", 4, 85.6, 0.05},
      {"energy-rdf-lit", 8, 0.80176, 1e-5},
      {"distribution-as-rdf", 0, 4 * 17 / 18.0 * (1 - std::exp2(-9)), 1e-12},
      {"distribution-as-brdf", 0, 0.75574, 1e-5},
      {"distribution-as-brdf", 2, 0.80020, 1e-5},
      {"renderer-constants", 0, 0, 1e-14},
  };
  for (const Pin& pin : pins) {
    ASSERT_LT(pin.figure, claim(pin.claim).measured.size()) << pin.claim;
    const Figure& figure = claim(pin.claim).measured[pin.figure];
    EXPECT_NEAR(figure.value, pin.value, pin.tolerance) << pin.claim << ": " << figure.what;
  }
}

TEST(PaperErrata, AreThePageInDocs) {
  EXPECT_EQ(read_file(LOBELIA_SOURCE_DIR "/docs/errata.md", 1 << 20),
            errata_document(measured_claims()))
      << "run: lobelia verify paper --errata > docs/errata.md";
}

TEST(PaperClaims, AreCompleteUnderUniqueNames) {
  static const std::regex kebab("[a-z0-9.]+(-[a-z0-9.]+)*");
  std::set<std::string_view> names;
  for (const Claim& claim : measured_claims()) {
    EXPECT_TRUE(names.insert(claim.name).second) << claim.name << " twice";
    EXPECT_TRUE(std::regex_match(std::string(claim.name), kebab)) << claim.name;
    EXPECT_FALSE(claim.where.empty()) << claim.name;
    EXPECT_FALSE(claim.statement.empty()) << claim.name;
    EXPECT_FALSE(claim.definition.empty()) << claim.name;
    EXPECT_FALSE(claim.measured.empty()) << claim.name;
    EXPECT_TRUE(claim.verdict != kNotReproduced || !claim.reason.empty()) << claim.name;
    for (const Figure& figure : claim.measured)
      EXPECT_TRUE(std::isfinite(figure.value) && !figure.text.empty()) << claim.name;
  }
}

TEST(PaperTable, HasALineForEveryClaimAndTheCounts) {
  const std::string table = table_text(measured_claims());
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), long(measured_claims().size()) + 3);
  EXPECT_THAT(table, HasSubstr("22 confirmed, 14 not reproduced, 8 found beyond the paper\n"));
}

/// Drawn once: it takes seconds.
const std::vector<Plot>& drawn_plots() {
  static const std::vector<Plot> drawn = plots();
  return drawn;
}

TEST(PaperPlots, AreWellFormedWithPointsInsideTheFrame) {
  for (const auto& [file, chart, claims] : drawn_plots()) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(draw_chart_file(chart).c_str())) << file;
    EXPECT_EQ(document.select_nodes("/svg/path").size(), chart.series.size()) << file;
    for (const ChartSeries& series : chart.series) {
      int inside = 0;
      for (const double y : series.y) inside += y >= chart.y.from && y <= chart.y.to;
      EXPECT_GT(4 * inside, int(series.y.size())) << file << ": " << series.label;
    }
  }
}

TEST(PaperPlots, NameClaimsThatExist) {
  std::set<std::string_view> names;
  for (const Claim& claim : measured_claims()) names.insert(claim.name);
  for (const Plot& plot : drawn_plots()) {
    EXPECT_FALSE(plot.claims.empty()) << plot.file;
    for (const std::string_view name : plot.claims) EXPECT_TRUE(names.contains(name)) << name;
  }
}

TEST(PaperCommand, ExitsWith0AndWritesRecordAndPlots) {
  const TemporaryDirectory directory;
  const auto result = run_lobelia({"verify", "paper", "--json", "paper.json", "--plots", "plots"},
                                  directory.path());
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_THAT(result.output_tail, HasSubstr("not reproduced"));
  const Json record = read_json(directory.path() / "paper.json");
  EXPECT_EQ(record["claims"].size(), measured_claims().size());
  EXPECT_EQ(record["notReproduced"], 14);
  const auto& drawn = drawn_plots();
  EXPECT_EQ(record, as_json(paper_record(
                        measured_claims(),
                        {"lobelia", "verify", "paper", "--json", "paper.json", "--plots", "plots"},
                        figure_records(drawn))));
  EXPECT_EQ(files_in(directory.path() / "plots"), drawn.size());
  for (const auto& plot : drawn)
    EXPECT_EQ(read_file(directory.path() / "plots" / plot.file, 1 << 20),
              draw_chart_file(plot.chart));
}

// The instruments, before what they find: quadratures against closed forms, searches against extremes
// that are known, verdicts against figures that are just in or just out.

TEST(PaperEnergy, IsForCs16ItsClosedFormToFifteenDigits) {
  // With u = 1 - n s/16: the integral of cs16 s^j ds is (16/n)^(j+1) B(17, j+1).
  const auto moment = [](int j, Real n) {
    Real beta = 1.0L / 17;
    for (int i = 1; i <= j; ++i) beta *= Real(i) / Real(17 + i);
    return std::pow(16 / n, Real(j + 1)) * beta;
  };
  // From 55 on the half-angle lobe ends before a right angle.
  for (const Real n : {55.0L, 100.0L, 333.3L, 1024.0L}) {
    const Real m0 = moment(0, n), m1 = moment(1, n), m2 = moment(2, n), m3 = moment(3, n);
    const Real expected[] = {m0, m0 - m1, 4 * (m0 - m1), 4 * (m0 - 5 * m1 + 6 * m2 - 2 * m3),
                             m0, m0 - m1};
    for (std::size_t i = 0; i < kRows.size(); ++i)
      EXPECT_NEAR(double(hemisphere_integral(kRows[i], Lobe::kCs16, n) / (2 * kPi * expected[i])),
                  1, 1e-15)
          << kRows[i].title << " n = " << double(n);
  }
}

TEST(PaperEnergy, LosesEnergyIfCutAsPrinted) {
  const Row& row = kRows[kBlinn];
  const Real whole = hemisphere_integral(row, Lobe::kCs16, 1024),
             cut = hemisphere_integral(row, Lobe::kCs16, 1024, Cut::kPrinted);
  // The cut is at s = 2 sin^2(x/4) of the half angle: (1 - n s/16)^17 of the integral of s^0.
  const Real lost = std::pow(1 - 64 * versine(printed_theta_cr(1024) / 2), Real(17));
  EXPECT_NEAR(double(1 - cut / whole), double(lost), 0.01 * double(lost));
}

TEST(PaperSearch, FindsAMaximumBetweenTwoPointsAndAtAnEnd) {
  const auto parabola = [](Real x) { return 5 - (x - 0.37L) * (x - 0.37L); };
  EXPECT_NEAR(double(largest(parabola, 0, 1, 4).at), 0.37, 1e-6);
  EXPECT_NEAR(double(largest(parabola, 0, 1, 4).value), 5, 1e-12);
  EXPECT_EQ(double(largest([](Real x) { return x; }, 0, 1, 4).at), 1);
}

TEST(PaperVerdict, IsConfirmedWhereTheMeasurementRoundsToThePrint) {
  EXPECT_TRUE(rounds_to(4.706e-4L, 4.7e-4, 1e-5));
  EXPECT_TRUE(rounds_to(1.275e-3L, 1.3e-3, 1e-4));
  EXPECT_FALSE(rounds_to(1.2e-3L, 1.3e-3, 1e-4));
  EXPECT_FALSE(rounds_to(0, -9.7e-3, 1e-4));
}

TEST(PaperFigureText, HasTheDigitsAskedFor) {
  EXPECT_EQ(figure_text(0.0170125, 3), "1.70e-2");
  EXPECT_EQ(figure_text(0.9996, 3), "1.00");
  EXPECT_EQ(figure_text(36.75, 3), "36.8");
  EXPECT_EQ(figure_text(-4.706e-4, 2), "-4.7e-4");
  EXPECT_EQ(figure_text(0, 3), "0");
  EXPECT_EQ(vanishing("", 3e-16L, 1e-15).text, "below 1e-15");
  EXPECT_EQ(vanishing("", 0.5L, 1e-15).text, "0.500");
}

}  // namespace
}  // namespace lobelia::paper

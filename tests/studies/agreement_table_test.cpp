// The table of agreement without engines: what is compared, how, and the page that is made of it.
#include <fmt/format.h>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "lobelia_paths.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "renderer/highlight.hpp"
#include "studies/agreement/agreement.hpp"
#include "tests/program/run_lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia::agreement {
namespace {

constexpr Scope kFull{false, 32}, kSmall{true, 32};

TEST(AgreementCases, CoverEveryHighlightUnderEveryLight) {
  for (const Scope& scope : {kFull, kSmall}) {
    std::set<std::string> highlights, with_exponent, lights;
    std::set<double> exponents;
    for (const Case& one : highlight_cases(scope)) {
      const HighlightChoice& h = one.highlight;
      const std::string highlight = fmt::format("{} {} {}", h.model, h.lobe, h.normalisation);
      highlights.insert(highlight);
      with_exponent.insert(fmt::format("{} {}", highlight, h.exponent));
      lights.insert(std::string(one.what));
      exponents.insert(h.exponent);
    }
    EXPECT_EQ(highlights.size(), models().size() * 7);
    EXPECT_EQ(lights.size(), 7u);
    if (scope.small) continue;
    EXPECT_EQ(exponents, (std::set<double>{1, 16, 64, 256, 1024, 1e5, 1e6}));
    EXPECT_EQ(with_exponent.size(), highlights.size() * exponents.size());
  }
}

TEST(AgreementCases, ShowEveryHighlightInManyPixels) {
  for (const Case& one : highlight_cases(kSmall)) {
    if (!one.close_up) continue;
    const Picture picture = truth::evaluate(one.scene, truth::Digits::kDouble);
    double peak = 0;
    for (const Rgb& value : picture) peak = std::max(peak, max_component(value));
    const auto bright = std::ranges::count_if(
        picture, [&](const Rgb& value) { return max_component(value) > peak / 2; });
    EXPECT_GT(bright, 12) << one.what << " " << one.highlight.model << " " << one.highlight.lobe
                          << " " << one.highlight.exponent;
    EXPECT_LT(bright, 32 * 32 / 2) << one.what;
  }
}

/// Two pixels, the second one in the ring.
const Picture kReference = {{1, 0.5, 1e-4}, {1, 1, 1}};
const PixelFlags kRing = {0, 1};

Image image_of(std::vector<float> values) {
  Image image(2, 1);
  std::ranges::copy(values, image.values().begin());
  return image;
}

TEST(AgreementFigures, CountTheRingApart) {
  const Figures f = difference_from(kReference, image_of({1, 0.5f, 1e-4f, 1, 1, 0}), kRing);
  EXPECT_LT(f.max_of_peak, 1e-8);
  EXPECT_EQ(f.ring_pixels, 1);
  EXPECT_EQ(f.ring_over, 1);
  EXPECT_EQ(f.ring_max_of_peak, 1);
}

TEST(AgreementFigures, AreOfThePeakAndOfTheValueWhereItIsNotTooSmall) {
  const Figures f = difference_from(kReference, image_of({1, 0.53125f, 2e-4f, 1, 1, 1}), kRing);
  EXPECT_DOUBLE_EQ(f.max_of_peak, 0.03125);
  EXPECT_DOUBLE_EQ(f.max_relative, 0.0625);
  EXPECT_NEAR(f.rms_of_peak, 0.03125 / std::sqrt(3), 1e-6);
  EXPECT_EQ(f.ring_over, 0);
}

TEST(AgreementFigures, TakeNoNumberForNearness) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Figures f = difference_from(kReference, image_of({nan, 0.5f, 0, 1, nan, 1}), kRing);
  EXPECT_TRUE(std::isinf(f.max_of_peak));
  EXPECT_TRUE(std::isinf(f.rms_of_peak));
  EXPECT_TRUE(std::isinf(f.max_relative));
  EXPECT_EQ(f.ring_over, 1);
}

TEST(AgreementTable, HasOursWithinItsTargetWithoutAnyEngine) {
  const Agreement agreement = measure({true, 32}, {}, {});
  EXPECT_EQ(agreement.count(Verdict::kMissed), 0u);
  EXPECT_EQ(agreement.count(Verdict::kFailed), 0u);
  EXPECT_EQ(agreement.count(Verdict::kNotComparable), 2u) << "a sized light, inter-reflection";
  EXPECT_EQ(agreement.rows.size(), agreement.cases.size());
  for (const Row& row : agreement.rows) EXPECT_EQ(row.variant.name, ours().name);
}

TEST(AgreementTable, SaysMissedWhereATargetIsMissed) {
  Agreement agreement;
  agreement.cases = highlight_cases(kSmall);
  Figures far;
  far.max_of_peak = 0.01;
  const Variant& blender = *std::ranges::find(variants(), "blender_native", &Variant::name);
  agreement.rows = {{0, ours(), {}, Verdict::kMet, {}}, {0, blender, far, Verdict::kMissed, {}}};
  const std::string page = report_markdown(agreement, "lobelia");
  EXPECT_THAT(page, HasSubstr("2 comparisons, 1 MISSED their targets"));
  EXPECT_THAT(page, HasSubstr(" | 1/1 MISSED |"));
  EXPECT_THAT(page, HasSubstr("*Blender native*: the reason is not known"));
  EXPECT_THAT(report_text(agreement), HasSubstr("1e-2 MISSED"));
  EXPECT_THAT(report_csv(agreement), HasSubstr(",missed,"));
}

TEST(AgreementPage, HasTheProgramsSectionsWithTheirColumns) {
  const std::string page = read_file(LOBELIA_SOURCE_DIR "/docs/agreement.md", 1 << 20);
  const std::string today = report_markdown({}, "lobelia verify references");
  EXPECT_EQ(page.substr(0, page.find("`lobelia verify references`:")),
            today.substr(0, today.find("`lobelia verify references`:")))
      << "run: make references, and copy out/references/agreement.md to docs";
  std::size_t at = 0;
  for (const std::string& heading : markdown_headings()) {
    const std::size_t found = page.find("\n" + heading + "\n", at);
    ASSERT_NE(found, std::string::npos) << heading;
    at = found;
  }
  EXPECT_THAT(page, HasSubstr(table_markdown(headline_table({}))));
  for (const Variant& variant : variants())
    EXPECT_THAT(page, HasSubstr(fmt::format("\n| {} | up to 1024 |", variant.title)));
}

TEST(AgreementCommand, RefusesWrongOptionsUpFront) {
  const TemporaryDirectory directory;
  write_file(directory.path() / "file", "");
  const auto expect = [&](std::vector<std::string> more, ExitCode code, const char* message) {
    std::vector<std::string> arguments{"verify", "references", "--small"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = run_lobelia(arguments, directory.path());
    EXPECT_EQ(result.exit_code, int(code)) << result.output_tail;
    EXPECT_THAT(result.output_tail, HasSubstr(message));
  };
  expect({"--engine", "blendr"}, ExitCode::kUsage, "did you mean 'blender'?");
  expect({"--engine", "analytic"}, ExitCode::kUsage, "allowed: povray, blender");
  expect({"--engine", "povray", "--povray", "no/such"}, ExitCode::kEngine, "no/such");
  expect({"--size", "4"}, ExitCode::kUsage, "--size");
  expect({"--json", "-", "--markdown"}, ExitCode::kUsage, "excludes");
  expect({"-o", "file"}, ExitCode::kOutput, "file");
  EXPECT_EQ(files_in(directory.path()), 1u);
}

}  // namespace
}  // namespace lobelia::agreement

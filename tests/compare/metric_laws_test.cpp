// Laws that every metric of the catalogue keeps: a newly listed metric is tested by these.
#include <oneapi/tbb/global_control.h>

#include "base/system/scratch_memory.hpp"
#include "compare/highlights/find.hpp"
#include "compare/metrics/catalogue.hpp"
#include "compare/metrics/picture_part.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using ::testing::DoubleEq;
using ::testing::Pointwise;

const Tolerance kTolerance{1e-3, 1e-4, 3};

std::vector<std::pair<Image, Image>> pairs() {
  std::vector<std::pair<Image, Image>> list;
  list.emplace_back(fixtures::flat(16, 16, 0, 0, 0), fixtures::flat(16, 16, 1, 1, 1));
  list.emplace_back(fixtures::noise(40, 33, 1, 1.0f), fixtures::noise(40, 33, 2, 1.0f));
  list.emplace_back(fixtures::highlight(64, 48, 20, 3.0), fixtures::highlight(64, 48, 22, 3.1));
  list.emplace_back(fixtures::noise(1, 1, 3, 0.1f), fixtures::noise(1, 1, 4, 0.1f));
  list.emplace_back(fixtures::noise(70, 1, 5, 30.0f), fixtures::noise(70, 1, 6, 30.0f));
  list.emplace_back(fixtures::flat(10, 50, -1, 0.2f, 0), fixtures::flat(10, 50, 0.1f, 0.2f, 0.3f));
  list.emplace_back(fixtures::highlight(200, 180, 20, 1.0), fixtures::highlight(200, 180, 22, 0.9));
  return list;
}

/// Every output of a metric; empty where it cannot be measured of that pair.
std::vector<double> measure(const Metric& metric, const MetricInput& input) {
  if (!is_measurable(metric, input)) return {};
  std::vector<double> values(metric.outputs.size(), -7.0);
  measure_metric(metric, input, values);
  return values;
}

std::vector<double> measure(const Metric& metric, const Image& a, const Image& b) {
  MetricInput input = fixtures::input(a, b, &kTolerance);
  std::vector<LocalHighlight> highlights;
  if (metric.needs == Needs::kHighlights) highlights = find_highlights(b);
  const std::vector<JudgedHighlight> judged = judge_highlights(a, b, highlights);
  input.highlights = judged;
  return measure(metric, input);
}

double measure(std::string_view id, const Image& a, const Image& b) {
  const Metric* metric = find_metric(id);
  return measure(*metric, a, b).at(std::size_t(find_metric_output(id) - metric->outputs.data()));
}

/// How far a value is from that of equal pictures; larger is worse for every output that is judged.
double badness(const MetricOutput& output, double value) {
  return output.better == Better::kHigher     ? -value
         : output.better == Better::kNearZero ? std::abs(value)
                                              : value;
}

bool is_judged(const MetricOutput& output) { return output.better != Better::kNeither; }

TEST(EveryMetric, IsTheSameBitForBitWhereThePicturesAreInFiles) {
  constexpr int kWidth = 811, kHeight = 613;
  const auto figures = [] {
    const Image a = fixtures::noise(kWidth, kHeight, 1, 1.5f),
                b = fixtures::highlight(kWidth, kHeight, 20, 1.2);
    std::vector<std::uint64_t> bits;
    for (const Metric* metric : metrics())
      for (const double value : measure(*metric, a, b))
        bits.push_back(std::bit_cast<std::uint64_t>(value));
    return bits;
  };
  const std::vector<std::uint64_t> in_memory = figures();
  keep_large_pieces_in_files(std::size_t{4} << 20);
  EXPECT_EQ(figures(), in_memory);
  keep_large_pieces_in_files(0);
  EXPECT_GT(in_memory.size(), 50u);
}

TEST(EveryMetric, IsTheSameBitForBitMeasuredWithTheOthersAsAlone) {
  for (const auto& [a, b] : pairs()) {
    PixelFlags mask(a.pixel_count()), highlight(mask);
    for (std::size_t i = 0; i < mask.size(); ++i) {
      mask[i] = i % 5 < 2;
      highlight[i] = i % 3 == 0 && i > mask.size() / 2;
    }
    MetricInput input = fixtures::input(a, b, &kTolerance);
    input.mask = mask;
    input.highlight = highlight;
    input.shown_further.push_back({DisplayLight(a, 2), DisplayLight(b, 2)});
    MetricList list;
    for (const Metric* metric : metrics())
      if (is_measurable(*metric, input)) list.push_back(metric);
    const auto together = measure_metrics(list, input);
    ASSERT_EQ(together.size(), list.size());
    for (std::size_t m = 0; m < list.size(); ++m)
      EXPECT_THAT(together[m],
                  Pointwise(::testing::NanSensitiveDoubleEq(), measure(*list[m], input)))
          << list[m]->outputs[0].id << ", " << a.width() << " x " << a.height();
  }
}

TEST(MetricCatalogue, HasUniqueIdsWithMeanings) {
  std::set<std::string_view> ids;
  for (const Metric* metric : metrics()) {
    ASSERT_FALSE(metric->outputs.empty());
    for (const MetricOutput& output : metric->outputs) {
      EXPECT_TRUE(ids.insert(output.id).second) << output.id << " is listed twice";
      EXPECT_FALSE(output.meaning.empty()) << output.id;
      EXPECT_EQ(find_metric_output(output.id), &output);
    }
  }
  EXPECT_EQ(find_metric_output("no such metric"), nullptr);
}

TEST(MetricLaws, APictureComparedWithItselfHasTheBestValue) {
  int checked = 0;
  for (const auto& [a, b] : pairs())
    for (const Image* image : {&a, &b})
      for (const Metric* metric : metrics()) {
        const std::vector<double> values = measure(*metric, *image, *image);
        for (std::size_t i = 0; i < values.size(); ++i)
          if (is_judged(metric->outputs[i])) {
            EXPECT_EQ(values[i], metric->outputs[i].best) << metric->outputs[i].id;
            ++checked;
          }
      }
  EXPECT_GT(checked, 60);
}

TEST(MetricLaws, AValueLiesInTheRangeOfItsOutput) {
  int checked = 0;
  const auto expect_in_range = [&](const Image& a, const Image& b) {
    for (const Metric* metric : metrics()) {
      const std::vector<double> values = measure(*metric, a, b);
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (!is_judged(metric->outputs[i])) continue;
        const auto& [id, range] = std::pair(metric->outputs[i].id, metric->outputs[i].range);
        EXPECT_GE(values[i], range.least) << id;
        // A mean of float sums may be a rounding above the largest value.
        EXPECT_LE(values[i], range.most * (1 + 1e-12)) << id;
        ++checked;
      }
    }
  };
  const Image black = fixtures::flat(200, 180, 0, 0, 0), white = fixtures::flat(200, 180, 1, 1, 1),
              dots = fixtures::noise(200, 180, 9, 1e6f);
  for (const Image* one : {&black, &white, &dots})
    for (const Image* other : {&black, &white, &dots}) expect_in_range(*one, *other);
  for (const auto& [a, b] : pairs()) expect_in_range(a, b), expect_in_range(b, a);
  EXPECT_GT(checked, 500);
}

TEST(MetricLaws, TheBestValueAndBothEndsOfARangeAreLimits) {
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs) {
      if (!is_judged(output)) continue;
      const auto is_limit = [&](double limit) { return limit_problem(output, limit).empty(); };
      const auto& [least, most] = output.range;
      const bool is_higher = output.better == Better::kHigher;
      EXPECT_EQ(is_limit(output.best), std::isfinite(output.best)) << output.id;
      EXPECT_EQ(is_limit(most), std::isfinite(most)) << output.id;
      EXPECT_EQ(is_limit(is_higher ? least : 0), !is_higher || std::isfinite(least)) << output.id;
      EXPECT_EQ(is_limit(1.001 * std::min(most, 1e9)), !std::isfinite(most)) << output.id;
      EXPECT_EQ(is_limit(is_higher ? least - 0.001 : -0.001), false) << output.id;
      EXPECT_FALSE(is_limit(std::nan(""))) << output.id;
    }
}

TEST(Limits, AreCorrectedIfBeyondTheRange) {
  const auto problem = [](const char* id, double limit) {
    return limit_problem(*find_metric_output(id), limit);
  };
  EXPECT_EQ(
      problem("share_over.abs=0.004", 10),
      "share_over.abs=0.004 is a share from 0 to 1, so 10 is no limit on it; for 10 % write 0.1");
  EXPECT_EQ(problem("ssim", 99),
            "ssim is a number from -1 to 1, so 99 is no limit on it; for 99 % write 0.99");
  EXPECT_EQ(problem("flip.ldr.mean", 300),
            "flip.ldr.mean is a number from 0 to 1, so 300 is no limit on it");
  EXPECT_EQ(problem("code.max", 256),
            "code.max is a number from 0 to 255, so 256 is no limit on it");
  EXPECT_EQ(problem("rmse", -1), "rmse is a number of at least 0, so -1 is no limit on it");
  EXPECT_EQ(problem("energy.highlight", -0.5),
            "a limit on energy.highlight is on its size, a finite number of at least 0, not -0.5");
  EXPECT_EQ(problem("max_rel_peak", 5), "") << "five times the peak is possible";
}

TEST(MetricLaws, DifferentPicturesHaveAWorseValue) {
  // At least one output of each metric sees the difference of each pair; none is better or NaN.
  for (const auto& [a, b] : pairs())
    for (const Metric* metric : metrics()) {
      const std::vector<double> values = measure(*metric, a, b);
      bool seen = values.empty();
      for (std::size_t i = 0; i < values.size(); ++i) {
        const MetricOutput& output = metric->outputs[i];
        if (!is_judged(output)) continue;
        EXPECT_GE(badness(output, values[i]), badness(output, output.best)) << output.id;
        seen |= badness(output, values[i]) > badness(output, output.best);
      }
      EXPECT_TRUE(seen) << metric->outputs[0].id << ", " << a.width() << " x " << a.height();
    }
}

TEST(MetricLaws, SymmetricMetricsIgnoreTheOrderOfPictures) {
  for (const auto& [a, b] : pairs())
    for (const Metric* metric : metrics()) {
      const std::vector<double> forth = measure(*metric, a, b), back = measure(*metric, b, a);
      for (std::size_t i = 0; i < forth.size(); ++i)
        if (metric->outputs[i].symmetric && forth[i] != back[i]) {  // they may both be infinite
          // Not bit for bit: CIEDE2000's means of angles round differently.
          EXPECT_NEAR(forth[i], back[i], 1e-12 * std::abs(forth[i])) << metric->outputs[i].id;
        }
    }
}

/// Each picture is farther from the reference than the one before, and no metric calls it nearer.
void expect_ever_worse(const Image& reference, const std::vector<Image>& pictures) {
  for (const Metric* metric : metrics()) {
    std::vector<double> before = measure(*metric, reference, reference);
    for (std::size_t k = 0; k < pictures.size(); ++k) {
      const std::vector<double> values = measure(*metric, pictures[k], reference);
      for (std::size_t i = 0; i < values.size(); ++i) {
        const MetricOutput& output = metric->outputs[i];
        // Values that cancel in a signed mean or in a centroid leave only rounding.
        const bool cancels = output.better == Better::kNearZero || output.id == "shift.highlight";
        const double rounding = cancels ? 1e-6 : 0;
        if (is_judged(output)) {
          EXPECT_GE(badness(output, values[i]), badness(output, before[i]) - rounding)
              << output.id << ", picture " << k;
        }
      }
      before = values;
    }
  }
}

TEST(MetricLaws, ALargerErrorIsNeverRatedLower) {
  std::vector<Image> pictures;
  for (const double peak : {0.999, 0.99, 0.95, 0.8})
    pictures.push_back(fixtures::highlight(192, 192, 20, peak));
  expect_ever_worse(fixtures::highlight(192, 192, 20, 1.0), pictures);
}

TEST(MetricLaws, ABlurrierHighlightIsNeverRatedBetter) {
  // A Gaussian blurred by a Gaussian is one that is wider, and lower by as much.
  std::vector<Image> pictures;
  for (const double wider : {1.02, 1.1, 1.3, 1.6})
    pictures.push_back(fixtures::highlight(192, 192, 40 / wider, 1 / wider));
  expect_ever_worse(fixtures::highlight(192, 192, 40, 1.0), pictures);
}

TEST(MetricLaws, AHighlightThatIsFartherOffIsNeverRatedBetter) {
  const Image wide = fixtures::highlight(256, 192, 40, 1.0);
  const auto shifted = [&](int columns) {
    Image image(192, 192);
    for (int y = 0; y < 192; ++y)
      for (int x = 0; x < 192; ++x)
        std::ranges::copy(wide.pixel(x + 32 - columns, y), image.pixel(x, y).begin());
    return image;
  };
  expect_ever_worse(shifted(0), {shifted(1), shifted(2), shifted(4), shifted(8)});
}

TEST(MetricLaws, TheNumberOfThreadsDoesNotChangeABit) {
  const Image a = fixtures::noise(300, 200, 8, 1.0f), b = fixtures::highlight(300, 200, 5, 1.0);
  for (const Metric* metric : metrics()) {
    const std::vector<double> many = measure(*metric, a, b);
    const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_THAT(measure(*metric, a, b), Pointwise(DoubleEq(), many)) << metric->outputs[0].id;
  }
}

TEST(Psnr, IsInDecibelsOfTheReferencesPeak) {
  const Image a = fixtures::flat(5, 4, 2, 2, 2), b = fixtures::flat(5, 4, 2.5f, 1.5f, 1.5f);
  EXPECT_DOUBLE_EQ(measure("psnr", a, b), 20 * std::log10(2.5 / 0.5));
  EXPECT_DOUBLE_EQ(measure("psnr", b, a), 20 * std::log10(2.0 / 0.5));
  const Image black = fixtures::flat(5, 4, 0, 0, 0);
  EXPECT_EQ(measure("psnr", a, black), -std::numeric_limits<double>::infinity());
}

TEST(Limits, PassAsTheDirectionSaysAndNeverANaN) {
  const MetricOutput error{"", "", Unit::kPlain, Better::kLower, true, ""},
      sign{"", "", Unit::kPlain, Better::kNearZero, true, ""},
      likeness{"", "", Unit::kPlain, Better::kHigher, true, ""},
      fact{"", "", Unit::kPlain, Better::kNeither, true, ""};
  EXPECT_TRUE(is_within(error, 1, 1));
  EXPECT_FALSE(is_within(error, 1.1, 1));
  EXPECT_TRUE(is_within(sign, -1, 1));
  EXPECT_FALSE(is_within(sign, -1.1, 1));
  EXPECT_TRUE(is_within(likeness, 1, 1));
  EXPECT_FALSE(is_within(likeness, 0.9, 1));
  EXPECT_FALSE(is_within(fact, 0, 1));
  for (const MetricOutput* output : {&error, &sign, &likeness})
    for (const auto& [value, limit] : {std::pair{1.0, std::nan("")}, {std::nan(""), 1.0}})
      EXPECT_FALSE(is_within(*output, value, limit));
}

}  // namespace
}  // namespace lobelia

// Each highlight is judged by itself: beside a light of any brightness a changed one is found, and nothing else is.
#include "compare/compare.hpp"
#include "compare/highlights/words.hpp"
#include "compare/sensitivity.hpp"
#include "compare/set/report.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/compare/spots.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

constexpr int kTableWidth = 160, kTableHeight = 120;

/// A highlight on even light, and a light of 3 x 3 pixels.
struct Beside {
  Spot spot;
  double base = 0, light = 0;
  int light_x = 0, light_y = 0;

  Image with(double kept = 1, double right = 0) const {
    return picture(kTableWidth, kTableHeight, [&](double x, double y) {
      const bool in_light = std::abs(x - light_x - 0.5) < 1.6 && std::abs(y - light_y - 0.5) < 1.6;
      return in_light ? light : base + kept * spot(x - right, y);
    });
  }
};

/// Any place and shape. The light is in view anywhere, but not on the highlight.
Beside random_case(std::mt19937& random, double light) {
  const auto between = [&](double low, double high) {
    return low + (high - low) * double(random()) / 4294967296.0;
  };
  Beside made;
  const double width = std::exp(between(std::log(1.5), std::log(20.0)));
  const double margin = std::min(2.0 * width, 45.0);
  made.spot = {between(margin, kTableWidth - margin),
               between(margin, kTableHeight - margin),
               between(0.05, 4),
               width,
               width * between(0.5, 1),
               between(0, 3),
               random() % 2 == 0};
  made.base = random() % 2 == 0 ? 0 : made.spot.peak * between(0, 0.6);
  made.light = light * made.spot.peak;
  do {
    made.light_x = 2 + int(random() % (kTableWidth - 4));
    made.light_y = 2 + int(random() % (kTableHeight - 4));
  } while (std::hypot(made.light_x - made.spot.x, made.light_y - made.spot.y) < 2.5 * width + 4);
  return made;
}

/// The limits on each highlight alone.
ComparisonOptions on_highlights() {
  ComparisonOptions options;
  options.highlight = true;
  options.default_limits = false;
  options.limits = {{"highlights.energy", kEnergyLimit},
                    {"highlights.width", kWidthLimit},
                    {"highlights.shift", kShiftLimit}};
  options.metrics = {"highlights.energy"};
  return options;
}

Comparison judged(const Image& a, const Image& b) { return compare(a, b, on_highlights()); }

Image each(const Image& image, const std::function<double(double)>& change) {
  Image result = image;
  for (float& value : result.values()) value = float(change(double(value)));
  return result;
}

const records::LocalHighlight* line_of(const Comparison& comparison, const Spot& spot) {
  const auto found = std::ranges::find_if(comparison.highlights, [&](const auto& one) {
    return std::hypot(one.x + 0.5 - spot.x, one.y + 0.5 - spot.y) < 2;
  });
  return found == comparison.highlights.end() ? nullptr : &*found;
}

TEST(HighlightsTable, HasNothingMissedBesideALightOfAnyBrightness) {
  std::mt19937 random(56);
  for (int round = 0; round < 24; ++round)
    for (const double light : {5.0, 50.0, 500.0, 5000.0, 50000.0}) {
      const Beside made = random_case(random, light);
      const Image reference = made.with();
      const auto say = [&](const char* change) {
        return ::testing::Message()
               << change << " beside a light of " << light << " times the peak at " << made.light_x
               << ", " << made.light_y << ": " << made.spot.x << ", " << made.spot.y << ", peak "
               << made.spot.peak << " over " << made.base << ", half-widths " << made.spot.major
               << ", " << made.spot.minor << (made.spot.ggx ? ", GGX" : "");
      };
      for (const auto& [change, kept, right] : {std::tuple{"5 % dimmer", 0.95, 0.0},
                                                {"30 % dimmer", 0.7, 0.0},
                                                {"moved", 1.0, 4.0},
                                                {"gone", 0.0, 0.0}})
        EXPECT_EQ(judged(made.with(kept, right), reference).verdict, Verdict::kDiffers)
            << say(change);
      EXPECT_EQ(judged(reference, reference).verdict, Verdict::kPass) << say("equal");
    }
}

TEST(HighlightsTable, NamesEachChange) {
  std::mt19937 random(57);
  int lines = 0;
  for (int round = 0; round < 40; ++round) {
    Beside made = random_case(random, 1000);
    made.base = std::min(made.base, 0.3 * made.spot.peak);
    const Image reference = made.with();
    const Comparison dimmer = judged(made.with(0.8), reference),
                     moved = judged(made.with(1, 0.5), reference);
    Beside wide = made;
    wide.spot.major *= 1.1;
    wide.spot.minor *= 1.1;
    const Comparison wider = judged(wide.with(), reference);
    for (const auto* of : {&dimmer, &moved, &wider})
      ASSERT_TRUE(line_of(*of, made.spot)) << made.spot.x << ", " << made.spot.y;
    EXPECT_NEAR(line_of(dimmer, made.spot)->energy, -0.2, 0.03);
    EXPECT_NEAR(line_of(dimmer, made.spot)->width, 0, 0.01);
    if (made.spot.minor > 3 && made.base == 0) {
      EXPECT_NEAR(line_of(moved, made.spot)->shift_x, 0.5, 0.1);
      EXPECT_NEAR(line_of(wider, made.spot)->width, 0.1, 0.03);
      ++lines;
    }
  }
  EXPECT_GT(lines, 5);
}

TEST(HighlightsTable, SaysWhichOnesTheReferenceLacks) {
  std::mt19937 random(60);
  for (int round = 0; round < 40; ++round) {
    const Beside made = random_case(random, 3000);
    const Image with = made.with(), without = made.with(0);
    const Comparison comparison = judged(with, without);
    EXPECT_EQ(comparison.verdict, Verdict::kDiffers);
    const auto* line = line_of(comparison, made.spot);
    ASSERT_TRUE(line) << made.spot.x << ", " << made.spot.y;
    EXPECT_TRUE(line->only_in_a);
    EXPECT_NEAR(line->energy, 1, 0.1);
    EXPECT_EQ(sentences_on_highlights(comparison.highlights),
              std::vector{"a has a highlight at (" + std::to_string(line->x) + ", " +
                          std::to_string(line->y) + ") that b lacks"});
    // One that both have is named once, however much brighter it is.
    for (const records::LocalHighlight& one : judged(made.with(20), with).highlights)
      EXPECT_FALSE(one.only_in_a) << one.x << ", " << one.y;
  }
}

TEST(HighlightsTable, HasTheFiguresThatAreJudged) {
  std::mt19937 random(61);
  for (int round = 0; round < 20; ++round) {
    const Beside made = random_case(random, 50);
    Image rough = made.with(0.9, 0.7);
    for (float& value : rough.values()) value *= 1 + 0.01f * (float(random() % 1000) / 1000 - 0.5f);
    const Comparison comparison = judged(rough, made.with());
    double energy = 0, width = 0, shift = 0;
    for (const records::LocalHighlight& one : comparison.highlights) {
      energy = std::max(energy, *one.energy_beyond);
      width = std::max(width, *one.width_beyond);
      shift = std::max(shift, *one.shift_beyond);
      EXPECT_LE(*one.energy_beyond, std::abs(one.energy));
    }
    EXPECT_EQ(energy, comparison.value("highlights.energy"));
    EXPECT_EQ(width, comparison.value("highlights.width"));
    EXPECT_EQ(shift, comparison.value("highlights.shift"));
  }
}

TEST(HighlightsTable, FindsAnExtraHighlightOnABroadOne) {
  const Beside broad{{80, 60, 0.7, 40, 40}, 0.2, 800, 12, 12},
      narrow{{80, 60, 2.5, 3, 3}, 0, 0, 12, 12};
  const Image reference = broad.with(), highlight = narrow.with();
  Image both = reference;
  for (std::size_t i = 0; i < both.values().size(); ++i) both.values()[i] += highlight.values()[i];
  const std::vector<std::string> said = sentences_on_highlights(judged(both, reference).highlights);
  EXPECT_EQ(std::ranges::count(said, std::string("a has a highlight at (79, 59) that b lacks")), 1);
}

TEST(HighlightsTable, NamesTheColourWhereTheLightIsTheSame) {
  const Beside made{{80, 60, 1, 9, 9}, 0.1, 0.1, 12, 12};
  const Image reference = made.with();
  const auto said = [&](double red, double green, double blue) {
    Image changed = reference;
    for (std::size_t i = 0; i < changed.values().size(); ++i)
      changed.values()[i] *= float(i % 3 == 0 ? red : i % 3 == 1 ? green : blue);
    const Comparison comparison = judged(changed, reference);
    return sentences_on_highlights(comparison.highlights).at(0);
  };
  EXPECT_THAT(said(1.2, 0.9, 0.9), HasSubstr("% more red light"));
  EXPECT_THAT(said(0.8, 1, 1.1), HasSubstr("% less red light"));
  EXPECT_THAT(said(1, 0.99, 1.3), HasSubstr("% more blue light"));
  EXPECT_THAT(said(1.2, 1.1, 1.1), HasSubstr("% more light"));
}

TEST(HighlightsTable, NamesTheWorstFirst) {
  const Spot left{30, 60, 1, 4, 4}, middle{80, 60, 0.5, 4, 4}, right{130, 60, 0.3, 4, 4};
  const auto with = [&](double of_left, double of_middle, double of_right) {
    return picture(kTableWidth, kTableHeight, [&](double x, double y) {
      if (x < 3 && y < 3) return 9000.0;
      return of_left * left(x, y) + of_middle * middle(x, y) + of_right * right(x, y);
    });
  };
  const Comparison comparison = judged(with(0.9, 0, 0.7), with(1, 1, 1));
  ASSERT_GE(comparison.highlights.size(), 3u);
  EXPECT_EQ(comparison.value("highlights.count"), double(comparison.highlights.size()));
  EXPECT_NEAR(comparison.highlights[0].x, 80, 1);
  EXPECT_NEAR(comparison.highlights[1].x, 130, 1);
  EXPECT_NEAR(comparison.highlights[2].x, 30, 1);
  EXPECT_EQ(comparison.value("highlights.x"), comparison.highlights[0].x);
  const auto sentences = sentences_on_highlights(comparison.highlights);
  ASSERT_EQ(sentences.size(), 3u);
  EXPECT_EQ(sentences[0], "the highlight at (79, 59) is gone");
  EXPECT_EQ(sentences[1], "the highlight at (129, 59) has 30 % less light");
  EXPECT_THAT(why_not_pass(comparison, "a", "b"), HasSubstr("the highlight at (79, 59) is gone"));
}

TEST(HighlightsTable, SaysThatAFigureIsOfAllBrightPixels) {
  const Spot left{30, 60, 1, 4, 4}, middle{80, 60, 0.5, 4, 4};
  const auto with = [&](double of_middle) {
    return picture(kTableWidth, kTableHeight,
                   [&](double x, double y) { return left(x, y) + of_middle * middle(x, y); });
  };
  const ComparisonOptions options = usual_options();
  EXPECT_THAT(highlight_sentence(compare(with(0), with(1), options)),
              HasSubstr("a's brightest pixels together are 23 % narrower"));
  EXPECT_THAT(highlight_sentence(compare(with(1), with(1), options)),
              HasSubstr("a's highlight is as wide"));
}

/// Waves of several lengths, as of a texture, on a slope.
Image texture(double phase) {
  return picture(kTableWidth, kTableHeight, [&](double x, double y) {
    return 0.3 + 0.002 * x + 0.2 * std::sin(0.9 * x + phase) * std::cos(1.1 * y) +
           0.1 * std::sin(0.13 * x + 0.21 * y) + 0.05 * std::sin(2.3 * x * y / 97);
  });
}

TEST(HighlightsTable, HasNoAlarmForNearlyEqualTextures) {
  for (const Image& reference :
       {texture(0), texture(1.2),
        picture(kTableWidth, kTableHeight, [](double x, double) { return x; }),
        picture(kTableWidth, kTableHeight, [](double x, double y) { return x * y; }),
        fixtures::flat(40, 30, 0.2f, 0.4f, 0.1f), fixtures::flat(40, 30, 0, 0, 0)}) {
    ComparisonOptions options = on_highlights();
    options.limits.clear();
    options.default_limits = true;
    for (const double factor : {0.99, 1.0, 1.01})
      for (const LimitResult& limit :
           compare(each(reference, [&](double v) { return factor * v; }), reference, options)
               .limits)
        EXPECT_TRUE(limit.pass || !limit.metric.starts_with("highlights."))
            << limit.metric << ' ' << limit.value << ", factor " << factor;
  }
}

TEST(HighlightsTable, HasNoAlarmForNoiseThatNobodyTold) {
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    const Beside made{{80, 60, 1, 9, 7}, seed % 2 == 0 ? 0.0 : 0.2, 800, 12, 12};
    const Image clean = made.with();
    const auto noisy = [&](std::uint64_t of) {
      Image image = clean;
      const Image noise = fixtures::noise(kTableWidth, kTableHeight, of, 1);
      for (std::size_t i = 0; i < image.values().size(); ++i)
        image.values()[i] = std::max(0.0f, image.values()[i] + 0.04f * (noise.values()[i] - 0.5f));
      return image;
    };
    const Comparison comparison = judged(noisy(2 * seed), noisy(2 * seed + 1));
    EXPECT_EQ(comparison.verdict, Verdict::kPass) << why_not_pass(comparison, "a", "b");
    // A clean reference tells nothing of the noise, and has no highlight less.
    for (const records::LocalHighlight& one : judged(noisy(2 * seed), clean).highlights)
      EXPECT_FALSE(one.only_in_a) << one.x << ", " << one.y;
    // The same noise hides no missing highlight.
    Image gone = made.with(0);
    EXPECT_EQ(judged(gone, noisy(2 * seed)).verdict, Verdict::kDiffers);
  }
}

/// With noise of 70 % of each pixel, and then a tent filter over 3 x 3 pixels.
Image with_filtered_noise(const Image& clean, std::mt19937& random) {
  std::gamma_distribution<double> factor(2.0, 0.5);
  Image noisy = clean;
  for (int y = 0; y < clean.height(); ++y)
    for (int x = 0; x < clean.width(); ++x) {
      const double by = factor(random);
      for (float& value : noisy.pixel(x, y)) value = float(double(value) * by);
    }
  Image filtered = noisy;
  for (int y = 1; y + 1 < clean.height(); ++y)
    for (int x = 1; x + 1 < clean.width(); ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (const int j : {-1, 0, 1})
          for (const int i : {-1, 0, 1})
            sum += double(noisy.pixel(x + i, y + j)[c]) * (2 - std::abs(i)) * (2 - std::abs(j));
        filtered.pixel(x, y)[c] = float(sum / 16);
      }
  return filtered;
}

TEST(HighlightsTable, TakesNoFilteredNoiseForAHighlight) {
  const Image clean = Beside{{80, 60, 1, 8, 8}, 0.2, 0.2, 12, 12}.with();
  std::mt19937 random(61);
  for (int round = 0; round < 60; ++round) {
    std::vector<LocalHighlight> highlights;
    add_highlights_of_a(with_filtered_noise(clean, random), clean, {}, {}, highlights);
    EXPECT_TRUE(highlights.empty()) << highlights.front().x << ", " << highlights.front().y;
  }
}

TEST(HighlightsTable, HasNoAlarmForRounding) {
  std::mt19937 random(59);
  for (int round = 0; round < 20; ++round) {
    Beside made = random_case(random, 30000);
    const Image reference = made.with();
    const Image half = each(reference, [](double v) {
      int exponent = 0;
      const double fraction = std::frexp(v, &exponent);
      return std::ldexp(std::nearbyint(2048 * fraction) / 2048, exponent);
    });
    EXPECT_EQ(judged(half, reference).verdict, Verdict::kPass);
  }
}

TEST(HighlightsTable, BoundsItsWorkAndItsCount) {
  const Image noise = fixtures::noise(700, 500, 3, 1);
  EXPECT_LE(find_highlights(noise).size(), kMostHighlights);
  const Image many = picture(700, 500, [](double x, double y) {
    const double dx = std::fmod(x, 10) - 5, dy = std::fmod(y, 10) - 5;
    return std::exp2(-(dx * dx + dy * dy) / 4);
  });
  EXPECT_EQ(find_highlights(many).size(), kMostHighlights);
  // 2000 x 1500 pixels are reduced to squares of 2 x 2, and what was reduced is still judged by its pixels.
  const Spot spot{1200.3, 700.6, 1, 9, 9};
  const Image large =
      picture(2000, 1500, [&](double x, double y) { return x < 4 && y < 4 ? 5000 : spot(x, y); });
  Image dimmer = large;
  for (float& value : dimmer.values()) value *= value < 100 ? 0.9f : 1;
  const Comparison comparison = judged(dimmer, large);
  const auto* line = line_of(comparison, spot);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->energy, -0.1, 1e-3);
  EXPECT_EQ(comparison.verdict, Verdict::kDiffers);
}

TEST(HighlightsTable, LooksOnlyWhereAHighlightMayLie) {
  const Beside made{{80, 60, 1, 9, 7}, 0, 800, 12, 12};
  PixelFlags where(std::size_t(kTableWidth * kTableHeight));
  for (int y = 30; y < 90; ++y)
    for (int x = 40; x < 120; ++x) where[std::size_t(y * kTableWidth + x)] = 1;
  const auto found = find_highlights(made.with(), where);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].x, 79);
  EXPECT_EQ(found[0].y, 59);
}

TEST(AutomaticExposure, ShowsEachHighlightOfThePicture) {
  for (const double light : {5.0, 500.0, 5e4, 1e6}) {
    const Beside made{{80, 60, 1.5, 9, 7}, 0, light, 12, 12};
    ComparisonOptions options = usual_options();
    options.metrics = {"ciede2000.max"};
    const Viewing viewing = compare(made.with(), made.with(), options).viewing;
    std::vector<double> all = viewing.further_stops;
    all.push_back(viewing.exposure_stops);
    all.push_back(*viewing.tail_stops);
    const bool shown = std::ranges::any_of(all, [](double stops) {
      const double value = 1.5 * std::exp2(stops);
      return value > 1.0 / 65 && value < 1.01;
    });
    EXPECT_TRUE(shown) << light;
    EXPECT_EQ(viewing.further_stops.empty(), light < 5000) << light;
    // Nothing is left out that was seen before.
    EXPECT_NEAR(viewing.exposure_stops, -std::log2(light), 1e-6);
  }
}

TEST(Sensitivity, ChangesEachHighlightInTurn) {
  const Beside made{{80, 60, 1, 5, 5}, 0.1, 800, 12, 12};
  ComparisonOptions options = usual_options();
  const auto changes = sensitivity(made.with(), options);
  for (const char* how : {"gone", "5 % dimmer", "30 % dimmer", "moved 4 pixels", "only in a"}) {
    const std::string name = std::string("the highlight at (79, 59) ") + how;
    const auto change = std::ranges::find(changes, name, &Change::name);
    ASSERT_NE(change, changes.end()) << name;
    EXPECT_EQ(change->expected, Expected::kFound) << name;
    EXPECT_TRUE(change->is_found()) << name;
    EXPECT_THAT(change->found_by, HasSubstr("highlights."));
  }
  options.default_limits = false;
  options.limits = {{"max_rel_peak", 0.01}};
  const auto blind = sensitivity(made.with(), options);
  const auto missed = std::ranges::find(blind, "the highlight at (79, 59) gone", &Change::name);
  ASSERT_NE(missed, blind.end());
  EXPECT_FALSE(missed->is_as_expected()) << "and the command says NOT FOUND";
}

}  // namespace
}  // namespace lobelia

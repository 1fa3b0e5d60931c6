// Faults are named where they were made, in random pictures, and nowhere else.
#include "compare/faults.hpp"

#include "base/pictures/colour.hpp"
#include "base/pictures/half.hpp"
#include "base/pictures/image_values.hpp"
#include "compare/set/report.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

constexpr int kWidth = 72, kHeight = 56, kPictures = 40;

std::vector<std::string> kinds(const Image& a, const Image& b) {
  std::vector<std::string> result;
  for (const records::Fault& fault : find_faults(a, b))
    result.push_back(fault.picture + " " + fault.kind);
  return result;
}

class Faults : public ::testing::Test {
 protected:
  double between(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }

  /// Highlights of several sizes and colours over a slope, with a brightest value from 2 to 200.
  Image scene() {
    Image image(kWidth, kHeight);
    const double peak = std::exp(between(std::log(2), std::log(200)));
    struct Spot {
      double x, y, width, height, colour[3];
    };
    std::vector<Spot> spots;
    for (int i = 0, count = 1 + int(between(0, 4)); i < count; ++i)
      spots.push_back({between(10, 60),
                       between(10, 46),
                       between(2, 9),
                       i == 0 ? peak : peak * between(0.01, 0.8),
                       {between(0.3, 1), between(0.3, 1), 1}});
    const double floor = between(0, 0.2), slope = between(0, 0.3);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
          double value = floor + slope * x / kWidth;
          for (const Spot& spot : spots)
            value += spot.height * spot.colour[c] *
                     std::exp(-(std::pow(x - spot.x, 2) + std::pow(y - spot.y, 2)) /
                              (2 * spot.width * spot.width));
          image.pixel(x, y)[c] = float(value);
        }
    return image;
  }

  Image noisy(Image image, double share) {
    std::normal_distribution<double> normal(0, share);
    for (float& value : image.values()) value = float(double(value) * (1 + normal(random_)));
    return image;
  }

  std::mt19937 random_{42};
};

Image of_each(Image image, const std::function<double(double)>& change) {
  for (float& value : image.values()) value = float(change(double(value)));
  return image;
}

double encoded(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}
double as_stored_in_8_bits(double light) {
  return double(srgb_decoded(float(std::round(255 * encoded(std::clamp(light, 0.0, 1.0))) / 255)));
}
Image in_halves(const Image& image) {
  return of_each(image, [](double value) { return rounded_to_half(value); });
}

TEST_F(Faults, NameAPictureThatIsClippedAndWhere) {
  for (int i = 0; i < kPictures; ++i) {
    const Image whole = scene();
    const double level = i % 2 == 0 ? 1 : between(0.3, 0.7) * double(peak_value(whole));
    const Image cut =
        of_each(whole, [&](double value) { return std::min(value, double(float(level))); });
    ASSERT_EQ(kinds(cut, whole), std::vector<std::string>{"a clipped"}) << i;
    EXPECT_EQ(kinds(whole, cut), std::vector<std::string>{"b clipped"}) << i;
    EXPECT_EQ(kinds(in_halves(cut), whole), std::vector<std::string>{"a clipped"}) << i;
    const records::Fault fault = find_faults(cut, whole).front();
    EXPECT_FLOAT_EQ(float(*fault.value), float(level));
    EXPECT_EQ(*fault.other, peak_value(whole));
    EXPECT_EQ(kinds(of_each(whole, as_stored_in_8_bits), whole),
              std::vector<std::string>{"a clipped"})
        << "a file of 8 bits";
  }
}

TEST_F(Faults, NameAPictureThatIsEncoded) {
  for (int i = 0; i < kPictures; ++i) {
    const Image light = scene();
    const auto encode = [&](double value) {
      return encoded(i % 2 == 0 ? value : std::clamp(value, 0.0, 1.0));
    };
    const Image wrong = of_each(light, encode);
    EXPECT_EQ(kinds(wrong, light), std::vector<std::string>{"a encoded as sRGB"}) << i;
    EXPECT_EQ(kinds(light, wrong), std::vector<std::string>{"b encoded as sRGB"}) << i;
    const auto in_8_bits = [&](double value) {
      return std::round(255 * encode(std::min(value, 1.0))) / 255;
    };
    EXPECT_EQ(kinds(of_each(light, in_8_bits), light),
              std::vector<std::string>{"a encoded as sRGB"})
        << i;
  }
}

TEST_F(Faults, NameABrightPixelAndItsPlace) {
  for (int i = 0; i < kPictures; ++i) {
    const Image reference = scene();
    Image firefly = i % 2 == 0 ? reference : noisy(reference, 0.001);
    const int x = int(between(0, kWidth)), y = int(between(0, kHeight));
    const auto peak = float(peak_value(reference));
    firefly.pixel(x, y)[std::size_t(i) % 3] = peak * float(between(6, 1000));
    ASSERT_EQ(kinds(firefly, reference), std::vector<std::string>{"a one bright pixel"}) << i;
    EXPECT_EQ(kinds(reference, firefly), std::vector<std::string>{"b one bright pixel"}) << i;
    const records::Fault fault = find_faults(firefly, reference).front();
    EXPECT_EQ(*fault.x, x);
    EXPECT_EQ(*fault.y, y);
    EXPECT_LT(*fault.rest, 0.01);
  }
}

TEST_F(Faults, AreNoneOfOtherDifferences) {
  using Change = std::function<Image(const Image&)>;
  const auto each = [](std::function<double(double)> change) -> Change {
    return [change](const Image& image) { return of_each(image, change); };
  };
  const auto moved = [](int right) -> Change {
    return [right](const Image& image) {
      Image result = image;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
          std::ranges::copy(image.pixel(std::max(x - right, 0), y), result.pixel(x, y).begin());
      return result;
    };
  };
  const std::pair<const char*, Change> changes[] = {
      {"equal", each([](double v) { return v; })},
      {"dimmer", each([](double v) { return 0.7 * v; })},
      {"slightly dimmer", each([](double v) { return 0.99 * v; })},
      {"brighter", each([](double v) { return 3 * v; })},
      {"gamma 1.8", each([](double v) { return std::pow(v, 1 / 1.8); })},
      {"gamma 2.2", each([](double v) { return std::pow(v, 1 / 2.2); })},
      {"gamma 2.4", each([](double v) { return std::pow(v, 1 / 2.4); })},
      {"Reinhard", each([](double v) { return v / (1 + v); })},
      {"black level", each([](double v) { return v + 0.05; })},
      {"squared", each([](double v) { return v * v; })},
      {"moved", moved(2)},
      {"halves", [](const Image& image) { return in_halves(image); }},
      {"encoded and dimmer", each([](double v) { return 0.9 * encoded(v); })},
      {"cut off and dimmer", each([](double v) { return std::min(0.9 * v, 1.0); })},
      {"noise", [&](const Image& image) { return noisy(image, 0.1); }},
      {"encoded with noise",
       [&](const Image& image) { return noisy(of_each(image, encoded), 0.1); }},
      {"a bright block",
       [](const Image& image) {
         Image result = image;
         for (int y = 20; y < 23; ++y)
           for (int x = 20; x < 23; ++x) result.pixel(x, y)[0] = 1e4f;
         return result;
       }},
      {"two bright pixels",
       [](const Image& image) {
         Image result = image;
         result.pixel(10, 10)[0] = result.pixel(50, 40)[1] = 1e5f;
         return result;
       }},
      {"another scene", [&](const Image&) { return scene(); }},
  };
  for (const auto& [name, change] : changes)
    for (int i = 0; i < kPictures; ++i) {
      const Image reference = scene();
      EXPECT_THAT(kinds(change(reference), reference), IsEmpty()) << name << " " << i;
    }
}

TEST_F(Faults, AreNoneOfALampThatIsDimmer) {
  // A flat lamp at 1 where the other has 1.5 may be clipped, or dimmer.
  Image reference = of_each(scene(), [](double v) { return std::min(v, 1.0) * 0.5; }),
        dimmer = reference;
  for (int y = 5; y < 15; ++y)
    for (int x = 5; x < 15; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        reference.pixel(x, y)[c] = 1.5f;
        dimmer.pixel(x, y)[c] = 1;
      }
  EXPECT_THAT(kinds(dimmer, reference), IsEmpty());
}

TEST_F(Faults, AreNoneOfAFlatPictureThatLacksAHighlight) {
  const Image flat = fixtures::flat(kWidth, kHeight, 0.1f, 0.1f, 0.1f);
  Image highlight = flat;
  for (int y = 5; y < 15; ++y)
    for (int x = 5; x < 15; ++x)
      for (float& value : highlight.pixel(x, y)) value += float(20 - std::hypot(x - 10, y - 10));
  EXPECT_THAT(kinds(flat, highlight), IsEmpty()) << "clipped at 0.1";
  EXPECT_THAT(kinds(highlight, flat), IsEmpty());
}

TEST_F(Faults, AreNoneOfAHighlightOfOnePixelThatBothHave) {
  Image reference = fixtures::flat(kWidth, kHeight, 0.1f, 0.1f, 0.1f);
  reference.pixel(9, 9)[0] = 100;
  Image brighter = reference;
  brighter.pixel(9, 9)[0] = 200;
  EXPECT_THAT(kinds(brighter, reference), IsEmpty());
}

TEST_F(Faults, AreSaidInPlaceOfTheHighlightsFigures) {
  ComparisonOptions options;
  options.highlight = true;
  const Image reference = scene();
  Image firefly = reference;
  firefly.pixel(7, 3)[1] = 1e6f;
  const Comparison bright = compare(firefly, reference, options);
  EXPECT_THAT(highlight_sentence(bright), HasSubstr("a has one bright pixel at (7, 3): "));
  EXPECT_EQ(comparison_record(bright, "a", "b").faults.size(), 1u);
  const Comparison encoded_one = compare(of_each(reference, encoded), reference, options);
  EXPECT_EQ(highlight_sentence(encoded_one, "ours", "theirs"), "ours is theirs encoded as sRGB");
  const Image cut = of_each(reference, [](double value) { return std::min(value, 1.0); });
  EXPECT_THAT(highlight_sentence(compare(cut, reference, options)),
              HasSubstr("a is clipped at 1 where b goes up to "));
  EXPECT_THAT(compare(reference, reference, options).faults, IsEmpty());
}

}  // namespace
}  // namespace lobelia

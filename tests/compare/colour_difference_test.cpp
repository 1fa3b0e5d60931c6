#include "compare/metrics/ciede2000.hpp"

#include "compare/metrics/delta_e_itp.hpp"
#include "compare/metrics/pixel_differences.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

struct LabPair {
  Lab a, b;
  double difference;
};

// G. Sharma, W. Wu, E. N. Dalal, Color Research and Application 30 (2005), Table 1, all 34 pairs.
constexpr LabPair kSharma[] = {
    {{50.0000, 2.6772, -79.7751}, {50.0000, 0.0000, -82.7485}, 2.0425},
    {{50.0000, 3.1571, -77.2803}, {50.0000, 0.0000, -82.7485}, 2.8615},
    {{50.0000, 2.8361, -74.0200}, {50.0000, 0.0000, -82.7485}, 3.4412},
    {{50.0000, -1.3802, -84.2814}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, -1.1848, -84.8006}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, -0.9009, -85.5211}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, 0.0000, 0.0000}, {50.0000, -1.0000, 2.0000}, 2.3669},
    {{50.0000, -1.0000, 2.0000}, {50.0000, 0.0000, 0.0000}, 2.3669},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0009}, 7.1792},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0010}, 7.1792},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0011}, 7.2195},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0012}, 7.2195},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0009, -2.4900}, 4.8045},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0010, -2.4900}, 4.8045},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0011, -2.4900}, 4.7461},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 0.0000, -2.5000}, 4.3065},
    {{50.0000, 2.5000, 0.0000}, {73.0000, 25.0000, -18.0000}, 27.1492},
    {{50.0000, 2.5000, 0.0000}, {61.0000, -5.0000, 29.0000}, 22.8977},
    {{50.0000, 2.5000, 0.0000}, {56.0000, -27.0000, -3.0000}, 31.9030},
    {{50.0000, 2.5000, 0.0000}, {58.0000, 24.0000, 15.0000}, 19.4535},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.1736, 0.5854}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2972, 0.0000}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 1.8634, 0.5757}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2592, 0.3350}, 1.0000},
    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
    {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
    {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
    {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
    {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
    {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
    {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
    {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
    {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
};

TEST(Ciede2000, AgreesWithThe34PairsOfSharma) {
  ASSERT_EQ(std::size(kSharma), 34u);
  for (std::size_t i = 0; i < std::size(kSharma); ++i) {
    const LabPair& pair = kSharma[i];
    // Four digits are printed: half a unit of the last is the whole tolerance.
    EXPECT_NEAR(ciede2000(pair.a, pair.b), pair.difference, 0.5001e-4) << "pair " << i + 1;
    EXPECT_NEAR(ciede2000(pair.b, pair.a), pair.difference, 0.5001e-4) << "exchanged, " << i + 1;
  }
}

TEST(Ciede2000, TakesThePlainMeanOfOppositeHues) {
  // Opposite in decimal numbers; in binary the angles are a little more or less than 180 apart.
  for (int degrees = 1; degrees < 180; ++degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    const Lab a{50, 2.49 * std::cos(angle), 2.49 * std::sin(angle)};
    const Lab b{50, -2 * a.a, -2 * a.b};
    const double turn = 1e-7;  // clearly on this side of the tie
    const Lab less{50, -4.98 * std::cos(angle - turn), -4.98 * std::sin(angle - turn)};
    EXPECT_NEAR(ciede2000(a, b), ciede2000(b, a), 1e-12) << degrees;
    EXPECT_NEAR(ciede2000(a, b), ciede2000(a, less), 1e-5) << degrees;
  }
}

TEST(Ciede2000, PutsThePrimariesOfTheDisplayWhereTablesHaveThem) {
  // As colour calculators with the standard's four-digit matrix have them, e.g. easyrgb.com. Their
  // white has a fifth digit (0.95047, 1, 1.08883): 0.01 in b. A wrong white is off by units.
  const auto expect_near = [](Lab lab, double l, double a, double b) {
    EXPECT_NEAR(lab.l, l, 0.011);
    EXPECT_NEAR(lab.a, a, 0.011);
    EXPECT_NEAR(lab.b, b, 0.011);
  };
  expect_near(lab_from_display({1, 0, 0}), 53.2329, 80.1093, 67.2201);
  expect_near(lab_from_display({0, 1, 0}), 87.7370, -86.1846, 83.1812);
  expect_near(lab_from_display({0, 0, 1}), 32.3026, 79.1967, -107.8637);
}

TEST(Percentile, IsTheValueOfThatRankOfAnySortedFloats) {
  std::mt19937 random(1);
  for (const std::size_t count : {1u, 2u, 3u, 100u, 70000u})
    for (const bool any_bits : {false, true}) {
      std::vector<float> values(count);
      for (float& value : values) {
        // A few values many times, or every exponent and both signs.
        value = any_bits ? std::bit_cast<float>(std::uint32_t(random())) : float(random() % 5) - 2;
        if (!std::isfinite(value)) value = -0.0f;
      }
      std::vector<float> sorted = values;
      std::ranges::sort(sorted);
      for (const std::size_t rank : {std::size_t{0}, count / 3, count / 2, count - 1})
        EXPECT_EQ(nth_value(values, rank), sorted[rank]) << count << ", " << rank;
    }
}

/// The formula as it stands, by the functions of the standard library.
double plain_ciede2000(Rgb one, Rgb other) {
  constexpr double kDegree = std::numbers::pi / 180;
  const auto lab = [](Rgb c) {
    const auto f = [](double t) {
      return t > 216.0 / 24389 ? std::cbrt(t) : 841.0 / 108 * t + 4.0 / 29;
    };
    const double x = f((0.4124 * c.r + 0.3576 * c.g + 0.1805 * c.b) / 0.9505),
                 y = f(0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b),
                 z = f((0.0193 * c.r + 0.1192 * c.g + 0.9505 * c.b) / 1.0890);
    return Lab{116 * y - 16, 500 * (x - y), 200 * (y - z)};
  };
  const auto saturation = [](double chroma) {
    return std::sqrt(std::pow(chroma, 7) / (std::pow(chroma, 7) + std::pow(25.0, 7)));
  };
  const Lab p = lab(one), q = lab(other);
  const double g = 0.5 * (1 - saturation((std::hypot(p.a, p.b) + std::hypot(q.a, q.b)) / 2));
  const auto hue = [](double a, double b) {
    const double angle = std::atan2(b, a) / kDegree;
    return angle < 0 ? angle + 360 : angle;
  };
  const double c1 = std::hypot((1 + g) * p.a, p.b), c2 = std::hypot((1 + g) * q.a, q.b),
               h1 = hue((1 + g) * p.a, p.b), h2 = hue((1 + g) * q.a, q.b);
  double dh = h2 - h1, mean_h = (h1 + h2) / 2;
  if (std::abs(dh) > 180) {
    dh += dh > 0 ? -360 : 360;
    mean_h += mean_h < 180 ? 180 : -180;
  }
  const double l = (p.l + q.l) / 2 - 50, c = (c1 + c2) / 2;
  const double t =
      1 - 0.17 * std::cos((mean_h - 30) * kDegree) + 0.24 * std::cos(2 * mean_h * kDegree) +
      0.32 * std::cos((3 * mean_h + 6) * kDegree) - 0.20 * std::cos((4 * mean_h - 63) * kDegree);
  const double dl = (q.l - p.l) / (1 + 0.015 * l * l / std::sqrt(20 + l * l)),
               dc = (c2 - c1) / (1 + 0.045 * c),
               dhue = 2 * std::sqrt(c1 * c2) * std::sin(dh / 2 * kDegree) / (1 + 0.015 * c * t);
  const double rotation =
      -2 * saturation(c) * std::sin(60 * std::exp(-std::pow((mean_h - 275) / 25, 2)) * kDegree);
  return std::sqrt(dl * dl + dc * dc + dhue * dhue + rotation * dc * dhue);
}

TEST(Ciede2000, IsForEachPixelThePlainFormulaWithinItsBound) {
  const int width = 203, height = 97;
  const Image a = fixtures::noise(width, height, 1, 1.1f);
  Image far = fixtures::noise(width, height, 2, 1.1f), near = a, dark = a, dim = a;
  for (std::size_t i = 0; i < near.values().size(); ++i) {
    near.values()[i] *= i % 11 < 4 ? 1 + 1e-4f * far.values()[i] : 1;
    dark.values()[i] = 1e-4f * a.values()[i];
    dim.values()[i] = 0.02f * far.values()[i];
  }
  for (const auto& [one, other] : {std::pair(&a, &far), {&a, &near}, {&dark, &dim}, {&dim, &far}}) {
    const DisplayLight shown_a(*one, 0), shown_b(*other, 0);
    const PixelValues values = ciede2000_of_pixels(shown_a, shown_b);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double plain =
          plain_ciede2000(fixtures::shown_at(shown_a, i), fixtures::shown_at(shown_b, i));
      ASSERT_NEAR(values[i], plain, 1e-7 * plain + 1e-9) << i;
    }
  }
}

struct ItpPair {
  double ictcp_a[3], ictcp_b[3];
  double difference;
};

// From the tests of the package colour-science, function delta_E_ITP: I, Ct and Cp of the colours that
// are named beside them, and the differences, to ten digits.
constexpr ItpPair kPublished[] = {
    {{0.4885468072, -0.04739350675, 0.07475401302},  // dark skin
     {0.4899203231, -0.04567508203, 0.07361341775},
     1.426572247},
    {{0.7538438727, 0, -6.25e-16},  // white
     {0.7538912244, 0.001930922514, -0.0003599955951},
     0.7426668055},
    {{0.1596179061, 0, -1.21e-16},  // black
     {0.1603575152, 0.02881444889, -0.009908665843},
     12.60096264},
    {{0.5965650331, -0.2083210482, 0.3699729716},  // red
     {0.596263079, -0.1629742033, 0.3617767026},
     17.36012552},
    {{0.7055787513, -0.4063731514, -0.07278767382},  // green
     {0.7046946082, -0.3771037586, -0.07141626753},
     10.60227327},
    {{0.5180652611, 0.2932420978, -0.1873112695},  // blue
     {0.5167090868, 0.298191609, -0.1824609953},
     4.040270489},
    {{0.7223275939, -0.01290632441, -0.1139004748},  // cyan
     {0.7215329274, -0.007863821961, -0.1106683944},
     3.00633812},
    {{0.6401125212, 0.280225698, 0.1665590804},  // magenta
     {0.640473651, 0.2819981563, 0.1654050172},
     1.07944277},
    {{0.7413041405, -0.3638807621, 0.04959414794},  // yellow
     {0.7412815181, -0.3299076141, 0.04545287368},
     12.5885645},
};

TEST(DeltaEItp, AgreesWithPublishedPairs) {
  for (const ItpPair& pair : kPublished) {
    const auto itp = [](const double(&ictcp)[3]) { return Itp{ictcp[0], ictcp[1] / 2, ictcp[2]}; };
    // The colours are rounded to 1e-10, six numbers of them, times 720; measured: 3.6e-8.
    EXPECT_NEAR(delta_e_itp(itp(pair.ictcp_a), itp(pair.ictcp_b)), pair.difference, 1e-7);
  }
}

struct Shown {
  Rgb a, b;
  double difference;
};

// From light to difference: the formulas of BT.2087-0, BT.2100-2 and BT.2124-0 in Python's decimal
// module with 50 digits, the powers by Decimal's own **; 17 digits of the result.
constexpr Shown kByDecimals[] = {
    {{0, 0, 0}, {1, 1, 1}, 418.09546806170778},
    {{0.25, 0.25, 0.25}, {0.5, 0.5, 0.5}, 48.870419159761610},
    {{1, 0, 0}, {0, 1, 0}, 256.67222031390030},
    {{0, 0, 1}, {0, 0, 0}, 297.65864619844702},
    {{0.5, 0.25, 0.125}, {0.5, 0.25, 0.1328125}, 2.0675666925249892},
};

TEST(DeltaEItp, AgreesWithTheFormulasIn50Digits) {
  // A rounding of PQ's powers is 4e-15, times 720 and the weights of Ct and Cp; measured: 2e-11.
  for (const Shown& pair : kByDecimals)
    EXPECT_NEAR(delta_e_itp(itp_from_display(pair.a), itp_from_display(pair.b)), pair.difference,
                1e-10);
}

/// The formulas as they stand, by the functions of the standard library.
Itp plain_itp(Rgb c) {
  const double r = 203 * (0.6274 * c.r + 0.3293 * c.g + 0.0433 * c.b),
               g = 203 * (0.0691 * c.r + 0.9195 * c.g + 0.0114 * c.b),
               b = 203 * (0.0164 * c.r + 0.0880 * c.g + 0.8956 * c.b);
  const auto signal = [](double luminance) {
    const double y = std::pow(luminance / 10000, 2610.0 / 16384);
    return std::pow((3424.0 / 4096 + 2413.0 / 128 * y) / (1 + 2392.0 / 128 * y), 2523.0 / 32);
  };
  const double l = signal((1688 * r + 2146 * g + 262 * b) / 4096),
               m = signal((683 * r + 2951 * g + 462 * b) / 4096),
               s = signal((99 * r + 309 * g + 3688 * b) / 4096);
  return {(l + m) / 2, (6610 * l - 13613 * m + 7003 * s) / 8192,
          (17933 * l - 17390 * m - 543 * s) / 4096};
}

TEST(DeltaEItp, IsForEachPixelThePlainFormulasWithinItsBound) {
  const int width = 203, height = 97;
  const Image a = fixtures::noise(width, height, 1, 1.1f);
  Image b = fixtures::noise(width, height, 2, 1.1f);
  for (std::size_t i = 0; i < b.values().size(); ++i) {
    // From far to equal, and as dark as floats go.
    if (i % 7 < 3) b.values()[i] = a.values()[i] * (1 + 1e-4f * b.values()[i]);
    if (i % 31 < 9) b.values()[i] *= std::pow(10.0f, -float(i % 38));
  }
  std::copy_n(a.values().begin(), 3000, b.values().begin());
  const DisplayLight shown_a(a, 0), shown_b(b, 0);
  const PixelValues values = delta_e_itp_of_pixels(shown_a, shown_b);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Itp p = plain_itp(fixtures::shown_at(shown_a, i)),
              q = plain_itp(fixtures::shown_at(shown_b, i));
    const double plain = 720 * std::hypot(p.i - q.i, p.t - q.t, p.p - q.p);
    ASSERT_NEAR(values[i], plain, 1e-7 * plain + 1e-9) << i;
  }
}

}  // namespace
}  // namespace lobelia

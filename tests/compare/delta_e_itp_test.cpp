#include "compare/metrics/delta_e_itp.hpp"

#include "tests/compare/pictures.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

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

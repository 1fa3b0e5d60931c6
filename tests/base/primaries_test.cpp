// Primaries of files against OpenEXR's own matrices.
#include "base/pictures/picture_colour.hpp"
#include "base/words/constants.hpp"
#include "tests/test.hpp"

#include <ImathMatrix.h>
#include <ImfChromaticities.h>

namespace lobelia {
namespace {

constexpr Chromaticities kAces = {0.7347, 0.2653, 0, 1, 0.0001, -0.077, 0.32168, 0.33767};

Imf::Chromaticities of_openexr(const Chromaticities& c) {
  const auto point = [&](std::size_t i) {
    return Imath::V2f(float(c[2 * i]), float(c[2 * i + 1]));
  };
  return {point(0), point(1), point(2), point(3)};
}

/// The same by OpenEXR, in float and with rows and columns exchanged, as AcesInputFile has it.
RgbMatrix by_openexr(const Chromaticities& from) {
  const Imath::M44f bradford(0.895100f, -0.750200f, 0.038900f, 0, 0.266400f, 1.713500f, -0.068500f,
                             0, -0.161400f, 0.036700f, 1.029600f, 0, 0, 0, 0, 1);
  const auto cone = [&](double x, double y) {
    return Imath::V3f(float(x / y), 1, float((1 - x - y) / y)) * bradford;
  };
  const Imath::V3f seen = cone(from[6], from[7]), ours = cone(0.3127, 0.3290);
  Imath::M44f ratio;
  ratio.setScale(ours / seen);
  const Imath::M44f all = Imf::RGBtoXYZ(of_openexr(from), 1) * bradford * ratio *
                          bradford.inverse() * Imf::XYZtoRGB(of_openexr(kRec709Chromaticities), 1);
  RgbMatrix result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result[std::size_t(i)][std::size_t(j)] = double(all[j][i]);
  return result;
}

void expect_openexrs(const Chromaticities& from) {
  const RgbMatrix matrix = to_rec709(from).value(), theirs = by_openexr(from);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(matrix[i][j], theirs[i][j], 2e-5) << i << j;
    EXPECT_NEAR(matrix[i][0] + matrix[i][1] + matrix[i][2], 1, 1e-12) << "grey stays grey";
  }
}

TEST(RgbMatrices, AreThoseOfOpenExrAndLeaveGreyAsItIs) {
  for (const Chromaticities& from : {kAces, kRec709Chromaticities}) expect_openexrs(from);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.05, 0.05);
  for (int i = 0; i < 200; ++i) {
    Chromaticities from = kRec709Chromaticities;
    for (double& value : from) value += shift(random);
    expect_openexrs(from);
  }
}

TEST(RgbMatrices, UndoOpenExrsConversionToXyzWithoutAdaptation) {
  const Imath::M44f to_xyz = Imf::RGBtoXYZ(of_openexr(kRec709Chromaticities), 1);
  const RgbMatrix back = to_rec709(kXyzChromaticities).value();
  std::mt19937 random(5);
  std::uniform_real_distribution<float> value(0, 10);
  for (int i = 0; i < 200; ++i) {
    const Imath::V3f rgb(value(random), value(random), value(random)), xyz = rgb * to_xyz;
    for (int c = 0; c < 3; ++c) {
      const std::array<double, 3>& row = back[std::size_t(c)];
      EXPECT_NEAR(row[0] * double(xyz.x) + row[1] * double(xyz.y) + row[2] * double(xyz.z),
                  double(rgb[c]), 1e-4);
    }
  }
  Chromaticities adapted = kXyzChromaticities;  // channels that are 1 for D65
  adapted[6] = 0.3127;
  adapted[7] = 0.3290;
  expect_openexrs(adapted);
}

TEST(RgbMatrices, DoNotExistForImpossiblePrimaries) {
  EXPECT_FALSE(to_rec709({}));
  EXPECT_FALSE(to_rec709({0.1, 0.1, 0.2, 0.2, 0.3, 0.3, 0.2, 0.2})) << "a line";
  EXPECT_FALSE(to_rec709({0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.7, 0.1})) << "a white outside";
  EXPECT_FALSE(to_rec709({0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3, 0})) << "a black white";
  for (std::size_t i = 0; i < 8; ++i)
    for (const double value : {kNaN, kInfinity, -kInfinity, 1e30}) {
      Chromaticities from = kAces;
      from[i] = value;
      EXPECT_FALSE(to_rec709(from)) << i << " " << value;
    }
}

}  // namespace
}  // namespace lobelia

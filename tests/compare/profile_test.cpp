#include "compare/profile/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "core/error.hpp"

namespace lobelia {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// A flat patch of sky, seen from the middle: the angle of a pixel is its distance from the centre.
struct Patch {
  static constexpr int kSize = 201;
  static constexpr double kHalfAngle = 60 * kDegree;
  std::vector<double> angle, solid_angle;

  Patch() {
    const double step = 2 * kHalfAngle / kSize;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const double r = std::hypot(x - kSize / 2, y - kSize / 2) * step;
        angle.push_back(r < kHalfAngle ? r : std::numeric_limits<double>::quiet_NaN());
        solid_angle.push_back(step * step);
      }
  }
  Image image(const std::function<double(double)>& radiance) const {
    Image picture(kSize, kSize);
    for (std::size_t i = 0; i < angle.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        picture.values()[3 * i + c] = float(std::isnan(angle[i]) ? 99.0 : radiance(angle[i]));
    return picture;
  }
  ProfileGeometry geometry(double epicentre, double blooming) const {
    return {angle, solid_angle, epicentre * kDegree, blooming * kDegree};
  }
};

double gaussian(double angle, double half_width_degrees) {
  const double x = angle / (half_width_degrees * kDegree);
  return std::exp(-std::numbers::ln2 * x * x);
}

TEST(Profile, FindsPeakWidthAndEnergyOfAKnownHighlight) {
  const Patch patch;
  for (const double width : {5.0, 10.0, 15.0}) {
    const Image image = patch.image([&](double angle) { return 3 * gaussian(angle, width); });
    const double blooming = width * std::sqrt(std::log2(1000.0));
    const Profile profile =
        measure_profile(patch.geometry(width, blooming), {{"ours", &image}}, {});
    const HighlightShape& shape = profile.shapes.at(0);
    EXPECT_FLOAT_EQ(float(shape.peak), 3.0f);
    EXPECT_EQ(shape.peak_angle, 0);
    // Straight lines between bins a pixel (0.6 degrees) wide: a hundredth at the narrowest.
    EXPECT_NEAR(shape.half_width / kDegree, width, 0.01 * width);
    // The integral of 3 2^-(r/w)^2 over the plane; what lies past 60 degrees is below 2e-5 of it.
    const double w = width * kDegree;
    EXPECT_NEAR(shape.energy, 3 * std::numbers::pi * w * w / std::numbers::ln2,
                1e-4 * shape.energy);
  }
}

TEST(Profile, HalfWidthOfACosinePowerShrinksAsTheRootOfTheExponent) {
  const Patch patch;
  double before = 0;
  for (const double exponent : {16.0, 64.0}) {
    const Image image = patch.image([&](double a) { return std::pow(std::cos(a), exponent); });
    const double half = std::acos(std::pow(0.5, 1 / exponent));
    const Profile profile = measure_profile(
        {patch.angle, patch.solid_angle, half, std::acos(std::pow(1e-3, 1 / exponent))},
        {{"ours", &image}}, {});
    EXPECT_NEAR(profile.shapes.at(0).half_width, half, 0.01 * half);
    if (before > 0) {
      EXPECT_NEAR(before / profile.shapes[0].half_width, 2, 0.05);
    }
    before = profile.shapes[0].half_width;
  }
}

TEST(Profile, CurveIsTheRadianceAtItsAngles) {
  const Patch patch;
  const Image image = patch.image([](double angle) { return gaussian(angle, 10); });
  const Profile profile = measure_profile(patch.geometry(10, 31.5), {{"ours", &image}}, {});
  ASSERT_GE(profile.angle.size(), 40u);
  std::size_t pixels = 0;
  for (std::size_t bin = 0; bin < profile.angle.size(); ++bin) {
    EXPECT_GT(profile.pixels[bin], 0u);
    pixels += profile.pixels[bin];
    if (bin > 0) {
      EXPECT_GT(profile.angle[bin], profile.angle[bin - 1]);
    }
    // Half a bin (0.3 degrees) squared times the largest curvature, ln 4 / width^2, halved.
    EXPECT_NEAR(profile.radiance[0][bin], gaussian(profile.angle[bin], 10), 1e-3);
  }
  EXPECT_GT(pixels, 10000u);
  EXPECT_GT(profile.angle.back(), 31.5 * kDegree) << "the curve shows the end of the zone";
}

TEST(Profile, PutsAnErrorIntoItsZone) {
  const Patch patch;
  const auto exact = [](double angle) { return 2 * gaussian(angle, 10); };
  const Image reference = patch.image(exact);
  const Image inner = patch.image([&](double a) { return exact(a) + (a < 5 * kDegree ? 0.1 : 0); });
  const Image outer = patch.image(
      [&](double a) { return exact(a) + (a > 20 * kDegree && a < 25 * kDegree ? 0.02 : 0); });
  const Image far = patch.image([&](double a) { return exact(a) + (a > 40 * kDegree ? 1 : 0); });
  const Profile profile = measure_profile(
      patch.geometry(10, 31.5),
      {{"reference", &reference}, {"inner", &inner}, {"outer", &outer}, {"far", &far}},
      {{1, 0}, {2, 0}, {3, 0}, {0, 0}});
  const auto& [in, out, past, same] = std::tie(profile.differences[0], profile.differences[1],
                                               profile.differences[2], profile.differences[3]);
  EXPECT_EQ(in.a, "inner");
  EXPECT_EQ(in.b, "reference");
  EXPECT_NEAR(in.epicentre.max_abs, 0.1, 1e-6);
  EXPECT_NEAR(in.epicentre.max_rel_peak, 0.05, 1e-6);
  // A quarter of the disc's area is off.
  EXPECT_NEAR(in.epicentre.rms, 0.05, 0.002);
  EXPECT_EQ(in.blooming.max_abs, 0);
  EXPECT_EQ(out.epicentre.max_abs, 0);
  EXPECT_NEAR(out.blooming.max_abs, 0.02, 1e-6);
  EXPECT_EQ(past.epicentre.max_abs + past.blooming.max_abs, 0);
  EXPECT_EQ(same.epicentre.rms + same.blooming.rms, 0);
  EXPECT_GT(same.blooming.pixels, same.epicentre.pixels);
}

TEST(Profile, DoesNotHideANaN) {
  const Patch patch;
  const Image good = patch.image([](double angle) { return gaussian(angle, 10); });
  Image broken = good;
  broken.pixel(Patch::kSize / 2 + 3, Patch::kSize / 2)[1] = std::nanf("");
  const Profile profile =
      measure_profile(patch.geometry(10, 31.5), {{"good", &good}, {"broken", &broken}}, {{1, 0}});
  EXPECT_TRUE(std::isnan(profile.shapes[1].peak));
  EXPECT_TRUE(std::isnan(profile.shapes[1].energy));
  EXPECT_TRUE(std::isnan(profile.shapes[1].half_width));
  EXPECT_TRUE(std::isnan(profile.differences[0].epicentre.max_abs));
  EXPECT_EQ(profile.differences[0].blooming.max_abs, 0);
  const Json record = profile_record(profile, 0, 0, "reflection");
  EXPECT_EQ(record["images"]["broken"]["peak"], "nan");
}

TEST(Profile, OfASceneWithoutALitPixelIsEmptyAndSaysSo) {
  const std::vector<double> nowhere(4, std::numeric_limits<double>::quiet_NaN()), solid(4, 1.0);
  const Image image(2, 2);
  const Profile profile =
      measure_profile({nowhere, solid, 0.1, 0.2}, {{"a", &image}, {"b", &image}}, {{0, 1}});
  EXPECT_TRUE(profile.angle.empty());
  EXPECT_TRUE(std::isnan(profile.shapes[0].peak));
  EXPECT_EQ(profile.differences[0].epicentre.pixels, 0u);
  EXPECT_TRUE(std::isnan(profile.differences[0].epicentre.rms));
}

TEST(Profile, RefusesAPictureOfAnotherSize) {
  const Patch patch;
  const Image small(2, 2);
  try {
    measure_profile(patch.geometry(10, 30), {{"small", &small}}, {});
    FAIL() << "it was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kInput);
  }
}

TEST(ProfileRecord, HasWhatTheDocumentationPromises) {
  const Patch patch;
  const Image image = patch.image([](double angle) { return gaussian(angle, 10); });
  const Json record =
      profile_record(measure_profile(patch.geometry(10, 31.5),
                                     {{"analytic", &image}, {"lobelia", &image}}, {{1, 0}}),
                     1, 2, "half_vector");
  EXPECT_EQ(record["kind"], "profile");
  EXPECT_EQ(record["light"], 1);
  EXPECT_EQ(record["sphere"], 2);
  EXPECT_EQ(record["angle"], "half_vector");
  EXPECT_EQ(record["zones"]["epicentreDegrees"][0], 0.0);
  EXPECT_NEAR(record["zones"]["epicentreDegrees"][1].get<double>(), 10, 1e-9);
  EXPECT_NEAR(record["zones"]["bloomingDegrees"][1].get<double>(), 31.5, 1e-9);
  const std::size_t bins = record["curve"]["angleDegrees"].size();
  for (const char* column : {"pixels", "analytic", "lobelia"})
    EXPECT_EQ(record["curve"][column].size(), bins) << column;
  for (const char* key : {"peak", "peakAngleDegrees", "halfWidthDegrees", "energy"})
    EXPECT_TRUE(record["images"]["lobelia"][key].is_number()) << key;
  for (const char* zone : {"epicentre", "blooming"})
    for (const char* key : {"maxAbs", "rms", "maxRelPeak"})
      EXPECT_EQ(record["differences"]["lobelia-analytic"][zone][key], 0.0) << zone << ' ' << key;
}

}  // namespace
}  // namespace lobelia

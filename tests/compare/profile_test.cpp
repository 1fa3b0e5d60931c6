#include "profile/profile.hpp"

#include "tests/json.hpp"
#include "tests/test.hpp"

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
  ProfileGeometry geometry(double epicentre, double flank, double blooming) const {
    return {angle, solid_angle, {epicentre * kDegree, flank * kDegree, blooming * kDegree}};
  }
};

double gaussian_of_width(double angle, double half_width_degrees) {
  const double x = angle / (half_width_degrees * kDegree);
  return std::exp(-std::numbers::ln2 * x * x);
}

TEST(Profile, FindsPeakWidthAndEnergyOfAKnownHighlight) {
  const Patch patch;
  for (const double width : {5.0, 10.0, 15.0}) {
    const Image image =
        patch.image([&](double angle) { return 3 * gaussian_of_width(angle, width); });
    const double blooming = width * std::sqrt(std::log2(1000.0));
    const Profile profile =
        measure_profile(patch.geometry(width, blooming / 2, blooming), {{"ours", &image}}, {});
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

TEST(Profile, CurveIsTheRadianceAtItsAngles) {
  const Patch patch;
  const Image image = patch.image([](double angle) { return gaussian_of_width(angle, 10); });
  const Profile profile = measure_profile(patch.geometry(10, 18, 31.5), {{"ours", &image}}, {});
  ASSERT_GE(profile.angle.size(), 40u);
  std::size_t pixels = 0;
  for (std::size_t bin = 0; bin < profile.angle.size(); ++bin) {
    EXPECT_GT(profile.pixels[bin], 0u);
    pixels += profile.pixels[bin];
    if (bin > 0) {
      EXPECT_GT(profile.angle[bin], profile.angle[bin - 1]);
    }
    // Half a bin (0.3 degrees) squared times the largest curvature, ln 4 / width^2, halved.
    EXPECT_NEAR(profile.radiance[0][bin], gaussian_of_width(profile.angle[bin], 10), 1e-3);
  }
  EXPECT_GT(pixels, 10000u);
  EXPECT_GT(profile.angle.back(), 31.5 * kDegree) << "the curve shows the end of the zone";
}

TEST(Profile, PutsAnErrorIntoItsZone) {
  const Patch patch;
  const auto exact = [](double angle) { return 2 * gaussian_of_width(angle, 10); };
  const Image reference = patch.image(exact);
  const Image inner = patch.image([&](double a) { return exact(a) + (a < 5 * kDegree ? 0.1 : 0); });
  const Image outer = patch.image(
      [&](double a) { return exact(a) + (a > 20 * kDegree && a < 25 * kDegree ? 0.02 : 0); });
  const Image far = patch.image([&](double a) { return exact(a) + (a > 40 * kDegree ? 1 : 0); });
  const Profile profile = measure_profile(
      patch.geometry(10, 18, 31.5),
      {{"reference", &reference}, {"inner", &inner}, {"outer", &outer}, {"far", &far}},
      {{1, 0}, {2, 0}, {3, 0}, {0, 0}});
  const auto& [in, out, past, same] = std::tie(profile.differences[0], profile.differences[1],
                                               profile.differences[2], profile.differences[3]);
  EXPECT_EQ(in.a, "inner");
  EXPECT_EQ(in.b, "reference");
  EXPECT_NEAR(in.zones[0].max_abs, 0.1, 1e-6);
  EXPECT_NEAR(in.zones[0].max_rel_peak, 0.05, 1e-6);
  // A quarter of the disc's area is off.
  EXPECT_NEAR(in.zones[0].rms, 0.05, 0.002);
  EXPECT_EQ(in.zones[2].max_abs, 0);
  EXPECT_EQ(out.zones[0].max_abs, 0);
  EXPECT_NEAR(out.zones[2].max_abs, 0.02, 1e-6);
  EXPECT_EQ(past.zones[0].max_abs + past.zones[2].max_abs, 0);
  EXPECT_EQ(same.zones[0].rms + same.zones[2].rms, 0);
  EXPECT_GT(same.zones[2].pixels, same.zones[0].pixels);
}

TEST(Profile, DoesNotHideANaN) {
  const Patch patch;
  const Image good = patch.image([](double angle) { return gaussian_of_width(angle, 10); });
  Image broken = good;
  broken.pixel(Patch::kSize / 2 + 3, Patch::kSize / 2)[1] = std::nanf("");
  const Profile profile = measure_profile(patch.geometry(10, 18, 31.5),
                                          {{"good", &good}, {"broken", &broken}}, {{1, 0}});
  EXPECT_TRUE(std::isnan(profile.shapes[1].peak));
  EXPECT_TRUE(std::isnan(profile.shapes[1].energy));
  EXPECT_TRUE(std::isnan(profile.shapes[1].half_width));
  EXPECT_TRUE(std::isnan(profile.differences[0].zones[0].max_abs));
  EXPECT_EQ(profile.differences[0].zones[2].max_abs, 0);
  const Json record = as_json(profile_record(profile, 0, 0, "reflection"));
  EXPECT_EQ(record["images"]["broken"]["peak"], "nan");
}

/// A patch with all that figures of the highlight need: flat, unit scale, over a base.
struct FullPatch : Patch {
  static constexpr double kBase = 0.5;
  std::vector<double> scale = std::vector(angle.size(), 1.0),
                      base = std::vector(angle.size(), kBase);

  ProfileGeometry full(double epicentre, double flank, double blooming) const {
    ProfileGeometry geometry = Patch::geometry(epicentre, flank, blooming);
    geometry.width = kSize;
    geometry.scale = scale;
    geometry.base = base;
    geometry.incidence = FilmPoint{0.6, 0.8};
    return geometry;
  }
};

TEST(HighlightFigures, ExplainMissingMeasurements) {
  const FullPatch patch;
  const auto of = [&](const Image& image, double end) {
    return measure_profile(patch.full(end / 3, end / 2, end), {{"a", &image}}, {}).figures.at(0);
  };
  const Image black(Patch::kSize, Patch::kSize);
  EXPECT_EQ(of(black, 30).why_not, "it is black") << "below the base is no light either";
  const Image narrow =
      patch.image([&](double angle) { return FullPatch::kBase + gaussian_of_width(angle, 0.7); });
  Image broken = narrow;
  broken.pixel(Patch::kSize / 2 + 3, Patch::kSize / 2)[1] = std::nanf("");
  EXPECT_EQ(of(broken, 3).why_not, "1 of its pixels are not finite");
  EXPECT_TRUE(std::isnan(of(broken, 3).centroid.x) && std::isnan(of(broken, 3).energy));
}

}  // namespace
}  // namespace lobelia

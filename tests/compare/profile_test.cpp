#include "profile/profile.hpp"

#include "base/words/constants.hpp"
#include "base/words/vec.hpp"
#include "profile/lobe_fit.hpp"
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

constexpr double kCoefficient = 2.5;

double cosine_lobe(double angle, double n) {
  return std::exp(n * std::log1p(-2 * std::pow(std::sin(angle / 2), 2)));
}

/// Pixels of a plane of angles around a middle that lies on none of them, down to 1/1000 of the lobe; about
/// `across` of them over the half-width. The scale falls to one side as a cosine of incidence does.
std::vector<LobeSample> lobe(double n, double across,
                             const std::function<double(double angle)>& value) {
  const double half = std::acos(std::pow(0.5, 1 / n)), end = std::acos(std::pow(1e-3, 1 / n));
  const double step = half / across;
  const int reach = int(end / step) + 1;
  std::vector<LobeSample> samples;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      const double dx = (x + 0.137) * step, dy = (y - 0.291) * step, angle = std::hypot(dx, dy);
      if (angle >= end) continue;
      const double scale = 0.7 + 0.2 * dx / end;
      samples.push_back({angle, scale, scale * kCoefficient * value(angle)});
    }
  return samples;
}

std::vector<LobeSample> cosine(double n, double across) {
  return lobe(n, across, [n](double angle) { return cosine_lobe(angle, n); });
}

TEST(CosineFit, RecoversTheExponentWithinItsErrorFromFloats) {
  for (const double n : {8.0, 16.0, 128.0, 1024.0, 8192.0, 65536.0, 1e7})
    for (const double across : {2.0, 8.0, 30.0}) {
      std::vector<LobeSample> samples = cosine(n, across);
      for (LobeSample& sample : samples) sample.radiance = double(float(sample.radiance));
      const LobeFit fit = fit_cosine_lobe(samples);
      ASSERT_EQ(fit.why_not, "") << n;
      EXPECT_NEAR(fit.width, n, 4 * fit.standard_error) << n << ' ' << across;
      EXPECT_LT(fit.standard_error, 1e-7 * n) << n << ' ' << across;
      EXPECT_GT(fit.standard_error, 0);
      EXPECT_NEAR(fit.coefficient, kCoefficient, 1e-6);
      EXPECT_EQ(fit.pixels, samples.size());
    }
}

TEST(CosineFit, SaysHowFarAnotherLobeIsFromItsCosine) {
  const auto cs16 = [](double angle) {
    const double s = 2 * std::pow(std::sin(angle / 2), 2);
    return std::pow(std::max(0.0, 1 - 256 * s / 16), 16);
  };
  const LobeFit fit = fit_cosine_lobe(lobe(256, 8, cs16));
  ASSERT_EQ(fit.why_not, "");
  // Narrower than cos^n, as it is 0 from a finite angle on.
  EXPECT_GT(fit.width, 258);
  EXPECT_LT(fit.width, 290);
  EXPECT_GT(fit.residual, 1e-3);
  EXPECT_LT(fit.residual, 1.7e-2) << "the paper's bound of the whole difference";
  EXPECT_GT(std::abs(fit.width - 256), 10 * fit.standard_error);
}

TEST(CosineFit, SaysWhyThereIsNone) {
  const std::vector<LobeSample> good = cosine(64, 6);
  const auto why = [](std::vector<LobeSample> samples) {
    const LobeFit fit = fit_cosine_lobe(samples);
    EXPECT_TRUE(std::isnan(fit.width) && std::isnan(fit.standard_error)) << fit.why_not;
    return fit.why_not;
  };
  const auto changed = [&](auto change) {
    std::vector<LobeSample> samples = good;
    for (LobeSample& sample : samples) change(sample);
    return samples;
  };
  EXPECT_EQ(why({}), "it has 0 pixels, too few: 9 are needed");
  EXPECT_EQ(why({good.begin(), good.begin() + 8}), "it has 8 pixels, too few: 9 are needed");
  EXPECT_EQ(why(changed([](LobeSample& s) { s.radiance = 0; })), "it holds no light");
  EXPECT_EQ(why(changed([](LobeSample& s) { s.radiance = -1; })), "it holds no light");
  EXPECT_EQ(why(changed([](LobeSample& s) { s.scale = 0; })), "it holds no light");
  EXPECT_EQ(why(cosine(64, 1)),
            "not resolved: 3 of its pixels are above half of its peak, 9 are needed");
  // Darkest in the middle.
  EXPECT_EQ(why(changed([](LobeSample& s) { s.radiance = s.scale * (0.1 + s.angle); })),
            "no power of a cosine fits it better than its neighbours do");
  std::vector<LobeSample> broken = good;
  broken[7].radiance = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(why(broken), "a pixel of it is not finite");
  broken[7].radiance = std::numeric_limits<double>::infinity();
  EXPECT_EQ(why(broken), "a pixel of it is not finite");
}

TEST(CosineFit, TakesAnglesUpToTheHorizonAndBeyond) {
  std::vector<LobeSample> samples = cosine(1, 12);
  samples.push_back({std::numbers::pi / 2, 1, 0});
  samples.push_back({std::numbers::pi, 1, 0});
  EXPECT_NEAR(fit_cosine_lobe(samples).width, 1, 1e-9);
}

// Which family of lobes a highlight belongs to, when camera and light are known.

/// The pixels of a unit sphere seen from far along z, lit from 40 degrees to the right. `value` has normal, eye and light.
template <class Value>
std::vector<SeenLobe> sphere(Value value) {
  constexpr int kSide = 161;
  const Vec3 eye{0, 0, 1}, light = normalize({std::sin(0.7), 0, std::cos(0.7)});
  const Vec3 half = normalize(eye + light);
  std::vector<SeenLobe> pixels;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const double x = (i - 80 + 0.3) / 82, y = (j - 80 - 0.2) / 82, z2 = 1 - x * x - y * y;
      if (!(z2 > 0)) continue;
      const Vec3 normal{x, y, std::sqrt(z2)};
      const double n_dot_l = dot(normal, light), n_dot_v = dot(normal, eye);
      if (!(n_dot_l > 0)) continue;
      const Vec3 mirror = 2 * n_dot_v * normal - eye;
      const double to_half = std::acos(std::min(1.0, dot(normal, half)));
      if (to_half > 0.5) continue;
      pixels.push_back({std::acos(std::clamp(dot(mirror, light), -1.0, 1.0)), to_half, n_dot_l,
                        n_dot_v, 2.5, 2.5 * value(normal, eye, light, half), kNaN});
    }
  return pixels;
}

/// Trowbridge and Reitz's distribution with Smith's masking as Heitz 2014, "Understanding the Masking-Shadowing Function",
/// writes it: by the length of the ellipsoid's projection. Written apart from the fit.
double ggx(Vec3 normal, Vec3 eye, Vec3 light, Vec3 half, double alpha) {
  const double h = dot(normal, half), v = dot(normal, eye), l = dot(normal, light);
  const double d = alpha * alpha / (kPi * std::pow(h * h * (alpha * alpha - 1) + 1, 2));
  const auto masking = [&](double cosine) {
    return 2 * cosine / (cosine + std::sqrt(alpha * alpha + (1 - alpha * alpha) * cosine * cosine));
  };
  return d * masking(v) * masking(l) / (4 * v);
}

std::vector<SeenLobe> blinn_phong(double n) {
  return sphere([n](Vec3 normal, Vec3, Vec3, Vec3 half) { return std::pow(dot(normal, half), n); });
}
std::vector<SeenLobe> phong(double n) {
  return sphere([n](Vec3 normal, Vec3 eye, Vec3 light, Vec3) {
    return std::pow(std::max(0.0, dot(2 * dot(normal, eye) * normal - eye, light)), n);
  });
}

TEST(LobeFamilies, NameTheLobeThatMadeTheHighlight) {
  for (const double n : {30.0, 121.0, 400.0}) {
    const auto of_phong = explain_highlight(phong(n), false);
    EXPECT_EQ(of_phong[0].family, FittedFamily::kPhong) << n;
    EXPECT_NEAR(of_phong[0].fit.width, n, 1e-6 * n);
    EXPECT_FALSE(of_phong[0].times_n_dot_l);
    EXPECT_LT(of_phong[0].fit.residual, 1e-9);
    const auto of_blinn = explain_highlight(blinn_phong(n), false);
    EXPECT_EQ(of_blinn[0].family, FittedFamily::kBlinnPhong) << n;
    EXPECT_NEAR(of_blinn[0].fit.width, n, 1e-6 * n);
    for (const auto& found : {of_phong, of_blinn})
      for (std::size_t k = 1; k < found.size(); ++k)
        EXPECT_GT(found[k].apart, kToldApart) << n << ' ' << k;
  }
}

TEST(LobeFamilies, FindTheRoughnessOfMicrofacets) {
  for (const double alpha : {0.06, 0.128, 0.35}) {
    const auto found =
        explain_highlight(sphere([alpha](Vec3 normal, Vec3 eye, Vec3 light, Vec3 half) {
                            return ggx(normal, eye, light, half, alpha);
                          }),
                          false);
    EXPECT_EQ(found[0].family, FittedFamily::kGgx);
    EXPECT_NEAR(found[0].fit.width, alpha, 1e-6 * alpha);
    // D at its middle over 4, with the coefficient's cosines taken out.
    EXPECT_NEAR(found[0].fit.coefficient, 1 / (4 * kPi * alpha * alpha), 1e-4 / (alpha * alpha));
    EXPECT_GT(found[1].apart, kToldApart);
    const auto beckmann = explain_highlight(
        sphere([alpha](Vec3 normal, Vec3 eye, Vec3 light, Vec3 half) {
          const double cosine = dot(normal, half), v = dot(normal, eye);
          const double tangent2 = 1 / (cosine * cosine) - 1;
          // Smith's masking by the error function; the fit has a rational approximation.
          const auto masking = [&](double c) {
            const double a = c / (alpha * std::sqrt(1 - c * c));
            return 2 / (1 + std::erf(a) + std::exp(-a * a) / (a * std::sqrt(kPi)));
          };
          return std::exp(-tangent2 / (alpha * alpha)) / std::pow(cosine, 4) * masking(v) *
                 masking(dot(normal, light)) / (4 * v);
        }),
        false);
    EXPECT_EQ(beckmann[0].family, FittedFamily::kBeckmann) << alpha;
    EXPECT_NEAR(beckmann[0].fit.width, alpha, 2e-3 * alpha);
  }
}

/// The same pixels with noise of that share of the peak.
std::vector<SeenLobe> noisy(std::vector<SeenLobe> pixels, double share, bool known,
                            std::mt19937& random) {
  double peak = 0;
  for (const SeenLobe& pixel : pixels) peak = std::max(peak, pixel.radiance);
  std::normal_distribution<double> normal;
  for (SeenLobe& pixel : pixels) {
    pixel.radiance += share * peak * normal(random);
    if (known) pixel.error = share * peak;
  }
  return pixels;
}

TEST(LobeFamilies, CannotBeToldApartInNoise) {
  // A Beckmann distribution and a power of the half vector's cosine are nearly the same.
  std::mt19937 random(11);
  const auto found = explain_highlight(noisy(blinn_phong(500), 0.2, true, random), false);
  EXPECT_EQ(found[0].apart, 0);
  EXPECT_LT(found[1].apart, kToldApart);
  const auto family = [&](FittedFamily name) {
    return std::ranges::find(found, name, &FamilyFit::family)->apart;
  };
  EXPECT_LT(family(FittedFamily::kBlinnPhong), kToldApart);
  EXPECT_LT(family(FittedFamily::kBeckmann), kToldApart);
  EXPECT_GT(family(FittedFamily::kGgx), kToldApart) << "its tail is another";
}

TEST(LobeFamilies, HaveTheWorseErrorWithSharedNoise) {
  std::mt19937 random(3);
  const std::vector<SeenLobe> pixels = noisy(blinn_phong(121), 0.02, true, random);
  EXPECT_GT(explain_highlight(pixels, true)[0].fit.standard_error,
            2 * explain_highlight(pixels, false)[0].fit.standard_error);
}

}  // namespace
}  // namespace lobelia

// The two options of a material: Schlick's Fresnel factor, and the diffuse base.
#include "renderer/fresnel.hpp"

#include "renderer/reflector.hpp"
#include "tests/renderer/laws/directions.hpp"

namespace lobelia {
namespace {

constexpr Rgb kReflectance{0.04, 0.3, 0.9}, kDiffuse{0.1, 0.2, 0.3};

/// Each component: a <= b.
bool at_most(Rgb a, Rgb b) { return a.r <= b.r && a.g <= b.g && a.b <= b.b; }

void expect_near(Rgb a, Rgb b, double allowed, const std::string& what) {
  EXPECT_NEAR(a.r, b.r, allowed) << what;
  EXPECT_NEAR(a.g, b.g, allowed) << what;
  EXPECT_NEAR(a.b, b.b, allowed) << what;
}

TEST(SchlicksFactor, GrowsFromTheReflectanceToOneAtGrazing) {
  const auto factor = [](double degrees) {  // of light and eye, each so far from the half vector
    const double a = radians(degrees);
    return fresnel_factor(Fresnel::kSchlick, kReflectance, {std::sin(a), 0, std::cos(a)},
                          {-std::sin(a), 0, std::cos(a)});
  };
  EXPECT_EQ(factor(0), kReflectance);
  expect_near(factor(90), {1, 1, 1}, 1e-15, "grazing");
  for (int degree = 0; degree < 90; ++degree) {
    EXPECT_TRUE(at_most(factor(degree), factor(degree + 1))) << degree;
    EXPECT_TRUE(at_most(kReflectance, factor(degree)) && at_most(factor(degree), {1, 1, 1}));
  }
  // Schlick's (1 - cos)^5 at 60 degrees is 1/32.
  expect_near(factor(60), 31.0 / 32 * kReflectance + 1.0 / 32 * Rgb{1, 1, 1}, 1e-15, "60");
}

TEST(FresnelAndDiffuseBase, AreRightForEveryModel) {
  const Frame frame;
  for (const Highlight& h : highlights(every_model(), std::vector{1.0, 16.0, 1024.0})) {
    const Reflector white({"", h, {1, 1, 1}, {}});
    for (const Fresnel fresnel : {Fresnel::kNone, Fresnel::kSchlick}) {
      const Reflector reflector({"", h, kReflectance, kDiffuse, fresnel});
      for (const Pair& p : direction_pairs(frame, h.exponent)) {
        const double highlight = white.eval(frame.normal, p.to_eye, p.to_light).r;
        const Rgb factor = fresnel_factor(fresnel, kReflectance, p.to_eye, p.to_light);
        expect_near(reflector.eval(frame.normal, p.to_eye, p.to_light),
                    highlight * factor + dot(frame.normal, p.to_light) / kPi * kDiffuse,
                    1e-12 * highlight + 1e-15, text(h));
      }
    }
  }
}

}  // namespace
}  // namespace lobelia

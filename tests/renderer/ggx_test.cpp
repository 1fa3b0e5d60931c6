// The laws of GGX: its shadowing is the textbook's, light is not directed one way, and none of it loses digits.
#include <fmt/format.h>
#include <boost/math/constants/constants.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "renderer/fresnel.hpp"
#include "renderer/ggx.hpp"
#include "renderer/reflector.hpp"
#include "renderer/scene/scene_io.hpp"
#include "tests/renderer/laws/directions.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using Big = boost::multiprecision::cpp_bin_float_50;

/// The formula as Walter et al. print it, by the cosine.
template <class Real>
Real textbook_distribution(Real alpha, Real cosine) {
  const Real bracket = cosine * cosine * (alpha * alpha - 1) + 1;
  return alpha * alpha / (boost::math::constants::pi<Real>() * bracket * bracket);
}

/// The formula as Heitz prints it.
Big textbook_visibility(Big alpha, Big n_dot_l, Big n_dot_v) {
  const auto lambda = [&](Big cosine) -> Big {
    return (sqrt(1 + alpha * alpha * (1 / (cosine * cosine) - 1)) - 1) / 2;
  };
  return 1 / ((1 + lambda(n_dot_l) + lambda(n_dot_v)) * 4 * n_dot_l * n_dot_v);
}

/// The largest relative error over alphas from 1e-4 to 1 and s from 1e-12 to 1.
template <class Real, class Function>
double largest_error(Function distribution) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform;
  double largest = 0;
  for (int i = 0; i < 20000; ++i) {
    const Real alpha = Real(std::pow(10, -4 * uniform(random))),
               s = Real(std::pow(10, -12 * uniform(random)));
    const Big truth = textbook_distribution<Big>(alpha, 1 - Big(s));
    largest = std::max(largest, std::abs(double((Big(distribution(alpha, s)) - truth) / truth)));
  }
  return largest;
}

TEST(GgxDistribution, LosesNoDigitsWhereTheTextbookFormulaLosesAll) {
  // Measured: 3.8 times epsilon, of both.
  EXPECT_LT(largest_error<double>(ggx_distribution<double>),
            6 * std::numeric_limits<double>::epsilon());
  EXPECT_LT(largest_error<float>(ggx_distribution<float>),
            6 * std::numeric_limits<float>::epsilon());
  EXPECT_GT(largest_error<float>(
                [](float alpha, float s) { return textbook_distribution<float>(alpha, 1 - s); }),
            0.99);
}

TEST(GgxMaterial, IsTheTextbookFormulaByItsRoughness) {
  std::mt19937_64 random(14);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 200; ++i) {
    const double roughness = std::pow(10, -1.9 * uniform(random));
    const Scene scene = parse_scene(
        fmt::format("<scene version=\"1\"><sensor type=\"perspective\"><float name=\"fov\" "
                    "value=\"28\"/><transform name=\"to_world\"><lookat origin=\"0,0,5\" "
                    "target=\"0,0,0\" up=\"0,1,0\"/></transform></sensor><bsdf id=\"m\" "
                    "type=\"ggx\"><float name=\"{}\" value=\"{}\"/></bsdf></scene>",
                    i % 2 ? "alpha" : "roughness", i % 2 ? roughness * roughness : roughness),
        "ggx", "");
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.fresnel, Fresnel::kSchlick);
    const Vec3 n{0, 0, 1},
        l = normalize({uniform(random), 0.3, 0.05 + uniform(random)}),
        v = normalize({-uniform(random), uniform(random), 0.05 + uniform(random)});
    const Vec3 h = normalize(l + v);
    const Big alpha = Big(roughness) * roughness;
    const Big truth =
        textbook_distribution<Big>(alpha, dot(n, h)) * textbook_visibility(alpha, l.z, v.z) * l.z;
    const double ours = highlight_radiance(material.highlight, l.z, v.z, dot(n - h, n - h) / 2);
    // An exponent of 0 is not reached where alpha is 1.
    EXPECT_NEAR(double(ours / truth), 1, roughness > 0.95 ? 1e-3 : 1e-9) << roughness;
  }
}

TEST(GgxVisibility, IsTheTextbookFormulaAndTheSameBothWays) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 20000; ++i) {
    const double alpha = std::pow(10, -4 * uniform(random)),
                 n_dot_l = std::pow(10, -6 * uniform(random)),
                 n_dot_v = std::pow(10, -6 * uniform(random));
    const double ours = ggx_visibility(alpha, n_dot_l, n_dot_v);
    EXPECT_EQ(ours, ggx_visibility(alpha, n_dot_v, n_dot_l));
    const Big truth = textbook_visibility(alpha, n_dot_l, n_dot_v);
    EXPECT_LT(std::abs(double((Big(ours) - truth) / truth)), 1e-15) << alpha << " " << n_dot_l;
  }
}

// The two options of a material: Schlick's Fresnel factor, and the diffuse base.

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

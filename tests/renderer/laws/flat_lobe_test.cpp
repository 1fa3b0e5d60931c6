// Exponent 0: every lobe is flat, and every figure that has a closed form in n is its limit.
#include "renderer/models/model.hpp"
#include "tests/renderer/laws/cases.hpp"
#include "tests/renderer/simple_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

TEST(FlatLobe, IsOneInsideOfTheRightAngleAloneForEveryLobe) {
  for (const LobeId& lobe : lobes())
    for (const double n : {0.0, 1e-6, 1e-3})
      for (const double s : {0.0, 1e-300, 0.1, 0.5, 0.999, 1 - 0x1p-53, 1.0, 1.5, 2.0}) {
        // No lobe falls faster than (1 - s)^(2 n), and 1 - s is 2^-53 at least.
        const double value = lobe_value(lobe, s, n);
        EXPECT_EQ(value > 0, s < 1) << info(lobe).name << " " << s;
        if (s < 1 && family(lobe) != "schlick") {
          EXPECT_NEAR(value, 1, 75 * n) << info(lobe).name << " " << s;
        }
      }
}

TEST(FlatLobe, HasTheCoefficientsOfAConstant) {
  // The integrals of 1 over the hemisphere, with and without a cosine; a quarter of it for a distribution of normals.
  const std::map<std::string_view, double> of_a_constant{
      {"phong_rdf", 0.5 / kPi},         {"modified_phong", 1 / kPi},
      {"blinn_phong_rdf", 0.5 / kPi},   {"modified_blinn_phong", 1 / kPi},
      {"blinn_phong_ndf", 0.125 / kPi}, {"blinn_phong_heightfield", 0.25 / kPi},
      {"microfacet_smith", 0.25 / kPi}};
  for (const ModelId model : every_model())
    for (const LobeId& lobe : lobes()) {
      const auto coefficient = [&](double n) {
        return radiance_coefficient({model, lobe, Normalisation::kExact, n});
      };
      const double flat = of_a_constant.at(info(model).name);
      EXPECT_NEAR(coefficient(0) / flat, 1, 1e-14) << info(model).name << info(lobe).name;
      double before = 0;
      // Schlick's lobe falls last, by n ln(1/n) of its area.
      for (const double n : {1e-9, 1e-6, 1e-3}) {
        EXPECT_NEAR(coefficient(n) / flat, 1, n * (10 + std::log(1 / n)))
            << info(model).name << info(lobe).name << n;
        EXPECT_GT(coefficient(n), before) << info(model).name << info(lobe).name << n;
        before = coefficient(n);
      }
    }
}

TEST(FlatLobe, IsSampledEvenly) {
  for (const LobeId& lobe : lobes()) {
    const PreparedLobe flat = prepare(lobe, 0);
    // Gauss draws an angle as if it were a radius.
    const bool is_even = family(lobe) != "gauss";
    for (const double xi : {0.0, 1e-9, 0.25, 0.5, 1 - 0x1p-53}) {
      const double s = flat.sample(xi);
      EXPECT_TRUE(s >= 0 && s <= 1 && flat.density(s) >= 0) << info(lobe).name << " " << xi;
      if (!is_even) continue;
      EXPECT_NEAR(s, xi, 1e-12) << info(lobe).name;
      if (s < 1) {
        EXPECT_NEAR(flat.density(s), 1, 1e-12) << info(lobe).name << " " << xi;
      }
    }
    // The steps of the samples are the reciprocal of the density.
    const double step = 1e-6,
                 slope = (flat.sample(0.5 + step) - flat.sample(0.5 - step)) / (2 * step);
    EXPECT_NEAR(slope * flat.density(flat.sample(0.5)), 1, 1e-6) << info(lobe).name;
  }
}

TEST(FlatLobe, ShowsItsCoefficientOnASphere) {
  for (const LobeId& lobe : lobes())
    for (const Precision precision :
         {Precision::kFloat32, Precision::kMixed, Precision::kFloat64}) {
      Material material = shiny(0);
      material.highlight.lobe = lobe;
      material.diffuse_reflectance = {};
      Scene scene = one_sphere(material);
      scene.camera.fov_degrees = 20;
      scene.film = {32, 32};
      const Vec3 to_light = normalize(Vec3{1, 0.5, 0.7});
      scene.lights = {DirectionalLight{-to_light, {1, 1, 1}}};
      RenderOptions options;
      options.precision = precision;
      const Image image = render(scene, options).image;
      int lit = 0;
      for (const float value : image.values()) {
        if (value == 0) continue;
        ++lit;
        EXPECT_NEAR(value, 0.5 * 0.5 / kPi, 1e-7) << info(lobe).name << " " << name(precision);
      }
      EXPECT_GT(lit, 300) << info(lobe).name;
      EXPECT_LT(lit, 3 * 32 * 32) << info(lobe).name;
    }
}

}  // namespace
}  // namespace lobelia

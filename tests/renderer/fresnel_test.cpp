// The two options of a material: Schlick's Fresnel factor, and the diffuse base; in the reflector, and with
// every model and lobe in the picture.
#include "renderer/fresnel.hpp"

#include "renderer/pixel_ray.hpp"
#include "renderer/reflector.hpp"
#include "renderer/render.hpp"
#include "tests/canonical_scene.hpp"
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

TEST(SchlicksFactor, IsTheReflectanceHeadOnAndOneAtGrazingAndGrowsInBetween) {
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

TEST(AMirrorsSchlickFactor, IsThatOfAHighlightFromTwoPerCentOnAndVanishesWithoutAStepBelow) {
  for (const double degrees : {0.0, 30.0, 60.0, 80.0, 89.0, 90.0}) {
    const double a = radians(degrees);
    const Vec3 to_eye{std::sin(a), 0, std::cos(a)}, mirrored{-std::sin(a), 0, std::cos(a)};
    const auto factor = [&](Rgb r) {
      return fresnel_factor(Fresnel::kSchlick, r, to_eye, mirrored, mirror_at_grazing(r));
    };
    for (const Rgb r : {Rgb{0.02, 0.02, 0.02}, Rgb{0, 0, 0.02}, Rgb{0.5, 0.001, 0}, Rgb{1, 1, 1}})
      EXPECT_EQ(factor(r), fresnel_factor(Fresnel::kSchlick, r, to_eye, mirrored)) << degrees;
    EXPECT_EQ(factor({}), Rgb{}) << degrees;
    double before = 0;
    for (double r = 1e-12; r < 1; r *= 1.01) {
      const double here = factor({r, r, r}).g;
      EXPECT_GE(here, before) << degrees << " " << r;
      EXPECT_GE(here, r * (1 - 1e-15));
      EXPECT_LE(here, std::min(1.0, 50 * r) * (1 + 1e-15)) << degrees << " " << r;
      before = here;
    }
  }
}

TEST(FresnelAndDiffuseBase, ScaleTheHighlightOfEveryModelAndAddTheAlbedoByPiTimesTheCosine) {
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

/// The picture of one sphere, which nothing shadows, one ray through the centre of each pixel, by the
/// reflector.
Rgb radiance_at(const Scene& scene, const CameraFrame& camera,
                const std::vector<Reflector>& reflectors, int x, int y) {
  const Vec3 ray = normalize(centre_ray(camera, x, y));
  const auto hit = nearest_hit(scene, camera.origin, ray);
  Rgb sum;
  if (!hit) return sum;
  const auto material = std::size_t(scene.spheres[std::size_t(hit->sphere)].material);
  for (const Light& light : scene.lights) {
    const Illumination here = illuminate(light, hit->point);
    sum = sum + here.irradiance * reflectors[material].eval(hit->normal, -ray, here.to_light);
  }
  return sum;
}

TEST(Render, OfEveryModelAndLobeIsTheReflectorInEveryPixel) {
  for (const char* name : {"head_on", "oblique_45", "grazing_80", "point_light", "two_lights"})
    for (const Highlight& h :
         highlights_of_both(every_model(), std::vector{1.0, 16.0, 128.0, 1024.0, 1e4})) {
      Scene scene = canonical_scene(name);
      scene.film = {32, 24};
      ASSERT_EQ(scene.spheres.size(), 1u) << name;
      std::vector<Reflector> reflectors;
      for (Material& material : scene.materials) {
        material = {"", h, kReflectance, kDiffuse, Fresnel::kSchlick};
        reflectors.emplace_back(material);
      }
      const CameraFrame camera = camera_frame(scene.camera, scene.film);
      std::vector<Rgb> truth;
      for (int y = 0; y < scene.film.height; ++y)
        for (int x = 0; x < scene.film.width; ++x)
          truth.push_back(radiance_at(scene, camera, reflectors, x, y));
      for (const auto precision :
           {std::optional<Precision>(), std::optional(Precision::kFloat64)}) {
        RenderOptions options;
        options.precision = precision;
        const Image image = render(scene, options).image;
        const double peak = *std::max_element(image.values().begin(), image.values().end());
        ASSERT_GT(peak, 0) << name;
        double worst = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
          const float* p = image.values().data() + 3 * i;
          ASSERT_TRUE(std::isfinite(p[0] + p[1] + p[2])) << name << " " << text(h);
          worst = std::max({worst, std::abs(p[0] - truth[i].r), std::abs(p[1] - truth[i].g),
                            std::abs(p[2] - truth[i].b)});
        }
        // Half a unit of float32 at the peak, and a little for the two ways of finding the angle; or what the
        // plan may add where it chooses the precision, of a peak that may lie between the pixels.
        EXPECT_LE(worst, precision ? 1e-7 * peak
                                   : kAllowedShadingError * std::max(peak, radiance_coefficient(h)))
            << name << " " << text(h);
      }
    }
}

}  // namespace
}  // namespace lobelia

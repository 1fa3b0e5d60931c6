// The law of the fused kernels: their pictures are those of the kernels one by one, bit for bit.
#include "renderer/fused.hpp"
#include "renderer/chord.hpp"
#include "renderer/highlight_reach.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/lights/lights.hpp"
#include "tests/more_samples.hpp"
#include "tests/renderer/laws/cases.hpp"
#include "tests/renderer/random_scene.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

Light directional() { return DirectionalLight{normalize(Vec3{-0.4, -0.3, -1}), {1, 0.9, 0.8}}; }
Light white() { return DirectionalLight{{0, 0, -1}, {1, 1, 1}}; }
Light point() { return PointLight{{1.5, 1, 3}, {9, 8, 7}}; }

Scene one_sphere(int width, int height) {
  Scene scene;
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 28};
  scene.film.width = width;
  scene.film.height = height;
  scene.lights = {directional()};
  scene.materials = {{"m", {}, {0.9, 0.6, 0.3}, {}}};
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  return scene;
}

/// Empty if the two pictures are one; otherwise where they differ first.
std::string difference(const Scene& scene, std::optional<Precision> precision = std::nullopt) {
  const Plan plan = make_plan(scene, EffectPolicy::kAsCalledFor, precision);
  if (!FusedRenderer::can_render(scene, plan)) return "is not rendered by fused kernels";
  RenderOptions options;
  options.allow_fused = false;
  options.precision = precision;
  const Image expected = render(scene, options).image;
  // All bits set, so that a pixel which is not written is seen.
  std::vector<float> rgb(expected.values().size());
  std::memset(rgb.data(), 0xff, rgb.size() * sizeof(float));
  const FusedRenderer fused(scene, plan);
  // In pieces, as threads do.
  for (int y = 0; y < scene.film.height; y += 7)
    fused.render_rows(y, std::min(y + 7, scene.film.height),
                      rgb.data() + std::size_t(y) * 3 * scene.film.width);
  for (std::size_t i = 0; i < rgb.size(); ++i)
    if (std::memcmp(&rgb[i], &expected.values()[i], sizeof(float)) != 0)
      return fmt::format("column {} of row {}: {:a}, one by one {:a}", i / 3 % scene.film.width,
                         i / 3 / scene.film.width, rgb[i], expected.values()[i]);
  return "";
}

bool lit(const Scene& scene) {
  const Image image = render(scene, {}).image;
  return std::any_of(image.values().begin(), image.values().end(), [](float v) { return v > 0; });
}

TEST(Fused, EveryHighlightIsBitForBitThatOfSingleKernels) {
  const std::vector<std::vector<Light>> lightings = {
      {white()}, {directional()}, {point()}, {directional(), point()}, {point(), white(), point()}};
  std::size_t number = 0;
  for (const Highlight& highlight : highlights_of_both(every_model(), std::vector{1.0, 64.0, 1e4}))
    for (const auto& lights : lightings)
      for (const bool diffuse : {false, true})
        for (const Fresnel fresnel : {Fresnel::kNone, Fresnel::kSchlick})
          for (const Precision precision :
               {Precision::kFloat32, Precision::kMixed, Precision::kFloat64}) {
            const std::size_t case_number = number++;
            if (is_left_out(case_number / 3 + case_number)) continue;  // each precision in turn
            Scene scene = one_sphere(37, 21);
            scene.lights = lights;
            Material& material = scene.materials[0];
            material.highlight = highlight;
            material.fresnel = fresnel;
            if (diffuse) material.diffuse_reflectance = {0.1, 0.2, 0.3};
            if (!diffuse) material.specular_reflectance = {0.7, 0.7, 0.7};
            EXPECT_EQ(difference(scene, precision), "")
                << text(highlight) << ", " << lights.size() << " lights, " << name(precision);
          }
}

TEST(Fused, AnySizeOfPictureIsTheSame) {
  for (const int width : {1, 2, 7, 8, 15, 16, 17, 31, 33, 127, 128, 129, 143, 300, 513, 1031})
    for (const int height : {1, 2, 9, 64}) {
      EXPECT_EQ(difference(one_sphere(width, height)), "") << width << " x " << height;
      Scene wide = one_sphere(width, height);
      wide.camera.fov_degrees = 150;
      EXPECT_EQ(difference(wide), "") << width << " x " << height;
    }
}

TEST(Fused, ASphereAnywhereIsTheSame) {
  int shown = 0;
  for (const double radius : {1e-9, 1e-3, 0.3, 1.0, 4.0, 4.9999, 5.0, 5.5, 100.0})
    for (const Vec3 center :
         {Vec3{0, 0, 0}, Vec3{1.2, 0.7, 0}, Vec3{-1, -1.3, 1}, Vec3{5, 0, 0}, Vec3{0, 0, 5},
          Vec3{0, 0, 9}, Vec3{3, 2, 4.9}, Vec3{0, 1, 5}, Vec3{1e3, 20, -4e3}, Vec3{0.001, 0, -1e7}})
      for (const double fov : {1e-3, 28.0, 120.0, 179.0}) {
        Scene scene = one_sphere(75, 41);
        scene.camera.fov_degrees = fov;
        scene.spheres[0] = {center, radius, 0};
        EXPECT_EQ(difference(scene), "") << radius << " at " << center.x << ", " << center.y << ", "
                                         << center.z << ", " << fov << " degrees";
        shown += lit(scene);
      }
  EXPECT_GT(shown, 50);
}

TEST(Fused, LeavesLightsOnASurfaceToWaves) {
  Scene scene = one_sphere(65, 65);
  for (const double z : {0.5, 1 + 1e-8, 1.01}) {
    scene.lights = {PointLight{{0, 0, z}, {1, 1, 1}}};
    EXPECT_EQ(difference(scene), "") << z;
  }
  for (const double z : {1.0, 1 + 1e-12}) {
    scene.lights = {PointLight{{0, 0, z}, {1, 1, 1}}};
    EXPECT_EQ(difference(scene), "is not rendered by fused kernels") << z;
    const Image image = render(scene, {}).image;
    EXPECT_EQ(*std::ranges::max_element(image.values()), 0) << z;
  }
}

TEST(Fused, TracesOnlyPixelsWithinReach) {
  Scene scene = one_sphere(1024, 1024);
  const auto share = [&] {
    const FusedRenderer fused(scene, make_plan(scene, EffectPolicy::kAsCalledFor));
    std::vector<float> rgb(3 * 1024 * 1024);
    fused.render_rows(0, 1024, rgb.data());
    return double(fused.work().camera_rays) / (1024.0 * 1024);
  };
  scene.materials[0].highlight.lobe = *find_lobe("cs16");
  EXPECT_LT(share(), 0.2);
  // The disc has pi/4 of the square around it, 0.816 of the picture wide; blocks add some.
  scene.materials[0].diffuse_reflectance = {0.1, 0.1, 0.1};
  EXPECT_GT(share(), 0.523);
  EXPECT_LT(share(), 0.56);
}

// The law of a highlight's reach: what is left out is black.

/// A sphere, an eye and a light that may be anywhere, and a highlight of any width.
struct Sight {
  Highlight highlight;
  Sphere sphere;
  Vec3 eye;
  Light light;
};

Sight random_sight(Random& random) {
  Sight sight;
  sight.highlight.model = random.one_of(all_models());
  sight.highlight.lobe = random.one_of(all_lobes());
  sight.highlight.exponent = random.log_between(1, 1e6);
  sight.sphere = {3 * random.vector(), random.log_between(0.1, 10), 0};
  const auto outside = [&] {
    return sight.sphere.center +
           sight.sphere.radius * (1 + random.log_between(1e-3, 100)) * random.direction();
  };
  sight.eye = outside();
  const double power = random.log_between(1e-3, 1e6);
  if (random.chance(0.5))
    sight.light = DirectionalLight{random.direction(), {power, power, power}};
  else
    sight.light = PointLight{outside(), {power, power, power}};
  return sight;
}

/// A unit vector at `angle` from a unit vector.
Vec3 at_angle(Vec3 axis, double angle, Random& random) {
  const Vec3 other = random.direction();
  const Vec3 aside = normalize(other - dot(other, axis) * axis);
  return normalize(std::cos(angle) * axis + std::sin(angle) * aside);
}

/// The highlight's float32 value at a point of the sphere; 0 where it cannot be seen.
double shown_value(const Sight& sight, double coefficient, Vec3 normal) {
  const Vec3 point = sight.sphere.center + sight.sphere.radius * normal;
  const Vec3 to_eye = normalize(sight.eye - point);
  const Illumination light = illuminate(lamp_of(sight.light), point);
  const double n_dot_v = dot(normal, to_eye), n_dot_l = dot(normal, light.to_light);
  if (n_dot_v <= 0 || n_dot_l <= 0) return 0;
  const double cosine = info(sight.highlight.model).angle == LobeAngle::kReflection
                            ? 2 * n_dot_l * n_dot_v - dot(light.to_light, to_eye)
                            : dot(normal, normalize(light.to_light + to_eye));
  const double value = lobe_value(sight.highlight.lobe, 1 - cosine, sight.highlight.exponent);
  return float(value) < std::numeric_limits<float>::min()
             ? 0
             : float(value * coefficient * light.irradiance.r);
}

TEST(HighlightReach, HoldsEveryNormalThatShines) {
  Random random(20261127);
  int narrow = 0, shining_near_the_edge = 0;
  for (int i = 0; i < 20000 * more_samples(); ++i) {
    const Sight sight = random_sight(random);
    const double coefficient = radiance_coefficient(sight.highlight);
    const Lamp lamp = lamp_of(sight.light);
    const auto cap = highlight_reach(sight.highlight, sight.sphere, sight.eye, lamp,
                                     coefficient * lamp.strength.r);
    if (!cap) continue;
    ++narrow;
    for (int k = 0; k < 60; ++k) {
      // Half of them just outside.
      const double angle = cap->angle + (k % 2 ? random.between(0, kPi - cap->angle)
                                               : random.log_between(1e-6, 0.1));
      const Vec3 normal = at_angle(cap->axis, angle, random);
      EXPECT_EQ(shown_value(sight, coefficient, normal), 0)
          << text(sight.highlight) << ", " << angle - cap->angle << " rad outside";
    }
    for (int k = 0; k < 4; ++k)
      shining_near_the_edge +=
          shown_value(sight, coefficient, at_angle(cap->axis, 0.9 * cap->angle, random)) > 0;
  }
  EXPECT_GT(narrow, 5000);
  // A bound that holds because it is far too wide is of no use.
  EXPECT_GT(shining_near_the_edge, 1500);
}

TEST(HighlightReach, IsUnknownForLobesThatMayRiseAgain) {
  const Sphere sphere{{0, 0, 0}, 1, 0};
  const Lamp lamp = Lamp::distant({0, 0, -1}, {1, 1, 1});
  Highlight highlight{*find_model("phong_rdf"), *find_lobe("cs16")};
  EXPECT_TRUE(highlight_reach(highlight, sphere, {0, 0, 5}, lamp, 1));
  highlight.lobe = formula_lobe("(1 - s)^n");
  EXPECT_FALSE(highlight_reach(highlight, sphere, {0, 0, 5}, lamp, 1));
}

TEST(HighlightReach, LeavesThePictureAsItIsBitForBit) {
  Random random(7);
  double rays = 0, others = 0;
  for (int i = 0; i < 400 * more_samples(); ++i) {
    Scene scene;
    scene.materials.clear();
    scene.film = {64 + random.below(90), 64 + random.below(90)};
    const int spheres = 1 + random.below(3);
    for (int k = 0; k < spheres; ++k) {
      const Sight sight = random_sight(random);
      scene.spheres.push_back({2.2 * double(k) * Vec3{1, 0.2, 0.4}, random.between(0.3, 1), k});
      Material material;
      material.id = fmt::format("m{}", k);
      material.highlight = sight.highlight;
      material.specular_reflectance = {1, random.between(0, 1), 0.5};
      if (random.chance(0.3)) material.fresnel = Fresnel::kSchlick;
      scene.materials.push_back(material);
    }
    scene.camera = {random.between(2.5, 9) * random.direction(),
                    scene.spheres[0].center,
                    {0, 1, 0.01},
                    random.between(15, 70)};
    for (int lights = 1 + random.below(3); lights > 0; --lights) {
      const Light light = random_sight(random).light;
      scene.lights.push_back(light);
    }
    RenderOptions options, one_by_one;
    one_by_one.allow_fused = false;
    const RenderResult ours = render(scene, options), truth = render(scene, one_by_one);
    ASSERT_TRUE(std::ranges::equal(ours.image.values(), truth.image.values())) << "scene " << i;
    rays += double(ours.work.camera_rays);
    others += double(truth.work.camera_rays);
  }
  EXPECT_LT(rays, 0.7 * others);
}

TEST(HighlightReach, LeavesOutNothingThatManyLightsAddUpTo) {
  Scene scene;
  scene.film = {128, 128};
  // From afar, where the bound is tight, at the ring in which the highlight of one light rounds to 0.
  scene.camera = {{0, 0, 1000}, {std::sin(0.8), 0, std::cos(0.8)}, {0, 1, 0}, 0.002};
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  scene.materials.resize(1);
  scene.materials[0].specular_reflectance = {1, 1, 1};
  Highlight& highlight = scene.materials[0].highlight;
  highlight.model = *find_model("blinn_phong_rdf");
  highlight.exponent = 300;
  scene.lights.assign(64, DirectionalLight{{0, 0, -1}, {1, 1, 1}});
  RenderOptions options;
  options.precision = Precision::kFloat64;
  const Image ours = render(scene, options).image;
  options.effects = EffectPolicy::kAll;
  const Image truth = render(scene, options).image;
  EXPECT_TRUE(std::ranges::equal(ours.values(), truth.values()));
  const auto black = std::ranges::count(truth.values(), 0);
  EXPECT_GT(black, 1000);
  EXPECT_LT(black, std::ptrdiff_t(truth.values().size()) - 1000);
}

}  // namespace
}  // namespace lobelia

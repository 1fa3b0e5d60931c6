// The law of the fused kernels: their pictures are those of the kernels one by one, bit for bit.
#include "renderer/fused.hpp"
#include "renderer/render.hpp"
#include "tests/more_samples.hpp"
#include "tests/renderer/laws/cases.hpp"
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

}  // namespace
}  // namespace lobelia

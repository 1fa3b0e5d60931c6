// The renderer against formulas that share none of its code, on scenes at random; and each precision against
// the bound that is stated of it.
#include <fmt/format.h>

#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "reference_scenes/engines/analytic/formulas/tracer.hpp"
#include "renderer/render.hpp"
#include "tests/more_samples.hpp"
#include "tests/renderer/random_scene.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using truth::Digits;

/// The relative error of rounding to float32.
constexpr double kStored = 6e-8;

/// Only what formulas per pixel can tell: lamps with a size, of which none shines, are left out.
Scene told_by_formulas(Scene scene) {
  std::erase_if(scene.lights, [](const Light& l) { return !is_delta(l); });
  return scene;
}

/// For each pixel, the sum of its highlights with every lobe at its peak, and how much of it a precision may
/// be off by.
struct PixelPeaks {
  std::vector<double> peak, allowed;
};
PixelPeaks peaks_of(const Scene& scene, const std::vector<double>& share_by_material) {
  const truth::Tracer<double> tracer(scene);
  PixelPeaks peaks;
  for (int y = 0; y < scene.film.height; ++y)
    for (int x = 0; x < scene.film.width; ++x) {
      double peak = 0, allowed = 0, weight = 1;
      tracer.follow(x + 0.5, y + 0.5, [&](const truth::Met<double>& met) {
        const Material& m = scene.materials[std::size_t(met.material)];
        const bool schlick = m.fresnel != Fresnel::kNone;
        const double specular = schlick ? 1 : max_component(m.specular_reflectance);
        for (std::size_t l = 0; l < scene.lights.size(); ++l)
          if (const auto arrival = tracer.arrival(l, met)) {
            const Highlight& h = m.highlight;
            // Shadowing makes a highlight higher at grazing angles, and its error with it.
            const double factor =
                info(h.model).has_shadowing
                    ? std::max(1.0, geometry_factor(h.model, h.exponent, arrival->n_dot_l,
                                                    dot(met.normal, met.to_eye)))
                    : 1;
            const double here = weight * radiance_coefficient(h) * factor * specular *
                                arrival->falloff * max_component(strength(scene.lights[l]));
            peak += here;
            allowed += share_by_material[std::size_t(met.material)] * here;
          }
        weight *= schlick ? 1 : max_component(m.mirror_reflectance);
      });
      peaks.peak.push_back(peak);
      peaks.allowed.push_back(allowed);
    }
  return peaks;
}

double apart(std::span<const float, 3> a, Rgb b) {
  return std::max({std::abs(a[0] - b.r), std::abs(a[1] - b.g), std::abs(a[2] - b.b)});
}
double apart(Rgb a, Rgb b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

TEST(RandomScenes, AgreeWithTheFormulasInEveryPixel) {
  const int scenes = 200 * more_samples();
  int compared = 0, lit = 0;
  expect_of_random_scenes(SceneKind::kExact, scenes, [&](const Scene& random_one, Random& random) {
    const Scene scene = told_by_formulas(random_one);
    RenderOptions options;
    options.allow_fused = random.chance(0.5);
    const Image picture = render(scene, options).image;
    const std::vector<Rgb> formulas = truth::evaluate(scene, Digits::kDouble);
    const auto ring = truth::edge_ring(scene);
    const auto peaks =
        peaks_of(scene, std::vector<double>(scene.materials.size(), kAllowedShadingError));
    std::vector<Rgb> fine;
    for (std::size_t i = 0; i < formulas.size(); ++i) {
      if (ring[i]) continue;
      ++compared;
      const Rgb expected = formulas[i];
      lit += max_component(expected) > 0;
      const auto pixel = picture.pixel(int(i) % picture.width(), int(i) / picture.width());
      const double allowed = peaks.allowed[i] + kStored * max_component(expected) + 1e-40;
      if (apart(pixel, expected) <= allowed) continue;
      // Mirrors and sharp lobes magnify roundings: what 50 digits say, and how far double is from it.
      if (fine.empty()) fine = truth::evaluate(scene, Digits::kFifty);
      const double roundings = 100 * apart(formulas[i], fine[i]);
      if (!(apart(pixel, fine[i]) <= allowed + roundings))
        return fmt::format(
            "pixel {}, {} is {:.9g} {:.9g} {:.9g}, by the formulas {:.9g} {:.9g} {:.9g}; {:.3g} "
            "apart, {:.3g} allowed",
            i % std::size_t(picture.width()), i / std::size_t(picture.width()), pixel[0], pixel[1],
            pixel[2], fine[i].r, fine[i].g, fine[i].b, apart(pixel, fine[i]), allowed + roundings);
    }
    return std::string();
  });
  EXPECT_GT(600 * compared, 5000 * scenes);
  EXPECT_GT(600 * lit, 2000 * scenes);
}

TEST(RandomScenes, AreWithinEachPrecisionsBoundOfFloat64) {
  int tight = 0;
  double closest = 0;
  expect_of_random_scenes(SceneKind::kExact, 1200, [&](const Scene& random_one, Random&) {
    const Scene scene = told_by_formulas(random_one);
    RenderOptions options;
    options.precision = Precision::kFloat64;
    const Image wide = render(scene, options).image;
    const auto ring = truth::edge_ring(scene);
    const auto least = min_half_lengths(scene);
    for (const Precision precision : {Precision::kFloat32, Precision::kMixed}) {
      std::vector<double> share;
      for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        const Highlight& h = scene.materials[m].highlight;
        // A lobe is 1 at most: a bound beyond that says nothing.
        share.push_back(std::min(1.0, shading_error_bound(precision, h, least[m]) +
                                          shading_error_bound(Precision::kFloat64, h, least[m])));
        tight += share.back() < 1e-3;
      }
      const auto peaks = peaks_of(scene, share);
      options.precision = precision;
      const Image narrow = render(scene, options).image;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        if (ring[i]) continue;
        for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
          const double a = wide.values()[c], b = narrow.values()[c];
          const double error = std::max(0.0, std::abs(a - b) - 2 * kStored * a - 1e-40);
          if (!(error <= peaks.allowed[i]))
            return fmt::format(
                "value {} is {:.9g} in {}, {:.9g} in float64: {:.3g} apart, {:.3g} allowed", c, b,
                name(precision), a, error, peaks.allowed[i]);
          if (peaks.allowed[i] > 0) closest = std::max(closest, error / peaks.allowed[i]);
        }
      }
    }
    return std::string();
  });
  EXPECT_GT(tight, 1200);
  EXPECT_GT(closest, 0.01) << "bounds that nothing comes near";
}

// ---- a camera on a sphere

/// A camera on a sphere's surface, as near as numbers come to it, looking anywhere.
Scene camera_on_a_sphere(Random& random, double off) {
  Scene scene;
  scene.materials = {
      {"", {*find_model("phong_rdf"), *find_lobe("cosine"), {}, 2}, {1, 1, 1}, {1, 1, 1}}};
  const double size = random.log_between(1e-3, 1e3);
  const Vec3 center =
      random.chance(0.3) ? Vec3{} : random.log_between(1e-3, 1e3) * random.direction();
  scene.spheres = {{center, size, 0}};
  scene.camera.origin = center + (1 + off) * size * random.direction();
  scene.camera.target = scene.camera.origin + random.direction();
  scene.camera.up = random.direction();
  scene.camera.fov_degrees = random.between(20, 160);
  scene.film = {13, 11};
  for (int i = 0; i < 3; ++i)
    scene.lights.push_back(DirectionalLight{random.direction(), {1, 1, 1}});
  return scene;
}

bool is_black(const Image& image) {
  return std::all_of(image.values().begin(), image.values().end(), [](float v) { return v == 0; });
}
bool is_black(const std::vector<Rgb>& pixels) {
  return std::all_of(pixels.begin(), pixels.end(), [](Rgb p) { return lobelia::is_black(p); });
}

TEST(ACameraOnASphere, DoesNotSeeItByWhateverWayItIsRendered) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Scene scene = camera_on_a_sphere(random, 0);
    RenderOptions one_by_one;
    one_by_one.allow_fused = false;
    ASSERT_TRUE(is_black(render(scene, {}).image)) << "fused";
    ASSERT_TRUE(is_black(render(scene, one_by_one).image)) << "one by one";
    ASSERT_TRUE(is_black(truth::evaluate(scene, Digits::kDouble))) << "formulas";
    if (seed < 20) {
      ASSERT_TRUE(is_black(truth::evaluate(scene, Digits::kFifty))) << "50 digits";
    }
    Scene crowd = scene;  // that a hierarchy sorts
    crowd.spheres.resize(30, scene.spheres[0]);
    ASSERT_TRUE(is_black(render(crowd, {}).image)) << "crowd";
    crowd.camera.aperture_radius = scene.spheres[0].radius * 1e-15;
    ASSERT_TRUE(is_black(render(crowd, {}).image)) << "lens";
  }
}

TEST(ACameraOnASphere, SeesItFromAHairOutside) {
  int seen = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    Scene scene = camera_on_a_sphere(random, 1e-6);
    const Vec3 to_center = scene.spheres[0].center - scene.camera.origin;
    scene.camera.target =
        scene.camera.origin + (1 / length(to_center)) * to_center + 0.1 * random.direction();
    scene.camera.fov_degrees = 60;
    const auto mask = truth::surface_mask(scene);
    ASSERT_TRUE(std::all_of(mask.begin(), mask.end(), [](auto m) { return m == 1; })) << seed;
    const Image picture = render(scene, {}).image;
    const auto formulas = truth::evaluate(scene, Digits::kDouble);
    for (std::size_t i = 0; i < formulas.size(); ++i)
      ASSERT_LE(apart(picture.pixel(int(i) % 13, int(i) / 13), formulas[i]),
                1e-4 * (max_component(formulas[i]) + 1e-3))
          << seed;
    seen += !is_black(picture);
  }
  EXPECT_GT(seen, 200);
}

}  // namespace
}  // namespace lobelia

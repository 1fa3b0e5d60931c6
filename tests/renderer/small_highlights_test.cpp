#include "renderer/small_highlights.hpp"

#include <fmt/format.h>

#include <numbers>

#include "renderer/frame.hpp"
#include "renderer/pixel_ray.hpp"
#include "renderer/render.hpp"
#include "tests/renderer/random_scene.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// The integral of a highlight over the film, by polar coordinates around its middle on the sphere: another computation, which
/// knows no pixels and no rays.
class EnergyOnFilm {
 public:
  explicit EnergyOnFilm(const Scene& scene)
      : scene_(scene),
        sphere_(scene.spheres[0]),
        highlight_(scene.materials[0].highlight),
        lamp_(*find_lamp(scene.lights[0])),
        frame_(camera_frame(scene.camera, scene.film)) {}

  double value() const {
    // From the direction where both angles of a lobe are 0, by fixed points.
    Vec3 middle = normalize(to_light(sphere_.center) + to_eye(sphere_.center));
    for (int i = 0; i < 200; ++i) {
      const Vec3 point = sphere_.center + sphere_.radius * middle;
      middle = normalize(to_light(point) + to_eye(point));
    }
    // Steps grow from the middle outwards.
    const Tangents t = tangents(middle);
    constexpr int kRounds = 96, kSteps = 500;
    const double least = 1e-3 / std::sqrt(highlight_.exponent + 1), most = 3.1;
    double sum = 0;
    for (int round = 0; round < kRounds; ++round) {
      const double turn = 2 * std::numbers::pi * (round + 0.5) / kRounds;
      const Vec3 aside = std::cos(turn) * t.first + std::sin(turn) * t.second;
      // u = log(1 + angle / least), evenly.
      const double end = std::log1p(most / least);
      for (int step = 0; step < kSteps; ++step) {
        const double u = end * (step + 0.5) / kSteps, angle = least * std::expm1(u);
        const Vec3 normal = std::cos(angle) * middle + std::sin(angle) * aside;
        sum += radiance(normal) * area_on_film(normal) * std::sin(angle) * least * std::exp(u) *
               (end / kSteps) * (2 * std::numbers::pi / kRounds);
      }
    }
    return sum;
  }

 private:
  Vec3 to_light(Vec3 point) const {
    return lamp_.is_distant ? -lamp_.direction : normalize(lamp_.position - point);
  }
  Vec3 to_eye(Vec3 point) const { return normalize(frame_.origin - point); }

  double radiance(Vec3 normal) const {
    const Vec3 point = sphere_.center + sphere_.radius * normal, l = to_light(point),
               v = to_eye(point);
    const double n_dot_l = dot(normal, l);
    if (n_dot_l <= 0 || dot(normal, v) <= 0) return 0;
    const ModelInfo& model = info(highlight_.model);
    const Vec3 off = model.angle == LobeAngle::kHalfVector ? normal - normalize(l + v)
                                                           : 2 * dot(normal, v) * normal - v - l;
    const double distance = lamp_.is_distant ? 1 : length(lamp_.position - point);
    return lamp_.strength.r / (distance * distance) * radiance_coefficient(highlight_) *
           lobe_value(highlight_.lobe, dot(off, off) / 2, highlight_.exponent) *
           (model.applies_cosine ? n_dot_l : 1);
  }
  /// Square pixels by steradian of normals.
  double area_on_film(Vec3 normal) const {
    const Tangents t = tangents(normal);
    const auto place = [&](Vec3 n) {
      const Vec3 view = sphere_.center + sphere_.radius * n - frame_.origin;
      const double ahead = dot(view, frame_.forward);
      return std::array{dot(view, frame_.right) / ahead / frame_.half_width * frame_.width / 2,
                        dot(view, frame_.up) / ahead / frame_.half_height * frame_.height / 2};
    };
    constexpr double kStep = 1e-5;
    const auto slope = [&](Vec3 along) {
      const auto ahead = place(normalize(normal + kStep * along)),
                 back = place(normalize(normal - kStep * along));
      return std::array{(ahead[0] - back[0]) / (2 * kStep), (ahead[1] - back[1]) / (2 * kStep)};
    };
    const auto a = slope(t.first), b = slope(t.second);
    return std::abs(a[0] * b[1] - a[1] * b[0]);
  }

  const Scene& scene_;
  const Sphere& sphere_;
  Highlight highlight_;
  Lamp lamp_;
  CameraFrame frame_;
};

double energy(const Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.values().size(); i += 3) sum += double(image.values()[i]);
  return sum;
}

/// A sphere that a lamp lights from the camera's side.
Scene random_sphere(Random& random, double exponent, int side) {
  Scene scene;
  const auto models = all_models();
  Material material;
  do {
    material.highlight = {models[std::size_t(random.below(int(models.size())))],
                          *find_lobe("cosine"), Normalisation::kExact, exponent};
  } while (info(material.highlight.model).has_shadowing);
  material.specular_reflectance = {1, 1, 1};
  scene.materials = {material};
  scene.camera = {{0, 0, random.between(5, 8)}, {0, 0, 0}, {0, 1, 0}, random.between(34, 45)};
  scene.film = {side, side, {}};
  scene.spheres = {{{random.between(-0.3, 0.3), random.between(-0.3, 0.3), 0}, 1, 0}};
  const Vec3 from = normalize({random.between(-1, 1), random.between(-1, 1), 1.2});
  if (random.chance(0.5))
    scene.lights = {DirectionalLight{-from, {1, 1, 1}}};
  else
    scene.lights = {PointLight{10 * from, {100, 100, 100}}};
  scene.sampler.averages_small_highlights = true;
  return scene;
}

TEST(SmallHighlights, HaveTheirEnergyAtEveryExponentAndSizeOfPicture) {
  Random random(59);
  int averaged = 0, missed = 0;
  for (int k = 0; k < 100; ++k) {
    const double n = random.log_between(1, 1e8);
    const int sizes[] = {32, 64, 128, 256, 512, 1024};
    Scene scene = random_sphere(random, n, random.one_of(std::span<const int>(sizes)));
    const double truth = EnergyOnFilm(scene).value();
    const RenderResult result = render(scene, {});
    // A broad highlight ends at the silhouette, where pixels are wholly in or out.
    const double allowed = n > 100 ? kAverageError : 0.02;
    EXPECT_NEAR(energy(result.image) / truth, 1, allowed) << n << ", " << scene.film.width;
    averaged += result.plan.averages_highlights;
    scene.sampler.averages_small_highlights = false;
    missed += std::abs(energy(render(scene, {}).image) / truth - 1) > 0.1;
  }
  EXPECT_GT(averaged, 40);
  EXPECT_GT(missed, 20);
}

TEST(RandomScenes, HaveTheEnergyOfTheirSmallHighlights) {
  expect_of_random_scenes(SceneKind::kExact, 20, [](const Scene&, Random& random) -> std::string {
    const double n = random.log_between(200, 1e8);
    const Scene scene = random_sphere(random, n, 32 << random.below(6));
    const double share = energy(render(scene, {}).image) / EnergyOnFilm(scene).value();
    return std::abs(share - 1) <= kAverageError
               ? ""
               : fmt::format("n = {}, {} pixels: {} of the energy", n, scene.film.width, share);
  });
}

TEST(SmallHighlights, HaveTheirEnergyWithEveryLobe) {
  Random random(62);
  for (const LobeId& lobe : all_lobes())
    for (int k = 0; k < 3; ++k) {
      Scene scene = random_sphere(random, random.log_between(1e4, 1e8), 128);
      scene.materials[0].highlight.lobe = lobe;
      const RenderResult result = render(scene, {});
      EXPECT_TRUE(result.plan.averages_highlights);
      EXPECT_NEAR(energy(result.image) / EnergyOnFilm(scene).value(), 1, kAverageError)
          << info(lobe).name << ", " << scene.materials[0].highlight.exponent;
    }
}

TEST(SmallHighlights, LeaveAPictureOfWideOnesAsItIs) {
  Random random(60);
  for (int k = 0; k < 40; ++k) {
    Scene scene = random_sphere(random, random.log_between(1, 300), 256);
    const RenderResult with = render(scene, {});
    EXPECT_FALSE(with.plan.averages_highlights);
    scene.sampler.averages_small_highlights = false;
    const RenderResult without = render(scene, {});
    EXPECT_TRUE(std::ranges::equal(with.image.values(), without.image.values()));
    EXPECT_EQ(with.work.of_effect, without.work.of_effect);
  }
}

TEST(SmallHighlights, AreTheSameWithEveryEffectForced) {
  Random random(61);
  for (int k = 0; k < 20; ++k) {
    Scene scene = random_sphere(random, random.log_between(1e4, 1e8), 64);
    RenderOptions all;
    all.effects = EffectPolicy::kAll;
    const RenderResult planned = render(scene, {});
    EXPECT_TRUE(planned.plan.averages_highlights);
    EXPECT_TRUE(std::ranges::equal(planned.image.values(), render(scene, all).image.values()));
  }
}

TEST(SmallHighlights, AreFoundOnAPlaneWhereTheLampIsMirrored) {
  Scene scene;
  scene.camera = {{0, 1, 0}, {0, 1, -1}, {0, 1, 0}, 90};
  scene.film = {100, 100, {}};
  Material material;
  material.highlight = {*find_model("modified_phong"), *find_lobe("cosine"), {}, 1e7};
  material.specular_reflectance = {1, 1, 1};
  scene.materials = {material};
  scene.planes = {{{0, 0, 0}, {0, 1, 0}}};
  scene.lights = {PointLight{{0, 1, -4}, {1, 1, 1}}};
  // The mirror image at (0, -1, -4) is 2 below the eye and 4 ahead.
  const std::vector<SmallHighlight> found = find_small_highlights(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].x, 50, 1e-6);
  EXPECT_NEAR(found[0].y, 75, 1e-6);
}

}  // namespace
}  // namespace lobelia

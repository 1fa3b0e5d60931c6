// Lights with a size that lie on a surface. Scenes are random: any plane, body and lamp, at any scale and place. The
// surface is black, so that it shows in a picture by what it hides alone. Lamps without a size are held to the formulas
// (analytic_test.cpp, evaluation_test.cpp, random_scenes_test.cpp).
#include <fmt/format.h>

#include "renderer/frame.hpp"
#include "renderer/pixel_ray.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/contact.hpp"
#include "renderer/scene/scene.hpp"
#include "tests/renderer/simple_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

constexpr int kSide = 24;
constexpr double kScales[] = {1e-3, 1, 1e4};
/// From the origin, in scales.
constexpr double kAway[] = {0, 1e5};
constexpr int kSeeds = 12;

/// A scene of spheres, and what becomes of its lights by a lamp that lies on a surface.
class RandomScene {
 public:
  RandomScene(double scale, double away, int seed)
      : scale_(scale), random_(std::uint64_t(seed)), frame_(tangents(unit())) {
    middle_ = scale * away * unit();
    normal_ = cross(frame_.first, frame_.second);
    scene.film = {kSide, kSide};
    for (int i = 0; i < 3; ++i) {
      Material m;
      m.highlight = {
          ModelId{std::uint8_t(random_() % models().size())}, *find_lobe("cosine"), {}, 20};
      m.specular_reflectance = {0.4, 0.4, 0.4};
      m.diffuse_reflectance = {0.5, 0.5, 0.5};
      scene.materials.push_back(m);
    }
    scene.materials.push_back({"black", scene.materials[0].highlight, {}, {}});
    // On both sides of the plane, and one that it may cut.
    add_sphere({0, 0, 1.5}, 0.8, 0);
    add_sphere({0, 0, -1.5}, 0.8, 1);
    add_sphere({0.5 * even(), 0.5 * even(), 0}, 0.5, 2);
    scene.camera = {at({6 * even(), 6, 2 * even()}), at({0, 0, 0}), normal_, 50};
  }

  double even() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  Vec3 unit() { return normalize({even(), even(), even() + 1e-3}); }
  double scale() const { return scale_; }
  Vec3 normal() const { return normal_; }

  /// The place of (x, y) in the plane, z above it.
  Vec3 at(Vec3 v) const { return middle_ + scale_ * turned(v); }
  Vec3 turned(Vec3 v) const { return v.x * frame_.first + v.y * frame_.second + v.z * normal_; }
  /// In the plane, aside of the spheres.
  Vec3 aside() {
    const double turn = std::numbers::pi * even(), radius = 2 + 0.5 * even();
    return {radius * std::cos(turn), radius * std::sin(turn), 0};
  }
  void add_sphere(Vec3 center, double radius, int material) {
    scene.spheres.push_back({at(center + 0.3 * Vec3{even(), even(), even()}),
                             scale_ * radius * (1 + 0.2 * even()), material});
  }
  /// Changes no pixel, but other inner loops are chosen.
  void add_crowd(int count) {
    for (int i = 0; i < count; ++i)
      scene.spheres.push_back({at({20 + i % 20 * 0.1, -20, i * 0.01}), scale_ * 1e-3, 3});
  }
  Plane black_plane() {
    return {at({5 * even(), 5 * even(), 0}), random_() % 2 ? normal_ : -normal_, 3, 3, 1};
  }
  Rgb power(double strength) const { return strength * Rgb{1, 0.5, 0.25}; }
  double height(Vec3 p) const { return dot(p - middle_, normal_) / scale_; }

  Scene scene;

 private:
  double scale_;
  std::mt19937_64 random_;
  Tangents frame_;
  Vec3 middle_, normal_;
};

/// Calls f(random, its scene) for many random scenes with each of the crowds.
template <class F>
void for_random_scenes(std::initializer_list<int> crowds, const F& f) {
  for (const int crowd : crowds)
    for (const double scale : kScales)
      for (const double away : kAway)
        for (int seed = 0; seed < kSeeds; ++seed) {
          RandomScene random(scale, away, seed);
          random.add_crowd(crowd);
          SCOPED_TRACE(
              fmt::format("crowd {}, scale {}, {} away, seed {}", crowd, scale, away, seed));
          f(random, random.scene);
          if (testing::Test::HasFatalFailure()) return;
        }
}

/// The surface at a pixel's centre.
struct Seen {
  int surface = -1;  ///< spheres first, then planes
  Vec3 point;
};
Seen seen(const Scene& scene, int x, int y) {
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  const Vec3 direction = normalize(centre_ray(frame, x, y));
  Seen nearest;
  double distance = std::numeric_limits<double>::infinity();
  if (const auto hit = nearest_hit(scene, frame.origin, direction)) {
    nearest = {hit->sphere, hit->point};
    distance = length(hit->point - frame.origin);
  }
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    const Plane& plane = scene.planes[k];
    const double t = dot(plane.point - frame.origin, plane.normal) / dot(direction, plane.normal);
    if (t > 0 && t < distance) {
      nearest = {int(scene.spheres.size() + k), frame.origin + t * direction};
      distance = t;
    }
  }
  return nearest;
}

template <class F>
void for_pixels(const Scene& scene, const F& f) {
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) f(x, y, seen(scene, x, y));
}

Scene lights_of(Scene scene) {
  scene.spheres.clear();
  scene.planes.clear();
  return scene;
}

/// In how many pixels a picture is another's.
struct Tally {
  int lit = 0, dark = 0;
  void expect(float value, float expected, int x, int y) {
    EXPECT_EQ(value, expected) << x << ", " << y;
    (expected > 0 ? lit : dark) += 1;
  }
};

TEST(ARectangleInAPlane, ShinesAsIfThePlaneWereNotThereAndIsSeen) {
  Tally spheres, plane;
  for_random_scenes({0, 40}, [&](RandomScene& random, Scene& scene) {
    const double turn = random.even(), size = 0.6 * random.scale();
    const Vec3 u = random.turned({std::cos(turn), std::sin(turn), 0});
    const Vec3 v = random.turned({-std::sin(turn), std::cos(turn), 0});
    scene.lights = {RectangleLight{random.at(random.aside()), size * u,
                                   (random.even() > 0 ? size : -size) * v, random.power(5)}};
    const Image lights = render(lights_of(scene), {}).image;
    const Image without = render(scene, {}).image;
    scene.planes = {random.black_plane()};
    const Image with = render(scene, {}).image;
    for_pixels(scene, [&](int x, int y, const Seen& seen) {
      if (seen.surface >= 0 && std::abs(random.height(seen.point)) < 1e-6 &&
          seen.surface < int(scene.spheres.size()))
        return;
      if (seen.surface == int(scene.spheres.size()))
        plane.expect(with.pixel(x, y)[0], lights.pixel(x, y)[0], x, y);
      else
        spheres.expect(with.pixel(x, y)[0], without.pixel(x, y)[0], x, y);
    });
  });
  EXPECT_GT(spheres.lit, 500);
  EXPECT_GT(plane.lit, 100) << "the lamp itself";
}

TEST(ARectangleAHairBehindAPlane, IsHiddenByIt) {
  int dark = 0;
  for_random_scenes({0}, [&](RandomScene& random, Scene& scene) {
    scene.planes = {random.black_plane()};
    const Vec3 u = random.turned({0.6 * random.scale(), 0, 0});
    const Vec3 v = random.turned({0, 0.6 * random.scale(), 0});
    const Vec3 place = random.at(random.aside());
    scene.lights = {RectangleLight{place, u, v, random.power(5)}};
    const double hair = 10 * closeness(scene);
    std::get<RectangleLight>(scene.lights[0]).center = place - hair * random.normal();
    const Image with = render(scene, {}).image;
    for_pixels(scene, [&](int x, int y, const Seen& seen) {
      if (std::abs(random.height(seen.point)) < 1e-6) return;
      EXPECT_EQ(with.pixel(x, y)[0], 0) << x << ", " << y;
      ++dark;
    });
  });
  EXPECT_GT(dark, 5000);
}

TEST(ABallOfLightAroundASphereOfItsSize, ShinesAsIfTheSphereWereNotThereAndIsSeen) {
  Tally spheres, bulb;
  for_random_scenes({0, 40, 300}, [&](RandomScene& random, Scene& scene) {
    const Sphere body{random.at(random.aside() + Vec3{0, 0, random.even()}), 0.3 * random.scale(),
                      3};
    scene.lights = {SphereLight{body.center, body.radius, random.power(5)}};
    const Image lights = render(lights_of(scene), {}).image;
    const Image without = render(scene, {}).image;
    scene.spheres.push_back(body);
    const Image with = render(scene, {}).image;
    for_pixels(scene, [&](int x, int y, const Seen& seen) {
      if (seen.surface < 3)
        spheres.expect(with.pixel(x, y)[0], without.pixel(x, y)[0], x, y);
      else
        bulb.expect(with.pixel(x, y)[0], lights.pixel(x, y)[0], x, y);
    });
  });
  EXPECT_GT(spheres.lit, 2500);
  EXPECT_GT(bulb.lit, 300);
  EXPECT_EQ(bulb.dark, 0);
}

/// As in a room: mirrors and inter-reflection show the lamp and what it lies on.
Scene room() {
  Scene scene;
  scene.camera = {{0, 0.2, 6}, {0, 0.8, 0}, {0, 1, 0}, 60};
  scene.film = {48, 48};
  scene.sampler.sample_count = 64;
  Material plain = matt(0.5);
  plain.highlight = {*find_model("modified_phong"), *find_lobe("cosine"), {}, 20};
  plain.specular_reflectance = {0.3, 0.3, 0.3};
  Material mirror = plain;
  mirror.mirror_reflectance = {0.6, 0.6, 0.6};
  scene.materials = {plain, mirror};
  scene.spheres = {{{0, 0, 0}, 1, 1}, {{1.4, 2, -0.5}, 0.6, 0}};
  scene.planes = {{{0, 3, 0}, {0, -1, 0}, 0, 0, 1}, {{0, -1, 0}, {0, 1, 0}, 0, 0, 1}};
  return scene;
}

TEST(ALightOnASurface, IsTheLimitOfOneThatComesNearToItsBrightSide) {
  Scene scene = room();
  scene.spheres.push_back({{-1.5, 1.5, 0.5}, 0.4, 0});
  constexpr double kNear = 1e-7;
  // On the ceiling, on the third sphere, around it; each a hair before it as well.
  const std::pair<Light, Light> lights[] = {
      {RectangleLight{{0, 3, 0}, {1, 0, 0}, {0, 0, 1}, {5, 5, 5}},
       RectangleLight{{0, 3 - kNear, 0}, {1, 0, 0}, {0, 0, 1}, {5, 5, 5}}},
      {PointLight{{-1.1, 1.5, 0.5}, {5, 5, 5}}, PointLight{{-1.1 + kNear, 1.5, 0.5}, {5, 5, 5}}},
      {PointLight{{1, 3, 1}, {5, 5, 5}, {0, -1, 0}},
       PointLight{{1, 3 - kNear, 1}, {5, 5, 5}, {0, -1, 0}}},
      {SphereLight{{-1.5, 1.5, 0.5}, 0.4, {5, 5, 5}},
       SphereLight{{-1.5, 1.5, 0.5}, 0.4 + kNear, {5, 5, 5}}}};
  for (const auto& [on, before] : lights)
    for (const Depth depth : {Depth{0, 0}, {2, 0}, {0, 1}, {2, 2}}) {
      scene.depth = depth;
      scene.lights = {on};
      ASSERT_EQ(find_contacts(scene)[0].size(), 1u);
      const Image here = render(scene, {}).image;
      scene.lights = {before};
      ASSERT_TRUE(find_contacts(scene)[0].empty());
      const Image there = render(scene, {}).image;
      EXPECT_NEAR(mean(here) / mean(there), 1, 1e-3);
      int apart = 0;
      for (std::size_t i = 0; i < here.values().size(); ++i)
        apart += std::abs(here.values()[i] - there.values()[i]) > 0.02 * mean(there);
      // A hair decides where a few paths turn.
      EXPECT_LT(apart, 0.02 * double(here.values().size()));
    }
}

TEST(ABallOfLightThatTouchesAPlane, GivesAllItsLightToItsSide) {
  Scene scene = room();
  scene.sampler.sample_count = 16;
  scene.planes.erase(scene.planes.begin());
  scene.materials.push_back({"black", scene.materials[0].highlight, {}, {}});
  scene.lights = {SphereLight{{-1.5, 2.5, 0.5}, 0.5, {5, 5, 5}}};
  const double alone = mean(render(scene, {}).image);
  scene.planes.push_back({{7, 3, 1}, {0, 1, 0}, 2, 2, 1});
  EXPECT_NEAR(mean(render(scene, {}).image) / alone, 1, 1e-6);
}

}  // namespace
}  // namespace lobelia

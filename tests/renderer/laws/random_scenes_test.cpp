// Laws of the plan and of its pictures on scenes at random: what the plan leaves out would do nothing.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "renderer/peak_bound.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/contact.hpp"
#include "tests/more_samples.hpp"
#include "tests/renderer/random_scene.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

constexpr Precision kPrecisions[] = {Precision::kFloat32, Precision::kMixed, Precision::kFloat64};

RenderOptions with(EffectPolicy effects) {
  RenderOptions options;
  options.effects = effects;
  return options;
}

/// Empty if the two pictures are one, bit for bit.
std::string difference(const Image& a, const Image& b, std::string_view what) {
  for (std::size_t i = 0; i < a.values().size(); ++i)
    if (const float x = a.values()[i], y = b.values()[i]; std::memcmp(&x, &y, sizeof x) != 0)
      return fmt::format("{}: pixel {}, {} is {:.9g}, and {:.9g} without\n", what,
                         int(i / 3) % a.width(), int(i / 3) / a.width(), y, x);
  return "";
}

/// The counted work against the plan's.
std::string wrong_counts(const RenderResult& r, std::string_view policy) {
  std::string wrong;
  const auto at_most = [&](std::uint64_t count, std::uint64_t most, std::string_view rays) {
    if (count > most)
      wrong += fmt::format("{}: {} {} rays, {} expected at most\n", policy, count, rays, most);
  };
  at_most(r.work.camera_rays, r.plan.camera_rays, "camera");
  at_most(r.work.shadow_rays, r.plan.max_shadow_rays, "shadow");
  at_most(r.work.mirror_rays, r.plan.max_mirror_rays, "mirror");
  at_most(r.work.scattered_rays, r.plan.max_scattered_rays, "scattered");
  for (std::size_t e = 0; e < r.plan.effects.size(); ++e)
    if (!r.plan.effects[e].on && r.work.of_effect[e] > 0)
      wrong += fmt::format("{}: {} is off and did {}\n", policy, r.plan.effects[e].name,
                           r.work.of_effect[e]);
  return wrong;
}

TEST(RandomScenes, AreTheSameBitForBitWithEveryEffectForced) {
  int lit = 0;
  expect_of_random_scenes(SceneKind::kExact, 400, [&](const Scene& random_one, Random& random) {
    Scene scene = random_one;
    scene.sampler.averages_small_highlights = random.chance(0.5);
    const RenderResult planned = render(scene, with(EffectPolicy::kAsCalledFor)),
                       all = render(scene, with(EffectPolicy::kAll));
    lit += std::any_of(planned.image.values().begin(), planned.image.values().end(),
                       [](float v) { return v > 0; });
    return difference(planned.image, all.image, "with all effects") +
           wrong_counts(planned, "as called for") + wrong_counts(all, "all");
  });
  EXPECT_GT(lit, 100);
}

/// A change to a scene that makes the plan turn an effect on, or take another way, and brings nothing.
struct Idle {
  const char* name;
  std::function<bool(Scene&, Random&)> change;  ///< false where it would bring something
};

void add_dust(Scene& scene, Random& random, int count) {
  // Too small for any ray of so few to meet.
  for (int i = 0; i < count; ++i)
    scene.spheres.push_back({random.log_between(20, 2000) * random.direction(), 1e-9, 0});
}

const std::vector<Idle>& idle_changes() {
  constexpr double kNothing = 1e-300;  // far below what a float can hold, and not 0
  static const Rgb faint{kNothing, kNothing, kNothing};
  static const std::vector<Idle> changes = {
      {"a diffuse base of 1e-300",
       [](Scene& s, Random&) {
         for (Material& m : s.materials)
           if (is_black(m.diffuse_reflectance)) m.diffuse_reflectance = faint;
         return true;
       }},
      {"a Fresnel factor of a material that nothing has",
       [](Scene& s, Random&) {
         s.materials.push_back(s.materials.front());
         s.materials.back().fresnel = Fresnel::kSchlick;
         return true;
       }},
      {"a mirror of 1e-300 on what is none",
       [](Scene& s, Random&) {
         bool real = false;
         for (const Material& m : s.materials) real |= !is_black(m.mirror_reflectance);
         if (!real) s.depth.mirror = 3;
         for (Material& m : s.materials)
           if (is_black(m.mirror_reflectance)) m.mirror_reflectance = faint;
         return true;
       }},
      {"mirror_depth where nothing is a mirror",
       [](Scene& s, Random& random) {
         s.depth.mirror = random.below(5);
         return std::all_of(s.materials.begin(), s.materials.end(),
                            [](const Material& m) { return is_black(m.mirror_reflectance); });
       }},
      {"a light of 1e-300 with a size",
       [](Scene& s, Random& random) {
         const Light lights[] = {SphereLight{3 * random.vector(), 0.5, faint},
                                 RectangleLight{3 * random.vector(), {1, 0, 0}, {0, 0, 1}, faint},
                                 ConstantLight{faint}, EnvmapLight{faint, sky(), "sky.exr"}};
         s.lights.push_back(lights[random.below(4)]);
         return true;
       }},
      {"a lamp of every kind that does not shine",
       [](Scene& s, Random& random) {
         s.lights.push_back(DirectionalLight{random.direction(), {}});
         s.lights.push_back(PointLight{random.vector(), {}});
         s.lights.push_back(SphereLight{random.vector(), 1, {}});
         s.lights.push_back(RectangleLight{random.vector(), {1, 0, 0}, {0, 0, 1}, {}});
         s.lights.push_back(EnvmapLight{{}, sky(), "sky.exr"});
         return true;
       }},
      {"a lens of radius 1e-300",
       [](Scene& s, Random&) {
         s.camera.aperture_radius = kNothing, s.camera.focus_distance = 1;
         return true;
       }},
      {"four rays through the same place",
       [](Scene& s, Random&) {
         s.sampler.sample_count = 4, s.film.filter.radius = kNothing;
         return true;
       }},
      {"64 rays through the same place, the later ones where they are needed",
       [](Scene& s, Random&) {
         s.sampler.sample_count = 64, s.film.filter.radius = kNothing;
         return true;
       }},
      {"inter-reflection of a single convex body",
       [](Scene& s, Random&) {
         s.depth.glossy = 2;
         return s.spheres.size() + s.planes.size() < 2;
       }},
      {"a speck of dust, and inter-reflection of a single convex body",
       [](Scene& s, Random& random) {
         const bool single = s.spheres.size() + s.planes.size() < 2;
         add_dust(s, random, 1);
         s.depth.glossy = 2;
         return single;
       }},
      {"a speck of dust",
       [](Scene& s, Random& random) {
         add_dust(s, random, 1);
         return true;
       }},
      {"a crowd of dust",
       [](Scene& s, Random& random) {
         add_dust(s, random, 30);
         return true;
       }},
      {"a crowd of dust too large to be looked at by pairs",
       [](Scene& s, Random& random) {
         add_dust(s, random, 300);
         return true;
       }},
      {"a black plane behind all, on the side that no light comes from",
       [](Scene& s, Random& random) {
         const Vec3 normal = random.direction();
         for (const Light& light : s.lights) {
           if (!is_delta(light)) return false;  // an environment is everywhere
           const auto* directional = std::get_if<DirectionalLight>(&light);
           if (directional && dot(directional->direction, normal) < 1e-3) return false;
         }
         Material black;
         black.highlight = s.materials.front().highlight;
         s.materials.push_back(black);
         const int material = int(s.materials.size()) - 1;
         // Beyond what all but one in a million rays along a plane meet. Farther, a light near a surface would lie on it
         // (renderer/scene/contact.hpp).
         const double largest_coordinate = 1e12 * closeness(s);
         s.planes.push_back({1e6 * largest_coordinate * normal, normal, material, material, 1});
         return true;
       }},
  };
  return changes;
}

TEST(RandomScenes, AreTheSameBitForBitWithEachEffectTurnedOnForNothing) {
  std::vector<int> tried(idle_changes().size());
  expect_of_random_scenes(SceneKind::kExact, 150, [&](const Scene& scene, Random& random) {
    std::string wrong;
    RenderOptions options;
    // The plan may choose another for another scene.
    options.precision = kPrecisions[random.below(3)];
    const Image picture = render(scene, options).image;
    for (std::size_t i = 0; i < tried.size(); ++i) {
      const Idle& idle = idle_changes()[i];
      Scene other = scene;
      if (!idle.change(other, random)) continue;
      ++tried[i];
      wrong += difference(picture, render(other, options).image, idle.name);
    }
    return wrong;
  });
  for (std::size_t i = 0; i < tried.size(); ++i) EXPECT_GT(tried[i], 10) << idle_changes()[i].name;
}

TEST(RandomScenes, HardlyChangeWithAMirrorThatHardlyReflects) {
  // Schlick's factor has no step where a mirror begins.
  int mirrors = 0;
  expect_of_random_scenes(SceneKind::kExact, 150, [&](const Scene& random_one, Random&) {
    Scene scene = random_one;
    for (Material& m : scene.materials) m.mirror_reflectance = {};
    scene.depth.mirror = 1;
    Scene faint = scene;
    constexpr double kFaint = 1e-9;
    for (Material& m : faint.materials) m.mirror_reflectance = {kFaint, kFaint, kFaint};
    RenderOptions options;
    options.precision = Precision::kFloat64;
    const Image without = render(scene, options).image;
    const RenderResult with = render(faint, options);
    mirrors += with.work.mirror_rays > 0;
    const double once = peak_bound(scene, scene.lights);
    for (std::size_t i = 0; i < without.values().size(); ++i) {
      const double a = without.values()[i], b = with.image.values()[i];
      // Fifty times as much at grazing angles, of at most what one more surface may be as bright as.
      if (!(std::abs(a - b) <= 50 * kFaint * once + 1.3e-7 * a))
        return fmt::format("value {} is {:.9g} without a mirror, {:.9g} with one of 1e-9", i, a, b);
    }
    return std::string();
  });
  EXPECT_GT(mirrors, 50);
}

TEST(RandomScenes, AreTheSameBitForBitByFusedKernels) {
  int fused = 0;
  const auto law = [&](const Scene& scene, Random&) {
    RenderOptions other;
    other.allow_fused = false;
    other.threads = 1;
    const RenderResult here = render(scene, {});
    fused += here.plan.kernel.starts_with("fused");
    return difference(render(scene, other).image, here.image, "fused or in threads");
  };
  expect_of_random_scenes(SceneKind::kExact, 300, law);
  EXPECT_GT(fused, 30);
  expect_of_random_scenes(SceneKind::kAny, 100, law);
}

/// The record of the render, but for its times.
std::string figures(const RenderResult& r) {
  return fmt::format("{} samples, error {:.17g}, stopped {}, rays {} {} {} {}, work {}", r.samples,
                     r.error.value_or(-1), r.stop_reason, r.work.camera_rays, r.work.shadow_rays,
                     r.work.mirror_rays, r.work.scattered_rays, fmt::join(r.work.of_effect, " "));
}

/// Adds what cannot change the picture, each part with its chance; what it added, in words.
std::string add_idle_parts(Scene& s, Random& random) {
  std::string added;
  const Light black[] = {DirectionalLight{random.direction(), {}},
                         PointLight{random.vector(), {}},
                         SphereLight{random.vector(), 1, {}},
                         RectangleLight{random.vector(), {1, 0, 0}, {0, 0, 1}, {}},
                         ConstantLight{},
                         EnvmapLight{{}, sky(), "sky.exr"},
                         EnvmapLight{{1, 1, 1}, std::make_shared<Image>(2, 1), "black.exr"}};
  for (const Light& light : black)
    if (random.chance(0.4)) {
      s.lights.insert(s.lights.begin() + random.below(int(s.lights.size()) + 1), light);
      added += fmt::format("{} ", info(light).type);
    }
  if (s.spheres.size() + s.planes.size() < 2 && random.chance(0.5)) {
    s.depth.glossy = 8;
    added += "glossy_depth ";
  }
  if (std::ranges::none_of(s.materials, is_mirror) && random.chance(0.5)) {
    s.depth.mirror = 1 + random.below(4);
    added += "mirror_depth ";
  }
  if (s.sampler.sample_count == 1 && random.chance(0.5)) {
    s.film.filter = *find_filter(random.one_of(filter_names()));
    added += "filter ";
  }
  return added;
}

TEST(RandomScenes, CostNoMoreWithPartsThatCannotChangeThem) {
  int changed = 0;
  expect_of_random_scenes(SceneKind::kAny, 200, [&](const Scene& scene, Random& random) {
    Scene other = scene;
    const std::string added = add_idle_parts(other, random);
    if (added.empty()) return std::string();
    ++changed;
    RenderOptions options;
    options.max_samples = kMostRandomSamples;
    const RenderResult without = render(scene, options), with = render(other, options);
    std::string wrong = difference(without.image, with.image, added);
    if (figures(with) != figures(without))
      wrong += fmt::format("{}: {}, and {} without\n", added, figures(with), figures(without));
    if (with.plan.kernel != without.plan.kernel)
      wrong +=
          fmt::format("{}: {}, and {} without\n", added, with.plan.kernel, without.plan.kernel);
    for (std::size_t e = 0; e < with.plan.effects.size(); ++e)
      if (with.plan.effects[e].on != without.plan.effects[e].on)
        wrong += fmt::format("{}: {} is turned over\n", added, with.plan.effects[e].name);
    return wrong;
  });
  EXPECT_GT(changed, 100);
}

TEST(RandomScenes, AreTheSameBitForBitInBandsAsInOnePieceInAnyNumberOfThreads) {
  int several_bands = 0, noisy = 0;
  const auto law = [&](const Scene& random_one, Random& random) {
    Scene scene = random_one;
    scene.film.width = 1 + random.below(100);
    scene.film.height = 1 + random.below(200);
    scene.sampler.averages_small_highlights = random.chance(0.5);
    RenderOptions options;
    if (random.chance(0.2)) options.target_error = 0.3, options.max_samples = 8;
    const RenderResult whole = render(scene, options);
    options.threads = 1 + random.below(4);
    options.band_pixels = 1 + random.below(10000);
    Image rows(scene.film.width, scene.film.height);
    int next = 0, bands = 0;
    const RenderResult streamed = render(scene, options, [&](int y, int count, const float* rgb) {
      if (y == next) std::copy_n(rgb, 3 * count * rows.width(), rows.pixel(0, y).data());
      next = y == next ? y + count : -1;
      ++bands;
    });
    several_bands += bands > 1;
    noisy += streamed.error.has_value();
    if (next != rows.height()) return std::string("a row is missing, or comes twice\n");
    if (streamed.image.pixel_count() > 0) return std::string("the picture is held as well\n");
    if (figures(streamed) != figures(whole))
      return fmt::format("{} in bands,\n{} in one piece\n", figures(streamed), figures(whole));
    return difference(whole.image, rows, "in bands");
  };
  expect_of_random_scenes(SceneKind::kExact, 70 * more_samples(), law);
  expect_of_random_scenes(SceneKind::kAny, 35 * more_samples(), law);
  EXPECT_GT(several_bands, 35 * more_samples());
  EXPECT_GT(noisy, 7 * more_samples());
}

TEST(RandomScenes, AreFiniteAndNotNegative) {
  int random_ones = 0;
  expect_of_random_scenes(SceneKind::kAny, 300, [&](const Scene& random_one, Random& random) {
    Scene scene = random_one;
    scene.sampler.averages_small_highlights = random.chance(0.5);
    const RenderResult result =
        render(scene, with(random.chance(0.5) ? EffectPolicy::kAsCalledFor : EffectPolicy::kAll));
    random_ones += result.error.has_value();
    // Mitchell's filter alone is negative somewhere.
    const bool negative = scene.sampler.sample_count > 1 && name(scene.film.filter) == "mitchell";
    for (const float v : result.image.values())
      if (!std::isfinite(v) || (v < 0 && !negative)) return fmt::format("a value is {}", v);
    return wrong_counts(result, "random");
  });
  EXPECT_GT(random_ones, 100);
}

TEST(RandomScenes, AreNoBrighterThanTheirBound) {
  double closest = 0;
  expect_of_random_scenes(SceneKind::kExact, 400, [&](const Scene& scene, Random&) {
    const double bound = peak_bound(scene, scene.lights);
    const Image image = render(scene, {}).image;
    for (const float v : image.values()) {
      if (!(v <= bound * (1 + 1e-6)))
        return fmt::format("a value is {:.9g}; the bound is {:.9g}", v, bound);
      if (bound > 0) closest = std::max(closest, v / bound);
    }
    return std::string();
  });
  EXPECT_GT(closest, 0.5) << "a bound that nothing comes near";
}

/// Sums of all values of pictures by other seeds.
struct Sums {
  double count = 0, mean = 0, spread = 0;
  void add(double value) {
    const double before = value - mean;
    mean += before / ++count;
    spread += before * (value - mean);
  }
  double variance_of_mean() const { return spread / (count - 1) / count; }
};

TEST(RandomScenes, AreAsBrightWithinTheNoiseWithEveryEffectForced) {
  int noisy = 0;
  expect_of_random_scenes(SceneKind::kAny, 120, [&](const Scene& random_one, Random& random) {
    Scene scene = random_one;
    Sums sums[2];
    const std::uint64_t first = random.bits() >> 12;
    const auto apart = [&] {
      const double difference = std::abs(sums[0].mean - sums[1].mean);
      // The plan's precision is the same; float32 rounds each value.
      const double roundings = 1e-6 * (sums[0].mean + sums[1].mean);
      return std::max(0.0, difference - roundings) /
             std::sqrt(sums[0].variance_of_mean() + sums[1].variance_of_mean() + 1e-300);
    };
    const auto take = [&](int until) {
      for (int seed = int(sums[0].count); seed < until; ++seed)
        for (const int policy : {0, 1}) {
          scene.sampler.seed = (first + std::uint64_t(2 * seed + policy)) % (1ull << 52);
          const Image image =
              render(scene, with(policy == 0 ? EffectPolicy::kAsCalledFor : EffectPolicy::kAll))
                  .image;
          double sum = 0;
          for (const float v : image.values()) sum += v;
          sums[policy].add(sum);
        }
    };
    // A path that is rarely drawn makes a mean look certain that is not: what seems to differ is looked at
    // again with more pictures, and must differ by more.
    double t = 0;
    for (const auto& [pictures, allowed] :
         {std::pair(8, 4.5), {64, 5.0}, {512, 6.0}, {4096, 6.5}}) {
      take(pictures);
      t = apart();
      if (pictures == 8) noisy += sums[0].spread > 0;
      if (t < allowed) return std::string();
    }
    return fmt::format("the sum of all values is {:.6g}, and {:.6g} with all effects: {:.1f} sigma",
                       sums[0].mean, sums[1].mean, t);
  });
  EXPECT_GT(noisy, 50);
}

}  // namespace
}  // namespace lobelia

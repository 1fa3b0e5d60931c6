#include "tests/renderer/random_scene.hpp"

#include <fmt/format.h>

#include <chrono>

#include "base/pictures/exr_writer.hpp"
#include "renderer/frame.hpp"
#include "renderer/scene/scene_format.hpp"
#include "renderer/scene/scene_io.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

constexpr char kSkyFile[] = "sky.exr";

/// Mostly in between; now and then what is none, hardly there, or all.
double reflectance(Random& random) {
  const int which = random.below(10);
  if (which == 0) return 0;
  if (which == 1) return 1;
  if (which == 2) return random.log_between(1e-12, 0.1);
  return random.even();
}
Rgb colour(Random& random) {
  if (random.chance(0.5)) return reflectance(random) * Rgb{1, 1, 1};
  return {reflectance(random), reflectance(random), reflectance(random)};
}
Rgb strength(Random& random) {
  if (random.chance(0.1)) return {};
  const double scale = random.log_between(0.1, 30);
  return random.chance(0.5) ? scale * Rgb{1, 1, 1}
                            : scale * Rgb{random.even(), random.even(), random.even()};
}

/// Some of them by their formula.
LobeId member_of_the_family(int order) {
  return order % 8 == 6 ? formula_lobe(fmt::format("max(0, 1 - n*s/{0})^{0}", order))
                        : *find_lobe(fmt::format("cs{}", order));
}

Material material(Random& random) {
  Material m;
  m.highlight.model = random.one_of(all_models());
  m.highlight.lobe = random.chance(0.1) ? member_of_the_family(2 * (1 + random.below(64)))
                                        : random.one_of(all_lobes());
  if (has_paper_coefficient(m.highlight.lobe) && random.chance(0.25))
    m.highlight.normalisation = Normalisation::kPaper;
  const int sharpness = random.below(10);
  m.highlight.exponent = sharpness == 0   ? random.log_between(1e-3, 1)
                         : sharpness == 1 ? random.log_between(1e4, kMaxExponent)
                         : sharpness < 5  ? std::exp2(random.below(12))
                                          : random.log_between(1, 1e4);
  if (m.highlight.exponent < 2e-3) m.highlight.exponent = 0;
  if (random.chance(0.4)) m.fresnel = Fresnel::kSchlick;
  m.specular_reflectance = colour(random);
  if (random.chance(0.5)) m.diffuse_reflectance = colour(random);
  if (random.chance(0.4)) m.mirror_reflectance = colour(random);
  return m;
}

Vec3 on_surface(Random& random, const Scene& scene) {
  const int k = random.below(int(scene.spheres.size() + scene.planes.size()));
  if (k < int(scene.spheres.size())) {
    const Sphere& sphere = scene.spheres[std::size_t(k)];
    return sphere.center + sphere.radius * random.direction();
  }
  const Plane& plane = scene.planes[std::size_t(k) - scene.spheres.size()];
  const Tangents t = tangents(plane.normal);
  return plane.point + random.between(-2, 2) * t.first + random.between(-2, 2) * t.second;
}

Light light(Random& random, const Scene& scene, SceneKind kind, bool simple) {
  const bool on_a_surface = random.chance(0.1) && !(scene.spheres.empty() && scene.planes.empty());
  const Vec3 place = on_a_surface ? on_surface(random, scene) : 4 * random.vector();
  const int which = random.below(simple && kind == SceneKind::kExact ? 6 : 10);
  if (which < 3) return DirectionalLight{random.direction(), strength(random)};
  if (which == 5 && !simple) {
    const double cutoff = random.between(1, 90);
    return SpotLight{place, random.direction(), strength(random), cutoff,
                     cutoff * random.between(0, 0.99)};
  }
  if (which < 6)
    return PointLight{place, strength(random),
                      !simple && random.chance(0.3) ? random.direction() : Vec3{}};
  // One that does not shine is there all the same, and draws its random numbers where all effects are forced.
  const Rgb radiance = kind == SceneKind::kExact ? Rgb{} : strength(random);
  if (which == 6) return SphereLight{place, random.log_between(0.01, 2), radiance};
  if (which == 7) {
    const Tangents t = tangents(random.direction());
    return RectangleLight{place, random.log_between(0.01, 2) * t.first,
                          random.log_between(0.01, 2) * t.second, radiance};
  }
  if (which == 8) return ConstantLight{radiance};
  return EnvmapLight{radiance, sky(), kSkyFile};
}

Camera camera(Random& random, const Scene& scene) {
  Camera c;
  c.origin = random.log_between(1, 12) * random.direction();
  c.target = scene.spheres.empty()
                 ? random.vector()
                 : random.one_of(std::span(scene.spheres)).center + 0.3 * random.vector();
  const int where = random.below(20);
  if (!scene.spheres.empty() && where < 2) {
    // Inside a sphere, or as near to its surface as numbers come.
    const Sphere& sphere = scene.spheres[std::size_t(random.below(int(scene.spheres.size())))];
    c.origin = sphere.center +
               (where == 0 ? random.even() * sphere.radius : sphere.radius) * random.direction();
  }
  c.up = random.chance(0.5) ? Vec3{0, 1, 0} : random.direction();
  if (length(c.target - c.origin) < 1e-3) c.target = c.origin + random.direction();
  const Vec3 view = normalize(c.target - c.origin);
  if (length(cross(view, c.up)) < 1e-3) c.up = tangents(view).first;
  c.fov_degrees = random.chance(0.8) ? random.between(10, 70) : random.log_between(0.5, 170);
  if (random.chance(0.2)) {
    c.principal_point_offset_x = random.between(-0.5, 0.5);
    c.principal_point_offset_y = random.between(-0.5, 0.5);
  }
  return c;
}

/// The scene in other units: nothing but its coordinates may change the picture.
void scale(Scene& scene, double by) {
  scene.camera.origin = by * scene.camera.origin;
  scene.camera.target = by * scene.camera.target;
  scene.camera.aperture_radius *= by;
  scene.camera.focus_distance *= by;
  for (Sphere& s : scene.spheres) s.center = by * s.center, s.radius *= by;
  for (Plane& p : scene.planes) p.point = by * p.point, p.checker_size *= by;
  for (Light& any : scene.lights) {
    if (auto* point = std::get_if<PointLight>(&any))
      point->position = by * point->position, point->intensity = by * by * point->intensity;
    if (auto* ball = std::get_if<SphereLight>(&any))
      ball->center = by * ball->center, ball->radius *= by;
    if (auto* rectangle = std::get_if<RectangleLight>(&any)) {
      rectangle->center = by * rectangle->center;
      rectangle->half_u = by * rectangle->half_u;
      rectangle->half_v = by * rectangle->half_v;
    }
  }
}

/// The scene that the scene's text reads back as. The text has no pictures.
Scene as_written(Scene scene) {
  std::vector<bool> pictures;
  for (Light& any : scene.lights) {
    pictures.push_back(!picture_file(any).empty());
    if (pictures.back()) any = ConstantLight{strength(any)};
  }
  Scene read = parse_scene(scene_to_xml(scene), "random scene");
  for (std::size_t l = 0; l < pictures.size(); ++l)
    if (pictures[l]) read.lights[l] = EnvmapLight{strength(read.lights[l]), sky(), kSkyFile};
  return read;
}

std::uint64_t number_of(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 0) : otherwise;
}

/// Where LOBELIA_RANDOM_FINDS says; returns what to do with it.
std::string save(const Scene& scene, const std::string& name) {
  const char* folder = std::getenv("LOBELIA_RANDOM_FINDS");
  if (!folder) return "";
  const std::filesystem::path file = std::filesystem::path(folder) / (name + ".xml");
  std::ofstream(file) << scene_to_xml(scene);
  ExrWriter writer(std::filesystem::path(folder) / kSkyFile, sky()->width(), sky()->height(), {});
  writer.write_rows(0, sky()->height(), sky()->values().data());
  writer.finish();
  return fmt::format("lobelia render {} -o out.exr\n", file.string());
}

/// Every scene with a little less than this one has.
std::vector<Scene> simpler(const Scene& scene) {
  std::vector<Scene> found;
  const auto without = [&](auto member) {
    for (std::size_t i = 0; i < (scene.*member).size(); ++i) {
      Scene other = scene;
      (other.*member).erase((other.*member).begin() + std::ptrdiff_t(i));
      found.push_back(std::move(other));
    }
  };
  // Halves first: a crowd would go one by one.
  if (scene.spheres.size() > 4)
    for (const bool first : {true, false}) {
      Scene other = scene;
      const auto middle = other.spheres.begin() + std::ptrdiff_t(other.spheres.size() / 2);
      other.spheres.erase(first ? other.spheres.begin() : middle,
                          first ? middle : other.spheres.end());
      found.push_back(std::move(other));
    }
  without(&Scene::lights);
  without(&Scene::spheres);
  without(&Scene::planes);
  const auto less = [&](int value, int least, auto&& put) {
    for (const int smaller : {least, value / 2, value - 1})
      if (smaller >= least && smaller < value) put(found.emplace_back(scene)) = smaller;
  };
  less(scene.film.width, 1, [](Scene& s) -> int& { return s.film.width; });
  less(scene.film.height, 1, [](Scene& s) -> int& { return s.film.height; });
  less(scene.sampler.sample_count, 1, [](Scene& s) -> int& { return s.sampler.sample_count; });
  less(scene.depth.mirror, 0, [](Scene& s) -> int& { return s.depth.mirror; });
  less(scene.depth.glossy, 0, [](Scene& s) -> int& { return s.depth.glossy; });
  return found;
}

}  // namespace

Vec3 Random::direction() {
  for (;;) {
    const Vec3 v = vector();
    if (const double square = dot(v, v); square > 1e-4 && square < 1) return normalize(v);
  }
}

std::shared_ptr<const Image> sky() {
  static const auto picture = [] {
    auto image = std::make_shared<Image>(32, 16);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 32; ++x) {
        const bool sun = x > 19 && x < 22 && y > 3 && y < 6;
        const auto pixel = image->pixel(x, y);
        for (int channel = 0; channel < 3; ++channel)
          pixel[std::size_t(channel)] = sun ? 40.0f : 0.1f + 0.02f * float(y * channel);
      }
    return std::shared_ptr<const Image>(std::move(image));
  }();
  return picture;
}

Scene random_scene(std::uint64_t seed, SceneKind kind) {
  Random random(seed);
  const bool any = kind == SceneKind::kAny;
  Scene scene;
  // One in four is simple enough for the fused kernels.
  const bool simple = random.chance(0.25);
  for (int count = 1 + random.below(4); count > 0; --count) {
    scene.materials.push_back(material(random));
    if (simple) scene.materials.back().mirror_reflectance = {};
  }
  const int materials = int(scene.materials.size());
  const int crowd = random.below(40);
  const int spheres = simple       ? 1 + random.below(2)
                      : crowd == 0 ? 260 + random.below(40)
                      : crowd == 1 ? 25 + random.below(40)
                                   : random.below(7);
  for (int i = 0; i < spheres; ++i) {
    if (i > 0 && random.chance(0.03)) {  // one in the place of another
      scene.spheres.push_back(scene.spheres[std::size_t(random.below(i))]);
      scene.spheres.back().material = random.below(materials);
      continue;
    }
    const double most = spheres > 10 ? 0.3 : 1.2;
    scene.spheres.push_back(
        {2 * random.vector(), random.log_between(0.03, most), random.below(materials)});
  }
  for (int count = simple ? 0 : random.below(4) - 1; count > 0; --count) {
    const Vec3 normal = random.chance(0.5) ? Vec3{0, 1, 0} : random.direction();
    const int first = random.below(materials);
    scene.planes.push_back({random.between(-2.5, 0) * normal + 1e-3 * random.vector(), normal,
                            first, random.chance(0.4) ? random.below(materials) : first,
                            random.log_between(0.2, 3)});
  }
  for (int count = random.chance(0.05) ? 0 : 1 + random.below(simple ? 2 : 5); count > 0; --count)
    scene.lights.push_back(light(random, scene, kind, simple));
  scene.camera = camera(random, scene);
  scene.film = {1 + random.below(18), 1 + random.below(18)};
  scene.depth.mirror = random.below(5);
  scene.sampler.seed = random.bits() >> 12;
  if (any) {
    if (random.chance(0.7)) scene.sampler.sample_count = 1 + random.below(kMostRandomSamples);
    if (random.chance(0.5)) {
      scene.film.filter = *find_filter(random.one_of(filter_names()));
      if (random.chance(0.5)) scene.film.filter.radius = random.log_between(0.1, 4);
    }
    if (random.chance(0.25)) {
      scene.camera.aperture_radius = random.log_between(1e-3, 0.5);
      scene.camera.focus_distance = random.log_between(0.5, 10);
    }
    if (random.chance(0.4)) scene.depth.glossy = 1 + random.below(3);
  }
  if (random.chance(0.15)) scale(scene, random.log_between(1e-4, 1e3));
  return as_written(std::move(scene));
}

Scene shrunk(Scene scene, const std::function<bool(const Scene&)>& fails) {
  // Bounded: each step leaves less, but a law may be slow.
  for (int tried = 0; tried < 5000;) {
    bool smaller = false;
    for (Scene& other : simpler(scene)) {
      if (++tried > 5000) break;
      if (!fails(other)) continue;
      scene = std::move(other);
      smaller = true;
      break;
    }
    if (!smaller) break;
  }
  return scene;
}

void expect_of_random_scenes(SceneKind kind, int count, const SceneLaw& law) {
  using Clock = std::chrono::steady_clock;
  const std::uint64_t first = number_of("LOBELIA_RANDOM_SEED", 1);
  const auto end = Clock::now() + std::chrono::seconds(number_of("LOBELIA_RANDOM_SECONDS", 0));
  const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
  std::uint64_t seed = first;
  for (; seed < first + std::uint64_t(count) || Clock::now() < end; ++seed) {
    // The law draws the same numbers for each scene that comes of the seed.
    const auto wrong = [&](const Scene& scene) {
      Random random(~seed);
      return law(scene, random);
    };
    const Scene scene = random_scene(seed, kind);
    const std::string problem = wrong(scene);
    if (problem.empty()) continue;
    // A smaller scene that breaks the law in another way is another find.
    const auto way = [](const std::string& p) {
      return p.substr(0, p.find_first_of(":0123456789"));
    };
    const Scene smallest = shrunk(scene, [&](const Scene& s) {
      const std::string other = wrong(s);
      return !other.empty() && way(other) == way(problem);
    });
    ADD_FAILURE() << "random scene " << seed << " (LOBELIA_RANDOM_SEED): " << problem
                  << "\nThe smallest that breaks the law: " << wrong(smallest) << "\n"
                  << save(smallest, fmt::format("{}-{}", name, seed)) << scene_to_xml(smallest);
    return;
  }
  if (Clock::now() >= end && seed > first + std::uint64_t(count))
    fmt::print("{}: {} random scenes from seed {}\n", name, seed - first, first);
}

}  // namespace lobelia

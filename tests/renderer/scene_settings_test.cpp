// The lens, the filter, how far light is followed, mirrors.
#include "renderer/scene/scene_format.hpp"
#include "renderer/scene/sphere_lattice.hpp"
#include "tests/renderer/scene_text.hpp"

namespace lobelia {
namespace {

Scene with_sensor(const std::string& text) { return again(parse_scene(scene("", text), "s.xml")); }
std::string film(const std::string& body) { return "<film type=\"hdrfilm\">" + body + "</film>"; }
std::string filter(const std::string& type, const std::string& body = {}) {
  return "<rfilter type=\"" + type + "\">" + body + "</rfilter>";
}
std::string bsdf(const std::string& more) {
  return "<bsdf type=\"phong_rdf\" id=\"m\"><float name=\"exponent\" value=\"8\"/>" + more +
         "</bsdf>";
}

TEST(SceneLens, IsReadAndWrittenToTheLastDigit) {
  const Scene s = with_sensor(sensor("thinlens", given("float", "aperture_radius", "0.1") +
                                                     given("float", "focus_distance", "4.7")));
  EXPECT_EQ(s.camera.aperture_radius, 0.1);
  EXPECT_EQ(s.camera.focus_distance, 4.7);
  const Scene pinhole = with_sensor(sensor("thinlens", given("float", "focus_distance", "3.3")));
  EXPECT_EQ(pinhole.camera.aperture_radius, 0);
  EXPECT_EQ(pinhole.camera.focus_distance, 3.3);
  EXPECT_EQ(with_sensor(kSensor).camera.aperture_radius, 0);
}

TEST(SceneCamera, MayHaveItsFilmAside) {
  for (const auto& [x, y] : {std::pair("0.25", "-0.1"), {"0", "-0.1"}, {"0.25", "0"}}) {
    const std::string offsets = given("float", "principal_point_offset_x", x) +
                                given("float", "principal_point_offset_y", y);
    for (const auto& text : {sensor("perspective", offsets),
                             sensor("thinlens", offsets + given("float", "focus_distance", "2"))}) {
      const Camera camera = with_sensor(text).camera;
      EXPECT_EQ(camera.principal_point_offset_x, std::stod(x));
      EXPECT_EQ(camera.principal_point_offset_y, std::stod(y));
    }
  }
  EXPECT_EQ(with_sensor(kSensor).camera.principal_point_offset_x, 0);
}

TEST(SceneFilter, IsReadAndWrittenByEveryNameAndRadius) {
  int count = 0;
  for (const std::string_view name : filter_names()) {
    ++count;
    const Film plain = with_sensor(sensor("perspective", film(filter(std::string(name))))).film;
    EXPECT_EQ(plain.filter, *find_filter(name));
    const Film wide =
        with_sensor(
            sensor("perspective", film(filter(std::string(name), given("float", "radius", "1.7")))))
            .film;
    EXPECT_EQ(lobelia::name(wide.filter), name);
    EXPECT_EQ(wide.filter.radius, 1.7);
  }
  EXPECT_EQ(count, 5);
  EXPECT_EQ(with_sensor(kSensor).film.filter, Filter{});
}

TEST(SceneDepth, ComesFromTheIntegratorOrIsEightForMirrors) {
  const auto scene_of = [](const std::string& body) {
    return again(parse_scene(scene(body), "s.xml"));
  };
  const std::string mirror = bsdf(given("rgb", "mirror_reflectance", "0.1, 0.5, 0.9"));
  const std::string both = "<integrator type=\"path\">" + given("integer", "mirror_depth", "5") +
                           given("integer", "glossy_depth", "64") + "</integrator>";
  EXPECT_EQ(scene_of("").depth.mirror, 0);
  EXPECT_EQ(scene_of(both).depth.mirror, 5);
  EXPECT_EQ(scene_of(both).depth.glossy, 64);
  EXPECT_EQ(scene_of(both + mirror).depth.mirror, 5);
  EXPECT_EQ(scene_of("<integrator type=\"path\"/>" + mirror).depth.mirror, 0);
  Scene by_default = scene_of(mirror);
  EXPECT_EQ(by_default.materials[0].mirror_reflectance, (Rgb{0.1, 0.5, 0.9}));
  EXPECT_EQ(by_default.depth.mirror, kDefaultMirrorDepth);
  EXPECT_EQ(by_default.depth.glossy, 0);
  by_default.depth = {};
  EXPECT_EQ(again(by_default).depth.mirror, 0) << "what was set by hand is kept";
}

TEST(SceneSettings, EveryErrorHasItsPlace) {
  const BadScene bad[] = {
      {scene("", sensor("perspective", given("float", "aperture_radius", "1"))),
       "s.xml:2:160: <sensor> has no parameter 'aperture_radius'; allowed: fov, "
       "principal_point_offset_x, principal_point_offset_y"},
      {scene("", sensor("perspective", film(filter("box") + filter("tent")))),
       "s.xml:2:199: a second <rfilter>; one is allowed"},
      {scene("<integrator type=\"path\"/><integrator type=\"path\"/>"),
       "s.xml:3:27: a second <integrator>; one is allowed"},
      {scene("<integrator type=\"path\">" + given("integer", "mirror_depth", "65") +
             "</integrator>"),
       "s.xml:3:61: mirror_depth '65' is out of range; allowed: 0 to 64"},
      {scene("<integrator type=\"path\">" + given("integer", "glossy_depth", "1.5") +
             "</integrator>"),
       "s.xml:3:61: glossy_depth '1.5' is not a whole number; allowed: 0 to 64"},
      {scene(bsdf(given("rgb", "mirror_reflectance", "1.5"))),
       "s.xml:3:103: mirror_reflectance '1.5' is out of range; allowed: 0 to 1"},
  };
  for (const auto& [text, message] : bad) EXPECT_EQ(error_of(text), message) << text;
}

std::string shape(const std::string& type, const std::string& body,
                  const std::string& material = "<ref id=\"m\"/>") {
  return "<shape type=\"" + type + "\">" + body + material + "</shape>";
}
std::string lattice(int columns, int rows, int layers, const std::string& more = {}) {
  return shape("sphere_lattice", given("integer", "columns", std::to_string(columns)) +
                                     given("integer", "rows", std::to_string(rows)) +
                                     given("integer", "layers", std::to_string(layers)) +
                                     given("vector", "step", "3, 4, 5") + more);
}
Scene read(const std::string& body) { return again(parse_scene(scene(kMaterial + body), "s.xml")); }

TEST(ScenePlanes, ArePlainWithOneMaterialAndACheckerWithTwo) {
  const std::string other =
      "<bsdf type=\"phong_rdf\"><float name=\"exponent\" value=\"9\"/></bsdf>";
  const Scene s = read(shape("plane", "") + shape("plane",
                                                  given("point", "point", "1, -1, 0.1") +
                                                      given("vector", "normal", "0, 3, 4") +
                                                      given("float", "checker_size", "0.3"),
                                                  "<ref id=\"m\"/>" + other));
  ASSERT_EQ(s.planes.size(), 2u);
  EXPECT_EQ(s.planes[0].point, (Vec3{0, 0, 0}));
  EXPECT_EQ(s.planes[0].normal, (Vec3{0, 1, 0}));
  EXPECT_EQ(s.planes[0].checker_size, 1);
  EXPECT_EQ(s.planes[0].checker_material, s.planes[0].material);
  EXPECT_EQ(s.planes[1].point, (Vec3{1, -1, 0.1}));
  EXPECT_NEAR(s.planes[1].normal.y, 0.6, 1e-15);
  EXPECT_EQ(s.planes[1].checker_size, 0.3);
  EXPECT_EQ(s.materials[s.planes[1].material].highlight.exponent, 8);
  EXPECT_EQ(s.materials[s.planes[1].checker_material].highlight.exponent, 9);
}

TEST(SceneShapes, EveryErrorHasItsPlace) {
  const std::string third = "<ref id=\"m\"/><ref id=\"m\"/><ref id=\"m\"/>";
  const auto with = [](const std::string& body) {
    return "<scene version=\"1\">\n" + std::string(kSensor) + kMaterial + "\n" + body +
           "\n</scene>";
  };
  const BadScene bad[] = {
      {with(shape("plane", given("vector", "normal", "0, 0, 0"))),
       "s.xml:3:2: normal is zero; allowed: any other vector"},
      {with(shape("plane", "", third)),
       "s.xml:3:48: a third material in one <shape>; two are allowed"},
      {with(shape("sphere", "", third)),
       "s.xml:3:36: a second material in one <shape>; one is allowed"},
      {with(shape("sphere_lattice", given("integer", "columns", "0"))),
       "s.xml:3:2: <shape type=\"sphere_lattice\"> needs the parameter 'step' (from centre to centre "
       "along x, y, z; over 0 where there is more than one sphere)\n"
       "s.xml:3:61: columns '0' is out of range; allowed: 1 to 1024 spheres"},
      {with(lattice(1024, 1024, 1024)), "s.xml:3:2: over 4194304 spheres; allowed: 4194304"},
      {with(lattice(2, 1, 1, given("point", "center", "1e9, 0, 0"))),
       "s.xml:3:2: the lattice reaches to 1e+09; allowed: -1e+09 to 1e+09"},
      {with(shape("sphere_lattice", given("integer", "columns", "1") +
                                        given("integer", "rows", "2") +
                                        given("vector", "step", "1, 0, 1"))),
       "s.xml:3:2: step '1, 0, 1' puts spheres in one place; allowed: over 0 along every axis with "
       "more than one sphere"},
  };
  for (const auto& [text, message] : bad) EXPECT_EQ(error_of(text), message) << text;
}

TEST(SceneLattices, BecomeSpheresInTheOrderOfColumnsRowsAndLayers) {
  const Scene s = read(
      lattice(2, 3, 2, given("point", "center", "1, 0, 0.5") + given("float", "radius", "0.5")));
  ASSERT_EQ(s.spheres.size(), 12u);
  EXPECT_EQ(s.spheres[0].center, (Vec3{-0.5, -4, -2}));
  EXPECT_EQ(s.spheres[1].center, (Vec3{2.5, -4, -2}));
  EXPECT_EQ(s.spheres[2].center, (Vec3{-0.5, 0, -2}));
  EXPECT_EQ(s.spheres[11].center, (Vec3{2.5, 4, 3}));
  for (const Sphere& sphere : s.spheres) EXPECT_EQ(sphere.radius, 0.5);
}

TEST(SceneLattices, AreMovedByTheGeneratorThatTheFormatNames) {
  // SplitMix64's published stream of the seed 0 begins with this number; 0 mixed is the key.
  constexpr std::uint64_t kFirst = 0xE220A8397B1DCDAFu;
  const auto mix = [](std::uint64_t state) {
    std::uint64_t z = state + 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  };
  ASSERT_EQ(mix(0), kFirst);
  for (const int seed : {0, 7}) {
    // Along x the spheres are too large to move.
    const Scene s = read(lattice(2, 3, 2,
                                 given("float", "jitter", "0.7") + given("float", "radius", "1.8") +
                                     given("integer", "seed", std::to_string(seed))));
    ASSERT_EQ(s.spheres.size(), 12u);
    std::uint64_t counter = mix(std::uint64_t(seed));
    const auto along = [&](int place, int count, double step) {
      const double u = double(mix(counter++) >> 11) / 9007199254740992.0;
      return (place - 0.5 * (count - 1)) * step + 0.7 * std::max(0.0, step / 2 - 1.8) * (2 * u - 1);
    };
    for (int k = 0; k < 12; ++k) {
      const Vec3 found = s.spheres[std::size_t(k)].center;
      EXPECT_NEAR(found.x, along(k % 2, 2, 3), 1e-14) << k;
      EXPECT_NEAR(found.y, along(k / 2 % 3, 3, 4), 1e-14) << k;
      EXPECT_NEAR(found.z, along(k / 6, 2, 5), 1e-14) << k;
    }
  }
}

TEST(SceneLattices, AreCountedTogetherWithSpheresBeforeAnyIsMade) {
  const std::string whole = lattice(1024, 1024, 4);
  EXPECT_EQ(parse_scene(scene(kMaterial + whole), "s.xml").spheres.size(), 1u << 22);
  EXPECT_THAT(error_of(scene(kMaterial + whole + shape("sphere", ""))),
              HasSubstr("over 4194304 spheres"));
  EXPECT_THAT(error_of(scene(kMaterial + whole + whole)), HasSubstr("over 4194304 spheres"));
}

TEST(SceneShapes, AHundredThousandSpheresAreReadInTimeProportionalToTheirNumber) {
  std::string body = kMaterial;
  for (int i = 0; i < 100000; ++i)
    body += shape("sphere", given("point", "center", std::to_string(i) + ", 0, 0.5") +
                                given("float", "radius", "0.25"));
  // 0.2 s on one core of 2023; quadratic behaviour would run into the time limit of this program.
  EXPECT_EQ(parse_scene(scene(body), "s.xml").spheres.size(), 100000u);
  // The same with an error in every one.
  std::string wrong = kMaterial;
  for (int i = 0; i < 100000; ++i) wrong += shape("sphere", "", "<ref id=\"n\"/>");
  EXPECT_THAT(error_of(scene(wrong)), HasSubstr("99980 further errors"));
}

TEST(ScenePlanes, AreAtMostSixteen) {
  std::string body;
  for (int i = 0; i < kMaxPlanes; ++i) body += shape("plane", "");
  EXPECT_EQ(read(body).planes.size(), 16u);
  EXPECT_THAT(error_of(scene(kMaterial + body + shape("plane", ""))),
              HasSubstr("over 16 planes; allowed: 16"));
}

}  // namespace
}  // namespace lobelia

#include "lobelia_paths.hpp"
#include "renderer/scene/scene_format.hpp"
#include "renderer/scene/sphere_lattice.hpp"
#include "tests/renderer/scene_text.hpp"

namespace lobelia {
namespace {

const std::string kRoot = LOBELIA_SOURCE_DIR, kScenes = kRoot + "/reference_scenes/scenes";

TEST(CanonicalScenes, AllReadAndWriteBackToTheSameScene) {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kScenes)) {
    if (entry.path().extension() != ".xml") continue;
    ++count;
    SCOPED_TRACE(entry.path().string());
    const Scene scene = again(read_scene(entry.path()), entry.path().parent_path());
    EXPECT_FALSE(scene.lights.empty());
    EXPECT_FALSE(scene.spheres.empty());
  }
  EXPECT_GE(count, 14);
}

TEST(EffectScenes, HaveTheEffectsOfTheirNames) {
  const std::pair<const char*, const char*> beyond[] = {
      {"area_light", "an area light, a ground plane"},
      {"rectangle_light", "an area light, a ground plane"},
      {"environment", "an environment light, a ground plane"},
      {"environment_map", "an environment light"},
      {"mirrors", "a ground plane, a mirror"},
      {"depth_of_field", "a ground plane, depth of field"},
      {"crowd", ""},
  };
  const std::string effects = kScenes + "/effects/";
  for (const auto& [name, what] : beyond)
    EXPECT_EQ(beyond_delta_lights(read_scene(effects + name + ".xml")), what);
  EXPECT_EQ(read_scene(effects + "mirrors.xml").depth.mirror, 5);
  EXPECT_EQ(read_scene(effects + "crowd.xml").spheres.size(), 10164u);
}

TEST(SceneReader, TakesDefaultsForAllOptionalParts) {
  const Scene s = parse_scene(
      scene("<shape type=\"sphere\"><point name=\"center\" x=\"1\" z=\"3\"/>"
            "<bsdf type=\"modified_phong\"><float name=\"exponent\" value=\"8\"/></bsdf></shape>"
            "<shape type=\"sphere\"><ref id=\"below\"/></shape>"
            "<bsdf type=\"phong_rdf\" id=\"below\"><float name=\"exponent\" value=\"9\"/>"
            "<rgb name=\"specular_reflectance\" value=\"0.5\"/></bsdf>"),
      "s.xml");
  ASSERT_EQ(s.spheres.size(), 2u);
  EXPECT_EQ(s.spheres[0].center, (Vec3{1, 0, 3}));
  EXPECT_EQ(s.spheres[0].radius, 1);
  EXPECT_EQ(s.film.width, 256);
  EXPECT_EQ(s.sampler.sample_count, 1);
  EXPECT_EQ(s.materials[s.spheres[0].material].highlight.exponent, 8);
  EXPECT_EQ(info(s.materials[s.spheres[0].material].highlight.lobe).name, "cosine");
  EXPECT_EQ(s.materials[s.spheres[1].material].highlight.exponent, 9);
  EXPECT_EQ(s.materials[s.spheres[1].material].specular_reflectance, (Rgb{0.5, 0.5, 0.5}));
}

TEST(SceneReader, ExplainsEveryError) {
  const std::string emitter =
      "<emitter type=\"directional\">\n  <vector name=\"direction\" value=\"";
  const BadScene bad[] = {
      {scene(emitter + "0,0\"/></emitter>"),
       "s.xml:4:35: direction '0,0' is not three numbers; allowed: -1e+09 to 1e+09"},
      {scene(emitter + "0,0,0\"/></emitter>"),
       "s.xml:3:2: direction is zero; allowed: any other vector"},
      {scene("<emitter type=\"directionl\"/>"),
       "s.xml:3:16: unknown emitter type 'directionl'; allowed: directional, point, spot, sphere, "
       "rectangle, constant, envmap; did you mean 'directional'?"},
      {scene("<shpae/>"),
       "s.xml:3:2: unknown element <shpae> in <scene>; allowed: sensor, emitter, bsdf, shape, "
       "integrator; did you mean 'shape'?"},
      {scene("<shape type=\"sphere\"><float name=\"radius\" value=\"-1\"/><bsdf type=\"phong_rdf\">"
             "<float name=\"exponent\" value=\"8\"/></bsdf></shape>"),
       "s.xml:3:50: radius '-1' is out of range; allowed: 1e-09 to 1e+09"},
      {scene("<shape type=\"sphere\"><bsdf type=\"phong_rdf\"/></shape>"),
       "s.xml:3:23: <bsdf type=\"phong_rdf\"> needs the parameter 'exponent' (sharpness n)"},
      {scene(
           "<shape type=\"sphere\"><bsdf type=\"phong_rdf\"><float name=\"exponent\" value=\"8\"/>"
           "<string name=\"lobe\" value=\"cs15\"/></bsdf></shape>"),
       "s.xml:3:106: unknown lobe 'cs15'; allowed: cosine, cs2, cs4, cs8, cs16, cs32, cs64, "
       "spherical_gaussian, gauss, schlick, pk3.1, pk3.2, pk3.3, pk3.4, ggx; csK for any even K from 2 to 1024; expression, with a "
       "formula; did you mean 'cs16'?"},
      {scene(
           "<shape type=\"sphere\"><bsdf type=\"phong_rdf\"><float name=\"exponent\" value=\"8\"/>"
           "<string name=\"lobe\" value=\"expression\"/></bsdf></shape>"),
       "s.xml:3:106: the lobe 'expression' needs a formula"},
      {scene(
           "<shape type=\"sphere\"><bsdf type=\"phong_rdf\"><float name=\"exponent\" value=\"8\"/>"
           "<string name=\"formula\" value=\"c^n\"/></bsdf></shape>"),
       "s.xml:3:109: a formula is for the lobe 'expression', not for 'cosine'"},
      {scene(
           "<shape type=\"sphere\"><bsdf type=\"phong_rdf\"><float name=\"exponent\" value=\"8\"/>"
           "<string name=\"lobe\" value=\"expression\"/>"
           "<string name=\"formula\" value=\"1 - (s\"/></bsdf></shape>"),
       "s.xml:3:149: formula, column 7: the formula ends before a ')'"},
      {scene(
           "<shape type=\"sphere\"><bsdf type=\"phong_rdf\"><float name=\"exponent\" value=\"8\"/>"
           "<string name=\"lobe\" value=\"expression\"/>"
           "<string name=\"formula\" value=\"1 + n*s\"/></bsdf></shape>"),
       "s.xml:3:149: the formula 1 + n * s is no lobe: at s = 0.999 and n = 8 it is 8.992, more than the 1 at s = 0; it has to fall"},
      {scene("<shape type=\"sphere\"><ref id=\"x\"/></shape>"),
       "s.xml:3:31: no <bsdf> has the id 'x'"},
      {scene("<shape type=\"sphere\"/>"),
       "s.xml:3:2: <shape> needs a <bsdf> or a <ref id=\"...\"/> to one"},
      {"<scene version=\"1\"/>", "s.xml:1:2: the scene has no <sensor>; it needs one"},
      {scene("", std::string(kSensor) + kSensor), "s.xml:2:157: a second <sensor>; one is allowed"},
      {"<scene version=\"2\">\n" + std::string(kSensor) + "</scene>",
       "s.xml:1:17: format version '2'; this program reads version 1"},
      {"<scen/>", "s.xml:1:2: the root element is <scen>; a scene file begins with <scene>"},
  };
  for (const auto& [text, message] : bad) EXPECT_EQ(error_of(text), message) << text;
}

TEST(SceneReader, ReportsAllErrorsInOneRun) {
  const std::string message = error_of(scene(
      "<emitter type=\"pint\"/>\n<emitter type=\"point\"/>\n<shape type=\"sphere\"/>\nhello"));
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 3) << message;
  EXPECT_THAT(message, testing::HasSubstr("s.xml:3:"));
  EXPECT_THAT(message, testing::HasSubstr("s.xml:4:"));
  EXPECT_THAT(message, testing::HasSubstr("s.xml:5:"));
  EXPECT_THAT(message, testing::HasSubstr("text 'hello' inside <scene>"));
}

TEST(SceneReader, RefusesAPictureOfTooManyPixels) {
  const auto error_of_side = [](const std::string& side) {
    return error_of(scene(
        "", sensor("perspective", "<film type=\"hdrfilm\">" + given("integer", "width", side) +
                                      given("integer", "height", side) + "</film>")));
  };
  EXPECT_THAT(error_of_side("1000000"),
              testing::HasSubstr("width '1000000' is out of range; allowed: 1 to 32768 pixels"));
  EXPECT_THAT(error_of_side("32768"), testing::HasSubstr("32768 x 32768 pixels; allowed: "));
}

TEST(SceneReader, ReadsNoEntitiesAndNothingFromOutside) {
  EXPECT_THAT(
      error_of("<!DOCTYPE scene [<!ENTITY x SYSTEM \"file:///etc/passwd\">]>" + scene("&x;")),
      testing::HasSubstr("a DOCTYPE is not allowed"));
}

TEST(SceneReader, SurvivesBrokenOrDeeplyNestedXml) {
  for (const std::string& text :
       {std::string("<scene"), std::string("<scene>\n<a></scene>"), std::string(),
        std::string("\0\xff\xfe<>", 5), std::string("just text")})
    EXPECT_THAT(error_of(text), testing::HasSubstr("s.xml")) << text;
  EXPECT_THAT(error_of("<scene>\n<a></scene>"), testing::StartsWith("s.xml:2:"));
  std::string deep;
  for (int i = 0; i < 1000000; ++i) deep += "<a>";
  EXPECT_NE(error_of(deep), "it was read");
  EXPECT_NE(error_of(scene(deep)), "it was read");
}

TEST(SceneReader, BoundsTheNumberOfEverything) {
  std::string emitters;
  for (int i = 0; i <= kMaxLights; ++i)
    emitters +=
        "<emitter type=\"directional\"><vector name=\"direction\" value=\"0,0,1\"/></emitter>";
  EXPECT_THAT(error_of(scene(emitters)), testing::HasSubstr("over 65536 emitters"));
  const std::string sky = "<emitter type=\"constant\"/>";
  std::string skies;
  for (int i = 0; i <= kMaxEnvironments; ++i) skies += sky;
  EXPECT_THAT(error_of(scene(skies)), testing::HasSubstr("over 64 constant and envmap emitters"));
  const std::string ball = "<bsdf type=\"phong_rdf\"><float name=\"exponent\" value=\"8\"/></bsdf>";
  EXPECT_THAT(
      error_of(scene(
          emitters.substr(0, emitters.size() / (kMaxLights + 1) * kMaxLights) +
          "<shape type=\"sphere_lattice\"><integer name=\"columns\" value=\"1024\"/><integer name=\"rows\" value=\"5\"/>"
          "<vector name=\"step\" value=\"3,3,3\"/>" +
          ball + "</shape>")),
      testing::HasSubstr("65536 emitters times 5120"));
  EXPECT_THAT(error_of(std::string(kMaxSceneBytes + 1, ' ')), testing::HasSubstr("bytes; at most"));
}

TEST(SceneReader, ShowsNoControlCharactersOfAHostileFile) {
  EXPECT_THAT(error_of(scene("<emitter type=\"\x1b[31mred\"/>")),
              testing::Not(testing::HasSubstr("\x1b")));
}

TEST(SceneFormatDocument, MatchesTheOutputOfTheProgram) {
  std::ifstream file(kRoot + "/docs/scene_format.md");
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), scene_format_document())
      << "run: lobelia scene-format > docs/scene_format.md";
}

// The lens, the filter, how far light is followed, mirrors.

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

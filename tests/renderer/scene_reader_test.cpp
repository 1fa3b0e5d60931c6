#include "lobelia_paths.hpp"
#include "renderer/scene/scene_format.hpp"
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
       "s.xml:3:16: unknown emitter type 'directionl'; allowed: directional, point, sphere, "
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

}  // namespace
}  // namespace lobelia

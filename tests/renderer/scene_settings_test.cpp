// The lens, the filter, how far light is followed, mirrors.
#include "renderer/scene/scene_format.hpp"
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
  const std::string offsets = given("float", "principal_point_offset_x", "0.25") +
                              given("float", "principal_point_offset_y", "-0.1");
  for (const auto& type : {"perspective", "thinlens"}) {
    const std::string lens =
        type == std::string("thinlens") ? given("float", "focus_distance", "2") : std::string();
    const Camera camera = with_sensor(sensor(type, offsets + lens)).camera;
    EXPECT_EQ(camera.principal_point_offset_x, 0.25);
    EXPECT_EQ(camera.principal_point_offset_y, -0.1);
  }
  EXPECT_EQ(with_sensor(kSensor).camera.principal_point_offset_x, 0);
}

TEST(SceneFilter, OfEveryNameIsReadAndWrittenWithItsOwnRadiusOrAGivenOne) {
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

TEST(SceneDepth, IsWhatTheIntegratorSays) {
  const auto depth = [](const std::string& body) {
    return again(parse_scene(scene(body), "s.xml")).depth;
  };
  const std::string mirror = bsdf(given("rgb", "mirror_reflectance", "0, 0.5, 0"));
  const std::string both = "<integrator type=\"path\">" + given("integer", "mirror_depth", "5") +
                           given("integer", "glossy_depth", "64") + "</integrator>";
  EXPECT_EQ(depth("").mirror, 0);
  EXPECT_EQ(depth(both).mirror, 5);
  EXPECT_EQ(depth(both).glossy, 64);
  EXPECT_EQ(depth(both + mirror).mirror, 5);
  EXPECT_EQ(depth("<integrator type=\"path\"/>" + mirror).mirror, 0);
}

TEST(SceneDepth, WithAMirrorAndNoIntegratorIsEightReflections) {
  const Scene s =
      again(parse_scene(scene(bsdf(given("rgb", "mirror_reflectance", "0.1, 0.5, 0.9"))), "s.xml"));
  EXPECT_EQ(s.materials[0].mirror_reflectance, (Rgb{0.1, 0.5, 0.9}));
  EXPECT_EQ(s.depth.mirror, kDefaultMirrorDepth);
  EXPECT_EQ(s.depth.glossy, 0);
  Scene without = s;
  without.depth = {};
  EXPECT_EQ(again(without).depth.mirror, 0) << "what was set by hand is kept";
}

TEST(SceneSettings, EveryErrorHasItsPlace) {
  const BadScene bad[] = {
      {scene("", sensor("thinlens", "")),
       "s.xml:2:2: <sensor type=\"thinlens\"> needs the parameter 'focus_distance' (along the view, "
       "of the plane that is sharp)"},
      {scene("", sensor("thinlens", given("float", "focus_distance", "0"))),
       "s.xml:2:180: focus_distance '0' is out of range; allowed: 1e-09 to 1e+09"},
      {scene("", sensor("perspective", given("float", "aperture_radius", "1"))),
       "s.xml:2:160: <sensor> has no parameter 'aperture_radius'; allowed: fov, "
       "principal_point_offset_x, principal_point_offset_y"},
      {scene("", sensor("perspective", film(filter("boxx")))),
       "s.xml:2:183: unknown rfilter type 'boxx'; allowed: box, tent, gaussian, blackman_harris, "
       "mitchell; did you mean 'box'?"},
      {scene("", sensor("perspective", film(filter("box", given("float", "radius", "0.05"))))),
       "s.xml:2:216: radius '0.05' is out of range; allowed: 0.1 to 16 pixels"},
      {scene("", sensor("perspective", film(filter("box") + filter("tent")))),
       "s.xml:2:199: a second <rfilter>; one is allowed"},
      {scene("<integrator type=\"path\"/><integrator type=\"path\"/>"),
       "s.xml:3:27: a second <integrator>; one is allowed"},
      {scene("<integrator type=\"pat\"/>"),
       "s.xml:3:19: unknown integrator type 'pat'; allowed: path; did you mean 'path'?"},
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

}  // namespace
}  // namespace lobelia

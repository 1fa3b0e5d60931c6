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

}  // namespace
}  // namespace lobelia

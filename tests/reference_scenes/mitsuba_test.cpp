// Scene files of Mitsuba: written and read again, read as others write them, and broken.
#include "reference_scenes/formats/mitsuba.hpp"

#include <fmt/format.h>

#include "base/pictures/image_io.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "reference_scenes/formats/catalogue.hpp"
#include "renderer/scene/scene_io.hpp"
#include "tests/canonical_scene.hpp"
#include "tests/renderer/random_scene.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

const SceneFormat& mitsuba() { return scene_format("mitsuba"); }
std::string written(const Scene& scene) { return mitsuba().write(scene).at("scene.xml"); }

/// The scene with what Mitsuba cannot say taken away, and with what changes no picture as a reader has it.
Scene sayable(Scene scene) {
  for (Material& m : scene.materials) {
    m.highlight = {*find_model("modified_phong"), *find_lobe("cosine"), Normalisation::kExact,
                   m.highlight.exponent};
    m.fresnel = Fresnel::kNone;
    m.mirror_reflectance = {};
  }
  scene.planes.clear();
  bool environment = false;
  std::erase_if(scene.lights, [&](const Light& light) {
    return is_environment(light) && std::exchange(environment, true);
  });
  for (Light& any : scene.lights) {
    if (const auto* spot = std::get_if<SpotLight>(&any))
      any = PointLight{spot->position, spot->intensity};
    if (auto* point = std::get_if<PointLight>(&any)) point->normal = {};
    if (auto* sky = std::get_if<EnvmapLight>(&any)) sky->radiance = sky->radiance.r * Rgb{1, 1, 1};
  }
  if (name(scene.film.filter) == "blackman_harris") scene.film.filter = {};
  if (name(scene.film.filter) == "box" || name(scene.film.filter) == "mitchell")
    scene.film.filter = *find_filter(name(scene.film.filter));
  // Mitsuba has the standard deviation, of which not every radius is the triple.
  if (name(scene.film.filter) == "gaussian")
    scene.film.filter.radius =
        kGaussianDeviations * (scene.film.filter.radius / kGaussianDeviations);
  scene.sampler.seed = std::uint32_t(scene.sampler.seed);
  scene.depth.mirror = 0;
  if (scene.camera.aperture_radius == 0) scene.camera.focus_distance = Camera{}.focus_distance;
  if (scene.camera.aperture_radius > 0)
    scene.camera.principal_point_offset_x = scene.camera.principal_point_offset_y = 0;
  return scene;
}

TEST(Mitsuba, IsWrittenAndReadAgainAsTheSameScene) {
  const TemporaryDirectory directory;
  write_exr(directory.path() / "sky.exr", *sky(), {});
  int compared = 0;
  expect_of_random_scenes(SceneKind::kAny, 400, [&](const Scene& random, Random&) -> std::string {
    const Scene scene = sayable(random);
    if (scene.spheres.empty()) return "";
    if (const std::string why = mitsuba().why_not(scene); !why.empty()) return "refused: " + why;
    if (!mitsuba().write(scene).contains("phong.py")) return "without its model";
    const ImportedScene read = parse_mitsuba(written(scene), "scene.xml", directory.path());
    if (!read.problems.empty()) return "a problem: " + read.problems.front();
    ++compared;
    return scene_to_xml(read.scene) == scene_to_xml(scene)
               ? ""
               : "another scene:\n" + scene_to_xml(read.scene);
  });
  EXPECT_GT(compared, 300);
}

TEST(Mitsuba, SaysWhyItCannotShowAScene) {
  const Scene scene = sayable(canonical_scene("oblique_45"));
  const auto why = [&](auto change) {
    Scene other = scene;
    change(other);
    return mitsuba().why_not(other);
  };
  EXPECT_EQ(why([](Scene&) {}), "");
  const std::pair<void (*)(Scene&), const char*> cases[] = {
      {[](Scene& s) { s.materials[0].highlight.model = *find_model("phong_rdf"); },
       "Mitsuba's phong is modified_phong with the lobe cosine"},
      {[](Scene& s) { s.materials[0].fresnel = Fresnel::kSchlick; }, "Fresnel"},
      {[](Scene& s) {
         s.materials[0].mirror_reflectance = Rgb{1, 1, 1};
       },
       "mirror"},
      {[](Scene& s) {
         s.planes.push_back({{}, {0, 1, 0}});
       },
       "plane"},
      {[](Scene& s) { s.film.filter = *find_filter("blackman_harris"); }, "blackman_harris"},
      {[](Scene& s) { s.film.filter.radius = 2; }, "radius 2"},
      {[](Scene& s) { s.lights.assign(2, ConstantLight{}); }, "environments"},
      {[](Scene& s) {
         s.lights.assign(1, PointLight{{}, {}, {0, 1, 0}});
       },
       "normal"},
  };
  for (const auto& [change, words] : cases) EXPECT_THAT(why(change), HasSubstr(words));
  // Without a highlight, the model does not matter.
  EXPECT_EQ(why([](Scene& s) {
              s.materials[0].highlight.model = *find_model("phong_rdf");
              s.materials[0].specular_reflectance = {};
            }),
            "");
}

/// A file of somebody else: every supported element in another spelling.
constexpr char kTheirs[] = R"(<?xml version="1.0"?>
<scene version="3.0.0">
  <default name="spp" value="16"/>
  <default name="size" value="64"/>
  <default name="n" value="$spp"/>
  <integrator type="path"><integer name="max_depth" value="3"/><boolean name="hide_emitters" value="false"/></integrator>
  <sensor type="perspective" id="camera">
    <float name="fov" value="60"/>
    <string name="fov_axis" value="y"/>
    <float name="near_clip" value="0.1"/>
    <transform name="to_world">
      <rotate y="1" angle="180"/>
      <translate value="0, 0, 5"/>
    </transform>
    <sampler type="multijitter"><integer name="sample_count" value="$spp"/></sampler>
    <film type="hdrfilm">
      <integer name="width" value="$size"/>
      <integer name="height" value="32"/>
      <string name="pixel_format" value="rgba"/>
      <rfilter type="tent"/>
    </film>
  </sensor>
  <bsdf type="twosided" id="shiny">
    <bsdf type="phong">
      <float name="exponent" value="$n"/>
      <spectrum name="specular_reflectance" value="0.25"/>
    </bsdf>
  </bsdf>
  <shape type="sphere">
    <transform name="to_world">
      <scale value="0.5"/>
      <rotate x="1" y="2" z="3" angle="40"/>
      <translate x="1" y="-2"/>
    </transform>
    <ref name="bsdf" id="shiny"/>
  </shape>
  <shape type="sphere"/>
  <shape type="rectangle">
    <transform name="to_world"><scale y="3"/><scale x="2"/><lookat origin="0, 4, 0" target="0, 0, 0" up="0, 0, 1"/></transform>
    <bsdf type="null"/>
    <emitter type="area"><rgb name="radiance" value="1, 2, 3"/></emitter>
  </shape>
  <emitter type="point"><point name="position" x="1" y="2" z="3"/><spectrum name="intensity" value="4"/></emitter>
</scene>)";

TEST(Mitsuba, IsReadInOthersSpelling) {
  const ImportedScene read = parse_mitsuba(kTheirs, "theirs.xml");
  EXPECT_THAT(read.problems, ElementsAre());
  const Scene& scene = read.scene;
  EXPECT_EQ(scene.depth.glossy, 1);
  EXPECT_EQ(scene.film.width, 64);
  EXPECT_EQ(name(scene.film.filter), "tent");
  EXPECT_EQ(scene.sampler.sample_count, 16);
  EXPECT_EQ(scene.camera.origin, (Vec3{0, 0, 5}));
  // 60 degrees up and down, and twice the tangent to the sides.
  EXPECT_NEAR(std::tan(scene.camera.fov_degrees * kPi / 360), 2 * std::tan(kPi / 6), 1e-12);
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  EXPECT_NEAR(length(frame.forward - Vec3{0, 0, -1}), 0, 1e-12);
  EXPECT_NEAR(length(frame.right - Vec3{1, 0, 0}), 0, 1e-12);
  ASSERT_EQ(scene.spheres.size(), 2u);
  EXPECT_NEAR(length(scene.spheres[0].center - Vec3{1, -2, 0}), 0, 1e-12);
  EXPECT_NEAR(scene.spheres[0].radius, 0.5, 1e-12);
  const Material& shiny = scene.materials[std::size_t(scene.spheres[0].material)];
  EXPECT_EQ(shiny.highlight.exponent, 16);
  EXPECT_EQ(shiny.specular_reflectance, (Rgb{0.25, 0.25, 0.25}));
  EXPECT_EQ(shiny.diffuse_reflectance, (Rgb{0.5, 0.5, 0.5}));
  EXPECT_FALSE(has_highlight(scene.materials[std::size_t(scene.spheres[1].material)]));
  ASSERT_EQ(scene.lights.size(), 2u);
  const auto& rectangle = std::get<RectangleLight>(scene.lights[0]);
  EXPECT_EQ(rectangle.center, (Vec3{0, 4, 0}));
  EXPECT_NEAR(length(rectangle.half_u), 2, 1e-12);
  EXPECT_NEAR(length(rectangle.half_v), 3, 1e-12);
  // It shines where it looks.
  EXPECT_NEAR(length(normalize(cross(rectangle.half_u, rectangle.half_v)) - Vec3{0, -1, 0}), 0,
              1e-12);
}

TEST(Mitsuba, IsReadOfVersionsThatWriteNamesAsOneWord) {
  const ImportedScene read = parse_mitsuba(R"(<scene version="0.6.0">
    <sensor type="perspective"><transform name="toWorld"><lookAt origin="0,0,5" target="0,0,0" up="0,1,0"/></transform>
      <float name="fov" value="30"/></sensor>
    <bsdf type="phong" id="m"><rgb name="specularReflectance" value="0.5"/><rgb name="diffuseReflectance" value="0.1"/></bsdf>
    <shape type="sphere"><ref id="m"/></shape></scene>)",
                                           "old.xml");
  EXPECT_THAT(read.problems, ElementsAre());
  EXPECT_EQ(read.scene.camera.origin, (Vec3{0, 0, 5}));
  EXPECT_EQ(read.scene.materials[0].specular_reflectance, (Rgb{0.5, 0.5, 0.5}));
  EXPECT_EQ(read.scene.materials[0].highlight.exponent, 30);
  EXPECT_EQ(name(read.scene.film.filter), "gaussian");
  EXPECT_EQ(read.scene.film.width, 768);
}

TEST(Mitsuba, TurnsAndMovesLightsWithoutASize) {
  const ImportedScene read = parse_mitsuba(R"(<scene version="0.6.0">
    <sensor type="perspective"><float name="fov" value="30"/></sensor><shape type="sphere"/>
    <emitter type="directional"><transform name="toWorld"><lookat origin="0,4,0" target="0,0,0" up="1,0,0"/></transform></emitter>
    <emitter type="point"><transform name="toWorld"><scale value="2"/><translate x="3" y="1" z="2"/></transform>
      <spectrum name="intensity" value="4"/></emitter>
    <emitter type="directional"/></scene>)",
                                           "old.xml");
  EXPECT_THAT(read.problems, ElementsAre());
  ASSERT_EQ(read.scene.lights.size(), 3u);
  const auto& down = std::get<DirectionalLight>(read.scene.lights[0]);
  EXPECT_NEAR(length(down.direction - Vec3{0, -1, 0}), 0, 1e-12);
  const auto& point = std::get<PointLight>(read.scene.lights[1]);
  EXPECT_EQ(point.position, (Vec3{3, 1, 2}));
  EXPECT_EQ(point.intensity, (Rgb{4, 4, 4}));
}

TEST(Mitsuba, ReadsColoursThatAreEncodedAsSrgb) {
  const ImportedScene read = parse_mitsuba(R"(<scene version="0.6.0">
    <sensor type="perspective"><float name="fov" value="30"/></sensor>
    <shape type="sphere"><bsdf type="phong"><srgb name="specularReflectance" value="#ff8000"/>
      <srgb name="diffuseReflectance" value="0.5, 0.5, 0"/></bsdf></shape>
    <shape type="sphere"><bsdf type="phong"><rgb name="specularReflectance" value="#ff8000"/></bsdf></shape></scene>)",
                                           "old.xml");
  EXPECT_THAT(read.problems, ElementsAre());
  for (const Material& m : read.scene.materials) {
    EXPECT_EQ(m.specular_reflectance.r, 1);
    EXPECT_NEAR(m.specular_reflectance.g, 0.2158605, 1e-6);  // ((128/255 + 0.055) / 1.055)^2.4
    EXPECT_EQ(m.specular_reflectance.b, 0);
  }
  EXPECT_NEAR(read.scene.materials[0].diffuse_reflectance.g, 0.2140411, 1e-6);
}

TEST(Mitsuba, ReadsARoughMirrorWithGgx) {
  const std::string ggx =
      "<shape type=\"sphere\"><bsdf type=\"roughconductor\"><string name=\"distribution\" value=\"ggx\"/>"
      "<float name=\"alpha\" value=\"0.2\"/>{}</bsdf></shape>";
  const std::string head =
      "<scene version=\"{}\"><sensor type=\"perspective\"><float name=\"fov\" value=\"30\"/></sensor>";
  const ImportedScene read =
      parse_mitsuba(fmt::format(fmt::runtime(head + ggx + "</scene>"), "3.0.0", ""), "s.xml");
  EXPECT_THAT(read.problems, ElementsAre());
  const Material& m = read.scene.materials.at(0);
  EXPECT_EQ(info(m.highlight.model).name, "microfacet_smith");
  EXPECT_EQ(info(m.highlight.lobe).name, "ggx");
  EXPECT_NEAR(m.highlight.exponent, 48, 1e-9);
  EXPECT_EQ(m.specular_reflectance, (Rgb{1, 1, 1}));
  EXPECT_TRUE(is_black(m.diffuse_reflectance));
  for (const auto& [version, more] :
       {std::pair("0.6.0", ""), std::pair("3.0.0", "<string name=\"material\" value=\"Au\"/>")})
    EXPECT_THAT(
        parse_mitsuba(fmt::format(fmt::runtime(head + ggx + "</scene>"), version, more), "s.xml")
            .problems,
        ElementsAre(HasSubstr("roughconductor\"> is not supported")))
        << version;
}

/// A scene with `inside` in it, from its seventh line on.
std::string scene_with(const std::string& inside) {
  return "<scene version=\"3.0.0\">\n<sensor type=\"perspective\">\n<float name=\"fov\" value=\"30\"/>\n"
         "<transform name=\"to_world\"><lookat origin=\"0,0,5\" target=\"0,0,0\" up=\"0,1,0\"/></transform>\n"
         "</sensor>\n<shape type=\"sphere\"/>\n" +
         inside + "\n</scene>\n";
}

std::string moved(const char* shape, const std::string& by) {
  return fmt::format("<shape type=\"{}\"><transform name=\"to_world\">{}</transform></shape>",
                     shape, by);
}

TEST(Mitsuba, NamesUnreadPartsWithTheirLines) {
  const std::pair<std::string, const char*> cases[] = {
      {"<shape type=\"obj\"><string name=\"filename\" value=\"/etc/passwd\"/></shape>",
       "s.xml:7:2: <shape type=\"obj\"> is not supported; it is left out"},
      {"\n<bsdf type=\"roughplastic\" id=\"x\"/>",
       "s.xml:8:2: <bsdf type=\"roughplastic\"> is not supported; its surfaces are diffuse"},
      {"<emitter type=\"point\"><point name=\"position\" x=\"1\"/><transform name=\"to_world\"/></emitter>",
       "both a to_world and a position"},
      {"<emitter type=\"spot\"/>", "s.xml:7:2: <emitter type=\"spot\"> is not supported"},
      {"<include filename=\"other.xml\"/>", "s.xml:7:2: <include> is not supported; other files"},
      {"<medium type=\"homogeneous\"/>", "s.xml:7:2: <medium type=\"homogeneous\">"},
      {"<shape type=\"sphere\"><ref id=\"none\"/></shape>", "no <bsdf> has the id 'none'"},
      {"<shape type=\"sphere\"><float name=\"radius\" value=\"nan\"/></shape>", "s.xml:7:"},
      {"<shape type=\"sphere\"><float name=\"radius\" value=\"1e30\"/></shape>", "out of range"},
      {moved("sphere", "<scale x=\"2\"/>"), "ellipsoid"},
      {moved("sphere", "<scale value=\"0\"/>"), "s.xml:7:2"},
      {moved("sphere", "<matrix value=\"1 2 3\"/>"), "9 or 16 numbers"},
      {"<shape type=\"rectangle\"/>", "infinite plane"},
      {"<emitter type=\"envmap\"><string name=\"filename\" value=\"../x.exr\"/></emitter>",
       "180 degrees"},
      {"<shape type=\"sphere\" id=\"$where\"/>",
       "s.xml:7:2: the parameter '$where' has no <default>"},
      {"<integrator type=\"direct\"><boolean name=\"hide_emitters\" value=\"true\"/></integrator>",
       "s.xml:7:2: hide_emitters"},
      {"<integrator type=\"path\"/>", "give a max_depth"},
      {"<shape type=\"sphere\"><emitter type=\"area\"/></shape>", "a light only"},
  };
  for (const auto& [inside, said] : cases)
    EXPECT_THAT(parse_mitsuba(scene_with(inside), "s.xml").problems, ElementsAre(HasSubstr(said)))
        << inside;
}

TEST(Mitsuba, IsRefusedWhereNoSceneRemains) {
  for (const auto& [text, what] : std::vector<std::pair<std::string, std::string>>{
           {"", "broken XML"},
           {"<scene", "broken XML"},
           {"<scene version=\"3.0.0\"/>", "it has no <sensor>"},
           {"<mesh version=\"3.0.0\"/>", "begins with <scene>"},
           {"<!DOCTYPE x [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;\">]><scene version=\"3.0.0\"/>",
            "DOCTYPE"},
           {scene_with("").replace(scene_with("").find("<shape"), 6, "<ghost"),
            "it has no <shape>"}}) {
    SCOPED_TRACE(text);
    EXPECT_THAT(error_words(ExitCode::kInput, [&text = text] { parse_mitsuba(text, "s.xml"); }),
                HasSubstr(what));
  }
}

/// Read without another error than that of a bad input; what is read is a scene of ours.
void expect_read_or_refused(const std::string& text) {
  try {
    const Scene scene = parse_mitsuba(text, "s.xml").scene;
    const std::string xml = scene_to_xml(scene);
    ASSERT_EQ(scene_to_xml(parse_scene(xml, "ours")), xml) << text;
  } catch (const Error& error) {
    ASSERT_EQ(error.code(), ExitCode::kInput) << text;
    ASSERT_STRNE(error.what(), "");
  }
}

TEST(Mitsuba, SurvivesUnusualFiles) {
  std::string deep, doubled = "<default name=\"a0\" value=\"xxxxxxxx\"/>";
  for (int i = 0; i < 100'000; ++i) deep += "<shape>";
  for (int i = 1; i < 64; ++i)
    doubled += fmt::format("<default name=\"a{}\" value=\"$a{}$a{}\"/>", i, i - 1, i - 1);
  std::string many_spheres, many_bsdfs, many_lights;
  for (int i = 0; i < 3000; ++i) {
    many_spheres += "<shape type=\"sphere\"><bsdf type=\"diffuse\"/></shape>";
    many_bsdfs += fmt::format("<bsdf type=\"diffuse\" id=\"{}\"/>", i % 2000);
    many_lights += "<emitter type=\"constant\"/>";
  }
  const std::string scale = "<scale value=\"1e9\"/>";
  for (const std::string& inside :
       {deep, doubled + "<bsdf type=\"$a63\" id=\"x\"/>", many_spheres, many_bsdfs, many_lights,
        std::string("<emitter type=\"point\"><point name=\"position\" x=\"1e308\" y=\"-inf\" "
                    "z=\"nan\"/></emitter>"),
        moved("rectangle", scale + scale + scale), moved("sphere", "<rotate angle=\"4\"/>"),
        moved("sphere", "<lookat origin=\"0,0,0\" target=\"0,0,0\" up=\"0,0,0\"/>"),
        std::string("<transform><scale/></transform><shape><shape><sensor/></shape></shape>"),
        std::string("<sensor type=\"perspective\"/>text<![CDATA[x]]><!-- c --><?p i?>")})
    expect_read_or_refused(scene_with(inside));
  for (int i = 0; i < 100'000; ++i) deep += "</shape>";
  EXPECT_THAT(parse_mitsuba(scene_with(deep), "s.xml").problems,
              testing::Contains(HasSubstr("nested deeper")));
}

}  // namespace
}  // namespace lobelia

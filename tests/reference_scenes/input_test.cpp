// Input of the engines: numbers in full, and nothing that a person typed.
#include <regex>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/words/text.hpp"
#include "lobelia_paths.hpp"
#include "reference_scenes/engine.hpp"
#include "reference_scenes/engines/blender/blender.hpp"
#include "reference_scenes/engines/povray/povray_input.hpp"
#include "reference_scenes/preparation.hpp"
#include "renderer/peak_bound.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/contact.hpp"
#include "renderer/scene/scene_io.hpp"
#include "tests/reference_scenes/test_scenes.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

constexpr HighlightChoice kExpressed{"modified_blinn_phong", "cs16", "exact", 64};
constexpr HighlightChoice kNative{"phong_rdf", "cosine", "exact", 64};

/// The first that it can show.
Highlight a_highlight_of(const EngineInfo& engine) {
  for (const records::EngineModel& model : engine_models(*make_engine(engine.name, {})))
    for (const auto& lobes : {model.native, model.expressed})
      if (!lobes.empty()) return {*find_model(model.model), *find_lobe(lobes[0])};
  throw Error(ExitCode::kInternal, "it shows nothing");
}

TEST(EngineInput, HasNoWordOfASceneFileNorOfItsName) {
  const std::string words[] = {"h0stile\"} #include \"/etc/passwd\"", "h0stile */ #write (F, 1)",
                               "h0stile\n#declare Gain = 0;",
                               "h0stile\"\"\"'''; __import__('os').system('id')",
                               "h0stile \\u0022 \xc3\xa9\xe2\x80\xae \xe2\x80\xa8 $(id) `id`"};
  const fs::path original = fs::path(LOBELIA_SOURCE_DIR) / "reference_scenes/scenes/oblique_45.xml";
  const TemporaryDirectory directory;
  for (const std::string& word : words) {
    SCOPED_TRACE(word);
    const std::string id = std::regex_replace(escape_markup(word), std::regex("\n"), "&#10;");
    std::string text = read_file(original, 1 << 16);
    text = std::regex_replace(text, std::regex("\"highlight\""), "\"@\"");
    text = std::regex_replace(text, std::regex("<(emitter|shape) "), "<!-- # --><$1 id=\"@\" ");
    for (const auto& [mark, by] : {std::pair{'#', word}, {'@', id}})
      for (auto at = text.find(mark); at != text.npos; at = text.find(mark, at + by.size()))
        text.replace(at, 1, by);
    std::string name = word;
    std::ranges::replace(name, '/', '_');
    const fs::path file = directory.path() / (name + ".xml");
    write_file(file, text);
    Scene scene = read_scene(file);
    ASSERT_EQ(scene.materials[0].id, word);
    for (const EngineInfo& engine : engine_infos()) {
      if (!engine.is_program) continue;
      scene.materials[0].highlight = a_highlight_of(engine);
      const TemporaryDirectory kept;
      keep_engine_input(engine.name, scene, {}, kept.path());
      std::size_t files = 0;
      for (const auto& entry : fs::directory_iterator(kept.path())) {
        ++files;
        EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("h0stile")));
        EXPECT_THAT(read_file(entry.path(), 1 << 20), Not(HasSubstr("h0stile"))) << entry.path();
      }
      EXPECT_GE(files, 2u);
    }
  }
}

TEST(EngineInput, HasEveryNumberInFull) {
  const double third = 1.0 / 3, tenths = 0.1 + 0.2;
  ASSERT_EQ(exact_text(tenths), "0.30000000000000004");
  Scene scene = sphere_scene(kExpressed, {PointLight{{2, third, 3}, {tenths, 1, third}}}, 64);
  scene.camera.origin = {tenths, third, 5};
  scene.materials[0].highlight.exponent = 100 * third;
  const std::string pov = povray_input(scene).passes.at(0).scene();
  const std::string job = blender_input(scene, "scene0").text;
  for (const double value : {third, tenths, 100 * third}) {
    EXPECT_THAT(pov, HasSubstr(exact_text(value)));
    EXPECT_THAT(job, HasSubstr(exact_text(value)));
  }
}

TEST(EngineInput, NeverHasANumberThatIsNotFinite) {
  EXPECT_THROW(exact_text(std::numeric_limits<double>::quiet_NaN()), Error);
  EXPECT_THROW(exact_text(std::numeric_limits<double>::infinity()), Error);
}

TEST(EngineInput, GainBringsEveryPictureIntoTheRangeOfHalfFloat) {
  for (const ModelInfo& model : models())
    for (const Normalised& lobe : kNormalisations)
      for (const double exponent : {1.0, 16.0, 1024.0, 1e6})
        for (const double brightness : {1e-6, 1.0, 1e6}) {
          Scene scene = shadow_scene(
              {model.name, lobe.lobe, lobe.normalisation, exponent},
              {directional_at(30, brightness * kWhite), point_light(brightness * kWhite)}, 32);
          scene.materials[0].fresnel = exponent == 16 ? Fresnel::kSchlick : Fresnel::kNone;
          for (const PovrayPass& pass : povray_input(scene).passes) {
            int power = 0;
            EXPECT_EQ(std::frexp(pass.gain, &power), 0.5) << "not a power of two: " << pass.gain;
          }
          const PovrayInput input = povray_input(scene);
          const double gain = input.passes.front().gain;
          const auto lights = input.native ? scene.lights : std::vector{scene.lights.front()};
          scene.lights = lights;
          const Image picture = render(scene, {}).image;
          const double peak = *std::ranges::max_element(picture.values());
          EXPECT_LE(gain * peak, 3e4 * (1 + 1e-6));
          EXPECT_LE(peak, peak_bound(scene, lights) * (1 + 1e-6));
          // Without shadowing, whose largest factor is that of the picture and not of peak_bound().
          if (model.has_shadowing) {
            EXPECT_GE(gain * peak_bound(scene, lights), 1.4e4);
          } else {
            EXPECT_LE(gain * peak_bound(scene, lights), 3e4);
            EXPECT_GT(gain * peak_bound(scene, lights), 1.4e4);
          }
        }
}

TEST(EngineInput, UsesPovRaysOwnHighlights) {
  const auto is_native = [](const HighlightChoice& choice, Rgb specular = kWhite,
                            Fresnel fresnel = Fresnel::kNone) {
    Scene scene = sphere_scene(choice, {directional_at(45), point_light()}, 64);
    scene.materials[0].specular_reflectance = specular;
    scene.materials[0].fresnel = fresnel;
    const PovrayInput input = povray_input(scene);
    EXPECT_EQ(input.passes.size(), input.native ? 1u : 2u);
    return input.native;
  };
  EXPECT_TRUE(is_native({"phong_rdf", "cosine", "exact", 64}));
  EXPECT_TRUE(is_native({"phong_rdf", "cosine", "paper", 64}));
  EXPECT_TRUE(is_native({"blinn_phong_rdf", "cosine", "exact", 64}, {0.5, 0.5, 0.5}));
  EXPECT_FALSE(is_native({"phong_rdf", "cosine", "exact", 64}, {1, 0.5, 0.5}))
      << "its highlights have the colour of the lamp";
  EXPECT_FALSE(is_native({"phong_rdf", "cosine", "exact", 64}, kWhite, Fresnel::kSchlick));
  EXPECT_FALSE(is_native({"phong_rdf", "cs16", "exact", 64}));
  EXPECT_FALSE(is_native({"modified_phong", "cosine", "exact", 64}));
}

TEST(EngineUnits, KeepThePicture) {
  Scene scene = shadow_scene(kExpressed, {point_light(), directional_at(20)}, 48);
  const auto move = [](Vec3 point) { return 0.01 * point + Vec3{7, -3, 2}; };
  scene.camera.origin = move(scene.camera.origin);
  scene.camera.target = move(scene.camera.target);
  for (Sphere& sphere : scene.spheres) {
    sphere.center = move(sphere.center);
    sphere.radius *= 0.01;
  }
  auto& light = std::get<PointLight>(scene.lights[0]);
  light.position = move(light.position);
  const Image picture = render(scene, {}).image;
  const Scene placed = in_engine_units(scene);
  EXPECT_GE(placed.spheres[1].radius, 1);
  EXPECT_LT(placed.spheres[1].radius, 2);
  const Difference d = difference(render(placed, {}).image, picture, 1e-6, 1e-6);
  EXPECT_EQ(d.outliers, 0);
}

TEST(NotComparable, SaysWhy) {
  Scene scene = sphere_scene(kExpressed, {point_light()}, 16);
  EXPECT_EQ(why_not_comparable(scene), "");
  Scene inside = scene;
  inside.camera.origin = {0, 0, 0.5};
  EXPECT_THAT(why_not_for_programs(inside), HasSubstr("inside a sphere"));
  Scene wide = scene;
  wide.spheres.push_back({{1e9, 0, 0}, 1, 0});
  EXPECT_THAT(why_not_for_programs(wide), HasSubstr("precision"));
  EXPECT_EQ(make_engine("analytic", {})->why_not(wide, {}), "") << "formulas know no size";
}

TEST(NotComparable, IsAFeatureOfNoEngine) {
  const Scene scene = sphere_scene(kNative, {point_light()}, 16);
  const auto why = [&](auto change) {
    Scene changed = scene;
    change(changed);
    return why_not_comparable(changed);
  };
  EXPECT_THAT(why([](Scene& s) { s.depth.glossy = 1; }),
              HasSubstr("Cycles has none of the models"));
  EXPECT_THAT(why([](Scene& s) {
                s.materials[0].mirror_reflectance = kWhite;
                s.depth.mirror = 1;
                s.lights.push_back(SphereLight{});
              }),
              HasSubstr("lamps cannot be seen"));
  EXPECT_EQ(why([](Scene& s) { s.spheres.resize(1025, s.spheres.front()); }),
            "the scene has 1025 spheres; of more than 1024 no edges can be told, and nothing be "
            "compared");
  Scene glossy = scene;
  glossy.depth.glossy = 1;
  for (const EngineInfo& engine : engine_infos())
    EXPECT_THROW(keep_engine_input(engine.name, glossy, {}, "no_such_directory"), Error);
}

TEST(NotComparable, IsAMirrorThatShowsAPatternOfTheCamerasPlace) {
  const auto povray = make_engine("povray", {}), blender = make_engine("blender", {});
  for (const HighlightChoice& choice : {kExpressed, kNative}) {
    Scene scene = mirror_scene(choice, {point_light()}, 16);
    const bool native = choice.model == kNative.model;
    EXPECT_EQ(povray->why_not(scene, {}).empty(), native);
    EXPECT_EQ(blender->why_not(scene, {}), "");
    scene.depth.mirror = 0;
    EXPECT_EQ(povray->why_not(scene, {}), "") << "nothing is followed by it";
  }
}

TEST(NotComparable, IsALampOnASphereInEveryProgramUnlessItFacesAway) {
  const auto povray = make_engine("povray", {}), blender = make_engine("blender", {});
  const Vec3 up = normalize({0.3, 0.2, 1});
  Scene scene = ground_scene(kNative, {PointLight{up, kWhite}}, 16);
  for (const Vec3 away : {Vec3{}, Vec3{1e3, 2e3, -3e3}}) {
    Scene placed = moved(scene, 1, away);
    for (const auto* engine : {&povray, &blender})
      EXPECT_THAT((*engine)->why_not(placed, {}), HasSubstr("light 0 lies on sphere 0, and in"));
    EXPECT_EQ(make_engine("analytic", {})->why_not(placed, {}), "");
    std::get<PointLight>(placed.lights[0]).normal = up;
    EXPECT_EQ(blender->why_not(placed, {}), "") << "it lights nothing below its horizon";
    EXPECT_NE(povray->why_not(placed, {}), "");
  }
  scene.lights = {SphereLight{{0, 0, 0}, 1, kWhite}};
  EXPECT_EQ(blender->why_not(scene, {}), "") << "a bulb";
  EXPECT_THAT(povray->why_not(scene, {}), HasSubstr("lies on sphere 0"));
}

TEST(NotComparable, IsALampTooNearAPlaneForPovRay) {
  const auto povray = make_engine("povray", {}), blender = make_engine("blender", {});
  const auto why = [&](double height, Vec3 normal = {}) {
    const Scene scene =
        ground_scene(kNative, {PointLight{{2, -1 + height, 0}, kWhite, normal}}, 16);
    EXPECT_EQ(blender->why_not(scene, {}), "");
    return povray->why_not(scene, {});
  };
  EXPECT_EQ(why(0), "");
  EXPECT_EQ(why(0.01), "");
  for (const double height : {1e-3, -1e-3, 1e-9})
    EXPECT_EQ(
        why(height),
        "light 0 is nearer than 0.005 to plane 0 and does not lie on it, and POV-Ray's shadows do "
        "not tell the two apart");
  EXPECT_EQ(why(1e-3, {0, 1, 0}), "") << "it lights nothing of the plane's other side";
  EXPECT_NE(why(-1e-3, {0, 1, 0}), "");
}

TEST(EngineUnits, LeaveALampOnTheSurfacesThatItLiesOn) {
  // So far away that the rounding of places is beyond the closeness of what is near the origin.
  const Vec3 away{1e6, 2e6, -3e6}, normal = normalize({0.3, 1, 0.2});
  Scene scene = moved(sphere_scene(kNative, {}, 16), 1, away);
  scene.planes = {{away + Vec3{0, -1.5, 0}, normal, 0, 0, 1}};
  const Vec3 along = normalize(cross(normal, {1, 2, 3}));
  for (int i = 0; i < 50; ++i)
    scene.lights.push_back(PointLight{scene.planes[0].point + (0.1 * i - 2) * along, kWhite});
  scene.lights.push_back(PointLight{scene.spheres[0].center + normal, kWhite});
  const Contacts before = find_contacts(scene);
  EXPECT_EQ(before[0], std::vector{1});
  EXPECT_EQ(before[50], std::vector{0});
  EXPECT_EQ(find_contacts(in_engine_units(scene)), before);
}

TEST(BlenderInput, RefusesShapesEnlargedByBlender) {
  Scene scene = sphere_scene(kExpressed, {point_light()}, 16);
  scene.film = {3, 16};
  EXPECT_THROW(blender_input(scene, "scene0"), Error);
}

TEST(EngineCatalogue, FindsByNameAndSuggests) {
  for (const EngineInfo& engine : engine_infos())
    EXPECT_EQ(make_engine(engine.name, {})->info().name, engine.name);
  EXPECT_EQ(error_words(ExitCode::kUsage, [] { make_engine("blander", {}); }),
            "no reference engine 'blander'; there are: povray, blender, tachyon, sunflow, three, "
            "babylon, opengl, analytic; did you mean 'blender'?");
}

}  // namespace
}  // namespace lobelia

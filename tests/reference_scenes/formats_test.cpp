// Scenes for other programs: every format of the catalogue, and what the texts say to a reader that knows nothing of us.
#include "reference_scenes/formats/catalogue.hpp"

#include <fmt/format.h>

#include "base/pictures/contained_reader.hpp"
#include "base/pictures/image.hpp"
#include "base/records/scene.hpp"
#include "base/system/files.hpp"
#include "base/system/process.hpp"
#include "renderer/render.hpp"
#include "tests/canonical_scene.hpp"
#include "tests/json.hpp"
#include "tests/reference_scenes/require_engine.hpp"
#include "tests/reference_scenes/test_scenes.hpp"
#include "tests/renderer/random_scene.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

TEST(SceneFormats, HoldTheExamplesOrSayWhyNot) {
  struct {
    const char *scene, *format, *why;
  } const refusals[] = {
      {"oblique_45", "mitsuba", "material 0 is "},
      {"effects/area_light", "mitsuba", "it has a plane,"},
      {"effects/depth_of_field", "povray", "its picture is the average of many of POV-Ray"},
      {"effects/crowd", "povray", "the scene has 10164 spheres"},
  };
  for (const auto& [scene, format, why] : refusals)
    EXPECT_THAT(scene_format(format).why_not(canonical_scene(scene)), testing::StartsWith(why))
        << scene << " as " << format;
  for (const char* format : {"lobelia", "json", "blender-python", "povray"})
    EXPECT_EQ(scene_format(format).why_not(canonical_scene("two_spheres")), "") << format;
  for (const char* format : {"lobelia", "json", "blender-python"})
    for (const char* scene : {"effects/area_light", "effects/crowd", "effects/depth_of_field",
                              "effects/environment_map", "effects/mirrors"})
      EXPECT_EQ(scene_format(format).why_not(canonical_scene(scene)), "")
          << scene << " as " << format;
}

TEST(SceneFormats, WriteOrRefuseRandomScenesWithoutACrash) {
  int written = 0;
  expect_of_random_scenes(SceneKind::kAny, 200, [&](const Scene& scene, Random&) -> std::string {
    for (const SceneFormat& format : scene_formats()) {
      const std::string why = format.why_not(scene);
      if (why.ends_with('.'))
        return fmt::format("{}: the reason ends with a stop: {}", format.name, why);
      if (!why.empty()) continue;
      const auto texts = format.write(scene);
      ++written;
      if (!texts.contains(std::string(format.file)))
        return fmt::format("{}: no main file", format.name);
      for (const auto& [file, text] : texts) {
        if (text.empty()) return fmt::format("{}: {} is empty", format.name, file);
        if (text.find("nan") != text.npos && format.name != "povray")
          return fmt::format("{}: {} has a number that is none", format.name, file);
      }
    }
    return "";
  });
  EXPECT_GT(written, 400);
}

// ---- JSON ---------------------------------------------------------------------------------------

Json json_of(const Scene& scene) {
  return Json::parse(scene_format("json").write(scene).at("scene.json"));
}

TEST(JsonFormat, HasWhatARendererOfASphereNeeds) {
  for (const std::string_view model : model_names()) {
    SCOPED_TRACE(model);
    Scene scene = sphere_scene({model, "cosine", "paper", 24}, {directional_at(45, {1, 2, 3})}, 48);
    scene.camera.principal_point_offset_x = 0.05;
    scene.camera.principal_point_offset_y = -0.1;
    scene.film.height = 40;
    const Json json = json_of(scene);
    const Json &camera = json["camera"], &light = json["lights"][0], &own = json["materials"][0];
    const auto number = [](const Json& value) { return value.get<double>(); };
    const auto vector = [](const Json& v) { return Vec3{v[0], v[1], v[2]}; };
    const CameraFrame frame = camera_frame(scene.camera, scene.film);
    EXPECT_EQ(vector(camera["origin"]), frame.origin);
    EXPECT_EQ(vector(camera["right"]), frame.right);
    EXPECT_EQ(vector(camera["up"]), frame.up);
    EXPECT_EQ(vector(camera["forward"]), frame.forward);
    for (const double place : {0.5, 13.0, 39.5}) {
      EXPECT_NEAR((2 * place / 48 - 1) * number(camera["halfWidth"]) + number(camera["shiftU"]),
                  frame.film_u(place), 1e-15);
      EXPECT_NEAR((1 - 2 * place / 40) * number(camera["halfHeight"]) + number(camera["shiftV"]),
                  frame.film_v(place), 1e-15);
    }
    EXPECT_EQ(vector(light["direction"]), std::get<DirectionalLight>(scene.lights[0]).direction);
    EXPECT_EQ(vector(light["strength"]), (Vec3{1, 2, 3}));
    const ModelInfo& about = info(*find_model(model));
    EXPECT_EQ(own["angle"], about.angle == LobeAngle::kReflection ? "reflection" : "halfVector");
    EXPECT_EQ(own["appliesCosine"], about.applies_cosine);
    EXPECT_EQ(own["hasShadowing"], about.has_shadowing);
    EXPECT_EQ(own["exponent"], 24);
    EXPECT_EQ(number(own["coefficient"]), radiance_coefficient(scene.materials[0].highlight));
  }
}

TEST(JsonFormat, IsTheRecordOfTheSchemaAndReadsBackNumberForNumber) {
  expect_of_random_scenes(SceneKind::kAny, 100, [](const Scene& scene, Random&) -> std::string {
    const std::string text = scene_format("json").write(scene).at("scene.json");
    const auto record = records::parse_record<records::Scene>(text, "scene.json");
    if (records::record_text(record) != text) return "the record is another one when read";
    if (record.spheres.size() != scene.spheres.size() ||
        record.lights.size() != scene.lights.size())
      return "something is missing";
    for (std::size_t i = 0; i < record.materials.size(); ++i)
      if (record.materials[i].coefficient != radiance_coefficient(scene.materials[i].highlight))
        return "a coefficient has lost digits";
    return "";
  });
}

// ---- Blender ------------------------------------------------------------------------------------

TEST(BlenderPythonFormat, KeepsTextsOfTheSceneInsideItsStrings) {
  Scene scene = sphere_scene({"phong_rdf", "cosine", "exact", 64}, {directional_at(30)}, 32);
  scene.materials[0].id = "\"\"\"\nimport os\nos.system('x')\\\"\n'''";
  const std::string text = scene_format("blender-python").write(scene).at("scene.py");
  EXPECT_EQ(text.find("\nos.system"), text.npos);
  EXPECT_NE(text.find("\\\"\\\"\\\"\\nimport os\\n"), text.npos);
}

// The layers of a multilayer EXR that Blender itself writes.

using testing::Contains;

/// Blender's own first scene.
constexpr const char* kScript = R"(
import bpy, sys
scene = bpy.context.scene
scene.render.engine = 'CYCLES'
scene.cycles.samples = 4
scene.cycles.use_denoising = False
scene.render.resolution_x, scene.render.resolution_y = 24, 16
scene.render.resolution_percentage = 100
layer = scene.view_layers[0]
for name in ('z', 'normal', 'diffuse_direct', 'glossy_direct', 'environment'):
    setattr(layer, 'use_pass_' + name, True)
layer.cycles.denoising_store_passes = True
scene.render.image_settings.file_format = 'OPEN_EXR_MULTILAYER'
scene.render.image_settings.color_depth = '32'
scene.render.filepath = sys.argv[-1]
bpy.ops.render.render(write_still=True)
)";

class BlenderLayers : public testing::Test {
 protected:
  void SetUp() override { require_engine(*blender_); }
  std::filesystem::path render() {
    const auto path = directory_.path() / "picture.exr";
    const auto result =
        run_process({blender_->status().program.string(), "-b", "--factory-startup",
                     "--python-exit-code", "1", "--python-expr", kScript, "--", path.string()},
                    {});
    EXPECT_EQ(result.exit_code, 0) << result.output_tail;
    return path;
  }
  std::unique_ptr<Engine> blender_ = make_engine("blender", "");
  TemporaryDirectory directory_;
};

TEST_F(BlenderLayers, AreFoundByTheNamesThatPeopleUse) {
  const auto path = render();
  EXPECT_THAT(read_picture(path, "").source.channels, Contains("ViewLayer.Combined.R"));
  EXPECT_EQ(read_picture(path, "").source.samples, 4);
  for (const auto& [name, channel] : {std::pair{"combined", "ViewLayer.Combined.G"},
                                      {"ViewLayer.Combined", "ViewLayer.Combined.G"},
                                      {"albedo", "ViewLayer.Denoising Albedo.G"},
                                      {"N", "ViewLayer.Normal.Y"},
                                      {"depth", "ViewLayer.Depth.Z"},
                                      {"diffuse_direct", "ViewLayer.DiffDir.G"},
                                      {"GlossDir", "ViewLayer.GlossDir.G"}})
    EXPECT_THAT(read_picture(path, name).source.channels, Contains(channel)) << name;
  EXPECT_THAT(error_words(ExitCode::kInput, [&] { read_picture(path, "difuse"); }),
              HasSubstr("there are 'ViewLayer.DiffDir'"));
}

}  // namespace
}  // namespace lobelia

// Scenes for other programs: every format of the catalogue, and what the texts say to a reader that knows nothing of us.
#include "reference_scenes/formats/catalogue.hpp"

#include <fmt/format.h>

#include "base/pictures/image.hpp"
#include "base/records/scene.hpp"
#include "renderer/render.hpp"
#include "tests/canonical_scene.hpp"
#include "tests/json.hpp"
#include "tests/reference_scenes/test_scenes.hpp"
#include "tests/renderer/random_scene.hpp"
#include "tests/test.hpp"

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

using V = std::array<double, 3>;
V plus(double k, V a, V b) { return {k * a[0] + b[0], k * a[1] + b[1], k * a[2] + b[2]}; }
double times(V a, V b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
V unit(V a) { return plus(1 / std::sqrt(times(a, a)) - 1, a, a); }

/// A renderer of one sphere under parallel light that has read nothing but the record and its page of documentation.
std::vector<double> picture_of(const Json& scene) {
  const Json& camera = scene["camera"];
  const Json &light = scene["lights"][0], &material = scene["materials"][0],
             &sphere = scene["spheres"][0];
  const int width = scene["film"]["width"], height = scene["film"]["height"];
  const double half_width = camera["halfWidth"], half_height = camera["halfHeight"],
               radius = sphere["radius"];
  const V origin = camera["origin"], right = camera["right"], up = camera["up"],
          forward = camera["forward"];
  const V center = sphere["center"], to_light = plus(-2, light["direction"], light["direction"]);
  std::vector<double> picture;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = (2 * (x + 0.5) / width - 1) * half_width + double(camera["shiftU"]);
      const double v = (1 - 2 * (y + 0.5) / height) * half_height + double(camera["shiftV"]);
      const V ray = unit(plus(u, right, plus(v, up, forward)));
      const V from = plus(-1, center, origin);
      const double b = times(from, ray), d = b * b - times(from, from) + radius * radius;
      V radiance{};
      if (d > 0 && b < 0) {
        const V point = plus(-b - std::sqrt(d), ray, from);
        const V normal = unit(point), to_eye = plus(-2, ray, ray);
        const double n_dot_l = times(normal, to_light);
        const bool reflection = material["angle"] == "reflection";
        const V direction = reflection
                                ? plus(2 * times(normal, to_eye), normal, plus(-2, to_eye, to_eye))
                                : unit(plus(1, to_eye, to_light));
        const double cosine = std::max(0.0, times(direction, reflection ? to_light : normal));
        double lobe = std::pow(cosine, double(material["exponent"]));
        if (material["appliesCosine"]) lobe *= n_dot_l;
        if (material["hasShadowing"]) {
          const double n_dot_v = times(normal, to_eye), n = material["exponent"];
          const auto lambda = [&](double c) {
            return (std::sqrt(1 + 2 / (n + 2) * (1 / (c * c) - 1)) - 1) / 2;
          };
          lobe /= (1 + lambda(n_dot_l) + lambda(n_dot_v)) * n_dot_l * n_dot_v;
        }
        for (std::size_t c = 0; n_dot_l > 0 && c < 3; ++c)
          radiance[c] = double(light["strength"][c]) *
                        (double(material["specular"][c]) * double(material["coefficient"]) * lobe +
                         double(material["diffuse"][c]) / std::numbers::pi * n_dot_l);
      }
      picture.insert(picture.end(), radiance.begin(), radiance.end());
    }
  return picture;
}

TEST(JsonFormat, AloneGivesOurPictureOfASphere) {
  for (const std::string_view model : model_names())
    for (const std::string_view normalisation : normalisation_names()) {
      SCOPED_TRACE(fmt::format("{} {}", model, normalisation));
      Scene scene =
          sphere_scene({model, "cosine", normalisation, 24}, {directional_at(45, {1, 2, 3})}, 48);
      scene.materials[0].specular_reflectance = {0.9, 0.5, 0.1};
      scene.materials[0].diffuse_reflectance = {0.2, 0.1, 0.4};
      scene.camera.principal_point_offset_x = 0.05;
      scene.camera.principal_point_offset_y = -0.1;
      scene.film.height = 40;
      const std::vector<double> theirs = picture_of(json_of(scene));
      const Image ours = render(scene, {}).image;
      ASSERT_EQ(theirs.size(), ours.values().size());
      const double peak = *std::ranges::max_element(ours.values());
      ASSERT_GT(peak, 0.1);
      for (std::size_t i = 0; i < theirs.size(); ++i)
        ASSERT_NEAR(theirs[i], ours.values()[i], 1e-5 * peak) << "value " << i;
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

}  // namespace
}  // namespace lobelia

// Scenes for other programs: every format of the catalogue, and what the texts say to a reader that knows nothing of us.
#include "reference_scenes/formats/catalogue.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "core/image.hpp"
#include "records/scene.hpp"
#include "renderer/render.hpp"
#include "tests/canonical_scene.hpp"
#include "tests/json.hpp"
#include "tests/reference_scenes/test_scenes.hpp"
#include "tests/renderer/random_scene.hpp"

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
      {"effects/environment_map", "gltf-lights", "it has a light with a size"},
      {"effects/mirrors", "gltf-lights", "it has a checker"},
  };
  for (const auto& [scene, format, why] : refusals)
    EXPECT_THAT(scene_format(format).why_not(canonical_scene(scene)), testing::StartsWith(why))
        << scene << " as " << format;
  for (const char* format : {"lobelia", "json", "blender-python", "povray", "gltf-lights"})
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

// ---- glTF ---------------------------------------------------------------------------------------

std::string bytes_of(const std::string& uri) {
  const std::string head = "data:application/octet-stream;base64,";
  EXPECT_TRUE(uri.starts_with(head));
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : uri.substr(head.size())) {
    if (c == '=') break;
    bits = bits << 6 | std::uint32_t(digits.find(c));
    count += 6;
    if (count >= 8) bytes += char(bits >> (count -= 8) & 255);
  }
  return bytes;
}

/// The numbers of an accessor.
template <class T>
std::vector<T> numbers(const Json& gltf, int accessor) {
  const Json& a = gltf["accessors"][std::size_t(accessor)];
  const Json& view = gltf["bufferViews"][a["bufferView"].get<std::size_t>()];
  const std::string bytes = bytes_of(gltf["buffers"][0]["uri"]);
  EXPECT_EQ(bytes.size(), gltf["buffers"][0]["byteLength"]);
  const std::size_t offset = view["byteOffset"], length = view["byteLength"];
  EXPECT_EQ(offset % 4, 0u);
  EXPECT_LE(offset + length, bytes.size());
  std::vector<T> values(length / sizeof(T));
  std::memcpy(values.data(), bytes.data() + offset, length);
  EXPECT_EQ(values.size(), a["count"].get<std::size_t>() * (a["type"] == "VEC3" ? 3 : 1));
  return values;
}

TEST(GltfFormat, HasMeshesLightsAndCameraInTheirPlaces) {
  Scene scene = shadow_scene({"blinn_phong_ndf", "cosine", "exact", 64},
                             {directional_at(45, {1, 2, 4}), point_light()}, 64);
  scene.planes.push_back({{0, -1, 0}, {0, 1, 0}, 1, 1});
  const Json gltf = Json::parse(scene_format("gltf-lights").write(scene).at("scene.gltf"));
  EXPECT_EQ(gltf["asset"]["version"], "2.0");
  // Every node is shown, once.
  std::set<int> shown;
  for (const Json& node : gltf["scenes"][0]["nodes"])
    EXPECT_TRUE(shown.insert(node.get<int>()).second);
  EXPECT_EQ(shown.size(), gltf["nodes"].size());
  int meshes = 0, lights = 0, cameras = 0;
  for (const Json& node : gltf["nodes"]) {
    if (node.contains("mesh")) {
      ++meshes;
      ASSERT_LT(node["mesh"].get<std::size_t>(), gltf["meshes"].size());
    }
    if (node.contains("camera")) ++cameras;
    if (node.contains("matrix")) {
      const std::array<double, 16> m = node["matrix"];
      const V x{m[0], m[1], m[2]}, y{m[4], m[5], m[6]}, z{m[8], m[9], m[10]};
      EXPECT_NEAR(times(x, y), 0, 1e-9 * times(x, x));
      EXPECT_NEAR(times(y, z), 0, 1e-9 * times(x, x));
      EXPECT_GT(x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0]) +
                    x[2] * (y[0] * z[1] - y[1] * z[0]),
                0);
    }
    if (!node.contains("extensions")) continue;
    const auto which = node["extensions"]["KHR_lights_punctual"]["light"].get<std::size_t>();
    const Json& light = gltf["extensions"]["KHR_lights_punctual"]["lights"][which];
    ++lights;
    if (light["type"] == "point") {
      EXPECT_EQ(node["translation"].get<V>(), (V{2, 1.5, 3}));
      EXPECT_EQ(light["intensity"], 10);
      continue;
    }
    EXPECT_EQ(light["intensity"], 4);
    EXPECT_EQ(light["color"].get<V>(), (V{0.25, 0.5, 1}));
    const Vec3 direction = std::get<DirectionalLight>(scene.lights[0]).direction;
    const std::array<double, 16> m = node["matrix"];
    EXPECT_NEAR(-m[8], direction.x, 1e-12);
    EXPECT_NEAR(-m[9], direction.y, 1e-12);
    EXPECT_NEAR(-m[10], direction.z, 1e-12);
  }
  EXPECT_EQ(meshes, 3);
  EXPECT_EQ(lights, 2);
  EXPECT_EQ(cameras, 1);
}

TEST(GltfFormat, HasSpheresOfUnitRadiusThatFaceOutwards) {
  const Json gltf = Json::parse(
      scene_format("gltf-lights").write(canonical_scene("oblique_45")).at("scene.gltf"));
  const Json& primitive = gltf["meshes"][0]["primitives"][0];
  const auto positions = numbers<float>(gltf, primitive["attributes"]["POSITION"]);
  const auto normals = numbers<float>(gltf, primitive["attributes"]["NORMAL"]);
  const auto indices = numbers<std::uint16_t>(gltf, primitive["indices"]);
  const auto at = [&](std::size_t i) {
    return V{positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
  };
  for (std::size_t i = 0; i < positions.size() / 3; ++i) EXPECT_NEAR(times(at(i), at(i)), 1, 1e-6);
  EXPECT_EQ(positions, normals);
  ASSERT_EQ(indices.size() % 3, 0u);
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    ASSERT_LT(indices[i], positions.size() / 3);
    const V a = at(indices[i]), b = plus(-1, a, at(indices[i + 1])),
            c = plus(-1, a, at(indices[i + 2]));
    const V outwards{b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2],
                     b[0] * c[1] - b[1] * c[0]};
    EXPECT_GT(times(outwards, a), 0) << "triangle " << i / 3;
  }
  const Json& accessor = gltf["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_EQ(accessor["min"].get<V>(), (V{-1, -1, -1}));
  EXPECT_EQ(accessor["max"].get<V>(), (V{1, 1, 1}));
}

TEST(GltfFormat, StatesRoughnessByItsRuleAndTheExactModelInExtras) {
  for (const auto& [model, exponent_of_normals] :
       {std::pair("blinn_phong_ndf", 64.0), std::pair("phong_rdf", 256.0)}) {
    const Scene scene = sphere_scene({model, "cs16", "exact", 64}, {directional_at(30)}, 32);
    const Json gltf = Json::parse(scene_format("gltf-lights").write(scene).at("scene.gltf"));
    const Json& material = gltf["materials"][0];
    const double roughness = material["pbrMetallicRoughness"]["roughnessFactor"];
    EXPECT_NEAR(std::pow(roughness, 4), 2 / (exponent_of_normals + 2), 1e-12);
    EXPECT_EQ(material["extras"]["model"], model);
    EXPECT_EQ(material["extras"]["lobe"], "cs16");
    EXPECT_EQ(material["extras"]["coefficient"],
              radiance_coefficient(scene.materials[0].highlight));
  }
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

// Axes that turn a light and that choose GGX, and axes that cannot stand together.
#include <map>

#include "renderer/scene/scene_io.hpp"
#include "tests/farm/grid_text.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

std::map<std::string, std::string> values_on_axes(const Cell& cell) {
  return {cell.axes.begin(), cell.axes.end()};
}

TEST(Axes, TurnTheLightToTheirAngleFromTheEye) {
  const std::string scene = axis("scene", kSceneFiles + "head_on.xml, " + kSceneFiles +
                                              "oblique_45.xml, " + kSceneFiles + "point_light.xml");
  for (const auto& cell : cells_of(grid_of(scene + axis("angle", "0, 12.5, 45, 90, 180")))) {
    const Grid grid = grid_of(scene + axis("angle", "0, 12.5, 45, 90, 180"));
    const Scene turned = scene_of(grid, cell);
    auto values = values_on_axes(cell);
    const Scene start = read_scene(values["scene"]);
    const Vec3 eye = normalize(turned.camera.origin - turned.camera.target);
    const Lamp lamp = lamp_of(turned.lights[0]), before = lamp_of(start.lights[0]);
    const Vec3 place = lamp.position - turned.camera.target;
    const Vec3 to_light = lamp.is_distant ? -lamp.direction : normalize(place);
    EXPECT_NEAR(std::acos(std::clamp(dot(to_light, eye), -1.0, 1.0)) * 180 / kPi,
                std::stod(values["angle"]), 1e-6);
    EXPECT_EQ(max_component(lamp.strength), max_component(before.strength));
    if (!lamp.is_distant) {
      EXPECT_NEAR(length(place), length(before.position - start.camera.target), 1e-12);
    }
    if (values["angle"] == "45" && lamp.is_distant) {
      // Both canonical scenes become the second one.
      EXPECT_NEAR(lamp.direction.x, -0.5, 1e-12);
      EXPECT_NEAR(lamp.direction.y, -0.5, 1e-12);
    }
  }
  EXPECT_THAT(error_of(axis("scene", kSceneFiles + "two_lights.xml") + axis("angle", "45")),
              testing::HasSubstr("the one directional, point or spot light"));
  const TemporaryDirectory directory;
  Scene at_target = read_scene(kSceneFiles + "point_light.xml");
  std::get<PointLight>(at_target.lights[0]).position = at_target.camera.target;
  write_file(directory.path() / "t.xml", scene_to_xml(at_target));
  EXPECT_THAT(error_of(axis("scene", (directory.path() / "t.xml").string()) + axis("angle", "45")),
              testing::HasSubstr("has it there"));
}

TEST(Axes, TakeGgxByItsRoughness) {
  const Grid grid = grid_of(kScene + axis("model", "ggx, phong_rdf") + axis("roughness", "0.3, 1"));
  for (const auto& cell : cells_of(grid)) {
    const Highlight h = scene_of(grid, cell).materials[0].highlight;
    auto values = values_on_axes(cell);
    const double alpha = std::pow(std::stod(values["roughness"]), 2);
    EXPECT_NEAR(alpha_squared(h.exponent), alpha * alpha, 1e-3 * alpha * alpha);
    EXPECT_EQ(info(h.model).name, values["model"] == "ggx" ? "microfacet_smith" : "phong_rdf");
    EXPECT_EQ(info(h.lobe).name, values["model"] == "ggx" ? "ggx" : "cosine");
  }
}

TEST(Axes, AreRefusedThatSetTheSameThing) {
  for (const auto& [one, other] :
       {std::pair{axis("model", "ggx"), axis("lobe", "cosine")},
        {axis("model", "ggx"), axis("normalisation", "paper")},
        {axis("exponent", "16"), axis("roughness", "0.5")},
        {axis("angle", "45"), axis("light", kSceneFiles + "head_on.xml")}})
    EXPECT_THAT(error_of(kScene + one + other), testing::HasSubstr("beside an axis")) << one;
}

}  // namespace
}  // namespace lobelia

#include "renderer/edge_map.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "core/error.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace {

Scene canonical(const std::string& name) {
  Scene scene =
      read_scene(std::string(LOBELIA_SOURCE_DIR) + "/reference_scenes/scenes/" + name + ".xml");
  scene.film = {128, 128};
  return scene;
}

int count(const std::vector<std::uint8_t>& edges) {
  return std::accumulate(edges.begin(), edges.end(), 0);
}

TEST(EdgeMap, OfASphereLitFromTheCameraIsARingAboutItsSilhouette) {
  const auto edges = edge_map(canonical("head_on"));
  // Radius of the silhouette: tan(asin(1/5)) / tan(14 degrees) of half the picture.
  const double radius = 64 * 0.204124 / 0.249328;
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) {
      const double r = std::hypot(x - 63.5, y - 63.5);
      if (std::abs(r - radius) > 2.5) {
        EXPECT_EQ(edges[std::size_t(128 * y + x)], 0) << x << " " << y;
      }
    }
  EXPECT_GT(count(edges), int(2 * 3.14 * radius));
}

TEST(EdgeMap, GrowsByTerminatorAndByShadowEdge) {
  EXPECT_GT(count(edge_map(canonical("grazing_80"))), count(edge_map(canonical("head_on"))));
  Scene scene = canonical("two_spheres");
  const int with = count(edge_map(scene));
  scene.spheres[1].center = {3, 3, -20};  // still in view, no longer in the way of the light
  EXPECT_LT(count(edge_map(scene)), with);
}

TEST(EdgeMap, OfNothingIsEmpty) {
  Scene scene = canonical("head_on");
  scene.spheres.clear();
  EXPECT_EQ(count(edge_map(scene)), 0);
}

TEST(EdgeMap, RefusesASceneInWhichASingleRayDoesNotTell) {
  const auto message = [](auto change) -> std::string {
    Scene scene = canonical("head_on");
    change(scene);
    try {
      edge_map(scene);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kInput);
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(
      message([](Scene& s) {
        s.lights.push_back(EnvironmentLight{});
        s.planes.push_back({});
      }),
      "silhouettes, terminators and shadow edges can be told of a scene of up to 1024 spheres "
      "under directional and point lights; this one has more: an environment light, a ground "
      "plane");
  EXPECT_NE(message([](Scene& s) { s.spheres.resize(1025, s.spheres.front()); }), "");
  EXPECT_EQ(message([](Scene& s) { s.spheres.resize(1024, {{0, 0, -1e6}, 1, 0}); }), "");
}

}  // namespace
}  // namespace lobelia

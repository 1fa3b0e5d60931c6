#include "renderer/scene/scene.hpp"

#include "tests/renderer/simple_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

Scene plain() {
  Scene scene = one_sphere(shiny(16));
  scene.camera.fov_degrees = 28;
  scene.film = {24, 24};
  scene.lights = {DirectionalLight{{0, 0, -1}, {1, 1, 1}}};
  return scene;
}

float brightest(const Scene& scene) {
  const Image image = render(scene, {}).image;
  return *std::max_element(image.values().begin(), image.values().end());
}

TEST(Remarks, AreNoneForAnOrdinaryScene) {
  Scene scene = plain();
  EXPECT_THAT(remarks(scene), IsEmpty());
  EXPECT_GT(brightest(scene), 1);
  // The camera looks aside, but with the sphere's rim in a corner.
  scene.camera.target = {1.9, 1.9, 0};
  EXPECT_THAT(remarks(scene), IsEmpty());
}

TEST(Remarks, SayWhyAPictureIsBlackAndItIs) {
  constexpr std::pair<void (*)(Scene&), const char*> kCases[] = {
      {[](Scene& s) { s.lights.clear(); }, "no light: the picture is black"},
      {[](Scene& s) {
         s.lights = {PointLight{{0, 0, 3}, {0, 0, 0}}};
       },
       "no light shines"},
      {[](Scene& s) {
         s.lights = {PointLight{{0, 0.2, 0}, {1, 1, 1}}};
       },
       "light 0 is inside sphere 0"},
      {[](Scene& s) { s.spheres.clear(); }, "shows nothing"},
      {[](Scene& s) {
         s.camera.origin = {0, 0, 0.5};
       },
       "inside sphere 0"},
      {[](Scene& s) {
         s.camera.target = {0, 0, 10};
       },
       "looks away"},
  };
  for (const auto& [change, remark] : kCases) {
    Scene scene = plain();
    change(scene);
    EXPECT_THAT(remarks(scene), ElementsAre(HasSubstr(remark)));
    EXPECT_EQ(brightest(scene), 0) << remark;
  }
}

TEST(Remarks, ExplainASceneWithLightsAlone) {
  Scene scene = plain();
  scene.spheres.clear();
  scene.lights = {ConstantLight{{0.5, 0.5, 0.5}}};
  EXPECT_THAT(remarks(scene), ElementsAre(HasSubstr("its lights alone")));
  EXPECT_EQ(brightest(scene), 0.5f);
}

TEST(Remarks, ExplainACameraOnASphere) {
  Scene scene = plain();
  for (int i = 0; i < 200; ++i) {
    const double up = std::sin(0.01 * i), across = std::cos(0.01 * i);
    scene.camera.origin = {across * std::sin(i), up, across * std::cos(i)};
    scene.camera.target = {0.1, -0.2, 0.3};
    EXPECT_THAT(remarks(scene), ElementsAre(HasSubstr("on sphere 0"))) << i;
    EXPECT_EQ(brightest(scene), 0) << i;
  }
}

TEST(Remarks, AreFewWhateverTheNumberOfSpheres) {
  Scene scene = plain();
  scene.spheres.resize(100000, scene.spheres[0]);
  scene.camera.origin = {0, 0, 0};
  scene.camera.target = {0, 0, -1};
  EXPECT_LE(remarks(scene).size(), 3u);
}

}  // namespace
}  // namespace lobelia

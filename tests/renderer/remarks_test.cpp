#include "renderer/scene/scene.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "renderer/render.hpp"

namespace lobelia {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Scene plain() {
  Scene scene;
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 28};
  scene.film = {24, 24};
  scene.lights = {DirectionalLight{{0, 0, -1}, {1, 1, 1}}};
  Material material;
  material.highlight = {*find_model("phong_rdf"), *find_lobe("cosine"), {}, 16};
  material.specular_reflectance = {1, 1, 1};
  scene.materials = {material};
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  return scene;
}

float brightest(const Scene& scene) {
  const Image image = render(scene, {}).image;
  return *std::max_element(image.values().begin(), image.values().end());
}

TEST(Remarks, OfAnOrdinarySceneAreNone) {
  EXPECT_THAT(remarks(plain()), IsEmpty());
  EXPECT_GT(brightest(plain()), 1);
}

TEST(Remarks, OfASceneWithoutLightSayThatItIsBlackAndItIs) {
  Scene scene = plain();
  scene.lights.clear();
  EXPECT_THAT(remarks(scene), ElementsAre(HasSubstr("no light: the picture is black")));
  EXPECT_EQ(brightest(scene), 0);
  scene.lights = {PointLight{{0, 0, 3}, {0, 0, 0}}};
  EXPECT_THAT(remarks(scene), ElementsAre(HasSubstr("no light shines")));
  EXPECT_EQ(brightest(scene), 0);
}

TEST(Remarks, OfASceneWithoutShapesSayWhatIsLeftToSee) {
  Scene scene = plain();
  scene.spheres.clear();
  EXPECT_THAT(remarks(scene), ElementsAre(HasSubstr("shows nothing")));
  EXPECT_EQ(brightest(scene), 0);
  scene.lights = {ConstantLight{{0.5, 0.5, 0.5}}};
  EXPECT_THAT(remarks(scene), ElementsAre(HasSubstr("its lights alone")));
  EXPECT_EQ(brightest(scene), 0.5f);
}

TEST(Remarks, OfACameraInsideASphereSayThatItDoesNotSeeIt) {
  Scene scene = plain();
  scene.camera.origin = {0, 0, 0.5};
  EXPECT_THAT(remarks(scene), ElementsAre(HasSubstr("inside sphere 0")));
  EXPECT_EQ(brightest(scene), 0);
}

TEST(Remarks, OfACameraOnASphereSayThatItDoesNotSeeItAndThePictureIsBlackWhateverItsRounding) {
  Scene scene = plain();
  for (int i = 0; i < 200; ++i) {
    const double up = std::sin(0.01 * i), across = std::cos(0.01 * i);
    scene.camera.origin = {across * std::sin(i), up, across * std::cos(i)};
    scene.camera.target = {0.1, -0.2, 0.3};
    EXPECT_THAT(remarks(scene), ElementsAre(HasSubstr("on sphere 0"))) << i;
    EXPECT_EQ(brightest(scene), 0) << i;
  }
}

TEST(Remarks, OfACameraThatLooksAwaySaySoAndThePictureIsBlack) {
  Scene scene = plain();
  scene.camera.target = {0, 0, 10};
  EXPECT_THAT(remarks(scene), ElementsAre(HasSubstr("looks away")));
  EXPECT_EQ(brightest(scene), 0);
  // Aside, but with the sphere's rim in a corner.
  scene.camera.target = {1.9, 1.9, 0};
  EXPECT_THAT(remarks(scene), IsEmpty());
}

TEST(Remarks, OfALightInsideASphereSayThatItIsHidden) {
  Scene scene = plain();
  scene.lights = {PointLight{{0, 0.2, 0}, {1, 1, 1}}};
  EXPECT_THAT(remarks(scene), ElementsAre(HasSubstr("light 0 is inside sphere 0")));
  EXPECT_EQ(brightest(scene), 0);
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

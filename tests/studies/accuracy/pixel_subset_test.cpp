#include "studies/accuracy/accuracy.hpp"

#include "renderer/render.hpp"
#include "renderer/scene/scene_io.hpp"
#include "tests/canonical_scene.hpp"
#include "tests/test.hpp"

namespace lobelia::accuracy {
namespace {

Scene oblique(int side) {
  Scene result = canonical_scene("oblique_45");
  result.film.width = result.film.height = side;
  return result;
}

TEST(PixelSubset, IsOfThePicturesOwnPixels) {
  Scene s = oblique(301);
  s.film.height = 213;
  s.camera.principal_point_offset_x = 0.1;
  s.camera.principal_point_offset_y = -0.05;
  const Scene subset = pixel_subset(s, 64);
  const int every = s.film.width / subset.film.width;
  EXPECT_EQ(every, 5);
  EXPECT_EQ(subset.film.height, 42);
  RenderOptions options;
  options.precision = Precision::kFloat64;
  const Image all = render(s, options).image, some = render(subset, options).image;
  double most = 0;
  for (int y = 0; y < some.height(); ++y)
    for (int x = 0; x < some.width(); ++x) {
      const float here = some.pixel(x, y)[0];
      const float there = all.pixel(every * x + every / 2, every * y + every / 2)[0];
      EXPECT_NEAR(here, there, 1e-5) << x << ", " << y;
      most = std::max(most, double(here));
    }
  EXPECT_GT(most, 1);
}

TEST(PixelSubset, IsTheWholeOfASmallPicture) {
  const Scene s = oblique(40);
  EXPECT_EQ(pixel_subset(s, 40).film.width, 40);
  EXPECT_EQ(pixel_subset(s, 40).camera.fov_degrees, s.camera.fov_degrees);
  Scene line = s;
  line.film.width = 1000, line.film.height = 1;
  EXPECT_EQ(pixel_subset(line, 64).film.width, 1000);
}

}  // namespace
}  // namespace lobelia::accuracy

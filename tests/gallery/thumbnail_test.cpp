// What a thumbnail shows of our picture.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/colour.hpp"
#include "core/image_io.hpp"
#include "gallery/gallery.hpp"
#include "tests/gallery/fake_farm.hpp"

namespace lobelia::gallery {
namespace {

constexpr int kSide = 120;

/// A square highlight on black, from (x, y) on, as our picture of a cell.
void put_highlight(const FakeFarm& farm, int x, int y, int side) {
  Image image(kSide, kSide);
  for (int v = y; v < y + side; ++v)
    for (int u = x; u < x + side; ++u) std::ranges::fill(image.pixel(u, v), 1.0f);
  write_png(farm.cell_directory(FakeFarm::kPass) / "lobelia.png", to_display(image, 0));
  write_file(farm.cell_directory(FakeFarm::kPass) / "scene.xml", "<scene/>");
  farm.seal(FakeFarm::kPass);
}

/// Empty if there is none.
std::optional<Image> thumbnail(const FakeFarm& farm, const SurfaceOf& surface) {
  GalleryOptions options;
  options.surface = surface;
  write_gallery(farm.directory(), options);
  const auto file = farm.cell_directory(FakeFarm::kPass) / "thumbnail.png";
  if (!std::filesystem::exists(file)) return {};
  return read_image(file);
}

PixelFlags left_half(const std::filesystem::path& scene, int width, int height) {
  EXPECT_EQ(scene.filename(), "scene.xml");
  PixelFlags mask(std::size_t(width) * height);
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = int(i) % width < width / 2;
  return mask;
}

TEST(Thumbnail, IsGreyWhereItIsBlackAndNoSurfaceIs) {
  const FakeFarm farm;
  put_highlight(farm, 10, 10, 90);
  const auto image = thumbnail(farm, left_half);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->pixel(5, 5)[0], 0) << "a surface without light";
  EXPECT_GT(image->pixel(kSide - 5, 5)[0], 0) << "no surface";
  EXPECT_LT(image->pixel(kSide - 5, 5)[0], 0.1f);
  EXPECT_EQ(image->pixel(90, 50)[0], 1) << "light that is there stays";
}

TEST(Thumbnail, EnlargesASmallHighlightInTheFarthestCornerAndNoLargeOne) {
  for (const auto& [x, y] : {std::pair(20, 20), {90, 20}, {20, 90}, {90, 90}}) {
    const FakeFarm farm;
    put_highlight(farm, x, y, 6);
    const auto image = thumbnail(farm, {});
    ASSERT_TRUE(image);
    int bright = 0;
    for (int v = 0; v < kSide; ++v)
      for (int u = 0; u < kSide; ++u) {
        const bool is_far =
            (u < kSide / 2) == (x > kSide / 2) && (v < kSide / 2) == (y > kSide / 2);
        bright += is_far && image->pixel(u, v)[0] == 1;
      }
    EXPECT_GE(bright, 4 * 36) << x << ", " << y << ": enlarged at least twice";
  }
  const FakeFarm farm;
  put_highlight(farm, 10, 10, 40);
  const auto image = thumbnail(farm, {});
  ASSERT_TRUE(image);
  EXPECT_EQ(image->pixel(100, 100)[0], 0);
}

TEST(Thumbnail, IsMadeWithoutTheSceneWhereThatCannotBeRead) {
  const FakeFarm farm;
  put_highlight(farm, 10, 10, 40);
  EXPECT_TRUE(thumbnail(farm, [](const auto&, int, int) -> PixelFlags {
    throw Error(ExitCode::kInput, "a scene of another version");
  }));
}

}  // namespace
}  // namespace lobelia::gallery

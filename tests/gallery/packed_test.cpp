#include "gallery/site/gallery.hpp"
#include "tests/gallery/fake_farm.hpp"
#include "tests/gallery/site.hpp"
#include "tests/test.hpp"

namespace lobelia::gallery {
namespace {

class PackedGallery : public ::testing::Test {
 protected:
  PackedGallery() {
    options_.site = elsewhere_.path() / "site";
    options_.metrics_only = true;
  }
  void publish(std::optional<bool> packed) {
    options_.packed = packed;
    write_gallery(farm_.directory(), options_);
  }

  FakeFarm farm_;
  TemporaryDirectory elsewhere_;
  GalleryOptions options_;
};

TEST_F(PackedGallery, AddsNoFileForACell) {
  publish(true);
  const std::size_t before = files_below(options_.site).size();
  farm_.add_cell("one_more", "pass", {});
  farm_.write();
  publish(true);
  EXPECT_EQ(files_below(options_.site).size(), before);
}

TEST_F(PackedGallery, LeavesNothingOfTheOtherLayout) {
  const auto names_with = [&](bool packed) {
    publish(packed);
    std::set<std::string> names;
    for (const auto& [name, text] : files_below(options_.site)) names.insert(name);
    return names;
  };
  const auto single = names_with(false), packed = names_with(true);
  EXPECT_TRUE(single.contains("cells/" + FakeFarm::kPass + "/index.html"));
  EXPECT_FALSE(fs::exists(options_.site / "cells"));
  EXPECT_TRUE(packed.contains("cell.html"));
  EXPECT_EQ(names_with(false), single);
  EXPECT_FALSE(fs::exists(options_.site / "packed"));
  EXPECT_EQ(names_with(true), packed);
}

TEST_F(PackedGallery, IsForManyCells) {
  publish(std::nullopt);
  EXPECT_FALSE(fs::exists(options_.site / "cell.html"));
}

TEST_F(PackedGallery, HasNoLinkThatLeadsNowhere) {
  publish(true);
  const Site site(options_.site);
  EXPECT_EQ(site.pages().size(), 2u);
  EXPECT_THAT(site.bad_links(), IsEmpty());
  EXPECT_THAT(site.active_content(), IsEmpty());
}

TEST_F(PackedGallery, IsMadeWithoutAPictureThatCannotBeDecoded) {
  std::string damaged = tiny_png();
  damaged.replace(damaged.size() - 30, 8, 8, '\0');
  write_file(farm_.cell_directory(FakeFarm::kPass) / "lobelia.png", damaged);
  farm_.seal(FakeFarm::kPass);
  for (const bool packed : {true, false}) EXPECT_NO_THROW(publish(packed)) << packed;
}

}  // namespace
}  // namespace lobelia::gallery

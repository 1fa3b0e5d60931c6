// Pictures that a gallery makes: which maps a site has and when they are made, and what a thumbnail shows of ours.
#include <atomic>
#include <cerrno>

#include <zlib.h>

#include "base/pictures/colour.hpp"
#include "base/pictures/image_io.hpp"
#include "base/records/comparison.hpp"
#include "base/system/error.hpp"
#include "base/system/no_resources.hpp"
#include "gallery/packed/half_picture.hpp"
#include "gallery/site/derived_pictures.hpp"
#include "gallery/site/gallery.hpp"
#include "tests/gallery/fake_farm.hpp"
#include "tests/gallery/site.hpp"
#include "tests/test.hpp"

namespace lobelia::gallery {
namespace {

Image flat(int width, int height, float value) {
  Image image(width, height);
  std::fill(image.values().begin(), image.values().end(), value);
  return image;
}

class DifferenceMaps : public ::testing::Test {
 protected:
  DifferenceMaps() {
    write_picture("lobelia", flat(3, 2, 1));
    write_picture("povray", flat(3, 2, 0.75f));
    options_.site = elsewhere_.path() / "site";
    options_.maps = {{"probe", "Probe", "what a test asks for",
                      [this](const Image& a, const Image& b, const MapViewing& viewing) {
                        ++measured_;
                        if (a.width() == 3) seen_ = viewing;  // other cells have smaller ones
                        return std::vector<float>(a.pixel_count(), a.values()[0] - b.values()[0]);
                      }}};
  }
  void write_picture(const std::string& engine, const Image& image) const {
    const auto path = farm_.cell_directory(FakeFarm::kPass) / (engine + ".exr");
    std::filesystem::remove(path);
    write_exr(path, image, {});
    farm_.seal(FakeFarm::kPass);
  }
  void change_viewing(void (*change)(records::Viewing& viewing)) const {
    farm_.change<records::Comparison>(FakeFarm::kPass, "lobelia-povray.json",
                                      [&](records::Comparison& record) { change(record.viewing); });
  }
  std::string cell_data() const {
    return read_file(options_.site / "cells" / FakeFarm::kPass / "data.js", 1 << 20);
  }
  std::filesystem::path script() const {
    return options_.site / "cells" / FakeFarm::kPass / "povray.map.probe.js";
  }
  void publish() { write_gallery(farm_.directory(), options_); }

  FakeFarm farm_;
  TemporaryDirectory elsewhere_;
  GalleryOptions options_;
  std::atomic<int> measured_{0};
  MapViewing seen_{};
};

TEST_F(DifferenceMaps, AreOfEachComparisonUnderItsViewingCondition) {
  change_viewing([](records::Viewing& viewing) { viewing = {-2.5, 40, {}, {}, {}, {}}; });
  publish();
  EXPECT_THAT(cell_data(), HasSubstr("povray.map.probe.js"));
  EXPECT_THAT(read_file(script(), 1 << 20), HasSubstr(R"("width":3,"height":2)"));
  EXPECT_EQ(seen_.exposure_stops, -2.5);
  EXPECT_EQ(seen_.pixels_per_degree, 40);
}

TEST_F(DifferenceMaps, AreMadeAgainOnlyWhereAPictureOrTheViewingIsAnother) {
  publish();
  const int first = measured_;
  EXPECT_GT(first, 0);
  publish();
  EXPECT_EQ(measured_, first);
  write_picture("povray", flat(3, 2, 0.5f));
  publish();
  EXPECT_EQ(measured_, first + 1);
  change_viewing([](records::Viewing& viewing) { viewing.exposure_stops = 3; });
  publish();
  EXPECT_EQ(measured_, first + 2);
}

TEST_F(DifferenceMaps, AreNotThereWhereTheyWouldSayNothingTrue) {
  publish();
  ASSERT_TRUE(std::filesystem::exists(script()));
  const auto is_gone = [&] {
    publish();
    return !std::filesystem::exists(script()) &&
           cell_data().find("povray.map") == std::string::npos;
  };
  // Seen through a display that is not known here.
  change_viewing([](records::Viewing& viewing) {
    viewing.display = {"a.ocio", "1", "sRGB", "Film", "lin_srgb", "sRGB"};
  });
  EXPECT_TRUE(is_gone());
  change_viewing([](records::Viewing& viewing) { viewing.display.reset(); });
  EXPECT_FALSE(is_gone());
  write_picture("povray", flat(2, 2, 1));  // not of the size of ours
  EXPECT_TRUE(is_gone());
  write_picture("povray", flat(3, 2, 1));
  EXPECT_FALSE(is_gone());
  options_.metrics_only = true;
  EXPECT_TRUE(is_gone());
}

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

TEST(Thumbnail, EnlargesOnlySmallHighlights) {
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

TEST(Thumbnail, IsMadeAgainOnceTheSceneCanBeRead) {
  const FakeFarm farm;
  put_highlight(farm, 10, 10, 40);
  const auto without = thumbnail(farm, [](const auto&, int, int) -> PixelFlags {
    throw Error(ExitCode::kInput, "scene.xml: cannot read: File name too long");
  });
  const auto with = thumbnail(farm, left_half);
  ASSERT_TRUE(without && with);
  EXPECT_NE(without->pixel(100, 100)[0], with->pixel(100, 100)[0]);
}

TEST(Thumbnail, IsNotMadeWhereTheSceneCouldNotBeReadThisTime) {
  const FakeFarm farm;
  put_highlight(farm, 10, 10, 40);
  EXPECT_THROW(thumbnail(farm,
                         [](const auto&, int, int) -> PixelFlags {
                           throw failure_of("scene.xml: cannot read", EIO, ExitCode::kInput);
                         }),
               Error)
      << "it would stay as it is, without the surface";
}

TEST(CellPictures, StopThePublicationWhereASoundFileCannotBeRead) {
  const TemporaryDirectory directory;
  EXPECT_THROW(CellPictures(directory.path()).of("lobelia.exr"), Error);
}

// Float pictures as text: what is read back is what was written, to the bits that were kept.

/// The reader of gallery/web/src/half_picture.ts, written again.
std::vector<double> decoded(const records::PackedPicture& picture) {
  const std::size_t width = picture.width, pixels = width * picture.height;
  std::string bytes(6 * pixels, '\0');
  const std::string packed = from_base64(picture.planes);
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  EXPECT_EQ(size, bytes.size());
  std::vector<double> values(3 * pixels);
  std::vector<int> before(pixels), plane(pixels);
  for (int channel = 0; channel < 3; ++channel) {
    const auto* low = reinterpret_cast<const unsigned char*>(bytes.data()) + 2 * pixels * channel;
    for (std::size_t i = 0; i < pixels; ++i) {
      const bool column0 = i % width == 0, row0 = i < width;
      const int left = column0 ? (row0 ? 0 : plane[i - width]) : plane[i - 1];
      const int above = row0 ? left : plane[i - width];
      const int corner = column0 || row0 ? left : plane[i - width - 1];
      const int guess = !picture.predicted                ? 0
                        : corner >= std::max(left, above) ? std::min(left, above)
                        : corner <= std::min(left, above) ? std::max(left, above)
                                                          : left + above - corner;
      const int code = low[i] | low[pixels + i] << 8;
      plane[i] = static_cast<std::int16_t>(guess + (code >> 1 ^ -(code & 1)));
      const auto number = static_cast<std::int16_t>(plane[i] + (channel ? before[i] : 0));
      before[i] = number;
      const int magnitude = std::abs(number) << (10 - picture.mantissa_bits);
      double value = magnitude < 0x400
                         ? std::ldexp(magnitude, -24)
                         : std::ldexp(1024 + (magnitude & 0x3ff), (magnitude >> 10) - 25);
      if (magnitude >= 0x7c00) value = magnitude == 0x7c00 ? HUGE_VAL : NAN;
      values[3 * i + channel] = std::ldexp(number < 0 ? -value : value, -picture.scale_log2);
    }
  }
  return values;
}

Image noise(int width, int height, double decades) {
  Image image(width, height);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-decades, 0), side(-1, 1);
  for (float& value : image.values())
    value = static_cast<float>(std::copysign(std::pow(10, exponent(random)), side(random)));
  return image;
}

TEST(HalfPicture, KeepsEveryValueToTheBitsOfItsMantissa) {
  const Image image = noise(37, 23, 3);
  for (int precision = 1; precision <= kFinest; ++precision) {
    const std::vector<double> values = decoded(half_picture(image, precision));
    double largest = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      largest = std::max(largest, std::abs(values[i] / image.values()[i] - 1));
    // Rounded twice, to a half float and to fewer bits: a little over half a unit of the last.
    EXPECT_LE(largest, std::ldexp(0.5, -precision) *
                           (precision < 10 ? 1 + std::ldexp(1, precision - 10) : 1))
        << precision;
    EXPECT_GE(largest, std::ldexp(0.2, -precision)) << precision << ": more bits than it says";
  }
}

TEST(HalfPicture, HasItsLargestValueInRangeHoweverBrightOrDarkItIs) {
  for (const float factor : {1e-30f, 1e-6f, 1.0f, 163.0f, 2e5f, 1e30f}) {
    Image image = noise(8, 8, 1);
    for (float& value : image.values()) value *= factor;
    const std::vector<double> values = decoded(half_picture(image, kFinest));
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(values[i] / image.values()[i], 1, 5e-4) << factor;
  }
}

TEST(HalfPicture, KeepsNonfiniteValues) {
  Image image = noise(5, 4, 2);
  image.pixel(1, 1)[0] = std::numeric_limits<float>::infinity();
  image.pixel(2, 1)[1] = -std::numeric_limits<float>::infinity();
  image.pixel(3, 2)[2] = std::numeric_limits<float>::quiet_NaN();
  for (const int precision : {kFinest, 4, 1, kCoarsest}) {
    const auto values = decoded(half_picture(image, precision));
    EXPECT_EQ(values[3 * 6], HUGE_VAL) << precision;
    EXPECT_EQ(values[3 * 7 + 1], -HUGE_VAL) << precision;
    EXPECT_TRUE(std::isnan(values[3 * 13 + 2])) << precision;
    for (const std::size_t i : {0, 1, 2, 19, 20, 59})
      EXPECT_TRUE(std::isfinite(values[i])) << precision << " " << i;
  }
}

TEST(HalfPicture, OmitsValuesBelowItsLeast) {
  const Image image = noise(64, 64, 6);
  const records::PackedPicture coarse = half_picture(image, -2);
  EXPECT_NEAR(coarse.least, std::ldexp(1, -10), 2e-5);
  const auto values = decoded(coarse);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(values[i] == 0, std::abs(image.values()[i]) < coarse.least) << i;
  EXPECT_EQ(half_picture(image, 1).least, 0);
}

TEST(HalfPicture, IsShorterIfCoarserOrSmoother) {
  const Image rough = noise(128, 128, 5);
  std::size_t before = half_picture(rough, kFinest).planes.size();
  for (int precision = kFinest - 1; precision >= kCoarsest; --precision) {
    const std::size_t size = half_picture(rough, precision).planes.size();
    EXPECT_LT(double(size), 1.05 * double(before)) << precision;
    before = size;
  }
  EXPECT_LT(4 * before, half_picture(rough, kFinest).planes.size());
  Image smooth(128, 128);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x)
      for (float& value : smooth.pixel(x, y))
        value = static_cast<float>(std::exp(-(x * x + y * y) / 3000.0));
  EXPECT_LT(half_picture(smooth, kFinest).planes.size() * 6,
            half_picture(rough, kFinest).planes.size());
}

}  // namespace
}  // namespace lobelia::gallery

#include "base/pictures/image_io.hpp"

#include "base/pictures/png_writer.hpp"
#include "base/system/files.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

Image ramp(int width, int height) {
  Image image(width, height);
  float value = 1e-6f;
  for (float& v : image.values()) v = value *= 1.37f, value = value > 1e6f ? 1e-6f : value;
  return image;
}

std::ptrdiff_t threads_of_this_process() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
}

TEST(Exr, IsCodedOnTheCallingThreadOnRequest) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // in a process that has written none before
  const auto threads_started = [] {
    const TemporaryDirectory directory;
    code_pictures_on_calling_threads();
    const auto before = threads_of_this_process();
    const Image image = ramp(64, 256);
    write_exr(directory.path() / "ramp.exr", image, {});
    const Image back = read_image(directory.path() / "ramp.exr");
    const bool same = std::ranges::equal(back.values(), image.values());
    return same ? int(threads_of_this_process() - before) : -1;
  };
  EXPECT_EXIT(std::_Exit(threads_started()), testing::ExitedWithCode(0), "");
}

TEST(Png, IsTheSameFileHoweverManyRowsComeAtATime) {
  const TemporaryDirectory directory;
  const auto whole = directory.path() / "whole.png", rows = directory.path() / "rows.png";
  std::mt19937 random(1);
  for (const int width : {1, 37, 300})
    for (const int height : {1, 2, 50, 211}) {
      const std::size_t row = std::size_t(3 * width);
      DisplayImage image{width, height, std::vector<std::uint8_t>(row * std::size_t(height))};
      for (std::uint8_t& value : image.rgb) value = std::uint8_t(random());
      const ImageMetadata metadata{{"Software", "test"}};
      write_png(whole, image, metadata);
      for (const int batch : {1, 7, 64}) {
        PngWriter writer(rows, width, height, metadata);
        for (int y = 0; y < height; y += batch) {
          const int count = std::min(batch, height - y);
          const auto first = image.rgb.begin() + std::ptrdiff_t(row) * y;
          writer.write_rows({width, count, {first, first + std::ptrdiff_t(row) * count}});
        }
        EXPECT_FALSE(std::filesystem::exists(rows)) << "before it is finished";
        writer.finish();
        EXPECT_EQ(read_file(rows, 1 << 20), read_file(whole, 1 << 20)) << width << " x " << height;
        std::filesystem::remove(rows);
      }
    }
  PngWriter(rows, 3, 3).write_rows({3, 1, std::vector<std::uint8_t>(9)});
  EXPECT_FALSE(std::filesystem::exists(rows)) << "an unfinished file";
}

}  // namespace
}  // namespace lobelia

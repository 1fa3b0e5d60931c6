#include "base/pictures/exr_writer.hpp"

#include <atomic>
#include <barrier>
#include <thread>

#include "base/pictures/image_io.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/threads.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// Half of it smooth, half of it noise of every exponent, which no packing makes smaller.
Image picture(int width, int height) {
  Image image(width, height);
  std::mt19937 random(1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (float& v : image.pixel(x, y))
        v = y < height / 2 ? float(x) * 0.25f : std::bit_cast<float>(std::uint32_t(random()));
  return image;
}

bool same_bits(const Image& a, const Image& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::equal(a.values().begin(), a.values().end(), b.values().begin(), [](float x, float y) {
           return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
         });
}

std::string write(const fs::path& path, const Image& image, int batch) {
  ExrWriter writer(path, image.width(), image.height(), {{"Software", "test"}});
  for (int y = 0; y < image.height(); y += batch)
    writer.write_rows(y, std::min(batch, image.height() - y), image.pixel(0, y).data());
  writer.finish();
  return read_file(path, 1 << 26);
}

TEST(ExrWriter, AnotherReaderFindsEveryBitWhateverTheSize) {
  const TemporaryDirectory directory;
  for (const int width : {1, 2, 3, 37, 300})
    for (const int height : {1, 2, 15, 16, 17, 50, 1100}) {
      const Image image = picture(width, height);
      write(directory.path() / "a.exr", image, 7);
      EXPECT_TRUE(same_bits(read_image(directory.path() / "a.exr"), image))
          << width << " x " << height;
    }
}

TEST(ExrWriter, WritesTheSameBytesForAnyRowsOrThreads) {
  const TemporaryDirectory directory;
  const Image image = picture(701, 107);
  ASSERT_GT(image.pixel_count(), kPixelsOfOneThread) << "or one thread packs all";
  const fs::path path = directory.path() / "a.exr";
  write_exr(path, image, {{"Software", "test"}});
  const std::string expected = read_file(path, 1 << 26);
  for (const int batch : {1, 3, 15, 16, 17, 32, 50, 107})
    for (const int threads : {1, 4}) {
      std::string bytes;
      ThreadLimit(threads).run([&] { bytes = write(path, image, batch); });
      EXPECT_TRUE(bytes == expected) << batch << " rows, " << threads << " threads";
    }
}

TEST(ExrWriter, TheBytesAreTheSameWhereverTheMemoryOfAThreadIs) {
  const TemporaryDirectory directory;
  // Small ones, because a packer sees more by chance in a small table.
  const auto write_all = [&](const std::string& name) {
    const FlushLater quickly;
    std::mt19937 random(2);
    std::vector<std::string> all;
    for (int k = 0; k < 60; ++k) {
      Image image(2 + int(random() % 6), 1 + int(random() % 4));
      for (float& v : image.values()) v = random() % 8 > 0 ? 0.5f : 2.f;
      all.push_back(write(directory.path() / name, image, 16));
    }
    return all;
  };
  const std::vector<std::string> expected = write_all("first");
  // All of them live until the last one has written, so that none has the memory of another.
  constexpr int kThreads = 60;
  std::barrier all_have_written(kThreads);
  std::atomic<int> differ = 0;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < kThreads; ++i)
      threads.emplace_back([&, i] {
        differ += write_all(std::to_string(i)) != expected;
        all_have_written.arrive_and_wait();
      });
  }
  EXPECT_EQ(differ, 0);
}

TEST(ExrWriter, LeavesNothingBehindUnlessFinished) {
  const TemporaryDirectory directory;
  const Image image = picture(20, 40);
  {
    ExrWriter writer(directory.path() / "a.exr", 20, 40, {});
    writer.write_rows(0, 20, image.values().data());
    EXPECT_FALSE(fs::exists(directory.path() / "a.exr"));
    EXPECT_THROW(writer.finish(), Error);
    EXPECT_THROW(writer.write_rows(21, 1, image.values().data()), Error);
    EXPECT_THROW(writer.write_rows(20, 21, image.values().data()), Error);
  }
  EXPECT_TRUE(fs::is_empty(directory.path()));
  EXPECT_THROW(ExrWriter(directory.path() / "no" / "a.exr", 1, 1, {}), Error);
  EXPECT_TRUE(fs::is_empty(directory.path()));
}

TEST(ExrWriter, ALongNameOfAnAttributeIsReadable) {
  const TemporaryDirectory directory;
  const fs::path path = directory.path() / "a.exr";
  const Image image = picture(4, 4);
  write_exr(path, image, {{std::string(100, 'n'), "value"}});
  EXPECT_TRUE(same_bits(read_image(path), image));
  EXPECT_THROW(write_exr(path, image, {{std::string(256, 'n'), "value"}}), Error);
}

}  // namespace
}  // namespace lobelia

#include "core/image_io.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/png_writer.hpp"

namespace lobelia {
namespace {

Image ramp(int width, int height) {
  Image image(width, height);
  float value = 1e-6f;
  for (float& v : image.values()) v = value *= 1.37f, value = value > 1e6f ? 1e-6f : value;
  return image;
}

std::string message_of(const std::filesystem::path& path) {
  try {
    read_image(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kInput);
    return error.what();
  }
  ADD_FAILURE() << path << " was read";
  return "";
}

TEST(Exr, KeepsEveryBitOfEveryValueIncludingNanAndInfinity) {
  const TemporaryDirectory directory;
  Image image = ramp(37, 5);
  image.values()[3] = std::numeric_limits<float>::infinity();
  image.values()[4] = std::numeric_limits<float>::quiet_NaN();
  image.values()[5] = std::numeric_limits<float>::denorm_min();
  write_exr(directory.path() / "a.exr", image, {{"Software", "test"}});
  const Image back = read_image(directory.path() / "a.exr");
  ASSERT_EQ(back.width(), 37);
  ASSERT_EQ(back.height(), 5);
  for (std::size_t i = 0; i < image.values().size(); ++i) {
    const float a = image.values()[i], b = back.values()[i];
    EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << i;
  }
}

TEST(Exr, IsTheSameFileForTheSamePictureASecondLater) {
  const TemporaryDirectory directory;
  for (const char* name : {"a.exr", "b.exr"}) {
    write_exr(directory.path() / name, ramp(64, 64), {{"Software", "test"}, {"lobelia:seed", "1"}});
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  }
  EXPECT_EQ(read_file(directory.path() / "a.exr", 1 << 20),
            read_file(directory.path() / "b.exr", 1 << 20));
}

std::ptrdiff_t threads_of_this_process() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
}

TEST(Exr, IsCodedOnTheCallingThreadWhereAProcessAsksForThat) {
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

TEST(Png, IsDecodedFromSrgbToLinearLight) {
  const TemporaryDirectory directory;
  DisplayImage image{2, 1, {0, 128, 255, 1, 2, 3}};
  write_png(directory.path() / "a.png", image);
  const Image back = read_image(directory.path() / "a.png");
  // IEC 61966-2-1: 128/255 is (0.50196 + 0.055)/1.055 to the power 2.4.
  EXPECT_NEAR(back.pixel(0, 0)[1], 0.2158605, 1e-6);
  EXPECT_EQ(back.pixel(0, 0)[0], 0.0f);
  EXPECT_NEAR(back.pixel(0, 0)[2], 1.0f, 1e-6);
  EXPECT_NEAR(back.pixel(1, 0)[0], 1 / 255.0 / 12.92, 1e-7);
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

TEST(Reading, WhatIsNoPictureSaysSoInOneLineWithTheFile) {
  const TemporaryDirectory directory;
  const auto text = directory.path() / "text.exr", empty = directory.path() / "empty.png";
  write_file(text, "I am not a picture");
  write_file(empty, "");
  for (const auto& path : {text, empty, directory.path() / "missing.exr", directory.path()}) {
    const std::string message = message_of(path);
    EXPECT_THAT(message, testing::HasSubstr(path.string()));
    EXPECT_EQ(message.find('\n'), message.npos);
  }
}

TEST(Reading, ATruncatedExrIsAnErrorAtEveryLength) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a.exr";
  write_exr(path, ramp(64, 64), {});
  const std::string whole = read_file(path, 1 << 20);
  for (std::size_t length = 0; length < whole.size(); length += length < 512 ? 8 : 97) {
    write_file(path, whole.substr(0, length));
    EXPECT_THROW(read_image(path), Error) << length;
  }
  write_file(path, whole.substr(0, whole.size() - 1));
  EXPECT_THROW(read_image(path), Error);
}

TEST(Reading, AHeaderThatClaimsAHugePictureIsRefusedBeforeMemoryIsTaken) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "huge.exr";
  write_exr(path, ramp(64, 64), {});
  std::string bytes = read_file(path, 1 << 20);
  for (const char* window : {"dataWindow", "displayWindow"}) {
    // name, type "box2i", length, then xmin ymin xmax ymax
    const auto at = bytes.find(std::string(window) + '\0' + "box2i");
    ASSERT_NE(at, bytes.npos);
    const std::int32_t corner = 999999;
    std::copy_n(reinterpret_cast<const char*>(&corner), 4,
                bytes.begin() + std::ptrdiff_t(at + std::string(window).size() + 1 + 6 + 4 + 8));
    std::copy_n(reinterpret_cast<const char*>(&corner), 4,
                bytes.begin() + std::ptrdiff_t(at + std::string(window).size() + 1 + 6 + 4 + 12));
  }
  write_file(path, bytes);
  message_of(path);
}

TEST(Writing, WhereItCannotLeavesNoFile) {
  const TemporaryDirectory directory;
  EXPECT_THROW(write_exr(directory.path() / "no" / "a.exr", ramp(4, 4), {}), Error);
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
}

}  // namespace
}  // namespace lobelia

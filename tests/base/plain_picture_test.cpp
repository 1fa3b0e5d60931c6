// Plain pictures beside OpenImageIO: another library, the same bits.
#include "base/pictures/plain_picture.hpp"

#include <ImfCompression.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <zlib.h>

#include "base/pictures/picture_message.hpp"
#include "base/pictures/png_module.hpp"
#include "tests/base/picture_fixture.hpp"
#include "tests/more_samples.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

class PlainPicture : public PictureFiles {
 protected:
  PictureBytes bytes_of(const std::string& bytes, const char* format) {
    PictureBytes file{"picture", bytes, format};
    file.on_one_thread = random_() % 2 == 0;
    return file;
  }
  int below(int count) { return int(random_() % std::uint32_t(count)); }
  bool rarely() { return below(4) == 0; }
  template <class T>
  T one_of(std::initializer_list<T> all) {
    return all.begin()[below(int(all.size()))];
  }

  std::vector<float> random_values(std::size_t count) {
    using Limits = std::numeric_limits<float>;
    std::vector<float> result(count);
    float last = 0;
    for (float& value : result) {
      if (rarely())
        last = one_of({0.0f, -0.0f, 1.0f, -2.5f, 65504.0f, 6e-8f, Limits::max(), Limits::infinity(),
                       -Limits::infinity(), Limits::quiet_NaN(), Limits::denorm_min()});
      else if (rarely())
        last = float(random_()) / 4e9f;
      value = last;  // runs, which every packing packs
    }
    return result;
  }
  std::string random_exr() {
    const int width = 1 + below(70), height = 1 + below(70);
    const Imath::Box2i all = window(below(9) - 4, below(9) - 4, width, height);
    Imf::Header header(all, all);
    header.compression() = one_of({Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                                   Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION});
    header.lineOrder() = one_of({Imf::INCREASING_Y, Imf::DECREASING_Y});
    if (rarely()) header.setName("beauty");
    if (rarely()) header.insert("samplesPerPixel", Imf::IntAttribute(below(99)));
    if (rarely()) header.insert("cycles.R.samples", Imf::StringAttribute("64"));
    if (rarely())
      Imf::addChromaticities(
          header, {{0.7347f, 0.2653f}, {0.0f, 1.0f}, {1e-4f, -0.077f}, {0.32168f, 0.33767f}});
    const Imf::PixelType type = one_of({Imf::HALF, Imf::FLOAT});
    const std::vector<std::string> names = one_of<std::vector<std::string>>(
        {{"R", "G", "B"}, {"R", "G", "B", "A"}, {"Y"}, {"Y", "A"}});
    std::vector<ExrChannel> channels;
    std::vector<std::vector<half>> halves;
    Imf::FrameBuffer buffer;
    for (const std::string& name : names) {
      header.channels().insert(name, Imf::Channel(type));
      channels.push_back({name, random_values(std::size_t(width) * std::size_t(height)), type});
    }
    for (const ExrChannel& channel : channels) {
      halves.emplace_back(channel.values.begin(), channel.values.end());
      const void* values = type == Imf::HALF ? static_cast<const void*>(halves.back().data())
                                             : channel.values.data();
      const std::size_t size = type == Imf::HALF ? 2 : 4;
      buffer.insert(channel.name,
                    Imf::Slice::Make(type, values, all, size, size * std::size_t(width)));
    }
    const auto path = directory_.path() / "random.exr";
    {
      Imf::OutputFile output(path.c_str(), header);
      output.setFrameBuffer(buffer);
      output.writePixels(height);
    }
    return read_file(path, 1 << 24);
  }
  std::string random_png() {
    Png png;
    png.width = std::uint32_t(1 + below(60));
    png.height = std::uint32_t(1 + below(30));
    png.bits = one_of({8, 16});
    png.colour_type = one_of({0, 2, 4, 6});
    const int channels = (png.colour_type & 2 ? 3 : 1) + (png.colour_type & 4 ? 1 : 0);
    png.samples.resize(png.width * png.height * std::size_t(channels * png.bits / 8));
    for (char& sample : png.samples) sample = char(random_());
    const auto chromaticities = [] {
      std::string all;
      for (const std::uint32_t x : {31270u, 32900u, 68000u, 32000u, 26500u, 69000u, 15000u, 6000u})
        all += big_endian(x);
      return all;
    };
    if (rarely()) png.chunks += png_chunk("gAMA", big_endian(one_of({45455u, 100000u, 55556u})));
    if (rarely()) png.chunks += png_chunk("sRGB", std::string(1, '\0'));
    if (rarely()) png.chunks += png_chunk("cHRM", chromaticities());
    if (rarely())
      png.chunks += png_chunk(
          "cICP", {char(one_of({1, 9, 12})), one_of({'\x8', '\x10', '\x12', '\xd'}), 0, 1});
    if (rarely())
      png.chunks += png_chunk("tEXt", std::string("samplesPerPixel\0"
                                                  "16",
                                                  18));
    if (rarely()) png.chunks += png_chunk("pHYs", big_endian(1) + big_endian(1) + '\0');
    return png_file(png);
  }
  std::string random_file(const char* format) {
    return std::string_view(format) == "png" ? random_png() : random_exr();
  }

  std::mt19937 random_{7};
};

/// All that is known of a picture but its values.
std::string facts(const Picture& picture) {
  ReadingAnswer answer;
  answer.kind = ReadingAnswer::Kind::kPicture;
  answer.source = picture.source;
  answer.width = std::uint64_t(picture.image.width());
  answer.height = std::uint64_t(picture.image.height());
  return pack(answer);
}

/// NaN equals NaN, whatever its other bits.
bool are_same_values(const Image& a, const Image& b) {
  return std::ranges::equal(a.values(), b.values(), [](float x, float y) {
    return std::memcmp(&x, &y, sizeof x) == 0 || (x != x && y != y);
  });
}

TEST_F(PlainPicture, ReadsRandomContentAsOpenImageIoDoes) {
  for (int i = 0; i < 300 * more_samples(); ++i)
    for (const char* format : {"openexr", "png"}) {
      const std::string bytes = random_file(format);
      const PictureBytes file = bytes_of(bytes, format);
      const Picture other = image_io_table().read_picture(file, "");
      const auto plain = read_plain_picture(file, "");
      ASSERT_TRUE(plain) << format << " " << i;
      ASSERT_EQ(facts(*plain), facts(other)) << format << " " << i;
      ASSERT_TRUE(are_same_values(plain->image, other.image)) << format << " " << i;
      ASSERT_EQ(plain_layer_names(file), image_io_table().layer_names(file));
      if (!other.source.alpha.empty()) {
        const auto alpha = read_plain_picture(file, "A");
        const Picture other_alpha = image_io_table().read_picture(file, "A");
        ASSERT_EQ(facts(*alpha), facts(other_alpha)) << format << " " << i;
        ASSERT_TRUE(are_same_values(alpha->image, other_alpha.image)) << format << " " << i;
      }
    }
}

TEST_F(PlainPicture, ReadsDamagedFilesAsOpenImageIoDoesOrLeavesThem) {
  int plain_ones = 0;
  for (int i = 0; i < 400 * more_samples(); ++i)
    for (const char* format : {"openexr", "png"}) {
      std::string bytes = random_file(format);
      for (int k = 0; k < 3; ++k) bytes[std::size_t(below(int(bytes.size())))] = char(random_());
      if (rarely()) bytes.resize(std::size_t(below(int(bytes.size()))));
      const PictureBytes file = bytes_of(bytes, format);
      std::optional<Picture> plain;
      try {
        plain = read_plain_picture(file, "");
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::kInput);
        EXPECT_THROW(image_io_table().read_picture(file, ""), Error) << error.what();
        continue;
      }
      if (!plain) continue;
      ++plain_ones;
      try {
        const Picture other = image_io_table().read_picture(file, "");
        ASSERT_EQ(facts(*plain), facts(other)) << format << " " << i;
        ASSERT_TRUE(are_same_values(plain->image, other.image)) << format << " " << i;
      } catch (const Error& error) {
        ADD_FAILURE() << format << " " << i << ": " << error.what();
      }
    }
  EXPECT_GT(plain_ones, 40);
}

TEST_F(PlainPicture, LeavesAFileWithoutABlockBeforeAnyBandIsGivenOn) {
  const Image image(2100, 2060);
  const auto path = directory_.path() / "large.exr";
  write_exr(path, image, {});
  std::string bytes = read_file(path, 1 << 28);
  int bands = 0;
  const auto count_bands = [&](const Picture&, int) { ++bands; };
  PictureBytes whole = bytes_of(bytes, "openexr");
  whole.on_rows = count_bands;
  EXPECT_TRUE(read_plain_picture(whole, ""));
  EXPECT_EQ(std::exchange(bands, 0), 3);
  // The table of offsets, one for 16 rows, follows the header's last attribute.
  const std::size_t table = bytes.find("screenWindowWidth") + 18 + 6 + 4 + 4 + 1;
  bytes.replace(table + 8 * 128, 8, std::string(8, '\0'));
  PictureBytes file = bytes_of(bytes, "openexr");
  file.on_rows = count_bands;
  EXPECT_FALSE(read_plain_picture(file, ""));
  EXPECT_EQ(bands, 0);
}

TEST_F(PlainPicture, LeavesAllElseToOpenImageIo) {
  const auto all = window(0, 0, 2, 1), part = window(0, 0, 1, 1);
  const std::vector<ExrChannel> rgb{{"R", {1, 2}}, {"G", {3, 4}}, {"B", {5, 6}}};
  const auto with = [&](ExrChannel more) {
    auto channels = rgb;
    channels.push_back(std::move(more));
    return channels;
  };
  const std::vector<std::vector<ExrPart>> files{
      {{.data = all, .display = window(0, 0, 3, 1), .channels = rgb}},
      {{.data = all, .display = all, .channels = with({"Z", {7, 8}})}},
      {{.data = all, .display = all, .channels = with({"A", {7, 8}, Imf::HALF})}},
      {{.data = all, .display = all, .channels = {{"diffuse.R", {1, 2}}}}},
      {{.data = all, .display = all, .channels = {{"Y", {1, 2}, Imf::UINT}}}},
      {{.data = all, .display = all, .channels = rgb, .texts = {{"view", "left"}}}},
      {{.data = all, .display = all, .channels = rgb, .texts = {{"View", "left"}}}},
      {{.name = "a", .data = all, .display = all, .channels = rgb},
       {.name = "b", .data = part, .display = all, .channels = {{"Y", {1}}}}}};
  for (const auto& parts : files) {
    const std::string bytes = read_file(exr("a.exr", parts), 1 << 20);
    EXPECT_FALSE(read_plain_picture(bytes_of(bytes, "openexr"), ""));
  }
  const std::string palette = png_chunk("PLTE", "abcdef"),
                    clear = png_chunk("tRNS", "\1\2\1\2\1\2");
  for (const Png& png :
       {Png{.bits = 8, .colour_type = 3, .samples = "\1", .chunks = palette},
        Png{.width = 8, .bits = 1, .colour_type = 0, .samples = "x"},
        Png{.samples = "abc", .chunks = clear},
        Png{.samples = "abc", .chunks = png_chunk("oFFs", big_endian(1) + big_endian(2) + '\0')},
        Png{.samples = "abc", .chunks = png_chunk("iCCP", "damaged")}})
    EXPECT_FALSE(read_plain_picture(bytes_of(png_file(png), "png"), ""));
  EXPECT_FALSE(may_be_plain("jpeg"));
  // A text that unpacks to a thousand times its size.
  const std::string zeros(std::size_t{8} << 20, '\0');
  uLongf size = compressBound(uLong(zeros.size()));
  std::string packed(size, '\0');
  ASSERT_EQ(compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                     reinterpret_cast<const Bytef*>(zeros.data()), uLong(zeros.size())),
            Z_OK);
  const std::string text = png_chunk("zTXt", std::string("a\0\0", 3) + packed.substr(0, size));
  const std::string bomb = png_file({.samples = "abc", .chunks = text});
  EXPECT_FALSE(read_plain_picture(bytes_of(bomb, "png"), ""));
  EXPECT_FALSE(png_table().read_codes(bomb, 4096));
  EXPECT_EQ(read_image(file("bomb.png", bomb)).width(), 1) << "by OpenImageIO";
}

TEST(PngCodes, AreReadOnlyFromOurOwnSoundFiles) {
  DisplayImage image{37, 23, {}};
  for (int i = 0; i < 3 * 37 * 23; ++i) image.rgb.push_back(std::uint8_t(i * i / 7));
  const std::string file = png_bytes(image, {{"Software", "a test"}});
  const auto codes = [](const std::string& bytes) { return png_table().read_codes(bytes, 4096); };
  const auto read = codes(file);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->width, 37);
  EXPECT_EQ(read->height, 23);
  EXPECT_EQ(read->rgb, image.rgb);
  EXPECT_FALSE(png_table().read_codes(file, 36));
  for (std::size_t size = 0; size < file.size() - 12; ++size)
    EXPECT_FALSE(codes(file.substr(0, size))) << size;
  std::string wide = file;
  wide[17] = 1;  // claims more pixels than it has
  EXPECT_FALSE(codes(wide));
  const std::string samples(12, 'x');
  for (const Png& other :
       {Png{.width = 2, .height = 2, .colour_type = 0, .samples = "abcd"},
        Png{.width = 2, .bits = 16, .samples = samples},
        Png{.width = 4, .samples = samples, .chunks = png_chunk("gAMA", big_endian(100000))},
        Png{.width = 4, .samples = samples, .chunks = png_chunk("cICP", {1, 8, 0, 1})}})
    EXPECT_FALSE(codes(png_file(other)));
}

}  // namespace
}  // namespace lobelia

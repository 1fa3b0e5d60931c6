// Pictures that are stored mirrored or turned are shown upright.
#include "base/pictures/orientation.hpp"

#include "base/pictures/image_io_module.hpp"
#include "base/pictures/png_module.hpp"
#include "tests/base/format_samples.hpp"
#include "tests/base/picture_fixture.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

/// Pixels of any size, row by row.
struct Pixels {
  int width = 0, height = 0;
  std::vector<std::string> values = {};

  std::string bytes() const {
    std::string all;
    for (const std::string& value : values) all += value;
    return all;
  }
};

class Orientation : public PictureFiles {
 protected:
  Pixels random_pixels(int width, int height) {
    Pixels result{width, height};
    std::uniform_int_distribution<int> code(0, 255);
    for (int i = 0; i < width * height; ++i)
      result.values.push_back(
          std::string{char(code(random_)), char(code(random_)), char(code(random_))});
    return result;
  }
  int side() { return std::uniform_int_distribution<int>(1, 9)(random_); }

  /// Exif: where the first stored row and the first stored column are seen.
  static Pixels stored(const Pixels& shown, int orientation) {
    constexpr std::array<std::array<char, 2>, 8> kSeen{{{'t', 'l'},
                                                        {'t', 'r'},
                                                        {'b', 'r'},
                                                        {'b', 'l'},
                                                        {'l', 't'},
                                                        {'r', 't'},
                                                        {'r', 'b'},
                                                        {'l', 'b'}}};
    const auto [row_side, column_side] = kSeen[std::size_t(orientation - 1)];
    const bool rows_are_rows = row_side == 't' || row_side == 'b';
    Pixels result{rows_are_rows ? shown.width : shown.height,
                  rows_are_rows ? shown.height : shown.width};
    for (int row = 0; row < result.height; ++row)
      for (int column = 0; column < result.width; ++column) {
        int x = 0, y = 0;
        for (const auto& [side, step] : {std::pair(row_side, row), std::pair(column_side, column)})
          (side == 'l' || side == 'r' ? x : y) = side == 'l'   ? step
                                                 : side == 'r' ? shown.width - 1 - step
                                                 : side == 't' ? step
                                                               : shown.height - 1 - step;
        result.values.push_back(shown.values[std::size_t(y * shown.width + x)]);
      }
    return result;
  }

  void expect_shown(const std::filesystem::path& upright, const std::filesystem::path& turned,
                    int orientation) {
    const Picture expected = read_picture(upright, ""), picture = read_picture(turned, "");
    EXPECT_EQ(values(picture.image), values(expected.image)) << turned << " " << orientation;
    EXPECT_EQ(picture.image.width(), expected.image.width());
    EXPECT_EQ(picture.source.orientation, orientation);
    EXPECT_EQ(picture.source.display, expected.source.display);
    EXPECT_EQ(picture.source.data, expected.source.data);
  }

  /// For each orientation and several random pictures; `encode` gives the bytes of a file that states it.
  template <class Encode>
  void expect_upright(const std::string& ending, const Encode& encode, int most = 8) {
    for (int orientation = 1; orientation <= most; ++orientation)
      for (int i = 0; i < 4; ++i) {
        const Pixels shown = random_pixels(side(), side());
        expect_shown(file("upright" + ending, encode(shown, 1)),
                     file("turned" + ending, encode(stored(shown, orientation), orientation)),
                     orientation);
      }
  }

  std::mt19937 random_{7};
};

std::string exif(int orientation, bool little = true, int type = 3, int count = 1) {
  const auto number = [&](int value, int bytes) {
    return little ? little_endian(std::uint32_t(value), bytes)
                  : big_endian(std::uint32_t(value), bytes);
  };
  std::string value = number(orientation, type == 3 ? 2 : 4);
  value.resize(4);
  return (little ? std::string("II*\0", 4) : std::string("MM\0*", 4)) + number(8, 4) +
         number(1, 2) + number(274, 2) + number(type, 2) + number(count, 4) + value + number(0, 4);
}

std::string exif_segment(const std::string& exif) {
  return jpeg_segment(0xe1, std::string("Exif\0\0", 6) + exif);
}

std::string png_of(const Pixels& pixels, const std::string& chunks) {
  return png_file({.width = std::uint32_t(pixels.width),
                   .height = std::uint32_t(pixels.height),
                   .samples = pixels.bytes(),
                   .chunks = chunks});
}

Tiff tiff_of(const Pixels& pixels, int orientation) {
  return {.width = std::uint32_t(pixels.width),
          .height = std::uint32_t(pixels.height),
          .samples = pixels.bytes(),
          .more = {{274, 3, 1, std::uint32_t(orientation)}}};
}

/// A WebP with the Exif in a chunk of its own.
std::string extended_webp(const std::string& exif) {
  const auto chunk = [](const std::string& name, const std::string& data) {
    return name + little_endian(std::uint32_t(data.size()), 4) + data +
           std::string(data.size() % 2, '\0');
  };
  const std::string chunks =
      chunk("VP8X", '\x08' + std::string(3, '\0') + little_endian(7, 3) + little_endian(7, 3)) +
      webp_file().substr(12) + chunk("EXIF", exif);
  return "RIFF" + little_endian(std::uint32_t(chunks.size() + 4), 4) + "WEBP" + chunks;
}

TEST_F(Orientation, ComesFromTheExifOfAPng) {
  expect_upright(".png", [&](const Pixels& pixels, int orientation) {
    const bool little = orientation % 2 == 0;
    return png_of(pixels, png_chunk("eXIf", exif(orientation, little, little ? 3 : 4)));
  });
}

TEST_F(Orientation, IsTheSameForBothReadersOfAPng) {
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const std::string bytes =
        png_of(random_pixels(side(), side()), png_chunk("eXIf", exif(orientation)));
    const PictureBytes png{"picture.png", bytes, "png"};
    const auto plain = read_plain_picture(png, "");
    ASSERT_TRUE(plain);
    const Picture other = image_io_table().read_picture(png, "");
    EXPECT_EQ(values(plain->image), values(other.image)) << orientation;
    EXPECT_EQ(other.source.orientation, plain->source.orientation);
    EXPECT_EQ(png_table().read_codes(bytes, 64).has_value(), orientation == 1)
        << "codes are as they are stored";
  }
}

TEST_F(Orientation, ComesFromTheExifOfAJpeg) {
  expect_upright(".jpg", [&](const Pixels& blocks, int orientation) {
    const std::string bytes = blocks.bytes();
    return with_segments(
        block_jpeg(blocks.width, blocks.height, 3, {bytes.begin(), bytes.end()}),
        jpeg_segment(0xfe, "a comment") + exif_segment(exif(orientation, orientation < 5)));
  });
}

TEST_F(Orientation, ComesFromTheTagOfATiff) {
  expect_upright(".tif", [&](const Pixels& pixels, int orientation) {
    return tiff_file(tiff_of(pixels, orientation));
  });
}

TEST_F(Orientation, IsUndoneOnceWhereLibtiffMirrors) {
  expect_upright(".tif", [&](const Pixels& pixels, int orientation) {
    Tiff tiff = tiff_of(pixels, orientation);
    tiff.photometric = 6;  // YCbCr
    tiff.more.push_back({530, 3, 2, 1 | 1 << 16});
    return tiff_file(tiff);
  });
}

TEST_F(Orientation, ComesFromThePageOfATiff) {
  const Pixels first = random_pixels(3, 2), second = random_pixels(4, 5);
  std::string pages = tiff_file(tiff_of(stored(first, 3), 3));
  Tiff further = tiff_of(stored(second, 6), 6);
  further.at = std::uint32_t(pages.size());
  const std::string page = tiff_file(further);
  pages.replace(pages.size() - 4, 4, page.substr(4, 4));  // the place of the next directory
  const auto path = file("pages.tif", pages + page);
  const auto alone = file("second.tif", tiff_file(tiff_of(second, 1)));
  EXPECT_EQ(values(read_image(path)),
            values(read_image(file("a.tif", tiff_file(tiff_of(first, 1))))));
  const std::vector<std::string> layers = layer_names(path);
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_EQ(values(read_picture(path, layers[1]).image), values(read_image(alone)));
}

TEST_F(Orientation, ComesFromTheExifOfAWebP) {
  const Image plain = read_image(file("plain.webp", webp_file()));
  Pixels shown{plain.width(), plain.height()};
  for (std::size_t i = 0; i < plain.pixel_count(); ++i)
    shown.values.emplace_back(reinterpret_cast<const char*>(&plain.values()[3 * i]), 12);
  for (int orientation = 1; orientation <= 8; ++orientation)
    for (const std::string& prefix : {std::string(), std::string("Exif\0\0", 6)}) {
      const Image image =
          read_image(file("turned.webp", extended_webp(prefix + exif(orientation))));
      Pixels seen{image.width(), image.height()};
      for (std::size_t i = 0; i < image.pixel_count(); ++i)
        seen.values.emplace_back(reinterpret_cast<const char*>(&image.values()[3 * i]), 12);
      EXPECT_EQ(stored(seen, orientation).values, shown.values) << orientation;
    }
}

TEST_F(Orientation, ComesFromTheHeaderOfADpx) {
  // SMPTE ST 268: 0 is upright, 1 mirrored, 2 upside down, 3 both. From 4 on lines are columns.
  constexpr std::array<char, 4> kFields{0, 1, 3, 2};
  const auto encode = [](const Pixels& pixels, char field, bool little) {
    std::string bytes =
        dpx_file(std::uint32_t(pixels.width), std::uint32_t(pixels.height), pixels.bytes());
    bytes[769] = field;
    constexpr std::array<int, 10> kLong{0, 4, 16, 24, 28, 772, 776, 784, 788, 792};
    constexpr std::array<int, 4> kShort{768, 770, 804, 806};
    if (!little) return bytes;
    for (const int at : kLong) std::reverse(bytes.begin() + at, bytes.begin() + at + 4);
    for (const int at : kShort) std::reverse(bytes.begin() + at, bytes.begin() + at + 2);
    std::reverse(bytes.begin() + 808, bytes.begin() + 812);
    return bytes;
  };
  for (const bool little : {false, true}) {
    expect_upright(
        ".dpx",
        [&](const Pixels& pixels, int orientation) {
          return encode(pixels, kFields[std::size_t(orientation) - 1], little);
        },
        int(kFields.size()));
    const Pixels shown = random_pixels(side(), side());
    for (const char field : {char(4), char(5), char(6), char(7)})
      EXPECT_THROW(read_image(file("columns.dpx", encode(shown, field, little))), Error);
    for (const char field : {char(8), char(127)})
      EXPECT_EQ(read_picture(file("odd.dpx", encode(shown, field, little)), "").source.orientation,
                1);
  }
}

TEST_F(Orientation, IsUndoneOnceInATga) {
  // Bits 4 and 5 of its descriptor: the first value is at the right, the first row at the top.
  for (const int bits : {0, 0x10, 0x20, 0x30})
    for (const bool run_lengths : {false, true}) {
      const Pixels shown = random_pixels(side(), side());
      const auto encode = [&](const Pixels& rows, int descriptor) {
        std::string data;
        for (const std::string& pixel : rows.values) {
          if (run_lengths) data += '\0';
          data.append(pixel.rbegin(), pixel.rend());
        }
        std::string bytes = tga_file(
            {.width = rows.width, .height = rows.height, .run_lengths = run_lengths, .data = data});
        bytes[17] = char(descriptor);
        return bytes;
      };
      const bool is_mirrored = (bits & 0x10) != 0, is_from_top = (bits & 0x20) != 0;
      const int orientation = is_from_top ? (is_mirrored ? 2 : 1) : (is_mirrored ? 3 : 4);
      const Image upright = read_image(file("upright.tga", encode(shown, 0x20)));
      const Image turned = read_image(file("turned.tga", encode(stored(shown, orientation), bits)));
      EXPECT_EQ(values(turned), values(upright)) << bits;
    }
}

TEST_F(Orientation, ComesFromTheAxesOfARadianceFile) {
  // Y points up. The first axis is that of the stored rows.
  for (const bool x_first : {false, true})
    for (const int x_sign : {1, -1})
      for (const int y_sign : {1, -1}) {
        const Pixels shown = random_pixels(side(), side());
        const auto axis = [&](bool is_x) {
          const int length = is_x ? shown.width : shown.height;
          return std::string((is_x ? x_sign : y_sign) > 0 ? "+" : "-") + (is_x ? "X " : "Y ") +
                 std::to_string(length);
        };
        std::string rgbe;
        const int rows = x_first ? shown.width : shown.height,
                  columns = x_first ? shown.height : shown.width;
        for (int row = 0; row < rows; ++row)
          for (int column = 0; column < columns; ++column) {
            const int x_step = x_first ? row : column, y_step = x_first ? column : row;
            const int x = x_sign > 0 ? x_step : shown.width - 1 - x_step,
                      y = y_sign < 0 ? y_step : shown.height - 1 - y_step;
            rgbe += shown.values[std::size_t(y * shown.width + x)] + '\x80';
          }
        const std::string line = axis(x_first) + " " + axis(!x_first);
        const Picture picture = read_picture(
            file("axes.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + line + "\n" + rgbe), "");
        std::string flat;
        for (const std::string& value : shown.values) flat += value + '\x80';
        const Image upright =
            read_image(file("flat.hdr", hdr_file(shown.width, shown.height, flat)));
        EXPECT_EQ(values(picture.image), values(upright)) << line;
        EXPECT_EQ(picture.image.width(), shown.width) << line;
        EXPECT_EQ(picture.source.orientation == 1, line.starts_with("-Y") && x_sign > 0) << line;
      }
}

TEST_F(Orientation, IsUprightWithoutAMeaning) {
  const Pixels shown = random_pixels(3, 2);
  const Image upright = read_image(file("upright.png", png_of(shown, "")));
  std::string damaged = png_chunk("eXIf", exif(3));
  damaged.back() ^= 1;  // the checksum
  const std::string texts[] = {
      png_chunk("eXIf", exif(0)),
      png_chunk("eXIf", exif(9)),
      png_chunk("eXIf", exif(65535)),
      png_chunk("eXIf", exif(3, true, 2)),     // a text
      png_chunk("eXIf", exif(3, true, 3, 2)),  // two numbers
      png_chunk("eXIf", exif(3).substr(0, 15)),
      png_chunk("eXIf", "II"),
      png_chunk("eXIf", ""),
      damaged,
      png_chunk("tEXt", std::string("Orientation\0003", 13)),
  };
  for (const std::string& chunk : texts) {
    const Picture picture = read_picture(file("odd.png", png_of(shown, chunk)), "");
    EXPECT_EQ(values(picture.image), values(upright)) << chunk;
    EXPECT_EQ(picture.source.orientation, 1);
  }
  ExrPart part{"", window(0, 0, 2, 1), window(0, 0, 2, 1), {{"Y", {1, 2}}}};
  part.texts["Orientation"] = "3";
  EXPECT_THAT(values(read_image(exr("text.exr", {part}))), ElementsAre(1, 1, 1, 2, 2, 2));
}

TEST_F(Orientation, IsSaid) {
  const Picture picture =
      read_picture(file("turned.png", png_of(random_pixels(3, 2), png_chunk("eXIf", exif(3)))), "");
  const auto facts = reading_facts(picture.source);
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_EQ(facts[0].first, "Orientation");
  EXPECT_THAT(facts[0].second, HasSubstr("180 degrees"));
}

}  // namespace
}  // namespace lobelia

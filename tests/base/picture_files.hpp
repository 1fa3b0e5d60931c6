// Files of pictures, made byte by byte or by OpenEXR: what tests of the reader read.
#pragma once

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <half.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/system/files.hpp"

namespace lobelia::fixtures {

inline std::string big_endian(std::uint32_t value, int bytes = 4) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += char(value >> (8 * i));
  return text;
}

inline std::string little_endian(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += char(value >> (8 * i));
  return text;
}

inline std::string little_endian(const std::vector<float>& values) {
  std::string text(values.size() * 4, '\0');
  std::memcpy(text.data(), values.data(), text.size());
  return text;
}

// ---- PNG (ISO/IEC 15948)

inline std::string png_chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  std::uint32_t crc = 0xffffffffu;
  for (const char c : body) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
  }
  return big_endian(std::uint32_t(data.size())) + body + big_endian(~crc);
}

struct Png {
  std::uint32_t width = 1, height = 1;
  int bits = 8;
  int colour_type = 2;       ///< 0 grey, 2 RGB, 4 grey and alpha, 6 RGBA
  std::string samples = {};  ///< row by row, 16 bits big-endian
  std::string chunks = {};   ///< between header and samples
};

inline std::string png_file(const Png& png) {
  std::string rows;
  const std::size_t row = png.height == 0 ? 0 : png.samples.size() / png.height;
  for (std::size_t y = 0; y < png.height; ++y) rows += '\0' + png.samples.substr(y * row, row);
  // One block that is stored, not compressed.
  std::uint32_t a = 1, b = 0;
  for (const char c : rows) a = (a + static_cast<unsigned char>(c)) % 65521, b = (b + a) % 65521;
  const auto size = std::uint32_t(rows.size());
  const std::string zlib = std::string("\x78\x01\x01", 3) + little_endian(size, 2) +
                           little_endian(~size, 2) + rows + big_endian(b << 16 | a);
  return "\x89PNG\r\n\x1a\n" +
         png_chunk("IHDR", big_endian(png.width) + big_endian(png.height) + char(png.bits) +
                               char(png.colour_type) + std::string(3, '\0')) +
         png.chunks + png_chunk("IDAT", zlib) + png_chunk("IEND", "");
}

// ---- TIFF 6.0, one strip, little-endian

struct TiffEntry {
  std::uint32_t tag, type, count, value;
};

struct Tiff {
  std::uint32_t width = 1, height = 1;
  int samples_per_pixel = 3, bits = 8;
  int photometric = 2;  ///< 1 grey, 2 RGB, 5 separated (CMYK)
  bool is_float = false;
  std::string samples = {};
  bool directory_first = false;
  bool says_bits = true;
  std::string profile = {};  ///< ICC
  std::vector<TiffEntry> more = {};
  std::uint32_t at = 0;  ///< where it is put as a further page
};

inline std::string tiff_file(const Tiff& tiff) {
  const auto samples = std::uint32_t(tiff.samples_per_pixel);
  const std::uint32_t count =
      (tiff.says_bits ? 10u : 9u) + !tiff.profile.empty() + std::uint32_t(tiff.more.size());
  const std::uint32_t start = tiff.at + (tiff.directory_first ? 8 + 2 + 12 * count + 4 : 8);
  std::vector<TiffEntry> entries = {{256, 4, 1, tiff.width},
                                    {257, 4, 1, tiff.height},
                                    {258, 3, 1, std::uint32_t(tiff.bits)},
                                    {259, 3, 1, 1},
                                    {262, 3, 1, std::uint32_t(tiff.photometric)},
                                    {273, 4, 1, start},
                                    {277, 3, 1, samples},
                                    {278, 4, 1, tiff.height},
                                    {279, 4, 1, std::uint32_t(tiff.samples.size())},
                                    {339, 3, 1, tiff.is_float ? 3u : 1u}};
  if (!tiff.says_bits) entries.erase(entries.begin() + 2);
  std::string padded = tiff.samples;
  if (!tiff.profile.empty()) {
    padded.resize((padded.size() + 3) / 4 * 4);
    entries.push_back(
        {34675, 7, std::uint32_t(tiff.profile.size()), start + std::uint32_t(padded.size())});
    padded += tiff.profile;
  }
  if (padded.size() % 2 != 0) padded += '\0';
  entries.insert(entries.end(), tiff.more.begin(), tiff.more.end());
  std::ranges::sort(entries, {}, &TiffEntry::tag);
  std::string directory = little_endian(std::uint32_t(entries.size()), 2);
  for (const TiffEntry& e : entries)
    directory += little_endian(e.tag, 2) + little_endian(e.type, 2) + little_endian(e.count, 4) +
                 little_endian(e.value, 4);
  directory += little_endian(0, 4);
  const std::uint32_t at = tiff.at + (tiff.directory_first ? 8 : std::uint32_t(8 + padded.size()));
  return std::string("II*\0", 4) + little_endian(at, 4) +
         (tiff.directory_first ? directory + padded : padded + directory);
}

// ---- JPEG (ITU-T T.81)

inline std::string jpeg_segment(int marker, const std::string& data) {
  return '\xff' + std::string(1, char(marker)) + big_endian(std::uint32_t(data.size() + 2), 2) +
         data;
}

/// Blocks of 8 x 8 pixels, each of one colour: `values` has the grey or R, G and B of each block, row by row. Exact: one
/// step of quantisation is an eighth of a code.
inline std::string block_jpeg(int columns, int rows, int components,
                              const std::vector<std::uint8_t>& values) {
  std::string frame = big_endian(8, 1) + big_endian(std::uint32_t(8 * rows), 2) +
                      big_endian(std::uint32_t(8 * columns), 2) + char(components);
  std::string scan(1, char(components));
  for (int c = 1; c <= components; ++c) {
    frame += std::string{char(c), '\x11', '\0'};
    scan += std::string{char(c), '\0'};
  }
  // Twelve codes of four bits, the sizes of a DC's difference; one of one bit, the end of a block.
  std::string sizes = std::string{0, 0, 0, 12} + std::string(12, '\0');
  for (int size = 0; size < 12; ++size) sizes += char(size);
  const std::string end_of_block = '\1' + std::string(15, '\0') + '\0';
  std::string bits;
  std::vector<int> before(std::size_t(components), 0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int level = 8 * (int(values[i]) - 128);
    int& last = before[i % std::size_t(components)];
    const int difference = level - last;
    last = level;
    int size = 0;
    while (std::abs(difference) >> size != 0) ++size;
    const int coded = difference < 0 ? difference + (1 << size) - 1 : difference;
    for (int bit = 3; bit >= 0; --bit) bits += char('0' + (size >> bit & 1));
    for (int bit = size - 1; bit >= 0; --bit) bits += char('0' + (coded >> bit & 1));
    bits += '0';
  }
  bits.resize((bits.size() + 7) / 8 * 8, '1');
  std::string data;
  for (std::size_t i = 0; i < bits.size(); i += 8) {
    data += char(std::stoi(bits.substr(i, 8), nullptr, 2));
    if (data.back() == '\xff') data += '\0';
  }
  // Without a colour transform three components are R, G and B, four are C, M, Y and K.
  return "\xff\xd8" +
         (components > 1 ? jpeg_segment(0xee, std::string("Adobe\0\x64\0\0\0\0\0", 12)) : "") +
         jpeg_segment(0xdb, '\0' + std::string(64, '\1')) + jpeg_segment(0xc0, frame) +
         jpeg_segment(0xc4, '\0' + sizes) + jpeg_segment(0xc4, '\x10' + end_of_block) +
         jpeg_segment(0xda, scan + std::string("\0\x3f\0", 3)) + data + "\xff\xd9";
}

/// 8 x 8 pixels, every component in the middle of its range.
inline std::string grey_jpeg_file(int components) {
  return block_jpeg(1, 1, components, std::vector<std::uint8_t>(std::size_t(components), 128));
}

/// The XMP of a JPEG with a gain map ("Ultra HDR").
inline std::string gain_map_segment() {
  return jpeg_segment(0xe1,
                      std::string("http://ns.adobe.com/xap/1.0/\0", 29) +
                          "<rdf:Description xmlns:hdrgm='http://ns.adobe.com/hdr-gain-map/1.0/' "
                          "hdrgm:Version='1.0'/>");
}

/// A JPEG with a segment behind its first marker.
inline std::string with_segments(const std::string& jpeg, const std::string& segments) {
  return jpeg.substr(0, 2) + segments + jpeg.substr(2);
}

// ---- GIF89a: frames of one pixel and one colour

inline std::string gif_file(const std::vector<std::string>& colours) {
  std::string file = "GIF89a" + std::string("\1\0\1\0\0\0\0", 7);
  for (const std::string& rgb : colours)
    file += std::string("\x21\xf9\4\0\0\0\0\0", 8) + ',' + std::string("\0\0\0\0\1\0\1\0\x80", 9) +
            rgb + rgb + std::string("\2\2\x44\1\0", 5);
  return file + ';';
}

// ---- Radiance RGBE and PFM, which is float

inline std::string hdr_file(int width, int height, const std::string& rgbe) {
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
         std::to_string(width) + "\n" + rgbe;
}

/// Rows from the bottom, as the format has them.
inline std::string pfm_file(int width, int height, const std::vector<float>& rgb) {
  return "PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n" +
         little_endian(rgb);
}

// ---- OpenEXR

struct ExrChannel {
  std::string name;
  std::vector<float> values;
  Imf::PixelType type = Imf::FLOAT;
  std::vector<std::uint32_t> numbers = {};  ///< of UINT, in place of the values
};

struct ExrPart {
  std::string name = {};
  Imath::Box2i data, display;
  std::vector<ExrChannel> channels;
  std::optional<Imf::Chromaticities> chromaticities = {};
  std::map<std::string, std::string> texts = {};
  std::optional<int> samples = {};  ///< as pbrt writes them
};

inline Imath::Box2i window(int x, int y, int width, int height) {
  return {Imath::V2i(x, y), Imath::V2i(x + width - 1, y + height - 1)};
}

/// Values of every channel: of its data window, in reading order.
inline void write_exr_parts(const std::filesystem::path& path, const std::vector<ExrPart>& parts) {
  std::vector<Imf::Header> headers;
  for (const ExrPart& part : parts) {
    Imf::Header header(part.display, part.data);
    if (!part.name.empty()) header.setName(part.name);
    header.setType(Imf::SCANLINEIMAGE);
    if (part.chromaticities) Imf::addChromaticities(header, *part.chromaticities);
    for (const auto& [name, text] : part.texts) header.insert(name, Imf::StringAttribute(text));
    if (part.samples) header.insert("samplesPerPixel", Imf::IntAttribute(*part.samples));
    for (const ExrChannel& channel : part.channels)
      header.channels().insert(channel.name, Imf::Channel(channel.type));
    headers.push_back(header);
  }
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), int(headers.size()));
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const ExrPart& part = parts[p];
    const auto width = std::size_t(part.data.max.x - part.data.min.x + 1);
    // The values that each channel stores, kept until they are written.
    std::vector<std::vector<half>> halves;
    std::vector<std::vector<std::uint32_t>> numbers;
    halves.reserve(part.channels.size());
    numbers.reserve(part.channels.size());
    Imf::FrameBuffer buffer;
    for (const ExrChannel& channel : part.channels) {
      const void* values = channel.values.data();
      std::size_t size = 4;
      if (channel.type == Imf::HALF) {
        values = halves.emplace_back(channel.values.begin(), channel.values.end()).data();
        size = 2;
      } else if (!channel.numbers.empty()) {
        values = channel.numbers.data();
      } else if (channel.type == Imf::UINT) {
        values = numbers.emplace_back(channel.values.begin(), channel.values.end()).data();
      }
      buffer.insert(channel.name,
                    Imf::Slice::Make(channel.type, values, part.data, size, size * width));
    }
    Imf::OutputPart output(file, int(p));
    output.setFrameBuffer(buffer);
    output.writePixels(part.data.max.y - part.data.min.y + 1);
  }
}

inline void write_exr_channels(const std::filesystem::path& path, int width, int height,
                               const std::vector<ExrChannel>& channels) {
  write_exr_parts(path, {{"", window(0, 0, width, height), window(0, 0, width, height), channels}});
}

}  // namespace lobelia::fixtures

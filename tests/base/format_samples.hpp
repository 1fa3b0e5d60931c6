// A small valid file of each format that is read, and what a hostile one may be made of.
#pragma once

#include <ImfCompression.h>
#include <fmt/format.h>

#include <random>

#include "tests/base/picture_files.hpp"

namespace lobelia::fixtures {

inline std::string from_hex(std::string_view digits) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes += char(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16));
  return bytes;
}

// ---- Truevision TGA

struct Tga {
  int width = 4, height = 4;
  bool run_lengths = false;
  std::string data = {};  ///< blue, green and red, or runs of them
  bool footer = false;
};

inline std::string tga_file(const Tga& tga) {
  return std::string("\0\0", 2) + char(tga.run_lengths ? 10 : 2) + std::string(9, '\0') +
         little_endian(std::uint32_t(tga.width), 2) + little_endian(std::uint32_t(tga.height), 2) +
         std::string("\x18\x20") + tga.data +
         (tga.footer ? std::string(8, '\0') + "TRUEVISION-XFILE." + '\0' : "");
}

// ---- Windows BMP, 24 bits

inline std::string bmp_file(int width, int height, const std::string& rows) {
  return "BM" + little_endian(std::uint32_t(54 + rows.size()), 4) + little_endian(0, 4) +
         little_endian(54, 4) + little_endian(40, 4) + little_endian(std::uint32_t(width), 4) +
         little_endian(std::uint32_t(height), 4) + little_endian(1, 2) + little_endian(24, 2) +
         std::string(24, '\0') + rows;
}

// ---- DPX (SMPTE ST 268), RGB of 8 bits, big-endian

inline std::string dpx_file(std::uint32_t width, std::uint32_t height, const std::string& data) {
  std::string file(2048, '\0');
  const auto put = [&](std::size_t at, const std::string& bytes) {
    file.replace(at, bytes.size(), bytes);
  };
  put(0, "SDPX" + big_endian(2048) + "V2.0");
  put(16, big_endian(std::uint32_t(2048 + data.size())));
  put(24, big_endian(1664) + big_endian(384));
  put(768, big_endian(0, 2) + big_endian(1, 2) + big_endian(width) + big_endian(height));
  put(784, big_endian(0) + big_endian(0) + big_endian(255));
  put(800, "\x32\x02\x02\x08" + big_endian(0, 2) + big_endian(0, 2) + big_endian(2048));
  return file + data;
}

// ---- WebP: 8 x 8, lossy, as libwebp wrote it

inline std::string webp_file() {
  return from_hex(
      "52494646d00000005745425056503820c4000000f004009d012a080008000000002588027435c03f40378890c0"
      "15201c401ec01fc43f90fe2671807e801e6c64cfe6138000fef4bcce77ff1cf84efbf24e3ecc2c49330e6fe4d5"
      "f78eea48bfaa4afd324f913fee42d94f7cc416d32a6ffc1acd7c9fc2b4367fcefd7aa15f2a7ba6f3ff2377f7c1"
      "6a6888a1b743396d5c682b55a7f8a3ff76a139ec934bcb5ec0773c1479d517fe3daf8effe11d5fb3507eb650ff"
      "a8f51fee25ff4dfdff9fdceb52a147a99fe3045ff9f37ff883ff14f2fd9d367f9d800000");
}

// ---- one of each

struct Sample {
  std::string name, bytes;
};

/// Valid pictures: every format, and what is common within it.
inline std::vector<Sample> format_samples() {
  std::string colours;
  for (int i = 0; i < 192; ++i) colours += char(i * 37 % 251);
  std::vector<float> floats;
  for (int i = 0; i < 192; ++i) floats.push_back(0.01f * float(i * 29 % 191));
  const std::string four = colours.substr(0, 48);
  std::string runs;  // 16 pixels in four runs
  for (int i = 0; i < 4; ++i) runs += '\x83' + colours.substr(std::size_t(3 * i), 3);
  std::vector<Sample> samples = {
      {"rgb8.png", png_file({.width = 8, .height = 8, .samples = colours})},
      {"rgba16.png",
       png_file({.width = 4, .height = 6, .bits = 16, .colour_type = 6, .samples = colours})},
      {"grey.jpg", grey_jpeg_file(1)},
      {"colour.jpg", grey_jpeg_file(3)},
      {"gain.jpg", with_segments(block_jpeg(1, 1, 3, {200, 150, 90}), gain_map_segment())},
      {"pq.png", png_file({.width = 4,
                           .height = 8,
                           .bits = 16,
                           .samples = colours,
                           .chunks = png_chunk("cICP", std::string("\x9\x10\0\1", 4))})},
      {"rgb8.tif", tiff_file({.width = 8, .height = 8, .samples = colours})},
      {"float.tif", tiff_file({.width = 8,
                               .height = 8,
                               .bits = 32,
                               .is_float = true,
                               .samples = little_endian(floats)})},
      {"flat.hdr", hdr_file(8, 6, colours)},
      {"rgb.pfm", pfm_file(8, 8, floats)},
      {"rgb.ppm", "P6 8 8 255\n" + colours},
      {"grey.pgm", "P5 8 8 255\n" + colours.substr(0, 64)},
      {"text.ppm", "P3 2 2 9\n1 2 3 4 5 6 7 8 9 0 1 2\n"},
      {"bits.pbm", "P4 8 8\n" + colours.substr(0, 8)},
      {"plain.tga", tga_file({.data = four})},
      {"runs.tga", tga_file({.run_lengths = true, .data = runs, .footer = true})},
      {"rgb.bmp", bmp_file(4, 4, four)},
      {"rgb.dpx", dpx_file(8, 8, colours)},
      {"lossy.webp", webp_file()},
  };
  const std::vector<float> channel(floats.begin(), floats.begin() + 64);
  const TemporaryDirectory scratch;
  const auto add = [&](const std::string& name, const auto& write) {
    write(scratch.path() / name);
    samples.push_back({name, read_file(scratch.path() / name, 1 << 20)});
  };
  add("zip.exr", [&](const std::filesystem::path& path) {
    write_exr_channels(path, 8, 8,
                       {{"R", channel}, {"G", channel}, {"B", channel}, {"A", channel}});
  });
  add("half.exr", [&](const std::filesystem::path& path) {
    write_exr_channels(path, 8, 8,
                       {{"R", channel, Imf::HALF},
                        {"G", channel, Imf::HALF},
                        {"B", channel, Imf::HALF},
                        {"id", channel, Imf::UINT}});
  });
  add("parts.exr", [&](const std::filesystem::path& path) {
    const auto data = window(2, 1, 8, 8), display = window(-1, 0, 12, 12);
    write_exr_parts(path, {{"one", data, display, {{"Y", channel}}},
                           {"two", data, display, {{"Z", channel}, {"left.R", channel}}}});
  });
  return samples;
}

}  // namespace lobelia::fixtures

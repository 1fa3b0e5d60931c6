#include "gallery/cells/picture.hpp"

#include <array>
#include <cstdint>
#include <fstream>

namespace lobelia::gallery {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::string_view kLastChunk("\0\0\0\0IEND\xae\x42\x60\x82", 12);
constexpr int kHeaderBytes = 24;  // signature, chunk head, width, height
constexpr std::uint32_t kMaxPngSide = 65536;

std::uint32_t big_endian(const char* at) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(at[i]);
  return value;
}

}  // namespace

Picture inspect_picture(const std::filesystem::path& directory, const std::string& file) {
  if (file.empty()) return {file, 0, 0, "The record names no picture."};
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(directory / file, ignored))
    return {file, 0, 0, "The picture " + file + " is missing."};
  std::ifstream in(directory / file, std::ios::binary);
  std::array<char, kHeaderBytes> head{};
  std::array<char, kLastChunk.size()> tail{};
  in.read(head.data(), head.size());
  in.seekg(-static_cast<std::streamoff>(tail.size()), std::ios::end);
  in.read(tail.data(), tail.size());
  const std::uint32_t width = big_endian(&head[16]), height = big_endian(&head[20]);
  if (!in || std::string_view(head.data(), 8) != kSignature ||
      std::string_view(tail.data(), tail.size()) != kLastChunk || width == 0 || height == 0 ||
      width > kMaxPngSide || height > kMaxPngSide)
    return {file, 0, 0, "The picture " + file + " is not a complete PNG."};
  return {file, int(width), int(height), ""};
}

}  // namespace lobelia::gallery

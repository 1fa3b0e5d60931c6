#include "core/picture_bytes.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "core/files.hpp"

namespace lobelia {
namespace {

constexpr std::uint64_t kMaxJpegBytes = std::uint64_t{1} << 30;

std::uint64_t number_at(std::string_view bytes, std::size_t at, bool little, std::size_t size = 4) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + (little ? size - 1 - i : i)]);
  return value;
}

/// ISO 3309, as PNG has it.
std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
  }
  return ~crc;
}

/// The first bytes of a file; zeros where it has no more.
std::string head(const std::filesystem::path& path) {
  std::string bytes(20, '\0');
  std::ifstream(path, std::ios::binary).read(bytes.data(), std::ptrdiff_t(bytes.size()));
  return bytes;
}

}  // namespace

bool is_iff(const std::filesystem::path& path) {
  const std::string bytes = head(path);
  return bytes.starts_with("FOR4") || bytes.starts_with("FORM") || path.extension() == ".iff";
}

bool is_exr_that_claims_too_much(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string start(8, '\0');
  file.read(start.data(), 8);
  if (!file || !start.starts_with("\x76\x2f\x31\x01")) return false;
  constexpr char kManyParts = 0x10;
  const bool many_parts = (start[5] & kManyParts) != 0;
  const std::uint64_t size = std::filesystem::file_size(path);
  // Name, type, length, value; an empty name ends a part's header, an empty header those of many parts.
  for (bool first = true;;) {
    std::string name, type, length(4, '\0');
    if (!std::getline(file, name, '\0')) return false;
    if (name.empty()) {
      if (first || !many_parts) return false;
      first = true;
      continue;
    }
    first = false;
    if (!std::getline(file, type, '\0') || !file.read(length.data(), 4)) return false;
    const std::uint64_t bytes = number_at(length, 0, true);
    if (bytes > size - std::uint64_t(file.tellg())) return true;
    file.seekg(std::streamoff(bytes), std::ios::cur);
  }
}

bool is_cut_off(const std::filesystem::path& path, std::string_view format) {
  if (format == "jpeg") {
    // ITU-T T.81, B.1.1.3: within a scan no 0xff is followed by either, so the last of each are markers.
    const std::string bytes = read_file(path, kMaxJpegBytes);
    const std::size_t scan = bytes.rfind("\xff\xda"), end = bytes.rfind("\xff\xd9");
    return end == bytes.npos || (scan != bytes.npos && end < scan);
  }
  if (format != "dpx") return false;
  // SMPTE ST 268: "SDPX" or, little-endian, "XPDS", and the file's size at 16, all ones if unknown.
  const std::string bytes = head(path);
  const std::uint64_t stated = number_at(bytes, 16, bytes.starts_with("XPDS"));
  return stated != 0xffffffffu && std::filesystem::file_size(path) < stated;
}

bool is_tiff_without_bits(const std::filesystem::path& path) {
  constexpr std::uint64_t kBitsPerSample = 258, kMaxEntries = 65535;
  std::ifstream file(path, std::ios::binary);
  std::string start(16, '\0');
  file.read(start.data(), 16);
  const bool little = start.starts_with("II");
  if (file.gcount() < 8 || (!little && !start.starts_with("MM"))) return false;
  const std::uint64_t version = number_at(start, 2, little, 2);
  const bool big = version == 43;
  if (version != 42 && !big) return false;
  // A directory is a count, entries, and the place of the next one.
  const std::size_t offset = big ? 8 : 4, count_size = big ? 8 : 2, entry_size = big ? 20 : 12;
  std::uint64_t at = number_at(start, big ? 8 : 4, little, offset);
  constexpr int kMaxPages = 1024;
  for (int page = 0; at != 0 && page < kMaxPages; ++page) {
    file.clear();
    file.seekg(std::streamoff(at));
    std::string bytes(count_size, '\0');
    if (!file.read(bytes.data(), std::streamsize(count_size))) return false;
    const std::uint64_t count = number_at(bytes, 0, little, count_size);
    if (count > kMaxEntries) return false;
    bytes.resize(count * entry_size + offset);
    file.read(bytes.data(), std::streamsize(bytes.size()));
    // The last directory may end without a next one.
    if (std::uint64_t(file.gcount()) < count * entry_size) return false;
    bool has_bits = false;
    for (std::uint64_t i = 0; i < count; ++i)
      has_bits |= number_at(bytes, i * entry_size, little, 2) == kBitsPerSample;
    if (!has_bits) return true;
    at = file ? number_at(bytes, count * entry_size, little, offset) : 0;
  }
  return false;
}

PngColour png_colour(const std::filesystem::path& path) {
  PngColour colour;
  std::ifstream file(path, std::ios::binary);
  file.seekg(8);
  constexpr std::uint64_t kLongest = 32;  // of those that are read
  for (std::string head(8, '\0'); file.read(head.data(), 8);) {
    const std::uint64_t length = number_at(head, 0, false);
    const std::string type = head.substr(4);
    if (type == "IDAT") break;
    if (type == "iCCP") colour.has_icc_profile = true;
    if (length > kLongest) {
      file.seekg(std::streamoff(length + 4), std::ios::cur);
      continue;
    }
    std::string data(length + 4, '\0');
    if (!file.read(data.data(), std::streamsize(data.size()))) break;
    const std::uint64_t checksum = number_at(data, length, false);
    data.resize(length);
    if (crc32(type + data) != checksum) continue;
    const auto number = [&](std::size_t i) { return double(number_at(data, 4 * i, false)) / 1e5; };
    if (type == "sRGB" && length == 1) colour.is_srgb = true;
    if (type == "gAMA" && length == 4 && !colour.gamma)
      // The chunk has five digits of the inverse: 1.8 is 0.55556.
      colour.gamma = number(0) > 0 ? std::round(1e4 / number(0)) / 1e4 : 0;
    if (type == "cHRM" && length == 32 && !colour.chromaticities)
      colour.chromaticities = {number(2), number(3), number(4), number(5),
                               number(6), number(7), number(0), number(1)};
    if (type == "cICP" && length == 4 && !colour.cicp)
      colour.cicp = {static_cast<unsigned char>(data[0]), static_cast<unsigned char>(data[1]),
                     static_cast<unsigned char>(data[2]), data[3] == 1};
  }
  return colour;
}

}  // namespace lobelia

#include "core/picture_bytes.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string>

#include "core/files.hpp"

namespace lobelia {
namespace {

constexpr std::uint64_t kMaxJpegBytes = std::uint64_t{1} << 30;

std::uint64_t number_at(std::string_view bytes, std::size_t at, bool little) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + (little ? 3 - i : i)]);
  return value;
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

}  // namespace lobelia

#include "base/pictures/picture_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>

#include "base/pictures/tiff_directory.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/no_resources.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace {

using namespace std::string_view_literals;

struct Mark {
  std::string_view bytes, format;
};

constexpr Mark kMarks[] = {{"\x76\x2f\x31\x01", "openexr"},
                           {"\x89PNG\r\n\x1a\n", "png"},
                           {"\xff\xd8\xff", "jpeg"},
                           {"II*\0"sv, "tiff"},
                           {"MM\0*"sv, "tiff"},
                           {"II+\0"sv, "tiff"},
                           {"MM\0+"sv, "tiff"},
                           {"#?", "hdr"},
                           {"SDPX", "dpx"},
                           {"XPDS", "dpx"},
                           {"BM", "bmp"}};

bool is_pnm(std::string_view head) {
  return head.size() > 2 && head[0] == 'P' && "123456Ff"sv.find(head[1]) != head.npos &&
         (std::isspace(static_cast<unsigned char>(head[2])) || head[2] == '#');
}

/// Truevision TGA 2.0, the header's 18 bytes.
bool is_tga_header(std::string_view head) {
  if (head.size() < 18) return false;
  const auto byte = [&](std::size_t at) { return number_at(head, at, true, 1); };
  const auto one_of = [](std::uint64_t value, std::initializer_list<std::uint64_t> allowed) {
    return std::ranges::find(allowed, value) != allowed.end();
  };
  const bool has_map = byte(1) == 1;
  return byte(1) <= 1 && one_of(byte(2), {1, 2, 3, 9, 10, 11}) &&
         (!has_map || one_of(byte(7), {15, 16, 24, 32})) && number_at(head, 12, true, 2) > 0 &&
         number_at(head, 14, true, 2) > 0 && one_of(byte(16), {8, 15, 16, 24, 32}) &&
         (byte(17) & 0xc0) == 0;
}

/// Calls `see` with the type and the value of each attribute of an EXR, in all parts. Returns false if one is longer than
/// the file.
template <class See>
bool see_exr_attributes(std::string_view bytes, const See& see) {
  if (bytes.size() < 8 || !bytes.starts_with("\x76\x2f\x31\x01")) return true;
  constexpr char kManyParts = 0x10;
  const bool many_parts = (bytes[5] & kManyParts) != 0;
  std::size_t at = 8;
  const auto text = [&]() -> std::string_view {
    const std::size_t end = std::min(bytes.find('\0', at), bytes.size());
    const std::string_view result = bytes.substr(at, end - at);
    at = end + 1;
    return result;
  };
  // Attributes are name, type, length, value. An empty name ends the header of a part, an empty header all headers.
  for (bool first = true;;) {
    const std::string_view name = text();
    if (at >= bytes.size()) return true;
    if (name.empty()) {
      if (first || !many_parts) return true;
      first = true;
      continue;
    }
    first = false;
    const std::string_view type = text();
    if (at + 4 > bytes.size()) return true;
    const std::uint64_t length = number_at(bytes, at, true);
    at += 4;
    if (length > bytes.size() - at) return false;
    see(type, bytes.substr(at, length));
    at += length;
  }
}

constexpr std::string_view kBecameShorter = "it became shorter while it was read";

Error not_readable(const std::filesystem::path& path, std::string_view why) {
  return Error(ExitCode::kInput, "{}: not a readable picture: {}", path.string(),
               printable(why, 300));
}

[[noreturn]] void system_said(const std::filesystem::path& path, int error) {
  if (!lacking(error).empty()) throw failure_of(path.string(), error, ExitCode::kInput);
  throw not_readable(path, error == ENOENT ? "no such file" : std::strerror(error))
      .set_fault(!tells_of_file(error));
}

}  // namespace

std::uint64_t number_at(std::string_view bytes, std::size_t at, bool little, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t place = at + (little ? size - 1 - i : i);
    value = value << 8 | (place < bytes.size() ? static_cast<unsigned char>(bytes[place]) : 0);
  }
  return value;
}

std::string_view picture_format(std::string_view head, std::string_view footer,
                                std::string_view ending) {
  for (const Mark& mark : kMarks)
    if (head.starts_with(mark.bytes)) return mark.format;
  if (is_pnm(head)) return "pnm";
  if (head.starts_with("RIFF") && head.size() >= 12 && head.substr(8, 4) == "WEBP") return "webp";
  const bool is_tga = footer.ends_with("TRUEVISION-XFILE.\0"sv) || lower_case(ending) == ".tga";
  return is_tga && is_tga_header(head) ? "targa" : "";
}

bool is_exr_that_claims_too_much(std::string_view bytes) {
  return !see_exr_attributes(bytes, [](std::string_view, std::string_view) {});
}

bool has_subsampled_channels(std::string_view bytes) {
  bool found = false;
  see_exr_attributes(bytes, [&](std::string_view type, std::string_view value) {
    if (type != "chlist") return;
    // A name, its end, the type, a flag, three bytes, and the sampling along x and y; an empty name ends the list.
    constexpr std::size_t kAfterName = 16;
    for (std::size_t at = 0; at < value.size() && value[at] != '\0';) {
      const std::size_t end = value.find('\0', at);
      if (end == value.npos || value.size() - end - 1 < kAfterName) return;
      for (const std::size_t sampling : {end + 9, end + 13})
        if (number_at(value, sampling, true) != 1) found = true;
      at = end + 1 + kAfterName;
    }
  });
  return found;
}

bool is_heif_of_hdr(std::string_view bytes) {
  // ISO/IEC 23008-12: the box colr of kind nclx, as ITU-T H.273 has it. Boxes come before the pixels.
  constexpr std::string_view kBox = "colrnclx";
  constexpr std::size_t kBoxes = 1 << 16;
  const std::string_view head = bytes.substr(0, kBoxes);
  for (std::size_t at = head.find(kBox); at != head.npos; at = head.find(kBox, at + 1)) {
    const std::uint64_t transfer = number_at(head, at + kBox.size() + 2, false, 2);
    if (transfer == 16 || transfer == 18) return true;
  }
  return false;
}

bool has_gain_map(std::string_view jpeg) {
  // Adobe's specification 1.0 (XMP), and ISO 21496-1.
  for (const std::string_view name :
       {"http://ns.adobe.com/hdr-gain-map/1.0/", "urn:iso:std:iso:ts:21496:-1"})
    if (jpeg.find(name) != jpeg.npos) return true;
  return false;
}

bool is_cut_off(std::string_view bytes, std::string_view format) {
  if (format == "jpeg") {
    // ITU-T T.81, B.1.1.3: within a scan neither follows 0xff, so the last of each is a marker.
    const std::size_t scan = bytes.rfind("\xff\xda"), end = bytes.rfind("\xff\xd9");
    return end == bytes.npos || (scan != bytes.npos && end < scan);
  }
  if (format != "dpx") return false;
  // SMPTE ST 268: "SDPX" or, little-endian, "XPDS", and the file's size at 16, all ones if unknown.
  const std::uint64_t stated = number_at(bytes, 16, bytes.starts_with("XPDS"));
  return stated != 0xffffffffu && bytes.size() < stated;
}

bool is_tiff_without_bits(std::string_view file) {
  constexpr std::uint64_t kBitsPerSample = 258;
  auto directory = TiffDirectory::first(file);
  for (int page = 0; directory && page < kMaxTiffPages; ++page, directory = directory->next())
    if (!directory->has(kBitsPerSample)) return true;
  return false;
}

std::vector<std::string_view> jpeg_segments(std::string_view jpeg, std::string_view beginning) {
  std::vector<std::string_view> found;
  std::size_t at = 2;
  while (at + 4 <= jpeg.size() && jpeg[at] == '\xff') {
    const int marker = static_cast<unsigned char>(jpeg[at + 1]);
    constexpr int kFill = 0xff, kScan = 0xda;
    if (marker == kFill) {
      ++at;
      continue;
    }
    const std::size_t length = number_at(jpeg, at + 2, false, 2);
    if (marker == kScan || length < 2) break;
    const std::string_view data = jpeg.substr(at + 4, length - 2);
    if (data.starts_with(beginning)) found.push_back(data.substr(beginning.size()));
    at += 2 + length;
  }
  return found;
}

PngColour png_colour(std::string_view file) {
  PngColour colour;
  constexpr std::size_t kLongest = 32;  // bytes of a chunk that is read
  // A chunk is length, type, data, checksum.
  for (std::size_t at = 8; at <= file.size() && file.size() - at >= 8;) {
    const std::size_t length = number_at(file, at, false);
    const std::string_view type = file.substr(at + 4, 4), data = file.substr(at + 8, length);
    if (type == "IDAT") break;
    if (type == "iCCP") colour.has_icc_profile = true;
    at += 12 + length;
    if (length > kLongest) continue;
    if (at > file.size()) break;
    const std::string_view checked = file.substr(at - 8 - length, 4 + length);
    const auto* bytes = reinterpret_cast<const unsigned char*>(checked.data());
    if (::crc32(0, bytes, uInt(checked.size())) != number_at(file, at - 4, false)) continue;
    const auto number = [&](std::size_t i) { return double(number_at(data, 4 * i, false)) / 1e5; };
    if (type == "sRGB" && length == 1) colour.is_srgb = true;
    if (type == "gAMA" && length == 4 && !colour.gamma)
      // The chunk holds the inverse with five digits: 0.55556 for 1.8.
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

void unreadable_picture(const std::filesystem::path& path, std::string_view why) {
  throw not_readable(path, why);
}

PictureFile::PictureFile(const std::filesystem::path& path)
    : PictureFile(path, [&] {
        // O_NONBLOCK: opening a pipe would wait for its writer.
        Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
        if (!file) system_said(path, errno);
        return file;
      }()) {}

PictureFile::PictureFile(InputFile file) : PictureFile(file.path(), file.release()) {}

void PictureFile::require_picture(const InputFile& file) {
  Descriptor same(::fcntl(file.descriptor(), F_DUPFD_CLOEXEC, 0));
  if (!same) system_said(file.path(), errno);
  PictureFile(file.path(), std::move(same)).known_format();
}

PictureFile::PictureFile(const std::filesystem::path& path, Descriptor file)
    : path_(path), file_(std::move(file)) {
  struct stat status {};
  if (::fstat(descriptor(), &status) != 0) system_said(path, errno);
  std::string problem;
  if (!S_ISREG(status.st_mode))
    problem = "not a regular file";
  else if (status.st_size == 0)
    problem = "the file is empty";
  else if (std::uint64_t(status.st_size) > kMaxPictureBytes)
    problem =
        fmt::format("the file has {} bytes; at most {} are read", status.st_size, kMaxPictureBytes);
  size_ = std::uint64_t(status.st_size);
  if (!problem.empty()) unreadable_picture(path, problem);
}

std::string PictureFile::read(std::uint64_t offset, std::size_t size) const {
  std::string bytes(size, '\0');
  if (read_in_pieces(descriptor(), bytes.data(), size, offset) < size) {
    if (errno != 0) system_said(path_, errno);
    unreadable_picture(path_, kBecameShorter);
  }
  return bytes;
}

std::string PictureFile::read_all() const { return read(0, size_); }

std::string_view PictureFile::known_format() const {
  constexpr std::uint64_t kHeadBytes = 64;
  const std::uint64_t footer = std::min<std::uint64_t>(size_, kFooterBytes);
  const std::string_view format =
      picture_format(read(0, std::min(size_, kHeadBytes)), read(size_ - footer, footer),
                     path_.extension().string());
  if (format.empty())
    unreadable_picture(path_,
                       fmt::format("its first bytes are not those of {} (compare and profile open "
                                   "other formats with --any-format)",
                                   kPictureFormats));
  return format;
}

Descriptor PictureFile::copy_in_memory(std::uint64_t max_bytes) const {
  if (size_ > max_bytes)
    unreadable_picture(
        path_, fmt::format("the file has {} bytes; at most {} of such a format are read", size_,
                           max_bytes));
  Descriptor copy(::memfd_create("picture", MFD_CLOEXEC));
  if (copy.get() < 0) system_said(path_, errno);
  off_t offset = 0;
  while (std::uint64_t(offset) < size_) {
    const ssize_t n = ::sendfile(copy.get(), descriptor(), &offset, std::size_t{1} << 24);
    const int error = errno;
    if (n > 0 && !interrupted()) continue;
    throw_if_interrupted();
    if (n < 0) system_said(path_, error);
    unreadable_picture(path_, kBecameShorter);
  }
  return copy;
}

}  // namespace lobelia

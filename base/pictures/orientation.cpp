#include "base/pictures/orientation.hpp"

#include <zlib.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/pictures/picture_file.hpp"
#include "base/pictures/tiff_directory.hpp"

namespace lobelia {
namespace {

constexpr std::string_view kExifMark("Exif\0\0", 6);
constexpr std::uint64_t kOrientationTag = 274;

int with_meaning(std::optional<std::uint64_t> number) {
  return number && *number >= 1 && *number <= kMostOrientation ? int(*number) : kUpright;
}

int of_directory(const std::optional<TiffDirectory>& directory) {
  return directory ? with_meaning(directory->number(kOrientationTag)) : kUpright;
}

int of_exif(std::string_view exif) {
  if (exif.starts_with(kExifMark)) exif.remove_prefix(kExifMark.size());
  return of_directory(TiffDirectory::first(exif));
}

/// PNG, third edition, 11.3.4.5. A chunk with a wrong checksum does not count, as for libpng.
int of_png(std::string_view file) {
  for (std::size_t at = 8; at <= file.size() && file.size() - at >= 12;) {
    const std::uint64_t length = number_at(file, at, false);
    if (length > file.size() - at - 12) break;
    const std::string_view checked = file.substr(at + 4, 4 + length);
    if (checked.starts_with("eXIf") &&
        ::crc32(0, reinterpret_cast<const unsigned char*>(checked.data()), uInt(checked.size())) ==
            number_at(file, at + 8 + length, false))
      return of_exif(checked.substr(4));
    at += 12 + length;
  }
  return kUpright;
}

/// RFC 9649, 2.7: chunks of an even length behind "RIFF", a length and "WEBP".
int of_webp(std::string_view file) {
  for (std::size_t at = 12; at <= file.size() && file.size() - at >= 8;) {
    const std::uint64_t length = number_at(file, at + 4, true);
    if (length > file.size() - at - 8) break;
    if (file.substr(at, 4) == "EXIF") return of_exif(file.substr(at + 8, length));
    at += 8 + length + length % 2;
  }
  return kUpright;
}

std::optional<TiffDirectory> directory_of(std::string_view file, std::size_t page) {
  auto directory = TiffDirectory::first(file);
  for (std::size_t i = 0; i < page && i < kMaxTiffPages && directory; ++i)
    directory = directory->next();
  return directory;
}

/// Radiance's line "-Y 480 +X 640": the axis from one stored row to the next, then that from one value to the next. Y
/// points up. Of OpenImageIO 2.4, "+X +Y" and "-X -Y" have each other's number.
int of_radiance(std::string_view file) {
  const std::size_t header = file.find("\n\n");
  if (header == file.npos) return kUpright;
  constexpr std::size_t kLongest = 64;
  std::string_view line = file.substr(header + 2, kLongest);
  line = line.substr(0, line.find('\n'));
  const std::size_t second = line.find_first_of("XY", 2);
  if (second == line.npos) return kUpright;
  const std::string axes = std::string(line.substr(0, 2)) + std::string(line.substr(second - 1, 2));
  constexpr std::string_view kAxes[] = {"-Y+X", "-Y-X", "+Y-X", "+Y+X",
                                        "+X-Y", "-X-Y", "-X+Y", "+X+Y"};
  const auto* const found = std::ranges::find(kAxes, axes);
  return found == std::end(kAxes) ? kUpright : int(found - kAxes) + 1;
}

/// SMPTE ST 268, field 30: the direction of the values of a line, then of the lines.
std::uint64_t field_of_dpx(std::string_view file) {
  constexpr std::size_t kPlace = 768;
  return number_at(file, kPlace, file.starts_with("XPDS"), 2);
}

int of_dpx(std::string_view file) {
  constexpr int kByField[] = {1, 2, 4, 3};
  const std::uint64_t field = field_of_dpx(file);
  return field < std::size(kByField) ? kByField[field] : kUpright;
}

bool exchanges_axes(int orientation) { return orientation >= 5; }

/// Where the stored pixel (x, y) of a picture of that stored size is shown.
std::pair<int, int> shown_at(int x, int y, int width, int height, int orientation) {
  // By orientation, from 1 on: what is mirrored before rows and columns are exchanged.
  constexpr bool kMirrorsX[] = {false, true, true, false, false, false, true, true},
                 kMirrorsY[] = {false, false, true, true, false, true, true, false};
  const auto kind = std::size_t(orientation - kUpright);
  if (kMirrorsX[kind]) x = width - 1 - x;
  if (kMirrorsY[kind]) y = height - 1 - y;
  return exchanges_axes(orientation) ? std::pair(y, x) : std::pair(x, y);
}

/// Where a window of a picture with that display window comes to lie.
PixelWindow turned_window(const PixelWindow& window, const PixelWindow& display, int orientation) {
  const auto corner = [&](int x, int y) {
    return shown_at(x - display.x, y - display.y, display.width, display.height, orientation);
  };
  const auto [x0, y0] = corner(window.x, window.y);
  const auto [x1, y1] = corner(window.x + window.width - 1, window.y + window.height - 1);
  return {display.x + std::min(x0, x1), display.y + std::min(y0, y1), std::abs(x1 - x0) + 1,
          std::abs(y1 - y0) + 1};
}

/// The picture as it is shown, from one that is stored in that orientation.
Image turned_upright(Image stored, int orientation) {
  if (orientation == kUpright) return stored;
  const int width = stored.width(), height = stored.height();
  const bool exchanged = exchanges_axes(orientation);
  Image result(exchanged ? height : width, exchanged ? width : height);
  // In squares that stay in the cache: with exchanged axes one of the pictures is walked across its rows.
  constexpr int kSide = 64;
  for (int top = 0; top < height; top += kSide)
    for (int left = 0; left < width; left += kSide)
      for (int y = top; y < std::min(top + kSide, height); ++y)
        for (int x = left; x < std::min(left + kSide, width); ++x) {
          const auto [to_x, to_y] = shown_at(x, y, width, height, orientation);
          std::ranges::copy(stored.pixel(x, y), result.pixel(to_x, to_y).begin());
        }
  return result;
}

}  // namespace

bool is_dpx_in_columns(std::string_view file) {
  const std::uint64_t field = field_of_dpx(file);
  return field >= 4 && field < 8;
}

int stated_orientation(std::string_view file, std::string_view format, std::size_t page) {
  if (format == "jpeg")
    for (const std::string_view exif : jpeg_segments(file, kExifMark)) return of_exif(exif);
  if (format == "png") return of_png(file);
  if (format == "webp") return of_webp(file);
  if (format == "tiff") return of_directory(directory_of(file, page));
  if (format == "hdr") return of_radiance(file);
  if (format == "dpx") return of_dpx(file);
  return kUpright;
}

int orientation_left_by_libtiff(std::string_view file, int orientation, std::size_t page) {
  constexpr std::uint64_t kCompression = 259, kPhotometric = 262, kSamples = 277;
  constexpr std::uint64_t kOldJpeg = 6, kJpeg = 7, kYCbCr = 6, kLogL = 32844, kLogLuv = 32845;
  const auto directory = directory_of(file, page);
  if (!directory) return orientation;
  const std::uint64_t packed = directory->number(kCompression).value_or(1);
  const std::uint64_t colours = directory->number(kPhotometric).value_or(0);
  const bool is_jpeg = packed == kJpeg || packed == kOldJpeg;
  const bool by_rgba = (is_jpeg && directory->number(kSamples).value_or(1) != 3) ||
                       colours == kYCbCr || colours == kLogL || colours == kLogLuv;
  if (!by_rgba) return orientation;
  // Mirroring leaves two of the four that exchange rows and columns.
  if (!exchanges_axes(orientation)) return kUpright;
  return orientation == 5 || orientation == 7 ? 5 : 7;
}

void turn_upright(Picture& picture, int orientation) {
  picture.image = turned_upright(std::move(picture.image), orientation);
  PictureSource& source = picture.source;
  const PixelWindow display = source.display;
  source.data = turned_window(source.data, display, orientation);
  source.display = turned_window(display, display, orientation);
  source.orientation = orientation;
}

std::string_view orientation_text(int orientation) {
  constexpr std::string_view kTexts[] = {"",
                                         "mirrored left to right",
                                         "turned by 180 degrees",
                                         "mirrored top to bottom",
                                         "rows and columns exchanged",
                                         "turned by 90 degrees clockwise",
                                         "turned by 180 degrees, rows and columns exchanged",
                                         "turned by 90 degrees counterclockwise"};
  return orientation >= kUpright && orientation <= kMostOrientation
             ? kTexts[std::size_t(orientation) - 1]
             : "";
}

}  // namespace lobelia

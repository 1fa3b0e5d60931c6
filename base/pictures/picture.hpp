// A picture as it was read from a file.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/pictures/image.hpp"

namespace lobelia {

/// Pixels x to x + width - 1, y to y + height - 1; y down. A file's data window is where it has values; its display
/// window is the picture.
struct PixelWindow {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const PixelWindow&) const = default;
};

/// Why a window cannot be read, in words that begin with `what`; empty if it can: at least one pixel, at most
/// kMaxImageSide a side, kMaxImagePixels in all, corners no farther than 2^30 from 0.
std::string window_problem(const std::string& what, const PixelWindow& window);

/// Whether they have no pixel in common.
bool are_apart(const PixelWindow& a, const PixelWindow& b);

bool is_inside(const PixelWindow& inner, const PixelWindow& outer);

/// Why the windows of a file cannot be read; empty if they can.
std::string windows_problem(const PixelWindow& data, const PixelWindow& display);

/// Moves `image` from the window `data` to `display`: cut off outside, 0 where there are no data.
Image place(Image image, const PixelWindow& data, const PixelWindow& display);

/// PictureSource::transfer where the ICC profile was applied.
inline constexpr char kByProfile[] = "ICC profile";

struct PictureSource {
  std::string format;                 ///< "openexr", "png": OpenImageIO's name
  std::string layer;                  ///< "" for the picture itself
  std::vector<std::string> channels;  ///< in the file: three, a vector's two, or one for grey
  std::string value_type;             ///< as stored: "half", "float", "uint8", "uint16", "uint"
  /// TransferCurve::name: "linear", "sRGB", "gamma 1.8", "PQ"; or kByProfile
  std::string transfer;
  bool multiplied_by_alpha = false;  ///< by us, after the transfer curve
  /// x, y of red, green, blue and white that the colours were converted from; empty for Rec. 709
  std::vector<double> chromaticities;
  std::string icc_profile;    ///< description of a profile
  bool icc_is_srgb = false;   ///< the profile is what is assumed anyway
  bool has_gain_map = false;  ///< which is not applied
  double samples = 0;         ///< of a pixel, if a renderer wrote them into the file; else 0
  PixelWindow data, display;
  int orientation = 1;  ///< of the stored rows and columns, undone (base/pictures/orientation.hpp)
  std::string alpha;    ///< name of the layer with its alpha; empty if there is none
  std::vector<std::string> layers;  ///< all layers of the file, as layer_names()
  int mip_levels = 1;               ///< in the file; the first was read
  /// Names of the Cryptomattes that the file's metadata announce (compare/layer_type.hpp), each once.
  std::vector<std::string> cryptomattes;
  /// Their manifests, JSON of objects and hashes, where the picture was read as it is stored; "" for none.
  std::vector<std::string> manifests;
  bool as_stored = false;  ///< see read_stored_picture()
};

/// How the file's values became light, where that is more than its format alone says: names and words for people.
std::vector<std::pair<std::string, std::string>> reading_facts(const PictureSource& source);

/// How many pixels may be read from a file of a given size. A few bytes can unpack to very many pixels: callers that know
/// the size of their pictures set a tighter limit. The header is checked before anything is unpacked.
struct PictureLimit {
  std::uint64_t pixels_of_any_file = std::uint64_t{1} << 24;
  std::uint64_t pixels_per_byte = 4096;  ///< in addition, for each byte of the file
};

struct Picture {
  Image image;     ///< of the display window
  Image overscan;  ///< of the data window if that leaves the display window, else empty
  PictureSource source;
};

/// Moves the picture from its data window, which its image has, to its display window, and keeps what leaves that.
void place_on_display(Picture& picture);

}  // namespace lobelia

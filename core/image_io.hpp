// Reading and writing pictures; all but the writing of EXR by OpenImageIO.
//
// OpenImageIO brings some 260 shared libraries and 0.2 s to every process that links it, so it lives
// in a module of its own (image_io_module.cpp) that is loaded at the first picture.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/picture.hpp"

namespace lobelia {

/// Reads a layer (core/picture_layers.hpp; "" is the picture itself) of a file of kPictureFormats (core/picture_file.hpp)
/// into scene-linear float RGB, grey repeated: decoded from the curve that transfer_curve() says, other primaries
/// converted to Rec. 709, colours of a file that are not multiplied by its alpha multiplied afterwards, in light. The
/// image is the display window. Integers are 1 at their largest; in an EXR they are numbers, as they are. Of a MIP map
/// the first level; of a cube map all faces.
/// Decoded by another process (core/contained_reader.hpp), because a file may be hostile.
/// Throws Error(kInput): missing, not a regular file, not such a picture, truncated, over kMaxImageSide or
/// kMaxImagePixels in either window, deep, CMYK or Lab, of chromaticities that are none, without that layer; it crashes
/// its decoder, or needs more memory or time than its size justifies. Throws Error(kInterrupted) when interrupted()
/// becomes true.
Picture read_picture(const std::filesystem::path& path, const std::string& layer);

/// The same of the picture itself.
Image read_image(const std::filesystem::path& path);

/// The same, read by this process: quicker, but a hostile file could end it or worse. Only for files that we wrote
/// ourselves, or of which we know the hash.
Image read_trusted_image(const std::filesystem::path& path);

/// Every layer that the file has, the picture ("") first if it has one. Errors as read_picture.
std::vector<std::string> layer_names(const std::filesystem::path& path);

/// Writes a float32 OpenEXR with ZIP compression, by ExrWriter (core/exr_writer.hpp): the bytes depend on
/// the arguments alone. Throws Error(kOutput); never leaves a partial file under `path`.
void write_exr(const std::filesystem::path& path, const Image& image,
               const ImageMetadata& metadata);

/// Writes an 8-bit sRGB PNG, its metadata as texts. Errors as write_exr.
void write_png(const std::filesystem::path& path, const DisplayImage& image,
               const ImageMetadata& metadata = {});

/// For a process that sees to many pictures at once: from now on each is encoded and decoded on the thread that asks for
/// it, and not on threads that all pictures share. To be said before the first one, while none is being written.
void code_pictures_on_calling_threads();

/// sRGB colours for values from 0 to 1, evenly spaced.
inline constexpr int kColourTableSize = 256;
using ColourTable = std::array<std::array<std::uint8_t, 3>, kColourTableSize>;

/// A map that OpenImageIO knows: "magma", "inferno", "plasma", "viridis", "turbo". Throws Error(kInternal) for
/// one that it does not.
ColourTable colour_table(std::string_view name);

}  // namespace lobelia

// Reads and writes pictures.
//
// OpenImageIO brings some 260 shared libraries and 0.3 s to every process that links it. So it is in a module of its own
// (image_io_module.cpp), which is loaded for the first picture that is not plain (base/pictures/plain_picture.hpp).
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "base/pictures/contained_reader.hpp"

namespace lobelia {

/// The picture itself: read_picture(path, "").
Image read_image(const std::filesystem::path& path);

/// The same, decoded in this process: faster, but a hostile file could crash it or worse. Only for files that we wrote
/// ourselves or whose hash we know.
Image read_trusted_image(const std::filesystem::path& path);

/// Writes a float32 OpenEXR with ZIP compression, by ExrWriter (base/pictures/exr_writer.hpp): the bytes depend on
/// the arguments alone. Throws Error(kOutput); never leaves a partial file under `path`.
void write_exr(const std::filesystem::path& path, const Image& image,
               const ImageMetadata& metadata);

/// Writes an 8-bit sRGB PNG with its metadata as texts. Errors as write_exr().
void write_png(const std::filesystem::path& path, const DisplayImage& image,
               const ImageMetadata& metadata = {});

/// The file that write_png() writes.
std::string png_bytes(const DisplayImage& image, const ImageMetadata& metadata = {});

/// Makes each picture be encoded and decoded on the thread that asks for it, instead of threads that all pictures share:
/// for a process that handles many pictures at once. Call it before the first picture.
void code_pictures_on_calling_threads();

/// sRGB colours for values from 0 to 1, evenly spaced.
inline constexpr int kColourTableSize = 256;
using ColourTable = std::array<std::array<std::uint8_t, 3>, kColourTableSize>;

/// A colour map of OpenImageIO: "magma", "inferno", "plasma", "viridis", "turbo". Throws Error(kInternal) for any other
/// name.
ColourTable colour_table(std::string_view name);

}  // namespace lobelia

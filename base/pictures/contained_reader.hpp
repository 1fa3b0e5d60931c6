// Reads pictures from untrusted files, in processes that can do no harm (docs/decisions/0008).
//
// The program opens the file and recognises its format. A second program, lobelia_picture_reader, forks for each picture.
// It loads OpenImageIO for the first that is not plain (base/pictures/plain_picture.hpp). The child gets the open file,
// limits, and only the system calls that it needs (base/pictures/reading_limits.hpp). It decodes, answers through a pipe
// and ends. A hostile file harms nothing but this child.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/pictures/picture.hpp"

namespace lobelia {

/// Reads a layer (base/pictures/picture_layers.hpp; "" is the picture itself) of a file of kPictureFormats
/// (base/pictures/picture_file.hpp) into scene-linear float RGB, grey repeated. Values are decoded by an ICC profile
/// (base/pictures/icc_profile.hpp) or by transfer_curve(), converted to Rec. 709 primaries, and then multiplied by alpha
/// if the file's are not. A gain map of a JPEG is not applied. The image is the display window. The largest integer
/// becomes 1; integers of an EXR keep their value. Of a MIP map the first level is read, of a cube map all faces. Any
/// number of threads may call it. Throws Error(kInput) if the file is missing, not a regular file, not such a picture,
/// truncated, over `limit`, over kMaxImageSide or kMaxImagePixels in either window, deep, CMYK or Lab, has impossible
/// chromaticities, a damaged profile, or no such layer, crashes its decoder, or needs more memory or time than its size
/// justifies. Throws Error(kInterrupted) as soon as interrupted().
Picture read_picture(const std::filesystem::path& path, const std::string& layer,
                     const PictureLimit& limit = {});

class PictureFile;

/// The same of a file that is open.
Picture read_picture(const PictureFile& file, const std::string& layer,
                     const PictureLimit& limit = {});

/// The same, but with the values that the file holds: no curve, profile, primaries or alpha is applied. A float keeps
/// its bits. An integer of 32 bits becomes the float of the same bits, so that no two of them are the same.
Picture read_stored_picture(const std::filesystem::path& path, const std::string& layer);

/// All layers of the file, first the picture ("") if it has one. Errors as read_picture().
std::vector<std::string> layer_names(const std::filesystem::path& path);

/// The part of code_pictures_on_calling_threads() for these processes.
void decode_contained_on_one_thread();

/// Whether to read any format that OpenImageIO knows, not only kPictureFormats; false at first.
void read_any_picture_format(bool any = true);

}  // namespace lobelia

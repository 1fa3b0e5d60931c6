// Reading pictures that nobody vouches for, in processes that can do no harm (docs/decisions/0017).
//
// The program opens the file and tells its format. A second program, lobelia_picture_reader, has OpenImageIO's module
// loaded and forks itself for each picture: the child gets the open file, limits and no system calls that it
// does not need (core/reading_limits.hpp), decodes, answers by a pipe and ends. What a file does to it, it
// does to nothing else.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/picture.hpp"
#include "core/reading_limits.hpp"

namespace lobelia {

/// As read_picture() and layer_names(). Throw Error(kInput) besides if the picture is over `limit`, or the decoder crashes
/// or needs more memory or time than the file justifies, and Error(kInterrupted) at once when interrupted() becomes true. For any number of threads.
Picture read_contained(const std::filesystem::path& path, const std::string& layer,
                       const PictureLimit& limit = {});
std::vector<std::string> layer_names_contained(const std::filesystem::path& path);

/// As code_pictures_on_calling_threads().
void decode_contained_on_one_thread();

/// Whether formats other than kPictureFormats are read, too, as far as OpenImageIO knows them; at first not.
void read_any_picture_format(bool any = true);

}  // namespace lobelia

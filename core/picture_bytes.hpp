// What a file's own bytes say where a library is not to be asked.
#pragma once

#include <filesystem>
#include <string_view>

namespace lobelia {

/// Whether it is an IFF file by its first bytes or its ending.
bool is_iff(const std::filesystem::path& path);

/// Whether it is an EXR with an attribute that is longer than the file: OpenEXR would take memory for it, 2 GiB
/// and more, before it looks.
bool is_exr_that_claims_too_much(const std::filesystem::path& path);

/// Whether the file was cut off, where the libraries fill what is missing and say nothing:
/// true of a JPEG without the marker that ends its last scan, and of a DPX that is shorter than its
/// header says; `format` is OpenImageIO's name, of another it is false. Throws Error(kInput) if it cannot be read.
bool is_cut_off(const std::filesystem::path& path, std::string_view format);

}  // namespace lobelia

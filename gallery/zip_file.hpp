// A folder as one ZIP file, the same bytes for the same files: no times, names in order.
#pragma once

#include <filesystem>

namespace lobelia::gallery {

/// The comment at the end of each, by which we know our own.
inline constexpr char kZipComment[] = "gallery by lobelia";

/// Writes all regular files below `directory`, under names that begin with `top`/. Throws Error(kOutput).
void write_zip(const std::filesystem::path& directory, const std::string& top,
               const std::filesystem::path& path);

/// Whether the file ends as those of write_zip() do.
bool is_our_zip(const std::filesystem::path& path);

}  // namespace lobelia::gallery

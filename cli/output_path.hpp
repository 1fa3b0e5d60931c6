// Where a picture and its record go.
#pragma once

#include <filesystem>

namespace lobelia::cli {

/// Throws Error(kUsage) unless `image` ends in .exr, Error(kOutput) unless it and the record beside
/// it can be written; returns the record's path (OUT.exr -> OUT.json).
std::filesystem::path checked_record_path(const std::filesystem::path& image);

}  // namespace lobelia::cli

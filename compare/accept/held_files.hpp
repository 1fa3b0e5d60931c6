// Files in directories that are held open (base/system/removal.hpp): by their names alone, so that no link leads elsewhere.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/system/descriptor.hpp"
#include "base/system/removal.hpp"
#include "base/system/sha256.hpp"

namespace lobelia {

using FileStatus = struct stat;

/// Whether both are one file, under whatever names.
bool is_one_file(const FileStatus& a, const FileStatus& b);
/// Whether both are one file, and nobody wrote into it between the two looks.
bool is_unchanged(const FileStatus& a, const FileStatus& b);

/// The status of the file that a link leads to. Nothing if there is none, or if that cannot be told.
std::optional<FileStatus> status_behind(const std::filesystem::path& path);
/// The status of the entry itself. Nothing if there is none. Throws Error(kOutput) if that cannot be told.
std::optional<FileStatus> status_in(const HeldDirectory& directory, const std::string& name);

/// The status of a regular file with these bytes. Nothing if there is none, or somebody writes into it meanwhile. Throws
/// Error(kOutput) and as sha256_of_file() if that cannot be told.
std::optional<FileStatus> status_if_holds(const HeldDirectory& directory, const std::string& name,
                                          const Sha256Digest& bytes);

/// The directory `relative` of `root`, by plain names. Holds none if it is missing. Throws Error(kOutput) for a link on the
/// way, and for another file system.
HeldDirectory find_in(const HeldDirectory& root, const std::filesystem::path& relative);
/// The same, and makes what is missing.
HeldDirectory make_in(const HeldDirectory& root, const std::filesystem::path& relative);

/// Replaces what is there. Throws Error(kOutput).
void move_file(const HeldDirectory& from, const std::string& name, const HeldDirectory& to,
               const std::string& new_name);
/// A second name of the file, or of the link itself. False if there cannot be one, as where there are no hard links.
bool link_file(const HeldDirectory& from, const std::string& name, const HeldDirectory& to,
               const std::string& new_name);
/// The names in it are on the disk then. Throws Error(kOutput).
void flush_names(const HeldDirectory& directory);

/// Writes a file anew, to the disk. Throws Error(kOutput).
void write_in(const HeldDirectory& directory, const std::string& name, std::string_view text);
/// Copies `from`, through a link, to the disk. The copy gets the mode of `rights` and its group, if this user may set that.
/// Throws Error(kOutput), and for `from` as sha256_of_file().
void copy_in(const HeldDirectory& directory, const std::string& name,
             const std::filesystem::path& from, const std::optional<FileStatus>& rights);

}  // namespace lobelia

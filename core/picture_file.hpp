// A picture's file, opened and looked at, before a library sees it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/descriptor.hpp"

namespace lobelia {

/// Larger files are not opened; those of --any-format are copied into memory.
inline constexpr std::uint64_t kMaxPictureBytes = std::uint64_t{8} << 30;
inline constexpr std::uint64_t kMaxAnyFormatBytes = std::uint64_t{1} << 30;

class PictureFile {
 public:
  /// Throws Error(kInput): missing, not a regular file, empty, over kMaxPictureBytes.
  explicit PictureFile(const std::filesystem::path& path);

  int descriptor() const { return file_.get(); }
  std::uint64_t size() const { return size_; }
  /// As picture_format(). Throws Error(kInput) if it has none, naming those that are read.
  std::string_view known_format() const;
  /// The whole file. Throws Error(kInput) if it became shorter.
  std::string read_all() const;
  /// A copy of the file in memory that belongs to no file system. Throws Error(kInput) if it is over `max_bytes`.
  Descriptor copy_in_memory(std::uint64_t max_bytes) const;

 private:
  std::string read(std::uint64_t offset, std::size_t size) const;
  std::filesystem::path path_;
  Descriptor file_;
  std::uint64_t size_ = 0;
};

/// Throws Error(kInput): the sentence that a file cannot be read with.
[[noreturn]] void unreadable_picture(const std::filesystem::path& path, std::string_view why);

}  // namespace lobelia

// Finds the pictures of a folder.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/no_resources.hpp"
#include "base/words/text.hpp"
#include "compare/accept/replacement.hpp"
#include "compare/set/pairing.hpp"

namespace lobelia {

/// Endings of renders and photographs, in any case. OpenImageIO reads more, such as .txt and films.
inline constexpr std::string_view kEndings[] = {
    ".avif", ".bmp", ".dpx", ".exr", ".gif", ".hdr",  ".heic", ".iff", ".jp2", ".jpeg",
    ".jpg",  ".pbm", ".pfm", ".pgm", ".png", ".pnm",  ".ppm",  ".psd", ".rgb", ".rgbe",
    ".rla",  ".sgi", ".sxr", ".tga", ".tif", ".tiff", ".tx",   ".webp"};

inline bool has_picture_ending(const std::filesystem::path& file) {
  return std::ranges::count(kEndings, lower_case(file.extension().string())) > 0;
}

/// The pictures of a folder and of those inside it, by their paths from it, sorted. Replaced references are none of them.
class FolderWalk {
 public:
  FolderWalk(std::filesystem::path root, std::size_t most_files)
      : root_(std::move(root)), most_files_(most_files) {
    std::error_code error;
    real_root_ = std::filesystem::canonical(root_, error);
    if (error) fail("cannot be read: " + error.message());
    walk(real_root_, "");
    std::ranges::sort(pictures);
    std::ranges::sort(not_followed);
  }

  std::vector<std::string> pictures;
  std::size_t passed_over = 0;
  std::vector<std::string> not_followed;

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw Error(ExitCode::kInput, "{}: {}", root_.string(), why);
  }

  /// `real` contains no links; `name` is the path from the root, which may.
  void walk(const std::filesystem::path& real, const std::filesystem::path& name) {
    // The link leads back to a folder around it, which is compared without the link.
    if (std::ranges::count(around_, real) > 0) return;
    around_.push_back(real);
    std::error_code error;
    for (std::filesystem::directory_iterator entry(real, error), end; !error && entry != end;
         entry.increment(error)) {
      if (entry->path().filename() == kReplacedName) continue;
      if (++files_ > most_files_)
        fail(fmt::format("holds over {} files, which is what is compared at most", most_files_));
      look_at(*entry, name / entry->path().filename());
    }
    if (error) fail("cannot be read: " + error.message());
    around_.pop_back();
  }

  void look_at(const std::filesystem::directory_entry& entry, const std::filesystem::path& name) {
    std::error_code unknown;
    // An entry that cannot be looked at would be left out without a word.
    const auto require_known = [&] {
      if (unknown && !tells_of_file(unknown.value()))
        throw failure_of((root_ / name).string() + ": cannot be read", unknown.value(),
                         ExitCode::kInput);
    };
    const bool is_link = entry.is_symlink(unknown);
    require_known();
    const bool is_directory = entry.is_directory(unknown);
    require_known();
    if (is_directory) {
      const std::filesystem::path real =
          is_link ? std::filesystem::canonical(entry.path(), unknown) : entry.path();
      if (is_below(real, real_root_))
        walk(real, name);
      else
        not_followed.push_back((root_ / name).generic_string());
    } else if (has_picture_ending(name)) {  // a link to nothing as well: it cannot be read
      pictures.push_back(name.generic_string());
    } else if (is_link && !entry.exists(unknown)) {
      not_followed.push_back((root_ / name).generic_string());
    } else {
      ++passed_over;
    }
  }

  const std::filesystem::path root_;
  const std::size_t most_files_;
  std::filesystem::path real_root_;
  std::vector<std::filesystem::path> around_;  ///< the current folder and those on the way to it
  std::size_t files_ = 0;                      ///< files and folders so far
};

}  // namespace lobelia

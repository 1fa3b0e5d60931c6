#include "compare/set/folder_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/text.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;

/// Endings of renders and photographs, in any case. OpenImageIO reads more, such as .txt and films.
constexpr std::string_view kEndings[] = {
    ".avif", ".bmp", ".dpx", ".exr", ".gif", ".hdr",  ".heic", ".iff", ".jp2", ".jpeg",
    ".jpg",  ".pbm", ".pfm", ".pgm", ".png", ".pnm",  ".ppm",  ".psd", ".rgb", ".rgbe",
    ".rla",  ".sgi", ".sxr", ".tga", ".tif", ".tiff", ".tx",   ".webp"};

bool has_picture_ending(const fs::path& file) {
  return std::ranges::count(kEndings, lower_case(file.extension().string())) > 0;
}

class FolderWalk {
 public:
  FolderWalk(const fs::path& root, std::size_t most_files) : root_(root), most_files_(most_files) {
    std::error_code error;
    real_root_ = fs::canonical(root, error);
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
    throw Error(ExitCode::kInput, fmt::format("{}: {}", root_.string(), why));
  }

  /// `real` contains no links; `name` is the path from the root, which may.
  void walk(const fs::path& real, const fs::path& name) {
    // The link leads back to a folder around it, which is compared without the link.
    if (std::ranges::count(around_, real) > 0) return;
    around_.push_back(real);
    std::error_code error;
    for (fs::directory_iterator entry(real, error), end; !error && entry != end;
         entry.increment(error)) {
      if (++files_ > most_files_)
        fail(fmt::format("holds over {} files, which is what is compared at most", most_files_));
      look_at(*entry, name / entry->path().filename());
    }
    if (error) fail("cannot be read: " + error.message());
    around_.pop_back();
  }

  void look_at(const fs::directory_entry& entry, const fs::path& name) {
    std::error_code unknown;
    const bool is_link = entry.is_symlink(unknown);
    if (entry.is_directory(unknown)) {
      const fs::path real = is_link ? fs::canonical(entry.path(), unknown) : entry.path();
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

  const fs::path& root_;
  const std::size_t most_files_;
  fs::path real_root_;
  std::vector<fs::path> around_;  ///< the current folder and those on the way to it
  std::size_t files_ = 0;         ///< files and folders so far
};

std::vector<std::string> only_in(const std::vector<std::string>& one,
                                 const std::vector<std::string>& other) {
  std::vector<std::string> names;
  std::ranges::set_difference(one, other, std::back_inserter(names));
  return names;
}

}  // namespace

bool is_below(const fs::path& path, const fs::path& folder) {
  return std::ranges::mismatch(folder, path).in1 == folder.end();
}

FolderPairs pair_by_name(const fs::path& a, const fs::path& b, std::size_t most_files) {
  const FolderWalk in_a(a, most_files), in_b(b, most_files);
  FolderPairs pairs;
  std::ranges::set_intersection(in_a.pictures, in_b.pictures, std::back_inserter(pairs.both));
  pairs.missing = only_in(in_b.pictures, in_a.pictures);
  pairs.extra = only_in(in_a.pictures, in_b.pictures);
  pairs.passed_over = in_a.passed_over + in_b.passed_over;
  pairs.not_followed = in_a.not_followed;
  pairs.not_followed.insert(pairs.not_followed.end(), in_b.not_followed.begin(),
                            in_b.not_followed.end());
  return pairs;
}

}  // namespace lobelia

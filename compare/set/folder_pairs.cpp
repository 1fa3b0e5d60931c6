#include "compare/set/folder_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <system_error>

#include "core/error.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;

/// Of the formats that OpenImageIO reads, those that renders and photographs come in. Not all of its endings:
/// it takes .txt and films as well.
constexpr std::string_view kEndings[] = {
    ".avif", ".bmp", ".dpx", ".exr", ".gif", ".hdr",  ".heic", ".iff", ".jp2", ".jpeg",
    ".jpg",  ".pbm", ".pfm", ".pgm", ".png", ".pnm",  ".ppm",  ".psd", ".rgb", ".rgbe",
    ".rla",  ".sgi", ".sxr", ".tga", ".tif", ".tiff", ".tx",   ".webp"};

struct Folder {
  std::vector<std::string> pictures;
  std::size_t passed_over = 0;
};

Folder pictures_in(const fs::path& folder) {
  const auto fail = [&](std::string_view why) {
    throw Error(ExitCode::kInput, fmt::format("{}: {}", folder.string(), why));
  };
  Folder found;
  std::error_code status;
  fs::recursive_directory_iterator entry(folder, status);
  std::size_t files = 0;
  for (; !status && entry != fs::recursive_directory_iterator(); entry.increment(status)) {
    std::error_code unknown;
    if (entry->is_directory(unknown)) continue;
    if (++files > kMaxFolderFiles)
      fail(fmt::format("holds over {} files, which is what is compared at most", kMaxFolderFiles));
    if (has_picture_ending(entry->path()))
      found.pictures.push_back(entry->path().lexically_relative(folder).generic_string());
    else
      ++found.passed_over;
  }
  if (status) fail("cannot be read: " + status.message());
  std::sort(found.pictures.begin(), found.pictures.end());
  return found;
}

std::vector<std::string> only_in(const std::vector<std::string>& one,
                                 const std::vector<std::string>& other) {
  std::vector<std::string> names;
  std::set_difference(one.begin(), one.end(), other.begin(), other.end(),
                      std::back_inserter(names));
  return names;
}

}  // namespace

bool has_picture_ending(const fs::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return std::find(std::begin(kEndings), std::end(kEndings), ending) != std::end(kEndings);
}

FolderPairs pair_by_name(const fs::path& a, const fs::path& b) {
  const Folder in_a = pictures_in(a), in_b = pictures_in(b);
  FolderPairs pairs;
  std::set_intersection(in_a.pictures.begin(), in_a.pictures.end(), in_b.pictures.begin(),
                        in_b.pictures.end(), std::back_inserter(pairs.both));
  pairs.missing = only_in(in_b.pictures, in_a.pictures);
  pairs.extra = only_in(in_a.pictures, in_b.pictures);
  pairs.passed_over = in_a.passed_over + in_b.passed_over;
  return pairs;
}

}  // namespace lobelia

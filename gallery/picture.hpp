// A PNG beside the records: looked at just enough to know that a browser can show it.
#pragma once

#include <filesystem>
#include <string>

namespace lobelia::gallery {

struct SmallPicture {
  std::string file;  ///< empty: there is none
  int width = 0, height = 0;
};

struct Picture {
  std::string file;  ///< a plain name inside the cell's directory; empty: the record names none
  int width = 0, height = 0;
  std::string why_not;       ///< why it cannot be shown, in words; empty if it can
  SmallPicture small = {};   ///< published for a first look where this one is heavy
  bool is_published = true;  ///< false: a page has the small one alone

  bool shown() const { return width > 0 && why_not.empty(); }
  /// What a page shows first.
  SmallPicture first_look() const {
    return small.file.empty() ? SmallPicture{file, width, height} : small;
  }
};

/// Reads the header and the end of `file` in `directory`: a missing, truncated or foreign file
/// becomes words on the page in place of a broken image.
Picture look_at_picture(const std::filesystem::path& directory, const std::string& file);

}  // namespace lobelia::gallery

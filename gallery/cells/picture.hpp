// A PNG beside the records, read just enough to know that a browser can show it.
#pragma once

#include <filesystem>

namespace lobelia::gallery {

struct SmallPicture {
  std::string file;  ///< empty: there is none
  int width = 0, height = 0;
};

struct Picture {
  std::string file;  ///< a plain name inside the cell's directory; empty: the record names none
  int width = 0, height = 0;
  std::string why_not;       ///< why it cannot be shown, as a sentence; empty if it can
  SmallPicture small = {};   ///< published as a preview where this one is heavy
  bool is_published = true;  ///< false: only the small one is published

  bool shown() const { return width > 0 && why_not.empty(); }
  /// The picture that a page shows first.
  SmallPicture preview() const {
    return small.file.empty() ? SmallPicture{file, width, height} : small;
  }
};

/// Reads the header and the end of `file` in `directory`. A missing, truncated or foreign file
/// becomes a sentence on the page in place of a broken image.
Picture inspect_picture(const std::filesystem::path& directory, const std::string& file);

}  // namespace lobelia::gallery

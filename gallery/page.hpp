// What every page has: the head, the foot, and a few things that both kinds of page show.
#pragma once

#include <string>

#include "core/html.hpp"
#include "gallery/status.hpp"

namespace lobelia::gallery {

inline constexpr char kStyleFile[] = "style.css";
inline constexpr char kScriptFile[] = "gallery.js";

struct PageFrame {
  std::string title;
  std::string kind;     ///< class of the body: "index" or "cell"
  std::string root;     ///< from this page to the farm's directory: "" or "../../"
  std::string made_by;  ///< of the records, for the foot
};

/// The whole document around the content of <main>.
std::string finish_page(const PageFrame& frame, const Html& main);

void write_status(Html& html, CellStatus status);
/// A command that a reader may copy.
void write_command(Html& html, const std::string& command);
/// Words in place of something that is not there.
void write_absence(Html& html, const std::string& words);

}  // namespace lobelia::gallery

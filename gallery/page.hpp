// What every page has: the head, the way to the other pages, the foot, and a few things that several show.
#pragma once

#include <string>
#include <vector>

#include "core/html.hpp"
#include "gallery/status.hpp"

namespace lobelia::gallery {

inline constexpr char kStyleFile[] = "gallery.css";
inline constexpr char kScriptFile[] = "gallery.js";

/// What a page may load: files beside it and pictures made by its own script, and nothing from a network.
/// `file:` is for browsers to which two files are two origins; a page from a server cannot use it.
inline constexpr char kContentSecurityPolicy[] =
    "default-src 'none'; script-src 'self' file:; style-src 'self' file:; img-src 'self' data: file:; "
    "base-uri 'none'; form-action 'none'";

/// A page in the site's navigation.
struct PageLink {
  std::string file, title;
};

/// What all pages of a site share.
struct SiteFrame {
  std::string title;
  std::string base_url;  ///< where it will be published, with a slash at its end; empty: unknown
  std::vector<PageLink> pages;  ///< the index first
};

struct PageFrame {
  std::string title;    ///< of this page, without the site's
  std::string view;     ///< a file of gallery/web/src/views; nothing starts where there is none
  std::string root;     ///< from this page to the site's directory: "" or "../../"
  std::string path;     ///< from the site's directory to this page
  std::string made_by;  ///< of the records, for the foot
  std::string data;     ///< file of data_script() beside the page; empty: none
  std::string picture;  ///< from the site's directory, for those who link to the page; may be empty
};

/// The whole document around the content of <main>.
std::string finish_page(const SiteFrame& site, const PageFrame& frame, const Html& main);

/// A classic script that hands JSON to gallery.js under that name: lobelia('page','{...}').
std::string data_script(std::string_view name, std::string_view json);

void write_status(Html& html, CellStatus status);
/// A command that a reader may copy.
void write_command(Html& html, const std::string& command);
/// Words in place of something that is not there.
void write_absence(Html& html, const std::string& words);

}  // namespace lobelia::gallery

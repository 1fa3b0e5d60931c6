// The frame of every page (head, navigation, foot), and a few elements that several pages show.
#pragma once

#include "base/words/html.hpp"
#include "gallery/cells/status.hpp"

namespace lobelia::gallery {

inline constexpr char kStyleFile[] = "gallery.css";
inline constexpr char kScriptFile[] = "gallery.js";

/// A page may load files beside it and pictures made by its own script, and nothing from a network.
/// `file:` is for browsers that give each local file an origin of its own; a page from a server cannot use it.
inline constexpr char kContentSecurityPolicy[] =
    "default-src 'none'; script-src 'self' file:{}; style-src 'self' file:; img-src 'self' data: file:; "
    "base-uri 'none'; form-action 'none'";
/// Among the sources of scripts, for a page that runs WebAssembly from its data.
inline constexpr char kRunsWebAssembly[] = " 'wasm-unsafe-eval'";

/// A page in the site's navigation.
struct PageLink {
  std::string file, title;
};

/// Shared by all pages of a site.
struct SiteFrame {
  std::string title;
  std::string base_url;         ///< public address, with a slash at its end; empty: unknown
  std::vector<PageLink> pages;  ///< the index first
  bool is_packed = false;       ///< all cells are on one page (packed_cells.hpp)
  std::string style = kStyleFile, script = kScriptFile;
};

struct PageFrame {
  std::string title;    ///< of this page, without the site's
  std::string view;     ///< name of its script in gallery/web/src/views, which may not exist
  std::string root;     ///< from this page to the site's directory: "" or "../../"
  std::string path;     ///< from the site's directory to this page
  std::string made_by;  ///< program that wrote the records, for the foot
  std::string data;     ///< file of data_script() beside the page; empty: none
  std::string picture;  ///< preview picture, from the site's directory; may be empty
  bool runs_web_assembly = false;
};

/// The whole document around the content of <main>.
std::string finish_page(const SiteFrame& site, const PageFrame& frame, const Html& main);

/// A classic script that hands JSON to gallery.js under that name: lobelia('page','{...}').
std::string data_script(std::string_view name, std::string_view json);

/// A relative link to the file at these plain names: percent-encoded, joined with '/', so that a
/// name such as "a:b" or "50%#1" is neither a scheme nor a fragment.
std::string link_to(std::initializer_list<std::string_view> parts);

/// From the index to a cell's page.
std::string cell_link(const SiteFrame& site, const std::string& id);

void write_badge(Html& html, std::string_view style, std::string_view mark, std::string_view word);
void write_status(Html& html, const StatusInfo& status);
/// A command to copy.
void write_command(Html& html, const std::string& command);
/// A sentence in place of something that is missing.
void write_absence(Html& html, const std::string& words);
/// A name and its value in a <dl>. Writes nothing if the value is empty.
void write_fact(Html& html, const std::string& name, const std::string& value);
/// A table's <thead> with one heading per column.
void write_columns(Html& html, const std::vector<std::string>& titles);

}  // namespace lobelia::gallery

// The pages of the site beside the grid and the cells. Each is a file NAME_page.cpp and a name in views.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <span>

#include "base/records/record.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/words/html.hpp"
#include "gallery/site/published_texts.hpp"

namespace lobelia::gallery {

/// A page's content; the head, the navigation and the foot come around it.
struct ViewPage {
  std::string title;
  std::string made_by;  ///< program that wrote the record, for the foot
  Html main;            ///< complete without script
  std::string data;     ///< JSON for the page's script (pageData() in gallery/web); empty: none
  std::vector<std::string> files;  ///< that it links to, below the run's directory; copied with it
  std::string finding = {};        ///< the page in a sentence, for the index; may be empty
};

struct View {
  std::string_view name;   ///< also of its script in gallery/web/src/views, if it has one
  std::string_view title;  ///< in the navigation
  std::string_view file;   ///< "cost.html"
  /// Empty if the run has no record for it. A record that cannot be read becomes a sentence on the page.
  std::function<std::optional<ViewPage>(const RunFiles& run)> draw;
};

std::span<const View* const> views();
extern const View explorer_view;  ///< cells link to it

/// A page that says in place of everything why the record cannot be shown.
ViewPage unreadable_page(const char* title, const Error& error);

/// View::draw of the page that `write` fills from the record in RUN/file. If that cannot be read or `write` throws
/// Error(kInput), the page says so.
template <class T>
auto page_of(const char* file, const char* title,
             void (*write)(ViewPage&, const T&, const RunFiles&)) {
  return [=](const RunFiles& run) -> std::optional<ViewPage> {
    if (file_type_at(run / file) == std::filesystem::file_type::not_found) return std::nullopt;
    try {
      records::Origin origin;
      const T record = read_published<T>(run / file, run.texts, file, &origin);
      ViewPage page{title, origin.made_by, {}, "", {file}};
      write(page, record, run);
      return page;
    } catch (const Error& error) {
      if (error.code() != ExitCode::kInput) throw;
      return unreadable_page(title, error);
    }
  };
}

/// <header> with the title and a sentence below it.
void write_lead(Html& html, const char* title, const std::string& words);
/// The command that measured the record, and a link to it.
void write_source(Html& html, const std::string& command, const char* file);
/// Attributes of a <div> in which a wide table scrolls.
Attributes scroll_box(const std::string& label);

}  // namespace lobelia::gallery

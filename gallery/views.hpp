// The pages of the site beside the grid and the cells: each is a file, and a line in views.cpp.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/html.hpp"

namespace lobelia::gallery {

/// A page as its view draws it; the head, the navigation and the foot come around it.
struct ViewPage {
  std::string title;
  std::string made_by;  ///< of its records, for the foot
  Html main;            ///< complete without script
  std::string data;     ///< JSON: what pageData() of gallery/web gives its script; empty: nothing
  std::vector<std::string> files;  ///< that it links to, below the run's directory; copied with it
};

struct View {
  std::string_view
      name;  ///< also of its file in gallery/web/src/views, if a script makes more of it
  std::string_view title;  ///< in the navigation
  std::string_view file;   ///< "cost.html"
  /// Empty if the run has nothing for it. A record that cannot be read is said on the page.
  std::optional<ViewPage> (*draw)(const std::filesystem::path& run);
};

std::span<const View* const> views();

}  // namespace lobelia::gallery

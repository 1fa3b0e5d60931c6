// The report of `lobelia compare --html`: a site with all pairs.
#pragma once

#include "program/command/compare/compare_pictures.hpp"

namespace lobelia::cli {

struct HtmlReport {
  std::filesystem::path
      path;  ///< a directory, or with `single_file` perhaps a file that ends in .html
  bool single_file = false;
  std::string title;  ///< empty: the sets' titles
};

/// Throws Error(kOutput) unless the report can be written there. For before long work starts.
void require_place(const HtmlReport& html);

/// Writes the report, and its path on stderr. Reads the pictures again. Throws Error(kOutput).
void write_html(const HtmlReport& html, const CompareJob& job, const Pairing& pairing,
                const SetReport& report);

}  // namespace lobelia::cli

// The measured claims as a table, as docs/errata.md, as a record and as plots.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/words/svg_chart.hpp"
#include "studies/paper/claim.hpp"

namespace lobelia::paper {

/// One line per claim: verdict, name, printed, measured; then the counts.
std::string table_text(std::span<const Claim> claims);
/// docs/errata.md
std::string errata_document(std::span<const Claim> claims);
/// `command` is what made it.
records::VerifyPaper paper_record(std::vector<Claim> claims, std::vector<std::string> command = {},
                                  std::vector<records::PaperFigure> figures = {});

struct Plot {
  std::string file;  ///< "residuals.svg"
  Chart chart;
  std::vector<std::string_view> claims;  ///< the names of the claims that it shows
};
/// The curves behind the claims, drawn on all processors.
std::vector<Plot> plots();

std::vector<records::PaperFigure> figure_records(std::span<const Plot> plots);

/// Writes the SVG files into `directory`, which is made if it is not there.
void write_plots(const std::filesystem::path& directory, std::span<const Plot> plots);

}  // namespace lobelia::paper

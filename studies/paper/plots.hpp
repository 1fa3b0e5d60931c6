// The curves behind the claims, as SVG files.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/svg_chart.hpp"
#include "records/paper.hpp"

namespace lobelia::paper {

struct Plot {
  std::string file;  ///< "residuals.svg"
  Chart chart;
  std::vector<std::string_view> claims;  ///< that it shows, by their names
};
/// Drawn on all processors.
std::vector<Plot> plots();

/// As the record has them.
std::vector<records::PaperFigure> figure_records(std::span<const Plot> plots);

/// Writes them all into `directory`, which is made if it is not there.
void write_plots(const std::filesystem::path& directory, std::span<const Plot> plots);

}  // namespace lobelia::paper

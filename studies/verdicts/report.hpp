// The measured verdicts as a table, and as curves.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/svg_chart.hpp"
#include "records/verdicts.hpp"

namespace lobelia::verdicts {

/// A line for each cell: false alarms, and how many of each change were found.
std::string report_text(const records::VerifyVerdicts& verdicts);
/// The same table for docs/verdicts.md.
std::string report_markdown(const records::VerifyVerdicts& verdicts);

/// The share that is called different over how much dimmer a picture is: one chart for each kind of noise, a curve for each
/// cell.
std::vector<Chart> charts(const records::VerifyVerdicts& verdicts);

/// Writes verdicts-NOISE.svg into `directory`, which is made if it is not there.
void write_charts(const std::filesystem::path& directory, const records::VerifyVerdicts& verdicts);

}  // namespace lobelia::verdicts

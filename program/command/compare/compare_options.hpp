// The table of a comparison's options on the command line.
#pragma once

#include "compare/set/job.hpp"
#include "program/command/options.hpp"

namespace lobelia::cli {

/// Adds the options of the table under their headings: those of one heading. What one excludes or needs has to be
/// there by then. `choice` has to live as long as `command`.
void add_compare_options(CLI::App& command, CompareChoice& choice, std::string_view heading);

/// The project that counts where no pictures are given: the lobelia.toml of this directory; empty if there is none.
std::string usual_project();

/// A scene's parts, for make_job(). Throws as read_scene().
SceneParts scene_parts(const std::string& file, bool with_edges);

}  // namespace lobelia::cli

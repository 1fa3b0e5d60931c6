// The command line of `lobelia compare`, and what is done with it before and after the comparison.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/common_options.hpp"
#include "cli/compare_html.hpp"
#include "cli/compare_pictures.hpp"
#include "cli/output_files.hpp"
#include "core/colour.hpp"
#include "core/files.hpp"

namespace lobelia::cli {

struct CompareArguments {
  CompareJob job;
  ViewingFlags viewing;
  std::string project;
  std::string json, csv, junit, markdown, tolerance, layer;
  HtmlReport html;
  std::string a, b;
  std::vector<std::string> further;
  std::string junit_undecided = "failure", metrics, format = "text", colour = "auto";
  bool sensitivity = false, no_default_limits = false, accept = false;
  PrintChoice print;
  std::vector<std::string> fail, warn;
  DisplayViewChoice display;
  int threads = 0;
  WorkLimits limits;
};

/// Throws Error(kUsage) unless `text` is METRIC=LIMIT. `where` names it: "--fail".
MetricLimit parse_limit(std::string_view where, const std::string& text);
/// Throws Error(kUsage) unless `text` is RELATIVE,OF_PEAK,OUTLIERS.
Tolerance parse_tolerance(std::string_view where, const std::string& text);

/// Adds what the project says, as far as the command line does not: the project named, or without A the lobelia.toml of
/// this directory. Paths in it are from its own directory. Throws Error(kInput) for a project that cannot be read, and
/// Error(kUsage) for what its values do not allow.
void apply_project(CompareArguments& options);

/// Throws unless the second reference and the pictures of noise can be told which pair they are of.
void check_companions(const CompareJob& job, const Pairing& pairing);
/// Throws Error(kInput) unless there is a pair.
void require_pairs(const SetReport& report);

/// Whether a report goes to stdout in place of the table. Throws Error(kUsage) for two.
bool prints_report(const CompareArguments& options);

/// Throws unless all outputs can be written, are different files, and are not inputs under another path.
void require_outputs(const CompareArguments& options, const Pairing& pairing);

void write_reports(const CompareArguments& options, const SetReport& report, bool one,
                   FilesTogether& files);

/// Throws Error(kUsage) unless somebody sits at a terminal, and none of it is a CI job.
void require_person();

/// Shows what would change, asks, and copies the judged pictures that do not pass over their references, all or none: the
/// bytes that were compared. Leaves alone, and names, what was not compared as a whole. `options.job.hash_files` was set.
/// Whether nothing is left that fails. Throws as replace_files().
bool accept_pictures(const CompareArguments& options, const Pairing& pairing,
                     const SetReport& report);

}  // namespace lobelia::cli

// The command line of `lobelia compare`, and what is done with it before and after the comparison.
#pragma once

#include <string>
#include <vector>

#include "base/system/files.hpp"
#include "program/command/common_options.hpp"
#include "program/command/compare/compare_html.hpp"
#include "program/command/compare/compare_pictures.hpp"
#include "program/command/output_files.hpp"

namespace lobelia::cli {

struct CompareArguments {
  CompareChoice choice;
  CompareJob job;  ///< made of it
  DifferencePicture difference;
  std::string json, csv, junit, markdown;
  HtmlReport html;
  std::string a, b;
  std::vector<std::string> further;
  std::string junit_undecided = "failure", format = "text", colour = "auto";
  bool sensitivity = false, accept = false;
  PrintChoice print;
  WorkLimits limits;
};

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

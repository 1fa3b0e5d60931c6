// The files that `lobelia compare` writes.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "base/system/removal.hpp"
#include "program/command/compare/compare_arguments.hpp"
#include "program/command/output_files.hpp"

namespace lobelia::cli {
namespace {

namespace fs = std::filesystem;

/// Names all files that are read.
void add_inputs(const CompareArguments& options, const Pairing& pairing, OutputFiles& outputs) {
  const CompareJob& job = options.job;
  for (const std::string& file : {job.scene, job.project, job.ocio, job.pictures.csv})
    outputs.reads(file);
  for (const fs::path& file : job.parts.files()) outputs.reads(file);
  for (const PairRule& rule : job.rules)
    for (const auto* shapes : {&rule.mask, &rule.ignored})
      for (const fs::path& file : picture_files(*shapes)) outputs.reads(file);
  for (const PictureRow& row : pairing.rows) {
    for (const std::string& file : row.files) {
      outputs.reads(file);
      for (const std::string& ending : job.pictures.companions)
        if (!file.empty()) outputs.reads(with_ending(file, ending));
    }
    for (const fs::path& file : job.noise.files(pairing.is_by_name ? row.name : ""))
      outputs.reads(file);
    if (!job.c.empty()) outputs.reads(file_of(job.c, pairing.is_by_name ? row.name : ""));
  }
}

/// Throws Error(kUsage) if a folder that is written lies in one that is read: the next run would compare its pictures.
void require_outside(std::string_view option, const fs::path& directory, const CompareJob& job) {
  const fs::path real = real_path(directory, ExitCode::kOutput);
  std::vector<fs::path> folders = job.noise.files("");
  for (const auto* given : {&job.pictures.given, &job.pictures.also_accepted})
    folders.insert(folders.end(), given->begin(), given->end());
  if (!job.c.empty()) folders.emplace_back(job.c);
  for (const fs::path& folder : folders)
    if (!folder.empty() && is_below(real, real_path(folder)))
      throw Error(ExitCode::kUsage,
                  "{} {}: lies in {}, which is read by this command; choose "
                  "a folder outside it",
                  option, directory.string(), folder.string());
}

}  // namespace

void require_outputs(const CompareArguments& options, const Pairing& pairing) {
  const CompareJob& job = options.job;
  std::vector<fs::path> reports, pictures;
  for (const std::string& file : {options.json, options.csv, options.junit, options.markdown})
    if (!file.empty() && file != kStdout) reports.emplace_back(file);
  const bool one = is_one_pair(pairing);
  if (!options.difference.path.empty()) {
    if (one) {
      reports.push_back(options.difference.path);
    } else {
      require_outside("--diff-image", options.difference.path, job);
      for (const PairReport& pair : pairs_of(pairing))
        pictures.push_back(difference_file(options.difference.path, pair.name));
    }
  }
  if (!options.html.path.empty()) {
    require_outside("--html", options.html.path, job);
    require_place(options.html);
  }
  if (reports.empty() && pictures.empty()) return;
  OutputFiles outputs;
  add_inputs(options, pairing, outputs);
  for (const auto* files : {&reports, &pictures})
    for (const fs::path& file : *files) outputs.writes(file);
  for (const fs::path& file : reports) require_writable(file);
  if (!one && !options.difference.path.empty()) make_directories(options.difference.path);
  std::map<fs::path, std::set<std::string>> names;
  for (const fs::path& file : pictures) names[file.parent_path()].insert(file.filename().string());
  for (const auto& [folder, written] : names)
    remove_abandoned_parts(HeldDirectory(folder), written);
}

bool prints_report(const CompareArguments& options) {
  const std::string* reports[] = {&options.json, &options.csv, &options.junit, &options.markdown};
  const auto count =
      std::ranges::count_if(reports, [](const std::string* report) { return *report == kStdout; });
  if (count + (options.format == "github") > 1)
    throw Error(ExitCode::kUsage,
                "only one of --json, --csv, --junit, --markdown and --format github can go to "
                "stdout; give the others a file");
  return count == 1;
}

void write_reports(const CompareArguments& options, const SetReport& report, bool one,
                   FilesTogether& files) {
  const auto of = [](const std::string& file, const auto& text) {
    return std::pair(file, file.empty() ? "" : text());
  };
  const PairReport* const pair = one ? &report.pairs.front() : nullptr;
  const bool unreadable = pair && !pair->comparison;
  write_reports(
      "",
      {of(options.csv, [&] { return set_csv(report); }),
       of(options.junit, [&] { return set_junit(report, options.junit_undecided == "skipped"); }),
       of(options.markdown, [&] { return set_markdown(report); }),
       of(unreadable ? "" : options.json,
          [&] {
            return pair ? record_text(pair_record(*pair)) : record_text(set_record(report));
          })},
      files);
}

}  // namespace lobelia::cli

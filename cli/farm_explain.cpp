#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>

#include "cli/engine_programs.hpp"
#include "cli/farm_upkeep.hpp"
#include "core/text.hpp"
#include "farm/upkeep.hpp"
#include "records/record.hpp"

namespace lobelia::cli {
namespace {

/// A hash by its beginning, as people compare them; anything else whole.
std::string brief(const std::string& value) {
  constexpr std::size_t kHash = 64, kShown = 12;
  const bool is_hash =
      value.size() == kHash && value.find_first_not_of("0123456789abcdef") == std::string::npos;
  return is_hash ? value.substr(0, kShown) + "..." : printable(value, 400);
}

void print_part(const records::ExplainedPart& part) {
  if (part.same)
    fmt::print("  {}: {}\n", part.part, brief(part.was));
  else
    fmt::print("  {}: CHANGED: {}, was {}\n", part.part, brief(part.now), brief(part.was));
  for (const auto& file : part.files) fmt::print("    {}\n", printable(file, 400));
}

void print_job(const records::ExplainedJob& job) {
  fmt::print("{}: {}\n", printable(job.job),
             job.in_cache ? "in the cache" : "not in the cache: " + printable(job.why, 400));
  fmt::print("  key: {}\n", brief(job.key));
  for (const auto& part : job.parts) print_part(part);
}

bool is_unchanged(const records::ExplainedJob& job) {
  return job.in_cache && std::ranges::all_of(job.parts, &records::ExplainedPart::same);
}

}  // namespace

void add_farm_explain(CLI::App& farm, ExitCode& exit_code) {
  struct Options {
    std::string directory, cell, job;
    EnginePrograms programs;
    bool json = false;
  };
  auto* command = farm.add_subcommand(
      "explain", "What the key of each result of a cell was made of, and what has changed since");
  auto options = std::make_shared<Options>();
  command->add_option("DIR", options->directory, "The farm's directory")->required();
  command->add_option("CELL", options->cell, "The cell's id, as in DIR/cells")->required();
  command->add_option("JOB", options->job, "One of its jobs: render, reference-povray, profile...");
  options->programs.add_to(*command);
  command->add_flag("--json", options->json, "As a record (kind farm-explanation, docs/reference)");
  command->footer(
      "Hashes are shown by their beginning; --json has all of them. Exit codes: 0 all results are in the\n"
      "cache, and nothing has changed on this machine, 1 something has, 3 no such farm, cell or job.\n\n"
      "Example: lobelia farm explain out/gallery phong_rdf-n16 reference-povray");
  command->callback([options, &exit_code] {
    const records::FarmExplanation explanation =
        explain_cell(options->directory, options->cell, options->job, options->programs.given());
    if (options->json) {
      fmt::print("{}", record_text(explanation));
    } else {
      for (const auto& job : explanation.jobs) print_job(job);
      for (const auto& text : explanation.without)
        fmt::print("no result: {}\n", printable(text, 2000));
    }
    if (!std::ranges::all_of(explanation.jobs, is_unchanged)) exit_code = ExitCode::kDiffers;
  });
}

}  // namespace lobelia::cli

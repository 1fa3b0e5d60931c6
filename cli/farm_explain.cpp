#include "cli/farm_explain.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/engine_programs.hpp"
#include "core/text.hpp"
#include "farm/explain.hpp"

namespace lobelia::cli {
namespace {

/// A hash by its beginning, as people compare them; anything else whole.
std::string brief(const std::string& value) {
  constexpr std::size_t kHash = 64, kShown = 12;
  const bool is_hash =
      value.size() == kHash && value.find_first_not_of("0123456789abcdef") == std::string::npos;
  return is_hash ? value.substr(0, kShown) + "..." : printable(value, 400);
}

void print_part(const Json& part) {
  const std::string was = part.at("was"), now = part.at("now");
  const std::string name = part.at("part");
  if (part.at("same"))
    fmt::print("  {}: {}\n", name, brief(was));
  else
    fmt::print("  {}: CHANGED: {}, was {}\n", name, brief(now), brief(was));
  for (const auto& file : part.value("files", Json::array()))
    fmt::print("    {}\n", printable(file.get<std::string>(), 400));
}

/// Whether all is as it was.
bool print_job(const Json& job) {
  bool same = job.at("inCache");
  fmt::print("{}: {}\n", printable(job.at("job").get<std::string>()),
             same ? "in the cache"
                  : "not in the cache: " + printable(job.at("why").get<std::string>(), 400));
  fmt::print("  key: {}\n", brief(job.at("key")));
  for (const auto& part : job.at("parts")) {
    print_part(part);
    same = same && part.at("same");
  }
  return same;
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
  command->add_flag("--json", options->json,
                    "As a record (kind farm-explanation, docs/records.md)");
  command->footer(
      "Hashes are shown by their beginning; --json has all of them. Exit codes: 0 all results are in the\n"
      "cache, and nothing has changed on this machine, 1 something has, 3 no such farm, cell or job.\n\n"
      "Example: lobelia farm explain out/gallery phong_rdf-n16 reference-povray");
  command->callback([options, &exit_code] {
    const Json explanation =
        explain_cell(options->directory, options->cell, options->job, options->programs.given());
    bool same = true;
    if (options->json) fmt::print("{}", record_text(explanation));
    for (const auto& job : explanation.at("jobs")) {
      if (!options->json) {
        same = print_job(job) && same;
        continue;
      }
      same = same && job.at("inCache");
      for (const auto& part : job.at("parts")) same = same && part.at("same");
    }
    if (!options->json)
      for (const auto& text : explanation.at("without"))
        fmt::print("no result: {}\n", printable(text.get<std::string>(), 2000));
    if (!same) exit_code = ExitCode::kDiffers;
  });
}

}  // namespace lobelia::cli

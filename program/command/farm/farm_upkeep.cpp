#include <algorithm>

#include "base/records/record.hpp"
#include "base/words/numbers.hpp"
#include "farm/upkeep.hpp"
#include "program/command/common_options.hpp"
#include "program/command/farm/farm.hpp"
#include "program/command/gallery/publish.hpp"
#include "program/command/messages.hpp"
#include "program/command/options.hpp"
#include "program/command/output_files.hpp"

namespace lobelia::cli {
namespace {

struct UpkeepArguments {
  std::string directory, cell, job, max_size, json;
  EnginePrograms programs;
  bool attach = false, allow_commands = false, remove = false, all = false, dry_run = false;
};

struct Upkeep {
  CLI::App* command;
  std::shared_ptr<UpkeepArguments> options;
};

/// Adds a subcommand of `farm` with its required DIR.
Upkeep add_upkeep(CLI::App& farm, const std::string& name, const std::string& meaning,
                  const std::string& directory_meaning = "The farm's directory") {
  const Upkeep upkeep{farm.add_subcommand(name, meaning), std::make_shared<UpkeepArguments>()};
  upkeep.command->add_option("DIR", upkeep.options->directory, directory_meaning)->required();
  return upkeep;
}

void tell_of_lost_cache(const std::string& cache) {
  fmt::print("its cache {} is not there; the farm's command makes it again\n",
             printable_path(cache));
}

/// A dry run prints each path.
RemovalOptions removal_options(bool dry_run) {
  RemovalOptions options;
  options.dry_run = dry_run;
  if (dry_run)
    options.on_removed = [](const std::filesystem::path& path) {
      fmt::print("{}\n", printable_path(path.string()));
    };
  return options;
}

void tell_what_stays(const std::vector<std::string>& stays) {
  for (const auto& sentence : stays) say("lobelia: stays: {}\n", printable_path(sentence));
}

/// A line about the run on a cluster; empty if there is none.
std::string cluster_text(const std::string& directory) {
  const SlurmStatus status = slurm_status(slurm_run_directory(directory));
  if (!status.foreign.empty()) say("lobelia: {}\n", status.foreign);
  if (!status.problem.empty()) return fmt::format("Slurm: {}\n", status.problem);
  if (status.living.empty()) return "";
  return fmt::format(
      "Slurm, round {}: {} elements pending, {} running{}; 'lobelia farm status --attach {}' follows it\n",
      status.round, status.elements.pending, status.elements.running,
      status.elements.reason.empty() ? "" : " (" + status.elements.reason + ")", directory);
}

void add_farm_status(CLI::App& farm, ExitCode& exit_code) {
  const auto [command, options] =
      add_upkeep(farm, "status", "What has become of a farm's cells so far");
  OptionGroup group(*command);
  add_json(group, options->json, "farm-status");
  auto* attach = command->add_flag("--attach", options->attach,
                                   "Go back to a run on a cluster and follow it to its end");
  command
      ->add_flag("--allow-commands", options->allow_commands,
                 "With --attach: start the programs that the run names, and write into its "
                 "cache and its gallery wherever they are")
      ->needs(attach);
  command->callback([options = options, &exit_code] {
    if (options->attach) {
      SlurmRunOptions slurm = SlurmSettings().run_options();
      const auto followed = follow(slurm, [&](const SlurmRunOptions& with_progress) {
        return attach_to_slurm_run(options->directory, with_progress,
                                   leave_of_user(options->allow_commands));
      });
      exit_code = publish_if_wanted(options->directory, followed.gallery);
    }
    OutputFiles().writes_report(options->json);
    const records::FarmStatus status = farm_status(options->directory);
    write_reports("", {{options->json, record_text(status)}});
    if (options->json == kStdout) return;
    std::string text;
    for (const auto& failure : status.failures)
      text += fmt::format("failed: {}: {}: {} ({} attempts): {}\n", printable(failure.cell),
                          failure.engine, failure.failure, failure.attempts,
                          printable(failure.message, 400));
    std::vector<std::string> counts;
    const records::StatusCounts& of = status.status;
    for (const auto& [name, count] : {std::pair("failed", of.failed),
                                      {"differs", of.differs},
                                      {"undecided", of.undecided},
                                      {"missing", of.missing},
                                      {"unchecked", of.unchecked},
                                      {"pass", of.pass}})
      if (count > 0) counts.push_back(fmt::format("{} {}", count, name));
    text += fmt::format("{} cells: {}{}\n", status.cells, fmt::join(counts, ", "),
                        status.at_work ? "; a farm is at work in its cache" : "");
    fmt::print("{}", with_colours(text));
    if (!status.cache_is_there) tell_of_lost_cache(status.cache);
    fmt::print("{}", cluster_text(options->directory));
  });
}

void add_farm_verify(CLI::App& farm, ExitCode& exit_code) {
  const auto [command, options] =
      add_upkeep(farm, "verify", "Read every byte of a cache again, and open every picture",
                 "A farm's directory, or a cache");
  command->add_flag("--remove", options->remove,
                    "Take away what is damaged; the next farm makes it again");
  command->footer(
      "Of a farm's directory also the files under cells/, by the hashes in the cells' records, and whether the\n"
      "cache has every result that they name.\n\n"
      "Exit codes: 0 all is whole, or what was damaged has been taken away; 1 something is damaged or missing,\n"
      "3 no farm and no cache, 4 with --remove while a farm is at work.");
  command->callback([options = options, &exit_code] {
    ProgressLine line;
    const auto show = [&](std::size_t done, std::size_t all) {
      line.show(double(done) / double(all), fmt::format("{}/{}", done, all));
    };
    const CachePlace place = cache_of(options->directory);
    const VerifyReport report = place.of_farm
                                    ? verify_farm(options->directory, options->remove, show)
                                    : verify_cache(place.cache, options->remove, show);
    line.clear();
    for (const auto& text : report.damaged) fmt::print("damaged: {}\n", printable_path(text));
    if (!place.is_there) tell_of_lost_cache(place.cache.string());
    std::vector<std::string> found;
    if (!report.damaged.empty())
      found.push_back(fmt::format("{} damaged{}", report.damaged.size(),
                                  options->remove ? ", taken away" : ""));
    if (report.missing > 0) found.push_back(fmt::format("{} missing", report.missing));
    if (found.empty()) found.push_back("all whole");
    fmt::print("{} results, {} files, {}: {}\n", report.results, report.files,
               size_text(report.bytes), fmt::join(found, "; "));
    if (report.missing > 0 || (!report.damaged.empty() && !options->remove))
      exit_code = ExitCode::kDiffers;
  });
}

void add_farm_gc(CLI::App& farm) {
  const auto [command, options] =
      add_upkeep(farm, "gc", "Make a cache smaller", "A farm's directory, or a cache");
  command->add_option(
      "--max-size", options->max_size,
      "What was not used for longest goes until the rest is at most this: 10G, 500M");
  command->add_flag("--dry-run", options->dry_run, "Only list what would go, path by path");
  command->footer(
      "Without a size only what killed farms left half-made goes. Results that a farm's directory shows\n"
      "stay on the disk as long as they lie there too (they are links).");
  command->callback([options = options] {
    std::optional<std::uint64_t> most;
    if (!options->max_size.empty()) most = parse_size(options->max_size);
    const CachePlace place = cache_of(options->directory);
    if (!place.is_there) {
      tell_of_lost_cache(place.cache.string());
      return;
    }
    const GcReport report = collect_garbage(place.cache, most, removal_options(options->dry_run));
    tell_what_stays(report.stays);
    fmt::print("{} results {}removed ({}), {} kept ({}), {} half-made ones taken away{}\n",
               report.removed, options->dry_run ? "would be " : "", size_text(report.removed_bytes),
               report.kept, size_text(report.kept_bytes), report.abandoned,
               report.others > 0
                   ? fmt::format("; {} drafts of other machines stay in making/", report.others)
                   : "");
  });
}

void add_farm_clean(CLI::App& farm) {
  const auto [command, options] =
      add_upkeep(farm, "clean", "Take away cells that are not of a farm's grid any more");
  command->add_flag("--all", options->all,
                    "Every cell, what failed jobs left, and the farm's record; the cache stays");
  command->add_flag("--dry-run", options->dry_run, "Only list what would go, path by path");
  command->footer(
      "What neither a farm nor its gallery wrote stays, and is told. Exit codes: 0, 3 no farm's directory,\n"
      "4 a farm is at work there.");
  command->callback([options = options] {
    const CleanReport report =
        clean_farm(options->directory, options->all, removal_options(options->dry_run));
    tell_what_stays(report.stays);
    fmt::print("{} cells {}taken away ({} files)\n", report.cells,
               options->dry_run ? "would be " : "", report.files);
  });
}

/// The beginning of a hash; any other text whole.
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

void add_farm_explain(CLI::App& farm, ExitCode& exit_code) {
  const auto [command, options] =
      add_upkeep(farm, "explain",
                 "What the key of each result of a cell was made of, and what has changed since");
  command->add_option("CELL", options->cell, "The cell's id, as in DIR/cells")->required();
  command->add_option("JOB", options->job, "One of its jobs: render, reference-povray, profile...");
  options->programs.add_to(*command);
  OptionGroup group(*command);
  add_json(group, options->json, "farm-explanation");
  command->footer(
      "Hashes are shown by their beginning; --json has all of them. Exit codes: 0 all results are in the\n"
      "cache, and nothing has changed on this machine, 1 something has, 3 no such farm, cell or job.\n\n"
      "Example: lobelia farm explain out/gallery phong_rdf-n16 reference-povray");
  command->callback([options = options, &exit_code] {
    OutputFiles().writes_report(options->json);
    const records::FarmExplanation explanation =
        explain_cell(options->directory, options->cell, options->job, options->programs.given());
    write_reports("", {{options->json, record_text(explanation)}});
    if (options->json != kStdout) {
      for (const auto& job : explanation.jobs) print_job(job);
      for (const auto& text : explanation.without)
        fmt::print("no result: {}\n", printable(text, 2000));
    }
    if (!std::ranges::all_of(explanation.jobs, is_unchanged)) exit_code = ExitCode::kDiffers;
  });
}

}  // namespace

void add_farm_upkeep(CLI::App& farm, ExitCode& exit_code) {
  add_farm_status(farm, exit_code);
  add_farm_verify(farm, exit_code);
  add_farm_gc(farm);
  add_farm_clean(farm);
  add_farm_explain(farm, exit_code);
}

}  // namespace lobelia::cli

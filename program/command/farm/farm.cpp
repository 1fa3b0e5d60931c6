#include "program/command/farm/farm.hpp"

#include "base/system/interrupt.hpp"
#include "farm/failed_jobs.hpp"
#include "farm/upkeep.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/gallery/publish.hpp"
#include "program/command/messages.hpp"
#include "program/command/options.hpp"

namespace lobelia::cli {
namespace {

struct FarmArguments {
  std::string grid, directory, filter, memory = "4G", disk = "4G";
  EnginePrograms programs;
  SlurmSettings slurm;
  FarmOptions farm;
  double time_limit = 600, no_progress_limit = 300;
  bool memory_given = false, dry_run = false, allow_commands = false;
};

FarmOptions farm_options(const FarmArguments& options) {
  FarmOptions farm = options.farm;
  farm.programs = options.programs.given();
  farm.time_limit = std::chrono::duration<double>(options.time_limit);
  farm.no_progress_limit = std::chrono::duration<double>(options.no_progress_limit);
  farm.memory = parse_size(options.memory);
  farm.disk = parse_size(options.disk);
  farm.failed_directory = std::filesystem::absolute(options.directory) / FailedJobs::kName;
  farm.filter = JobFilter(options.filter);
  farm.leave = leave_of_user(options.allow_commands);
  farm.command = command_line();
  return farm;
}

void dry_run(const Grid& grid, const FarmArguments& options) {
  const FarmPlan plan = plan_farm(grid, options.directory, farm_options(options),
                                  [](const std::string& name, const std::string& reason) {
                                    fmt::print("{}: {}\n", name, reason);
                                  });
  for (const auto& sentence : plan.absent_engines) say("lobelia: {}\n", sentence);
  if (!plan.warning.empty()) warn(plan.warning);
  fmt::print("{} cells, {} jobs: {} to be done, {} not\n", plan.cells, plan.jobs, plan.wanted,
             plan.jobs - plan.wanted);
}

/// The share of the machine that was used, and the farm's own cost.
std::string work_text(const FarmSummary& summary) {
  const JobRunWork& work = summary.work;
  std::string text;
  if (work.wall_seconds > 0 && work.made > 0)
    text += fmt::format(
        "cores: {:.0f} % of {} x {:.1f} s went to engines and kernels; own cost {:.2f} ms for each result\n",
        100 * work.busy(), work.processors, work.wall_seconds,
        1000 * work.own_cpu_seconds / double(work.made));
  if (summary.cached_cells > 0)
    text += fmt::format("cache: {} cells were there, {:.3f} ms each\n", summary.cached_cells,
                        1000 * summary.cached_seconds / double(summary.cells));
  return text;
}

void print_summary(const FarmSummary& summary, const FarmArguments& options) {
  for (const auto& problem : summary.problems) say("lobelia: {}\n", printable(problem, 2000));
  for (const auto* sentences : {&summary.absent_engines, &summary.refusals})
    for (const auto& sentence : *sentences) say("lobelia: {}\n", sentence);
  if (summary.foreign > 0)
    say("lobelia: {}/cells also holds {} cells that are not of this grid\n",
        printable_path(options.directory), summary.foreign);
  if (summary.work.different > 0)
    say("lobelia: {} results that another farm made first have other pixels than ours; theirs stay\n",
        summary.work.different);
  for (const auto& warning : summary.warnings) warn(warning);
  const auto some = [](std::size_t count, const char* what) {
    return count > 0 ? fmt::format(", {} {}", count, what) : "";
  };
  fmt::print("{}",
             with_colours(fmt::format(
                 "{} cells: {} failed, {} differ, {} pass{}{}{}; {} pictures rendered, {} kept\n",
                 summary.cells, summary.failed, summary.differs, summary.pass,
                 some(summary.undecided, "undecided"), some(summary.unchecked, "not compared"),
                 some(summary.missing, "not done"), summary.rendered, summary.kept)));
  if (!verbosity().quiet) fmt::print("{}", work_text(summary));
}

/// Prints the summary, publishes the gallery if it is wanted, and returns the exit code of both.
ExitCode report(const FarmSummary& summary, const FarmArguments& options) {
  print_summary(summary, options);
  const ExitCode gallery = publish_if_wanted(options.directory, options.farm.gallery);
  if (summary.failed > 0) return ExitCode::kOutput;
  return summary.differs + summary.undecided > 0 ? ExitCode::kDiffers : gallery;
}

ExitCode run_on_cluster(const Grid& grid, const FarmArguments& options) {
  SlurmRunOptions run_options = options.slurm.run_options();
  if (options.memory_given)
    run_options.slurm.memory =
        memory_of_element(parse_size(options.memory), run_options.slurm.processors);
  const SlurmFarmSummary summary = follow(run_options, [&](const SlurmRunOptions& slurm) {
    return run_farm_on_slurm(grid, options.grid, options.directory, farm_options(options), slurm);
  });
  if (summary.slurm.detached) {
    for (const auto& warning : summary.farm.warnings) warn(warning);
    fmt::print("submitted; 'lobelia farm status {}' looks at it\n",
               printable_path(options.directory));
    return ExitCode::kSuccess;
  }
  const ExitCode code = report(summary.farm, options);
  if (code != ExitCode::kOutput && !summary.slurm.missing.empty()) {
    say("lobelia: {} jobs have no result after {} rounds; the same command tries again\n",
        summary.slurm.missing.size(), summary.slurm.rounds);
    return ExitCode::kOutput;
  }
  return code;
}

ExitCode run_farm_command(const FarmArguments& options) {
  const Grid grid = read_grid(options.grid);
  if (options.dry_run) {
    dry_run(grid, options);
    return ExitCode::kSuccess;
  }
  if (options.slurm.is_wanted()) return run_on_cluster(grid, options);
  ProgressLine line;
  FarmOptions farm = farm_options(options);
  farm.on_progress = [&](const FarmProgress& progress) {
    if (progress.total > 0)
      line.show(double(progress.done) / double(progress.total), progress.running);
  };
  FarmSummary summary;
  try {
    summary = run_farm(grid, options.directory, farm);
  } catch (const Error& error) {
    line.clear();
    if (error.code() != ExitCode::kInterrupted) throw;
    throw Error(error.code(),
                "interrupted; what is done is kept, and the same command goes on from there");
  }
  line.clear();
  return report(summary, options);
}

}  // namespace

Leave leave_of_user(bool given) {
  static bool warned = false;
  if (const std::string doubts = given || warned ? "" : doubts_of_trusted_folders();
      !doubts.empty()) {
    warned = true;
    warn(doubts);
  }
  return Leave::of_user(given);
}

void add_farm(CLI::App& app, ExitCode& exit_code) {
  auto* command = app.add_subcommand(
      "farm", "Render every cell of a grid and its references, and compare them");
  auto options = std::make_shared<FarmArguments>();
  FarmOptions& farm = options->farm;
  OptionGroup group(*command);
  group.add("GRID", options->grid, "", "Grid file (docs/grid_format.md)");
  add_common(group, "--output", options->directory, ": pictures and records", "DIR");
  group.add("--cache", farm.cache, "DIR",
            "Where results are kept, for any number of grids; $LOBELIA_CACHE, else DIR/cache");
  group.add_flag("--dry-run", options->dry_run, "Only list the jobs and why each is to be done");
  group.add("--filter", options->filter, "PATTERNS",
            "Only jobs of these names: 'phong*:-*blender' is those that begin with phong and do "
            "not end in blender");
  add_common(group, "--threads", farm.threads)->check(between(0, 1024))->capture_default_str();
  add_common(group, "--time-limit", options->time_limit, ": a picture has failed then")
      ->check(between(0.1, 1e6))
      ->capture_default_str();
  group.add_number("--no-progress-limit", options->no_progress_limit, 0, 1e6,
                   "Seconds in which an engine may say and write nothing; 0 is any");
  group.add_number("--attempts", farm.attempts, 1, 100,
                   "Tries for a picture whose failure may be temporary");
  auto* memory = group.add(
      "--memory", options->memory, "SIZE",
      "What a job's processes may use together: 4G; 0 is any. On a cluster an element asks for it for "
      "each of its threads, and 512M");
  memory->capture_default_str();
  group.add("--disk", options->disk, "SIZE", "What an engine may write for a picture; 0 is any")
      ->capture_default_str();
  group.add_number(
      "--give-up-after", farm.give_up_after, 0, 1000000,
      "Pictures in a row that an engine fails at before it is not tried any more; 0 is any number");
  auto* fail_fast = group.add_flag("--fail-fast", farm.fail_fast, "Stop at the first failure");
  command
      ->add_flag_callback(
          "--keep-going", [] {}, "A failure stops nothing else (as without it)")
      ->excludes(fail_fast);
  group.add("--gallery", farm.gallery, "SITE",
            "Then publish its gallery there (DIR itself, or another directory)");
  group.add_flag("--again", farm.again, "Make everything again, in the cache or not");
  group.add_flag("--require-engines", farm.require_engines,
                 "An engine that is not installed is an error");
  group.add_flag(
      "--allow-commands", options->allow_commands,
      "Start the programs that the grid names, and read its pictures wherever they are "
      "(docs/own_engine.md); without it only if the grid and its engine files lie in folders "
      "that $LOBELIA_ALLOW_COMMANDS_IN names");
  options->programs.add_to(*command);
  options->slurm.add_to(*command);
  add_farm_upkeep(*command, exit_code);
  add_farm_slurm(*command, exit_code);
  command->footer(
      "What the cache has is not made again, whichever grid it was made for. Ctrl-C leaves nothing\n"
      "half-written, and the same command goes on from there. Of an engine that is not installed\n"
      "nothing new is made, as the records say; what it made before stays. docs/farm.md tells the rest.\n\n"
      "Exit codes: 0 every cell agrees, 1 some differ, or with --gallery are not what the farm\n"
      "wrote, 3 bad grid, 4 some job failed or nothing can be written, 5 an engine is broken (a program\n"
      "given by its path is not that engine, too), or absent with --require-engines, 130 Ctrl-C, 143 SIGTERM.\n\n"
      "Example: lobelia farm reference_scenes/grids/sphere_grid.xml -o out/gallery\n"
      "         lobelia gallery out/gallery");
  // On Ctrl-C a farm stops its engines and writes its records; on a cluster it asks whether to cancel the jobs.
  command->preparse_callback([](std::size_t) { end_by_ourselves_when_interrupted(); });
  command->callback([command, memory, options, &exit_code] {
    options->memory_given = memory->count() > 0;
    if (!command->get_subcommands().empty()) return;
    if (options->grid.empty()) throw CLI::RequiredError("GRID");
    if (options->directory.empty()) throw CLI::RequiredError("--output");
    exit_code = run_farm_command(*options);
  });
}

}  // namespace lobelia::cli

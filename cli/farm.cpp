#include "farm/farm.hpp"

#include <fmt/format.h>

#include <memory>

#include "cli/between.hpp"
#include "cli/commands.hpp"
#include "cli/engine_programs.hpp"
#include "cli/progress.hpp"
#include "cli/warnings.hpp"

namespace lobelia::cli {
namespace {

struct Options {
  std::string grid, directory;
  EnginePrograms programs;
  int threads = 0;
  double time_limit = 600;
  bool again = false, quiet = false;
};

ExitCode run(const Options& options) {
  const Grid grid = read_grid(options.grid);
  ProgressLine line(!options.quiet);
  FarmOptions farm_options;
  farm_options.programs = options.programs.given();
  farm_options.threads = options.threads;
  farm_options.time_limit = std::chrono::duration<double>(options.time_limit);
  farm_options.again = options.again;
  farm_options.command = command_line();
  farm_options.on_progress = [&](const FarmProgress& progress) {
    if (progress.total > 0)
      line.show(double(progress.done) / double(progress.total), progress.running);
  };
  FarmSummary summary;
  try {
    summary = run_farm(grid, options.directory, farm_options);
  } catch (const Error& error) {
    line.clear();
    if (error.code() != ExitCode::kInterrupted) throw;
    throw Error(error.code(),
                "interrupted; what is done is kept, and the same command goes on from there");
  }
  line.clear();

  for (const auto& sentence : summary.absent_engines) fmt::print(stderr, "lobelia: {}\n", sentence);
  if (summary.foreign > 0)
    fmt::print(stderr, "lobelia: {}/cells also holds {} cells that are not of this grid\n",
               options.directory, summary.foreign);
  for (const auto& warning : summary.warnings) warn(warning);
  for (const auto& problem : summary.problems) fmt::print(stderr, "lobelia: {}\n", problem);
  fmt::print("{} cells: {} pass, {} differ, {} failed{}{}; {} pictures rendered, {} kept\n",
             summary.cells, summary.pass, summary.differs, summary.failed,
             summary.undecided > 0 ? fmt::format(", {} undecided", summary.undecided) : "",
             summary.unchecked > 0 ? fmt::format(", {} not compared", summary.unchecked) : "",
             summary.rendered, summary.kept);
  if (summary.failed > 0) return ExitCode::kEngine;
  return summary.differs + summary.undecided > 0 ? ExitCode::kDiffers : ExitCode::kSuccess;
}

}  // namespace

void add_farm(CLI::App& app, ExitCode& exit_code) {
  auto* command = app.add_subcommand("farm", "Render, reference and compare every cell of a grid");
  auto options = std::make_shared<Options>();
  command->add_option("GRID", options->grid, "Grid file (docs/grid_format.md)")->required();
  command->add_option("-o,--output", options->directory, "Directory for pictures and records")
      ->required()
      ->type_name("DIR");
  command->add_option("--threads", options->threads, "Threads; 0 is all processors")
      ->check(between(0, 1024))
      ->capture_default_str();
  command
      ->add_option("--time-limit", options->time_limit, "Seconds an engine may take for a picture")
      ->check(between(0.1, 1e6))
      ->capture_default_str();
  command->add_flag("--again", options->again, "Make everything again, current or not");
  command->add_flag("-q,--quiet", options->quiet, "No progress");
  options->programs.add_to(*command);
  command->footer(
      "What is there and current is kept: a second run does only what is missing. Ctrl-C leaves\n"
      "nothing half-written. An engine that is not installed is left out, as the records say.\n\n"
      "Exit codes: 0 every cell agrees, 1 some differ, 3 bad grid, 4 cannot write, 5 some cell\n"
      "could not be rendered, 130 interrupted.\n\n"
      "Example: lobelia farm reference_scenes/grids/sphere_grid.xml -o out/gallery\n"
      "         lobelia gallery out/gallery");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace lobelia::cli

#include <algorithm>

#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "cli/messages.hpp"
#include "cli/options.hpp"
#include "cli/output_files.hpp"
#include "core/files.hpp"
#include "core/host.hpp"
#include "records/record.hpp"
#include "renderer/kernels/kernels.hpp"
#include "renderer/scene/scene_io.hpp"
#include "studies/cost/benchmarks.hpp"
#include "studies/cost/table.hpp"

namespace lobelia::cli {
namespace {

struct CostArguments {
  std::vector<std::string> scenes, levels;
  std::string directory, json;
  EnginePrograms programs;
  bool all = false, quick = false, thorough = false;
  WorkLimits limits;
};

/// The levels named by --level, or all that have something to measure.
std::vector<const cost::Benchmark*> chosen_levels(const CostArguments& options) {
  std::vector<const cost::Benchmark*> chosen;
  for (const cost::Benchmark& level : cost::benchmarks()) {
    const bool named = std::ranges::count(options.levels, level.name) > 0;
    const bool lacks_scene = level.needs_scenes && options.scenes.empty();
    if (named && lacks_scene)
      throw Error(ExitCode::kUsage, fmt::format("--level {} needs a SCENE", level.name));
    if (named || (options.levels.empty() && !lacks_scene)) chosen.push_back(&level);
  }
  return chosen;
}

void run_cost(const CostArguments& options) {
  const auto levels = chosen_levels(options);
  cost::Options measured;
  for (const std::string& file : options.scenes)
    measured.scenes.push_back({std::filesystem::path(file).stem().string(), read_scene(file)});
  measured.effort = options.quick      ? cost::Effort::kQuick
                    : options.thorough ? cost::Effort::kThorough
                                       : cost::Effort::kUsual;
  for (const auto& [engine, program] : options.programs.given())
    measured.programs.emplace_back(engine, program.string());
  OutputFiles outputs;
  for (const std::string& file : options.scenes) outputs.reads(file);
  outputs.writes_report(options.json);
  if (!options.directory.empty()) {
    make_directories(options.directory);
    require_writable(std::filesystem::path(options.directory) / "cost.json");
  }
  ProgressLine line;
  records::Cost report{command_line(), records::this_host(), kernels().instruction_set, {}};
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double done = double(i) / double(levels.size());
    measured.on_progress = [&](const std::string& what) {
      line.show(done, fmt::format("{}: {}", levels[i]->name, what));
    };
    measured.progress("begins");
    for (cost::Table& table : levels[i]->measure(measured)) {
      cost::add_fronts(table);
      report.tables.push_back(std::move(table));
    }
  }
  line.clear();
  FilesTogether files;
  if (!options.directory.empty()) cost::write_cost(report, options.directory);
  write_reports(cost::cost_text(report, options.all), {{options.json, record_text(report)}}, files);
}

std::string level_lines() {
  std::string text;
  for (const cost::Benchmark& level : cost::benchmarks())
    text += fmt::format("  {:<14}{}{}\n", level.name, level.meaning,
                        level.needs_scenes ? " (of each SCENE)" : "");
  return text;
}

}  // namespace

void add_cost(CLI::App& app, ExitCode&) {
  auto* command = app.add_subcommand(
      "cost", "Measure what accuracy costs in time: error and time of every variant, in one run");
  auto options = std::make_shared<CostArguments>();
  command->add_option("SCENE", options->scenes, "Scene files, for the levels that need some");
  std::vector<std::string> names;
  for (const cost::Benchmark& level : cost::benchmarks()) names.emplace_back(level.name);
  command->add_option("--level", options->levels, "Measure this level alone; may be given again")
      ->check([](const std::string& level) {
        return level == "fixed-point"
                   ? "is gone; lobelia search --precision fixed:BITS has lobes in fixed point"
                   : std::string();
      })
      ->check(CLI::IsMember(names))
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);  // what comes after it may be a SCENE
  auto* quick = command->add_flag("--quick", options->quick, "A look: fewer rounds, smaller grids");
  command->add_flag("--thorough", options->thorough, "More rounds and samples: up to an hour")
      ->excludes(quick);
  options->programs.add_to(*command);
  OptionGroup output(*command, "Output");
  add_common(output, "--output", options->directory,
             ": cost.json, cost.csv and a chart (.svg) of each table's front", "DIR");
  add_json(output, options->json, "cost");
  output.add_flag("--all", options->all, "Print the variants that others dominate as well");
  options->limits.add_to(output);
  command->footer(
      "Levels:\n" + level_lines() +
      "\nTimes are medians of interleaved rounds, +- half the spread between quartiles. "
      "'front': the\nerrors by which no other way is both as fast and as accurate.\n"
      "\nExample:\n"
      "  lobelia cost reference_scenes/scenes/oblique_45.xml -o cost\n"
      "\nExit codes: 0 done, 2 usage, 3 a scene is unreadable, 4 an output cannot be "
      "written, 5 an engine failed,\n130 Ctrl-C, 143 SIGTERM. Times decide nothing.");
  command->callback([options] { options->limits.run([&] { run_cost(*options); }); });
}

}  // namespace lobelia::cli

#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/messages.hpp"
#include "program/command/options.hpp"
#include "program/command/output_files.hpp"
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

void run_cost(const CostArguments& options) {
  const auto levels = cost::chosen_benchmarks(options.levels, !options.scenes.empty());
  cost::Options measured;
  for (const std::string& file : options.scenes)
    measured.scenes.push_back({std::filesystem::path(file).stem().string(), read_scene(file)});
  measured.effort = options.quick      ? cost::Effort::kQuick
                    : options.thorough ? cost::Effort::kThorough
                                       : cost::Effort::kUsual;
  measured.programs = options.programs.given();
  OutputFiles outputs;
  for (const std::string& file : options.scenes) outputs.reads(file);
  outputs.writes_report(options.json);
  if (!options.directory.empty()) {
    make_directories(options.directory);
    require_writable(std::filesystem::path(options.directory) / "cost.json");
  }
  ProgressLine line;
  measured.on_progress = [&](double done, const std::string& what) { line.show(done, what); };
  const records::Cost report = cost::measure(levels, measured, command_line());
  line.clear();
  FilesTogether files;
  if (!options.directory.empty()) cost::write_cost(report, options.directory);
  write_reports(cost::cost_text(report, options.all), {{options.json, record_text(report)}}, files);
}

/// The levels that there were, and what to type now.
std::string hint_of_old_level(const std::string& level) {
  if (level == "fixed-point")
    return "fixed-point is gone; use lobelia search --precision fixed:BITS";
  if (level == "engine") return "engine is gone; use lobelia verify references, and make bench";
  if (level == "effects") return "effects is gone; compare pictures of two scenes";
  return "";
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
      ->check(&hint_of_old_level)
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

// Long work: farms and benchmarks.
#include "farm/farm.hpp"

#include "base/records/record.hpp"
#include "farm/failed_jobs.hpp"
#include "farm/upkeep.hpp"
#include "program/command/commands.hpp"
#include "program/command/options.hpp"
#include "program/python/module.hpp"
#include "studies/cost/benchmarks.hpp"

namespace lobelia::python {
namespace {

/// farm.json, and the sentences of the summary.
std::pair<std::string, std::vector<std::string>> farm(const py::object& grid_file,
                                                      const py::object& given_directory,
                                                      const py::dict& given,
                                                      const py::object& progress) {
  FarmOptions options;
  std::string filter, memory = "4G", disk = "4G";
  double time_limit = 600, no_progress_limit = 300;
  bool allow_commands = false;
  cli::EnginePrograms programs;
  parse_options(given, [&](CLI::App& app) {
    cli::OptionGroup group(app);
    group.add("--cache", options.cache, "DIR", "");
    group.add("--filter", filter, "", "");
    group.add_number("--threads", options.threads, 0, 1024, "");
    group.add_number("--time-limit", time_limit, 0.1, 1e6, "");
    group.add_number("--no-progress-limit", no_progress_limit, 0, 1e6, "");
    group.add_number("--attempts", options.attempts, 1, 100, "");
    group.add("--memory", memory, "SIZE", "");
    group.add("--disk", disk, "SIZE", "");
    group.add_flag("--fail-fast", options.fail_fast, "");
    group.add_flag("--again", options.again, "");
    group.add_flag("--require-engines", options.require_engines, "");
    group.add_flag("--allow-commands", allow_commands, "");
    programs.add_to(app);
  });
  const std::filesystem::path directory = path_of(given_directory);
  options.programs = programs.given();
  options.time_limit = std::chrono::duration<double>(time_limit);
  options.no_progress_limit = std::chrono::duration<double>(no_progress_limit);
  options.memory = parse_size(memory);
  options.disk = parse_size(disk);
  options.failed_directory = std::filesystem::absolute(directory) / FailedJobs::kName;
  options.filter = JobFilter(filter);
  options.leave = Leave::of_user(allow_commands);
  options.command = cli::command_line();
  std::string record;
  std::vector<std::string> sentences;
  if (const std::string doubts = allow_commands ? "" : doubts_of_trusted_folders(); !doubts.empty())
    sentences.push_back(doubts);
  run(progress, [&, file = path_of(grid_file)](const ShowProgress& show) {
    const Grid grid = read_grid(file);
    options.on_progress = [&](const FarmProgress& now) {
      if (now.total > 0) show(double(now.done) / double(now.total));
    };
    const FarmSummary summary = run_farm(grid, directory, options);
    for (const auto* some : {&summary.problems, &summary.absent_engines, &summary.refusals})
      sentences.insert(sentences.end(), some->begin(), some->end());
    sentences.insert(sentences.end(), summary.warnings.begin(), summary.warnings.end());
    record = records::record_text(records::read_record<records::Farm>(directory / "farm.json"));
  });
  return {record, sentences};
}

std::string cost(const py::list& scenes, const py::dict& given, const py::object& progress) {
  std::vector<std::string> levels;
  std::string effort = "usual";
  cli::EnginePrograms programs;
  parse_options(given, [&](CLI::App& app) {
    cli::OptionGroup group(app);
    group.add("--level", levels, "", "")->expected(1)->take_all();
    group.add_choice("--effort", effort, {"quick", "usual", "thorough"}, "");
    programs.add_to(app);
  });
  cost::Options options;
  for (const py::handle scene : scenes) {
    const auto one = py::reinterpret_borrow<py::object>(scene);
    const std::string path = path_of(one);
    options.scenes.push_back({std::filesystem::path(path).stem().string(), scene_of(one)});
  }
  options.effort = effort == "quick"      ? cost::Effort::kQuick
                   : effort == "thorough" ? cost::Effort::kThorough
                                          : cost::Effort::kUsual;
  options.programs = programs.given();
  std::vector<std::string_view> names;
  for (const cost::Benchmark& level : cost::benchmarks()) names.push_back(level.name);
  for (const std::string& level : levels) cli::chosen_place(level, "--level", names);
  const auto chosen = cost::chosen_benchmarks(levels, !scenes.empty());
  std::string record;
  run(progress, [&](const ShowProgress& show) {
    options.on_progress = [&](double done, const std::string&) { show(done); };
    record = records::record_text(cost::measure(chosen, options, cli::command_line()));
  });
  return record;
}

}  // namespace

void add_farm(py::module_& module) {
  module.def("farm", &farm);
  module.def("cost", &cost);
}

}  // namespace lobelia::python

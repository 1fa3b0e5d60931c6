#include <cstdio>

#include "base/records/record.hpp"
#include "base/system/standard_streams.hpp"
#include "farm/grid.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/farm/farm.hpp"
#include "program/command/options.hpp"
#include "program/command/output_files.hpp"
#include "reference_scenes/engines/outside/outside.hpp"
#include "reference_scenes/engines/outside/outside_reader.hpp"

namespace lobelia::cli {
namespace {

struct EnginesArguments {
  EnginePrograms programs;
  std::vector<std::string> files;
  std::string json;
  bool models = false, allow_commands = false;
};

/// Adds the engines that grids and engine files describe.
void add_outside_engines(const EnginesArguments& options,
                         std::vector<std::unique_ptr<Engine>>& engines) {
  if (options.files.empty()) return;
  const Leave of_user = leave_of_user(options.allow_commands);
  const auto add = [&](std::span<const OutsideEngine> described, const Leave& leave) {
    require_leave_to_start(described, leave);
    for (const OutsideEngine& one : described) engines.push_back(make_outside_engine(one, leave));
  };
  for (const std::string& file : options.files) {
    if (file.ends_with(".engine.xml")) {
      const OutsideEngine engine = read_engine_file(file);
      add({&engine, 1}, of_user);
    } else {
      const Grid grid = read_grid(file);
      add(grid.outside, of_user.said_by(grid.directory));
    }
  }
}

records::EngineFound engine_record(const EngineInfo& engine, const EngineStatus& status,
                                   const std::vector<records::EngineModel>& models) {
  records::EngineFound record;
  record.name = engine.name;
  record.title = engine.title;
  record.available = status.available();
  record.state = state_name(status.state);
  record.program = status.program.string();
  record.version = status.version;
  if (!status.available()) record.why = status.why;
  record.supported_versions = engine.supported_versions;
  record.shading = engine.shading;
  record.precision = engine.precision;
  record.effects = engine.effects;
  record.install = engine.install_hint;
  record.models = models;
  return record;
}

void print_engine(const EngineInfo& engine, const EngineStatus& status) {
  fmt::print("{} (--engine {})\n", engine.title, engine.name);
  const auto row = [](std::string_view what, std::string_view text) {
    fmt::print("  {:<12}{}\n", what, text);
  };
  if (engine.whole_scenes && !engine.is_program) {
    row("found", "pictures that are there already");
  } else if (!engine.is_program) {
    row("found", fmt::format("part of lobelia {}", status.version));
  } else if (status.available()) {
    row("found", printable(status.program.string(), 400));
    row("version",
        fmt::format("{} (what can be driven is {})", status.version, engine.supported_versions));
  } else {
    row(state_name(status.state), printable(status.why, 2000));
    row("to install", engine.install_hint);
    row("versions", engine.supported_versions);
  }
  row("shading", engine.shading);
  row("precision", engine.precision);
  row("effects", engine.effects);
}

/// A row for each model, a column for each engine that is a program.
void print_models(const std::vector<std::unique_ptr<Engine>>& engines) {
  std::vector<std::vector<std::string>> rows{{"model"}};
  for (const ModelId model : all_models()) rows.push_back({std::string(info(model).title)});
  for (const auto& engine : engines) {
    const auto models = engine_models(*engine);
    if (models.empty()) continue;
    rows[0].emplace_back(engine->info().name);
    for (std::size_t i = 0; i < models.size(); ++i) rows[i + 1].push_back(models[i].in_short());
  }
  fmt::print("{}", aligned(rows));
  fmt::print(
      "native: its own highlight, with cos^n and the lobes named; expressed: our formula in its language,\n"
      "with any lobe; both: native with cos^n, expressed with any lobe; -: cannot be compared\n");
}

ExitCode run_engines(const EnginesArguments& options) {
  OutputFiles outputs;
  for (const std::string& file : options.files) outputs.reads(file);
  outputs.writes_report(options.json);
  const bool prints = options.json != kStdout;
  records::Engines record;
  std::vector<std::string> problems;
  std::vector<std::unique_ptr<Engine>> engines;
  for (const EngineInfo& info : engine_infos())
    engines.push_back(make_engine(info.name, options.programs.of(info.name)));
  add_outside_engines(options, engines);
  if (options.models) {
    print_models(engines);
    return ExitCode::kSuccess;
  }
  for (const auto& engine : engines) {
    const EngineInfo& info = engine->info();
    const EngineStatus& status = engine->status();
    if (!options.json.empty())
      record.engines.push_back(engine_record(info, status, engine_models(*engine)));
    if (prints) print_engine(info, status);
    if (!status.available())
      problems.push_back(printable(
          fmt::format("{}: {}: {}", info.title, state_name(status.state), status.why), 2000));
  }
  if (prints) {
    fmt::print("\n");
    print_models(engines);
  }
  write_reports("", {{options.json, record_text(record)}});
  std::fflush(stdout);  // so that a message stands behind the list where both go to one file
  for (const auto& problem : problems) say("lobelia: {}\n", problem);
  return problems.empty() ? ExitCode::kSuccess : ExitCode::kEngine;
}

}  // namespace

void add_engines(CLI::App& app, ExitCode& exit_code) {
  auto* command = app.add_subcommand(
      "engines", "List the reference engines: which are here, what they can do, how to get them");
  auto options = std::make_shared<EnginesArguments>();
  command->add_option("FILE", options->files,
                      "A grid, or NAME.engine.xml: its own engines are listed as well");
  options->programs.add_to(*command);
  command->add_flag("--allow-commands", options->allow_commands,
                    "Ask the programs that these files name for their versions");
  OptionGroup group(*command);
  auto* json = add_json(group, options->json, "engines");
  command
      ->add_flag("--models", options->models,
                 "Print only which models each shades, whether it is here or not")
      ->excludes(json);
  command->footer(
      "Absent is an engine that is not installed; broken is one that is there and cannot be started, does\n"
      "not end, or tells no version that can be driven. Which scenes one refuses, 'lobelia farm' says.\n\n"
      "Exit codes: 0 all of them can be driven, 2 a FILE names programs and is not trusted, 3 bad FILE,\n"
      "5 one is absent or broken.\n\n"
      "Examples: lobelia engines --blender /opt/blender/blender\n"
      "          lobelia engines mine.engine.xml --allow-commands");
  command->callback([options, &exit_code] { exit_code = run_engines(*options); });
}

}  // namespace lobelia::cli

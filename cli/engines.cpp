#include <algorithm>
#include <iterator>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "core/standard_streams.hpp"
#include "farm/grid.hpp"
#include "records/record.hpp"
#include "reference_scenes/engines/outside/outside.hpp"
#include "reference_scenes/engines/outside/outside_reader.hpp"

namespace lobelia::cli {
namespace {

struct EnginesArguments {
  EnginePrograms programs;
  std::vector<std::string> files;
  bool json = false, allow_commands = false;
};

/// The engines that grids and engine files describe.
std::vector<OutsideEngine> outside_engines(const EnginesArguments& options) {
  std::vector<OutsideEngine> found;
  for (const std::string& file : options.files)
    if (file.ends_with(".engine.xml"))
      found.push_back(read_engine_file(file));
    else
      std::ranges::copy(read_grid(file).outside, std::back_inserter(found));
  require_commands_allowed(found, options.allow_commands);
  return found;
}

records::EngineFound engine_record(const EngineInfo& engine, const EngineStatus& status) {
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

ExitCode run_engines(const EnginesArguments& options) {
  records::Engines record;
  std::vector<std::string> problems;
  std::vector<std::unique_ptr<Engine>> engines;
  for (const EngineInfo& info : engine_infos())
    engines.push_back(make_engine(info.name, options.programs.of(info.name)));
  for (const OutsideEngine& outside : outside_engines(options))
    engines.push_back(make_outside_engine(outside));
  for (const auto& engine : engines) {
    const EngineInfo& info = engine->info();
    const EngineStatus& status = engine->status();
    if (options.json)
      record.engines.push_back(engine_record(info, status));
    else
      print_engine(info, status);
    if (!status.available())
      problems.push_back(printable(
          fmt::format("{}: {}: {}", info.title, state_name(status.state), status.why), 2000));
  }
  if (options.json) fmt::print("{}", record_text(record));
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
  command->add_flag("--json", options->json, "Print the list as JSON");
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

#include "cli/verify_references.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/commands.hpp"
#include "cli/engine_programs.hpp"
#include "cli/options.hpp"
#include "cli/progress.hpp"
#include "core/files.hpp"
#include "records/record.hpp"
#include "studies/agreement/report.hpp"

namespace lobelia::cli {
namespace {

struct VerifyReferencesArguments {
  std::string output;
  std::vector<std::string> engines;
  int size = 0;
  bool small = false, json = false, markdown = false, require_engines = false, quiet = false;
  EnginePrograms programs;
};

/// Those that are named, which have to be there, or all.
std::vector<std::unique_ptr<Engine>> engines_of(const VerifyReferencesArguments& options) {
  std::vector<std::string_view> names;
  for (const EngineInfo& engine : engine_infos())
    if (engine.is_program) names.push_back(engine.name);
  std::vector<std::string_view> wanted = names;
  if (!options.engines.empty()) {
    wanted.clear();
    for (const std::string& typed : options.engines)
      wanted.push_back(chosen(typed, "--engine", names, join(names), [&](const std::string& name) {
        const auto found = std::ranges::find(names, name);
        return found == names.end() ? std::nullopt : std::optional(*found);
      }));
  }
  std::vector<std::unique_ptr<Engine>> engines;
  for (const std::string_view name : names) {
    if (std::ranges::find(wanted, name) == wanted.end()) continue;
    engines.push_back(make_engine(name, options.programs.of(std::string(name))));
    if (!options.engines.empty() || options.require_engines ||
        engines.back()->status().state == EngineState::kBroken)
      require_available(engines.back()->info(), engines.back()->status());
  }
  return engines;
}

/// What to type for the same table, wherever its files went.
std::string command_for(const VerifyReferencesArguments& options) {
  std::string command = "lobelia verify references";
  if (options.small) command += " --small";
  if (options.size > 0) command += fmt::format(" --size {}", options.size);
  for (const std::string& engine : options.engines) command += " --engine " + engine;
  return command;
}

ExitCode run_verify_references(const VerifyReferencesArguments& options) {
  agreement::Scope scope{options.small,
                         options.small ? agreement::kSmallSize : agreement::kFullSize};
  if (options.size > 0) scope.size = options.size;
  const auto engines = engines_of(options);
  const std::filesystem::path directory = options.output;
  if (!options.output.empty()) {
    make_directories(directory);
    require_writable(directory / "agreement.json");
  }
  ProgressLine progress(!options.quiet);
  const auto result = agreement::measure(
      scope, engines, [&](double done, std::string_view what) { progress.show(done, what); });
  progress.clear();
  const records::Agreement record = agreement::report_record(result, command_line());
  const std::string page = agreement::report_markdown(result, command_for(options));
  if (!options.output.empty()) {
    FilesTogether files;
    write_record(directory / "agreement.json", record);
    write_file(directory / "agreement.csv", agreement::report_csv(result));
    write_file(directory / "agreement.md", page);
    files.commit();
  }
  fmt::print("{}", options.json       ? record_text(record)
                   : options.markdown ? page
                                      : agreement::report_text(result));
  if (result.count(agreement::Verdict::kFailed) > 0) return ExitCode::kEngine;
  return result.count(agreement::Verdict::kMissed) > 0 ? ExitCode::kDiffers : ExitCode::kSuccess;
}

}  // namespace

void add_verify_references(CLI::App& verify, ExitCode& exit_code) {
  auto* command = verify.add_subcommand(
      "references", "Hold ours and every engine to the formulas, and engines to one another");
  auto options = std::make_shared<VerifyReferencesArguments>();
  command
      ->add_option("-o,--output", options->output,
                   "Directory for agreement.json (kind agreement), agreement.csv and agreement.md")
      ->type_name("DIR");
  command->add_flag("--small", options->small, "A part of it that takes less than a minute");
  command->add_option("--size", options->size, "Width of pictures; usually 96, with --small 64")
      ->check(between(agreement::kSmallestSize, agreement::kLargestSize));
  command
      ->add_option("--engine", options->engines,
                   "These engines alone, which have to be there; otherwise all that are")
      ->type_name("NAME");
  options->programs.add_to(*command);
  command->add_flag("--require-engines", options->require_engines,
                    "An engine that is not installed is an error");
  auto* json = command->add_flag("--json", options->json, "Print the record instead of the table");
  command->add_flag("--markdown", options->markdown, "Print docs/agreement.md instead of the table")
      ->excludes(json);
  command->add_flag("-q,--quiet", options->quiet, "No progress line");
  command->footer(
      "Differences are from pictures evaluated from the formulas in double or 50 digits. Those of\n"
      "the value are what number formats leave, those of the peak what arithmetic leaves; pixels\n"
      "on edges are counted apart. docs/agreement.md has the outcome and says what columns mean.\n"
      "\n"
      "Exit codes: 0 every target is met, 1 some are missed; 2 usage, 4 an output cannot be\n"
      "written, 5 an engine that was named or required is absent, one is broken, or one failed.");
  command->callback([options, &exit_code] { exit_code = run_verify_references(*options); });
}

}  // namespace lobelia::cli

#include "farm/farm_engines.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/records/farm_file.hpp"
#include "base/records/record.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/version.hpp"
#include "base/words/text.hpp"
#include "farm/job.hpp"

namespace lobelia {
namespace {
namespace fs = std::filesystem;

/// The engines of the last run's farm.json; none if that is missing or damaged. Throws Error(kInput) after a fault of its
/// disk: an engine that is not here would be another one from then on.
std::vector<records::FarmEngine> engines_before(const fs::path& farm_directory) {
  if (farm_directory.empty()) return {};
  const fs::path file = farm_directory / "farm.json";
  std::string text;
  try {
    text = read_file(file, records::kMaxRecordBytes);
  } catch (const Error&) {
    if (!is_out_of_reach(file, records::kMaxRecordBytes)) throw;
    return {};
  }
  try {
    return records::parse_farm(text, file.string()).engines;
  } catch (const std::exception&) {
    return {};  // the farm writes it anew soon
  }
}

}  // namespace

fs::path program_for(const ProgramPaths& programs, const std::string& engine) {
  const auto found = programs.find(engine);
  return found == programs.end() ? fs::path() : found->second;
}

std::string start_of(const std::string& engine, const std::string& program) {
  return fmt::format("start '{}' as {}", printable(program, 1000), printable(engine));
}

std::vector<FarmEngine> find_engines(const std::vector<std::string>& names,
                                     const EngineChoice& choice) {
  std::vector<FarmEngine> engines;
  const auto before = engines_before(choice.farm_directory);
  const auto take_from_last_run = [&](FarmEngine& engine) {
    for (const auto& was : before) {
      if (was.name != engine.name) continue;
      engine.version = was.version;
      engine.content = was.content;
    }
  };
  FileHashes& hashes = FileHashes::of_user();
  for (const auto& name : names) {
    const fs::path program = program_for(choice.programs, name);
    auto made = make_farm_engine(name, choice.programs, choice.outside, choice.leave);
    if (choice.as_recorded) {
      take_from_last_run(engines.emplace_back(FarmEngine{std::move(made), name}));
      continue;
    }
    FarmEngine engine = look_for_engine(std::move(made), hashes);
    const EngineInfo& info = engine.engine->info();
    const EngineStatus& status = engine.engine->status();
    if (status.state == EngineState::kBroken)
      throw Error(ExitCode::kEngine, "{} is broken: {}", info.title, status.why);
    if (!engine.here && !program.empty())
      throw Error(ExitCode::kEngine, "{}: {}", info.title, status.why);
    if (!engine.here && choice.required) throw Error(ExitCode::kEngine, absence(engine));
    if (!engine.here) take_from_last_run(engine);
    engines.push_back(std::move(engine));
  }
  hashes.save();
  return engines;
}

std::unique_ptr<Engine> make_farm_engine(const std::string& name, const ProgramPaths& programs,
                                         std::span<const OutsideEngine> outside,
                                         const Leave& leave) {
  const auto found = std::ranges::find(outside, name, &OutsideEngine::name);
  return found == outside.end() ? make_engine(name, program_for(programs, name))
                                : make_outside_engine(*found, leave);
}

FarmEngine look_for_engine(std::unique_ptr<Engine> made, FileHashes& hashes) {
  FarmEngine engine{std::move(made), ""};
  engine.name = engine.engine->info().name;
  const EngineStatus& status = engine.engine->status();
  engine.here = status.available();
  if (!engine.here) return engine;
  engine.version = status.version;
  engine.files = engine_content(status, hashes);
  engine.content = engine.files.sha256;
  return engine;
}

std::string engine_difference(const FarmEngine& planned, const ProgramPaths& programs,
                              const Leave& leave) {
  FileHashes& hashes = FileHashes::of_user();
  const OutsideEngine* outside = planned.engine->outside();
  const FarmEngine here = look_for_engine(
      make_farm_engine(planned.name, programs,
                       outside ? std::span(outside, 1) : std::span<const OutsideEngine>(), leave),
      hashes);
  hashes.save();
  const std::string_view title = planned.engine->info().title;
  if (!here.is_here()) return fmt::format("{}: {}", title, here.engine->status().why);
  if (here.version != planned.version)
    return fmt::format("{}: engine version: {} here, {} in the plan", title, here.version,
                       planned.version);
  if (here.content != planned.content)
    return fmt::format("{}: engine content: other files under the same version {}", title,
                       here.version);
  return "";
}

std::string absence(const FarmEngine& engine) {
  const EngineInfo& info = engine.engine->info();
  return fmt::format("{} is absent: {}{}; to get it: {}", info.title, engine.engine->status().why,
                     engine.is_known() ? "; what it made before is kept" : "", info.install_hint);
}

std::vector<records::FarmEngine> engines_record(const std::vector<FarmEngine>& engines, bool ours) {
  const std::string ready(state_name(EngineState::kReady));
  std::vector<records::FarmEngine> found;
  if (ours)
    found.push_back({kOurs, "Lobelia", true, ready, kVersion, "", "", "", std::nullopt, {}});
  for (const auto& here : engines) {
    const EngineInfo& info = here.engine->info();
    records::FarmEngine& engine = found.emplace_back();
    engine.name = info.name;
    engine.title = info.title;
    engine.version = here.version;
    engine.content = here.content;
    engine.available = here.is_here();
    engine.models = engine_models(*here.engine);
    engine.state = ready;
    if (engine.available) continue;
    engine.state = state_name(here.engine->status().state);
    engine.why = here.engine->status().why;
    engine.install = info.install_hint;
  }
  return found;
}

}  // namespace lobelia

#include "farm/farm_engines.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/version.hpp"
#include "farm/job.hpp"
#include "records/record.hpp"

namespace lobelia {
namespace {
namespace fs = std::filesystem;

/// The engines of the last run's farm.json; none if it cannot be read.
std::vector<records::FarmEngine> engines_before(const fs::path& farm_directory) {
  std::error_code ignored;
  if (farm_directory.empty() || !fs::exists(farm_directory / "farm.json", ignored)) return {};
  try {
    return records::read_record<records::Farm>(farm_directory / "farm.json").engines;
  } catch (const std::exception&) {
    return {};  // written anew soon
  }
}

void identify(FarmEngine& engine, FileHashes& hashes) {
  const EngineStatus& status = engine.engine->status();
  engine.version = status.version;
  engine.files = engine_content(status, hashes);
  engine.content = engine.files.sha256;
}

void take_from_last_run(FarmEngine& engine, const std::vector<records::FarmEngine>& before) {
  for (const auto& was : before) {
    if (was.name != engine.name) continue;
    engine.version = was.version;
    engine.content = was.content;
  }
}

}  // namespace

std::vector<FarmEngine> find_engines(const std::vector<std::string>& names,
                                     const EngineChoice& choice) {
  std::vector<FarmEngine> engines;
  const auto before = engines_before(choice.farm_directory);
  FileHashes& hashes = FileHashes::of_user();
  for (const auto& name : names) {
    const auto program = choice.programs.find(name);
    const bool given = program != choice.programs.end();
    if (choice.as_recorded) {
      engines.push_back({make_engine(name, given ? program->second : fs::path()), name});
      take_from_last_run(engines.back(), before);
      continue;
    }
    FarmEngine engine = look_for_engine(name, given ? program->second : fs::path(), hashes);
    const EngineInfo& info = engine.engine->info();
    const EngineStatus& status = engine.engine->status();
    if (status.state == EngineState::kBroken)
      throw Error(ExitCode::kEngine, fmt::format("{} is broken: {}", info.title, status.why));
    if (!engine.here && given)
      throw Error(ExitCode::kEngine, fmt::format("{}: {}", info.title, status.why));
    if (!engine.here && choice.required) throw Error(ExitCode::kEngine, absence(engine));
    if (!engine.here) take_from_last_run(engine, before);
    engines.push_back(std::move(engine));
  }
  hashes.save();
  return engines;
}

FarmEngine look_for_engine(const std::string& name, const fs::path& program, FileHashes& hashes) {
  FarmEngine engine{make_engine(name, program), name};
  engine.here = engine.engine->status().available();
  if (engine.here) identify(engine, hashes);
  return engine;
}

std::string engine_difference(const FarmEngine& planned,
                              const std::map<std::string, fs::path>& programs) {
  FileHashes& hashes = FileHashes::of_user();
  const auto program = programs.find(planned.name);
  const FarmEngine here = look_for_engine(
      planned.name, program == programs.end() ? fs::path() : program->second, hashes);
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

std::vector<records::FarmEngine> engines_record(const std::vector<FarmEngine>& engines) {
  std::vector<records::FarmEngine> found;
  records::FarmEngine& ours = found.emplace_back();
  ours.name = kOurs;
  ours.title = "Lobelia";
  ours.version = kVersion;
  ours.available = true;
  ours.state = state_name(EngineState::kReady);
  for (const auto& here : engines) {
    const EngineInfo& info = here.engine->info();
    records::FarmEngine& engine = found.emplace_back();
    engine.name = info.name;
    engine.title = info.title;
    engine.available = here.is_here();
    engine.state = state_name(here.is_here() ? EngineState::kReady : here.engine->status().state);
    engine.version = here.version;
    engine.content = here.content;
    if (!here.is_here()) {
      engine.why = here.engine->status().why;
      engine.install = info.install_hint;
    }
  }
  return found;
}

}  // namespace lobelia

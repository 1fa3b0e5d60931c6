#include "farm/farm_engines.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/version.hpp"
#include "farm/our_name.hpp"

namespace lobelia {
namespace {
namespace fs = std::filesystem;

/// What the last run's farm.json says of its engines, as far as there is one that can be read.
Json engines_before(const fs::path& farm_directory) {
  std::error_code ignored;
  if (farm_directory.empty() || !fs::exists(farm_directory / "farm.json", ignored))
    return Json::array();
  try {
    return read_record(farm_directory / "farm.json", "farm").value("engines", Json::array());
  } catch (const std::exception&) {
    return Json::array();  // written anew soon
  }
}

void take_from_last_run(FarmEngine& engine, const Json& before) {
  for (const auto& was : before)
    if (was.is_object() && was.value("name", Json()) == engine.name &&
        was.value("version", Json()).is_string())
      engine.version = was["version"];
}

}  // namespace

std::vector<FarmEngine> find_engines(const std::vector<std::string>& names,
                                     const EngineChoice& choice) {
  std::vector<FarmEngine> engines;
  const Json before = engines_before(choice.farm_directory);
  for (const auto& name : names) {
    const auto program = choice.programs.find(name);
    const bool given = program != choice.programs.end();
    FarmEngine engine{make_engine(name, given ? program->second : fs::path()), name, "", true};
    const EngineInfo& info = engine.engine->info();
    const EngineStatus& status = engine.engine->status();
    if (status.state == EngineState::kBroken)
      throw Error(ExitCode::kEngine, fmt::format("{} is broken: {}", info.title, status.why));
    engine.here = status.available();
    if (engine.here)
      engine.version = status.version;
    else if (given)
      throw Error(ExitCode::kEngine, fmt::format("{}: {}", info.title, status.why));
    else if (choice.required)
      throw Error(ExitCode::kEngine, absence(engine));
    else
      take_from_last_run(engine, before);
    engines.push_back(std::move(engine));
  }
  return engines;
}

std::string absence(const FarmEngine& engine) {
  const EngineInfo& info = engine.engine->info();
  return fmt::format("{} is absent: {}{}; to get it: {}", info.title, engine.engine->status().why,
                     engine.is_known() ? "; what it made before is kept" : "", info.install_hint);
}

Json engines_record(const std::vector<FarmEngine>& engines) {
  Json record = Json::array({{{"name", kOurs},
                              {"title", "Lobelia"},
                              {"version", kVersion},
                              {"available", true},
                              {"state", state_name(EngineState::kReady)}}});
  for (const auto& here : engines) {
    const EngineInfo& info = here.engine->info();
    Json engine{{"name", info.name},
                {"title", info.title},
                {"available", here.is_here()},
                {"state", state_name(here.engine->status().state)}};
    if (here.is_known()) engine["version"] = here.version;
    if (!here.is_here()) {
      engine["why"] = here.engine->status().why;
      engine["install"] = info.install_hint;
    }
    record.push_back(std::move(engine));
  }
  return record;
}

}  // namespace lobelia

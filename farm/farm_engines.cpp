#include "farm/farm_engines.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/version.hpp"
#include "farm/our_name.hpp"

namespace lobelia {

std::vector<FarmEngine> find_engines(const std::vector<std::string>& names,
                                     const std::map<std::string, std::filesystem::path>& programs) {
  std::vector<FarmEngine> engines;
  for (const auto& name : names) {
    const auto program = programs.find(name);
    const bool given = program != programs.end();
    FarmEngine here{make_engine(name, given ? program->second : std::filesystem::path()), name, ""};
    const EngineStatus& status = here.engine->status();
    if (status.available)
      here.version = status.version;
    else if (given)
      throw Error(ExitCode::kEngine, fmt::format("{}: {}", here.engine->info().title, status.why));
    engines.push_back(std::move(here));
  }
  return engines;
}

std::string absence(const FarmEngine& engine) {
  const EngineInfo& info = engine.engine->info();
  return fmt::format("{} is left out: {}; to get it: {}", info.title, engine.engine->status().why,
                     info.install_hint);
}

Json engines_record(const std::vector<FarmEngine>& engines) {
  Json record = Json::array(
      {{{"name", kOurs}, {"title", "Lobelia"}, {"version", kVersion}, {"available", true}}});
  for (const auto& here : engines) {
    const EngineInfo& info = here.engine->info();
    Json engine{{"name", info.name}, {"title", info.title}, {"available", here.is_here()}};
    if (here.is_here()) {
      engine["version"] = here.version;
    } else {
      engine["why"] = here.engine->status().why;
      engine["install"] = info.install_hint;
    }
    record.push_back(std::move(engine));
  }
  return record;
}

}  // namespace lobelia

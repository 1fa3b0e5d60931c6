// The engines of a farm: which are here, in which version, and how its record lists them.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/records/farm.hpp"
#include "reference_scenes/content.hpp"
#include "reference_scenes/engines/outside/outside.hpp"

namespace lobelia {

/// Programs to use in place of those in $PATH, by engine.
using ProgramPaths = std::map<std::string, std::filesystem::path>;
/// Empty if there is none for this engine.
std::filesystem::path program_for(const ProgramPaths& programs, const std::string& engine);
/// "start '/opt/povray' as povray", of a program that a record names, for refuse_without_leave().
std::string start_of(const std::string& engine, const std::string& program);

struct FarmEngine {
  std::unique_ptr<Engine> engine;
  std::string name;
  std::string version = {};  ///< empty: unknown
  std::string content =
      {};            ///< SHA-256 of `files`; empty for an engine that is part of our program
  bool here = true;  ///< false: absent; version and content are those of the last run
  bool is_here() const { return here && !version.empty(); }
  /// Whether its results have keys: those in the cache are shown even if the engine is absent.
  bool is_known() const { return !version.empty(); }
  Content files = {};  ///< the program and everything it loads and reads (engine_content())
};

struct EngineChoice {
  ProgramPaths programs;
  bool required = false;  ///< an absent engine is an error
  std::filesystem::path
      farm_directory;        ///< its farm.json lists the engines of the last run; empty: none
  bool as_recorded = false;  ///< takes these without looking for any program
  std::vector<OutsideEngine> outside = {};  ///< besides those of the catalogue
  Leave leave = {};                         ///< for these, of the files that name them
};

/// Throws Error(kEngine) if an engine is broken, a program is not that engine, or a required engine is absent.
std::vector<FarmEngine> find_engines(const std::vector<std::string>& names,
                                     const EngineChoice& choice);

/// How an engine here differs from the plan, "POV-Ray: engine content: other files under ..."; empty if it is the same.
std::string engine_difference(const FarmEngine& planned, const ProgramPaths& programs,
                              const Leave& leave);

/// The engine on this machine, usable or not.
FarmEngine look_for_engine(std::unique_ptr<Engine> engine, FileHashes& hashes);

/// The one of `outside` with this name, or the catalogue's.
std::unique_ptr<Engine> make_farm_engine(const std::string& name, const ProgramPaths& programs,
                                         std::span<const OutsideEngine> outside,
                                         const Leave& leave);

/// "POV-Ray is absent: no program 'povray' in $PATH; to get it: ..."
std::string absence(const FarmEngine& engine);

/// The engines for farm.json, Lobelia first if it is to be shown.
std::vector<records::FarmEngine> engines_record(const std::vector<FarmEngine>& engines, bool ours);

}  // namespace lobelia

// The engines of a farm: which are here, in which version, and as its record tells it.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "records/farm.hpp"
#include "reference_scenes/engine_content.hpp"

namespace lobelia {

struct FarmEngine {
  std::unique_ptr<Engine> engine;
  std::string name;
  std::string version = {};  ///< empty: not known
  /// SHA-256 of the program and what it loads and reads (engine_content()); empty for one that is part of ours.
  std::string content = {};
  bool here = true;  ///< false: absent; version and content are those of the last run
  bool is_here() const { return here && !version.empty(); }
  /// Whether its results have keys: the cache's are shown though the engine is absent.
  bool is_known() const { return !version.empty(); }
  Content files = {};  ///< `content` is the hash of these
};

struct EngineChoice {
  std::map<std::string, std::filesystem::path> programs;  ///< in place of those in $PATH, by engine
  bool required = false;                                  ///< absence is an error
  std::filesystem::path farm_directory;  ///< whose farm.json tells what was here; empty: none
  bool as_recorded = false;              ///< that is believed, and no program looked for
};

/// Throws Error(kEngine) if one is broken, if one of `programs` is not that engine, or if a required one is absent.
std::vector<FarmEngine> find_engines(const std::vector<std::string>& names,
                                     const EngineChoice& choice);

/// How an engine here differs from the plan: "POV-Ray: engine content: other files under the same version 3.7.0.10". Empty
/// if it does not.
std::string engine_difference(const FarmEngine& planned,
                              const std::map<std::string, std::filesystem::path>& programs);

/// The engine as it is on this machine, whether it can be used or not.
FarmEngine look_for_engine(const std::string& name, const std::filesystem::path& program,
                           FileHashes& hashes);

/// "POV-Ray is absent: no program 'povray' in $PATH; to get it: ..."
std::string absence(const FarmEngine& engine);

/// The engines for farm.json, Lobelia first.
std::vector<records::FarmEngine> engines_record(const std::vector<FarmEngine>& engines);

}  // namespace lobelia

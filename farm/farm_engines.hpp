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
  bool here =
      true;  ///< false: there is no such program; version and content are those of the last run
  bool is_here() const { return here && !version.empty(); }
  /// Whether its results have keys: those that are in the cache are shown though the engine is absent.
  bool is_known() const { return !version.empty(); }
  Content files = {};  ///< what `content` is of, where it is here
};

struct EngineChoice {
  std::map<std::string, std::filesystem::path> programs;  ///< in place of those in $PATH, by engine
  bool required = false;                                  ///< absence is an error
  std::filesystem::path farm_directory;  ///< whose farm.json tells what was here; empty: none
  bool as_recorded = false;              ///< that is believed, and no program looked for
};

/// Looks for each. Throws Error(kEngine) if one is broken, if one of `programs` is not the engine that it should be
/// (asked for by its path, that is a mistake and not a lack), or if one is absent though all are required.
std::vector<FarmEngine> find_engines(const std::vector<std::string>& names,
                                     const EngineChoice& choice);

/// What of an engine on this machine is not as a plan has it: "POV-Ray: engine content: other files under the same version
/// 3.7.0.10". Empty if it is all the same.
std::string engine_difference(const FarmEngine& planned,
                              const std::map<std::string, std::filesystem::path>& programs);

/// The engine as it is on this machine, whether it can be used or not.
FarmEngine look_for_engine(const std::string& name, const std::filesystem::path& program,
                           FileHashes& hashes);

/// "POV-Ray is absent: no program 'povray' in $PATH; to get it: ..."
std::string absence(const FarmEngine& engine);

/// What farm.json says of ours and of each.
std::vector<records::FarmEngine> engines_record(const std::vector<FarmEngine>& engines);

}  // namespace lobelia

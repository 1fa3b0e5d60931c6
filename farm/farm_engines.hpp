// The engines of a farm: which are here, in which version, and as its record tells it.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/record.hpp"
#include "reference_scenes/engine.hpp"

namespace lobelia {

struct FarmEngine {
  std::unique_ptr<Engine> engine;
  std::string name;
  std::string version;  ///< empty: not available
  bool is_here() const { return !version.empty(); }
};

/// Looks for each. Throws Error(kEngine) if one of `programs` is not the engine that it should be: asked for by its
/// path, that is a mistake and not a lack.
std::vector<FarmEngine> find_engines(const std::vector<std::string>& names,
                                     const std::map<std::string, std::filesystem::path>& programs);

/// "POV-Ray is left out: no program 'povray' in $PATH; to get it: ..."
std::string absence(const FarmEngine& engine);

/// What farm.json says of ours and of each.
Json engines_record(const std::vector<FarmEngine>& engines);

}  // namespace lobelia

// What a cell's results were made of, and what of that is not the same on this machine now.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "records/farm.hpp"

namespace lobelia {

/// What the key of each result of a cell was made of, and what has changed since. With `job` ("reference-povray") only
/// that result. Engines are looked for in $PATH, or at `programs`. Writes nothing. Throws Error(kInput) if there is no
/// such farm, cell or job.
records::FarmExplanation explain_cell(const std::filesystem::path& directory,
                                      const std::string& cell, const std::string& job,
                                      const std::map<std::string, std::filesystem::path>& programs);

}  // namespace lobelia

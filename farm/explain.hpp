// Explains a cell's results: the parts that their keys were made of, and which of them have changed.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "records/farm.hpp"

namespace lobelia {

/// For each result of a cell, or only that of `job` ("reference-povray"). Engines are those in $PATH, or at `programs`.
/// Writes nothing. Throws Error(kInput) if there is no such farm, cell or job.
records::FarmExplanation explain_cell(const std::filesystem::path& directory,
                                      const std::string& cell, const std::string& job,
                                      const std::map<std::string, std::filesystem::path>& programs);

}  // namespace lobelia

// The part of lobelia convert that fits models to a measured material.
#pragma once

#include <string>

namespace lobelia::cli {

/// Prints the fits and writes the record to `json`, and pictures and scenes below `directory`; both may be empty.
void convert_measured(const std::string& file, const std::string& directory,
                      const std::string& json);

}  // namespace lobelia::cli

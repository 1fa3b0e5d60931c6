// The public C++ library as its users have it: this file sees no room.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lobelia::fixtures {

struct LibraryAnswer {
  std::string record, error;  ///< one of them
};

/// Compares two files, or with `in_memory` what read_picture() reads of them.
LibraryAnswer compare_by_library(const std::string& a, const std::string& b,
                                 const std::vector<std::pair<std::string, std::string>>& options,
                                 bool in_memory);

}  // namespace lobelia::fixtures

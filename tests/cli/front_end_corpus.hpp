// Pairs of pictures of every kind, made by number, with the options that they are compared with.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace lobelia::fixtures {

struct MadePair {
  int number = 0;
  std::string kind, a, b;  ///< files
  /// By the names of the command line; a flag has "true". One that is given twice stands twice.
  std::vector<std::pair<std::string, std::string>> options;
  bool is_plain =
      false;  ///< R, G and B in floats and nothing else, so that an array holds all of it
  std::string a_error, b_error;  ///< pictures of standard errors, if the noise is known by these
};

/// Writes the pair into the directory. The same number gives the same files.
MadePair make_pair_of_files(int number, const std::filesystem::path& directory);

}  // namespace lobelia::fixtures

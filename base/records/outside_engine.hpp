// An engine of the user's own, as a grid or an engine file describes it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lobelia::records {

/// Either a program (`command`) or pictures that exist already (`files`).
struct OutsideEngine {
  std::string name, title;
  std::string directory;  ///< of the file that describes it: absolute, without links
  std::vector<std::string> command, version_command;
  std::string files;
  std::string scene;
  std::vector<std::string> environment;
  std::optional<std::vector<std::string>> effects;
  double of_value = 0, of_peak = 0;
};

}  // namespace lobelia::records

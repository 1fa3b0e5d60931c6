// --povray PATH and --blender PATH: an option for every engine of the catalogue.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <string>

namespace lobelia::cli {

class EnginePrograms {
 public:
  /// This object has to live as long as `command`.
  void add_to(CLI::App& command);
  /// By engine, without those that the user left out.
  std::map<std::string, std::filesystem::path> given() const;
  /// Empty if the user left it out: the one in $PATH.
  std::filesystem::path of(const std::string& engine) const;

 private:
  std::map<std::string, std::string> typed_;
};

}  // namespace lobelia::cli

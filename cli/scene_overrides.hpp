// The options that change a scene on the command line, the same for every subcommand that takes one.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "renderer/scene/scene.hpp"

namespace lobelia::cli {

class SceneOverrides {
 public:
  void add_to(CLI::App& command);
  /// Changes every material of the scene. Throws Error(kUsage) naming the value and what is allowed.
  void apply(Scene& scene) const;

 private:
  std::optional<std::string> model_, lobe_, normalisation_;
  std::optional<double> exponent_;
  std::optional<int> width_, height_, samples_;
  std::optional<std::uint64_t> seed_;
};

}  // namespace lobelia::cli

#include "renderer/scene/scene_format.hpp"

#include <fmt/format.h>

#include "cli/commands.hpp"

namespace lobelia::cli {

void add_scene_format(CLI::App& app, ExitCode&) {
  auto* command =
      app.add_subcommand("scene-format", "Describe the scene file format (docs/scene_format.md)");
  command->callback([] { fmt::print("{}", scene_format_document()); });
}

}  // namespace lobelia::cli

#include "renderer/scene/scene_format.hpp"

#include <fmt/format.h>

#include "farm/grid.hpp"
#include "program/command/commands.hpp"

namespace lobelia::cli {

void add_scene_format(CLI::App& app, ExitCode&) {
  auto* command =
      app.add_subcommand("scene-format", "Describe the scene file format (docs/scene_format.md)");
  struct Schemas {
    bool scene = false, grid = false;
  };
  auto schemas = std::make_shared<Schemas>();
  auto* scene = command->add_flag("--xsd", schemas->scene, "Print the XML Schema of scene files");
  command->add_flag("--grid-xsd", schemas->grid, "Print the XML Schema of grid files")
      ->excludes(scene);
  command->callback([schemas] {
    fmt::print("{}", schemas->scene  ? scene_schema()
                     : schemas->grid ? grid_schema()
                                     : scene_format_document());
  });
}

}  // namespace lobelia::cli

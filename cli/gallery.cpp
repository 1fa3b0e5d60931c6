// lobelia gallery DIR
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "cli/commands.hpp"
#include "gallery/gallery.hpp"

namespace lobelia::cli {

void add_gallery(CLI::App& app, ExitCode&) {
  auto* command = app.add_subcommand("gallery", "Draw a farm's records as a static site");
  auto directory = std::make_shared<std::string>();
  command->add_option("DIR", *directory, "The directory that 'lobelia farm' wrote")->required();
  command->footer(
      "Writes DIR/index.html and a page for every cell, and prints the path of the index.\n"
      "The site opens from a double-click, needs no network, and may be moved or copied.\n\n"
      "Example:\n"
      "  lobelia farm sphere_grid.xml -o gallery-out\n"
      "  lobelia gallery gallery-out");
  command->callback([directory] {
    fmt::print("{}\n", gallery::write_gallery(std::filesystem::path(*directory)).string());
  });
}

}  // namespace lobelia::cli

// lobelia gallery RUN, lobelia gallery serve DIR
#include "gallery/gallery.hpp"

#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/publish.hpp"
#include "core/interrupt.hpp"
#include "gallery/preview_server.hpp"

namespace lobelia::cli {
namespace {

void add_serve(CLI::App& gallery) {
  auto* command =
      gallery.add_subcommand("serve", "Look at a gallery through a web server on this machine");
  auto directory = std::make_shared<std::string>();
  auto port = std::make_shared<int>(8080);
  command->add_option("DIR", *directory, "The directory that 'lobelia gallery' wrote")->required();
  command->add_option("--port", *port, "Port on 127.0.0.1; 0 is any free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command->footer(
      "Prints the address and serves until Ctrl-C: GET and HEAD, to this machine alone. A gallery needs\n"
      "no server; this is for seeing one as a server will give it.\n\n"
      "Example: lobelia gallery serve out/gallery");
  command->callback([directory, port] {
    end_by_ourselves_when_interrupted();  // Ctrl-C stops the server
    gallery::serve_site(*directory, *port, [](const std::string& url) {
      fmt::print("{}\n", url);
      if (std::fflush(stdout) != 0)  // otherwise the address would be lost
        throw Error(ExitCode::kOutput, "standard output: cannot write");
    });
  });
}

}  // namespace

void add_gallery(CLI::App& app, ExitCode& exit_code) {
  auto* command = app.add_subcommand("gallery", "Draw a farm's records as a static site");
  auto run = std::make_shared<std::string>();
  auto options = std::make_shared<gallery::GalleryOptions>();
  // Not required by the parser, which would ask for it with 'serve' too.
  command->add_option("RUN", *run, "The directory that 'lobelia farm' wrote");
  command->add_option("-o,--output", options->site, "Directory for the site; by default RUN itself")
      ->type_name("DIR");
  command->add_flag(
      "--metrics-only", options->metrics_only,
      "No float pictures and no maps: numbers, curves and thumbnails, for a site of a hundredth the size");
  command->add_option("--title", options->title, "Title of the site in place of the grid's");
  command->add_option(
      "--base-url", options->base_url,
      "Where it will be published: https://example.org/folder, for links to it by others");
  command->footer(
      "Writes an index, a page for every cell and every view, and prints the path of the index. The site\n"
      "opens from a double-click, needs no network, and may be moved or copied. A second time writes\n"
      "only what has changed, and removes the pages of cells that are gone. Every file is compared with its\n"
      "hash: a cell is 'missing', 'damaged' or 'changed' where one is not what the farm wrote.\n\n"
      "Exit codes: 0 published, 1 published, but some cell is not what the farm wrote, 3 no farm in RUN,\n"
      "4 nothing can be written.\n\n"
      "Examples:\n"
      "  lobelia farm sphere_grid.xml -o run\n"
      "  lobelia gallery run -o site\n"
      "  lobelia gallery serve site");
  add_serve(*command);
  command->callback([command, run, options, &exit_code] {
    if (!command->get_subcommands().empty()) return;
    if (run->empty()) throw CLI::RequiredError("RUN");
    const gallery::PublishedGallery made = publish(*run, *options);
    fmt::print("{}\n", made.index.string());
    if (!made.doubts.empty()) exit_code = ExitCode::kDiffers;
  });
}

}  // namespace lobelia::cli

// lobelia gallery RUN, lobelia gallery publish RUN -o OUT
#include "gallery/site/gallery.hpp"

#include <fmt/format.h>

#include "base/words/text.hpp"
#include "gallery/site/publication.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/gallery/publish.hpp"
#include "program/command/messages.hpp"

namespace lobelia::cli {
namespace {

/// Says for one version what replaces the command.
void add_removed_serve(CLI::App& gallery) {
  auto* command = gallery.add_subcommand("serve", "Removed");
  command->group("");
  command->prefix_command();
  command->callback([] {
    throw Error(ExitCode::kUsage,
                "'gallery serve' was removed: type python3 -m http.server --bind 127.0.0.1 in the "
                "gallery's directory");
  });
}

/// Options that `gallery` and `gallery publish` share.
void add_site_options(CLI::App& command, OptionGroup& group,
                      const std::shared_ptr<gallery::GalleryOptions>& options) {
  command.add_flag(
      "--metrics-only", options->metrics_only,
      "No float pictures and no maps: numbers, curves and small pictures. The cells then take about a quarter of "
      "the space, and with --packed less than a fiftieth");
  group
      .add(
          "--baseline", options->baselines, "DIR",
          "An earlier run: shows what is better, worse, new and gone since then. May be repeated, the oldest "
          "first: the last is compared, and all are points of each cell's timeline")
      ->allow_extra_args(false);  // RUN may come after it
  command.add_flag_function(
      "--packed,!--no-packed", [options](std::int64_t count) { options->packed = count > 0; },
      fmt::format(
          "With --metrics-only: one page for all cells, and their data in few files. Usual from {} cells on",
          gallery::kManyCells));
  command.add_option("--title", options->title, "Title of the site in place of the grid's");
  command.add_option(
      "--base-url", options->base_url,
      "Where it will be published: https://example.org/folder, for links to it by others");
}

/// Writes the site, prints where it is, and tells the exit code.
void write_site(const std::string& run, const gallery::GalleryOptions& options, WriteSite& write,
                ExitCode& exit_code) {
  const gallery::PublishedGallery made = publish(run, options, write);
  fmt::print("{}\n", made.index.string());
  if (!made.doubts.empty() || !made.worse.empty()) exit_code = ExitCode::kDiffers;
}

void add_publish(CLI::App& gallery, ExitCode& exit_code) {
  auto* command = gallery.add_subcommand(
      "publish", "Write a gallery for others: a folder for a web server, or one HTML file");
  auto run = std::make_shared<std::string>();
  auto options = std::make_shared<gallery::GalleryOptions>();
  auto with_host = std::make_shared<bool>(false);
  command->add_option("RUN", *run, "The directory that 'lobelia farm' wrote")->required();
  OptionGroup group(*command);
  add_common(group, "--output", options->site,
             ": one HTML file if it ends in .html, otherwise a folder", "OUT")
      ->required();
  add_site_options(*command, group, options);
  command->add_option("--cell", options->only_cell,
                      "With -o OUT.html: this cell alone, by its id in farm.json");
  group.add_flag("--with-host", *with_host,
                 "Keep paths, names of hosts and users, and process IDs in records and logs");
  auto limits = std::make_shared<WorkLimits>();
  limits->add_to(group);
  command->footer(fmt::format(
      "Writes what 'lobelia gallery' does, and prints its path. A folder has .nojekyll, and its script and\n"
      "style are named by their content. Absolute paths become their file's name. Texts with names of hosts or\n"
      "users, process IDs or other paths are left out. Every hash in a cell.json is of the published file. RUN is not changed.\n"
      "OUT gets its name when it is whole; in a folder that was published before, each file does.\n\n"
      "One HTML file holds up to {} cells and {} MiB, and has no pages of studies and no files to download.\n\n"
      "Exit codes: 0 published, 1 published, but some cell is not what the farm wrote or is worse than in the\n"
      "baseline, 2 no cell of that name, 3 no farm in RUN or in a baseline, 4 nothing can be written: OUT is\n"
      "something else, or would be larger than its form allows.\n\n"
      "Examples:\n"
      "  lobelia gallery publish run -o site\n"
      "  lobelia gallery publish run -o site --metrics-only\n"
      "  lobelia gallery publish run -o cell.html --cell phong_rdf-n16",
      gallery::kMostCellsOfPage, gallery::kMostBytesOfPage >> 20));
  command->callback([run, options, with_host, limits, &exit_code] {
    options->scrubbed = !*with_host;
    limits->run([&] { write_site(*run, *options, gallery::write_publication, exit_code); });
  });
}

}  // namespace

void add_gallery(CLI::App& app, ExitCode& exit_code) {
  auto* command = app.add_subcommand("gallery", "Draw a farm's records as a static site");
  auto run = std::make_shared<std::string>();
  auto options = std::make_shared<gallery::GalleryOptions>();
  // Not required by the parser, which would ask for it with 'publish' too.
  command->add_option("RUN", *run, "The directory that 'lobelia farm' wrote");
  OptionGroup group(*command);
  add_common(group, "--output", options->site, ": the site; by default RUN itself", "DIR");
  add_site_options(*command, group, options);
  command->footer(
      "Writes an index, a page for every cell and every view, and prints the path of the index. The site\n"
      "opens from a double-click, needs no network, and may be moved or copied. A second time writes\n"
      "only what has changed, and removes the pages of cells that are gone. Every file is compared with its\n"
      "hash: a cell is 'missing', 'damaged' or 'changed' where one is not what the farm wrote.\n\n"
      "A cell is worse than in the baseline if its status or a verdict is, or if with the same verdict its\n"
      "largest difference grew: beyond both error bars, and by over 1 % of itself and of its limit. Cells\n"
      "are the same if their values on all axes are.\n\n"
      "Exit codes: 0 published, 1 published, but some cell is not what the farm wrote or is worse than in the\n"
      "baseline, 3 no farm in RUN or in a baseline, 4 nothing can be written.\n\n"
      "Examples:\n"
      "  lobelia farm sphere_grid.xml -o run\n"
      "  lobelia gallery run -o site\n"
      "  lobelia gallery run -o site --baseline last_week --baseline yesterday");
  auto limits = std::make_shared<WorkLimits>();
  limits->add_to(group);
  add_publish(*command, exit_code);
  add_removed_serve(*command);
  command->callback([command, run, options, limits, &exit_code] {
    if (!command->get_subcommands().empty()) return;
    if (run->empty()) throw CLI::RequiredError("RUN");
    limits->run([&] { write_site(*run, *options, gallery::write_gallery, exit_code); });
  });
}

}  // namespace lobelia::cli

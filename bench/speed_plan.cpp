#include <fmt/format.h>
#include <malloc.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>

#include <atomic>

#include "bench/sections.hpp"
#include "core/files.hpp"
#include "farm/grid.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::bench {
namespace {

/// A grid of `exponents` times 200 cells.
std::string grid_text(int exponents) {
  std::string text = fmt::format(
      "<grid version=\"1\"><axis name=\"scene\" values=\"{}, {}\"/>"
      "<axis name=\"model\" values=\"phong_rdf, modified_phong, blinn_phong_rdf, blinn_phong_ndf, "
      "modified_blinn_phong\"/><axis name=\"lobe\" values=\"cosine, cs16\"/><axis name=\"size\" "
      "values=\"64, 128, 256, 320x240, 512\"/><axis name=\"samples\" values=\"1, 16\"/>"
      "<axis name=\"exponent\" values=\"",
      scene_file("head_on"), scene_file("two_spheres"));
  for (int i = 1; i <= exponents; ++i) text += fmt::format("{} ", i * 1.25);
  return text + "\"/><engine name=\"povray\"/><engine name=\"blender\"/></grid>";
}

std::size_t bytes_in_use() {
  const auto info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

}  // namespace

void plan() {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "grid.xml";
  fmt::print(
      "\nPlanning a grid, {} threads: its file read, its cells, the text of every cell's scene; "
      "median of 5\n",
      oneapi::tbb::info::default_concurrency());
  fmt::print("{:>9}{:>10}{:>10}{:>10}{:>14}{:>14}{:>12}\n", "cells", "read ms", "cells ms",
             "scenes ms", "us per scene", "cells/s", "bytes/cell");
  double share = 0;
  for (const int exponents : {5, 50, 500, 5000}) {
    write_file(path, grid_text(exponents));
    const Grid grid = read_grid(path);
    const std::size_t before = bytes_in_use();
    const std::vector<Cell> cells = cells_of(grid);
    const std::size_t after = bytes_in_use();
    std::atomic<std::size_t> bytes = 0;
    const auto times =
        interleaved({[&] { (void)read_grid(path); }, [&] { (void)cells_of(grid); },
                     [&] {
                       oneapi::tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
                         bytes += scene_to_xml(scene_of(grid, cells[i])).size();
                       });
                     }},
                    5);
    if (bytes < cells.size() * 500) fmt::print("the scenes are too short to be scenes\n");
    const double n = double(cells.size());
    const double all = times[0].median + times[1].median + times[2].median;
    share = 100 * times[2].median / all;
    fmt::print("{:>9}{:>10.1f}{:>10.1f}{:>10.1f}{:>14.2f}{:>14.0f}{:>12.0f}\n", cells.size(),
               1e3 * times[0].median, 1e3 * times[1].median, 1e3 * times[2].median,
               1e6 * times[2].median / n, n / all, double(after - before) / n);
  }
  fmt::print("Limit: making the scenes and their text takes {:.0f} % of the last grid's time.\n",
             share);
}

}  // namespace lobelia::bench

#include <set>

#include "base/system/removal.hpp"
#include "farm/grid.hpp"
#include "tests/fuzz/bundle.hpp"
#include "tests/fuzz/checks.hpp"

namespace lobelia::fuzz {

/// Larger grids would find nothing more and take the time of other inputs.
constexpr std::size_t kMostCells = 200;

void check_grid_reader(std::string_view bundle) {
  static const std::filesystem::path directory = scratch() / "grid";
  remove_in_temporary_directory(directory);
  std::filesystem::create_directories(directory);
  for (const auto& [name, text] : files_of_bundle(bundle)) write_plainly(directory / name, text);
  Grid grid;
  try {
    grid = read_grid(directory / "grid.xml");
  } catch (const Error& error) {
    check_refusal(error);
    return;
  }
  if (grid.axes.empty() || grid.cell_count() > kMaxCells)
    throw std::logic_error("a grid without axes, or with too many cells");
  if (grid.cell_count() > kMostCells) return;
  std::set<std::string> ids;
  for (const Cell& cell : cells_of(grid)) {
    if (cell.id.empty() || cell.id.size() > kMaxIdBytes ||
        cell.id.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                  "_.+-") != cell.id.npos ||
        cell.id[0] == '.' || cell.id[0] == '-')
      throw std::logic_error("a cell's id is no file name: " + cell.id);
    if (!ids.insert(cell.id).second) throw std::logic_error("two cells have the id " + cell.id);
    const Scene scene = scene_of(grid, cell);
    if (scene.film.width < 1 || scene.film.height < 1)
      throw std::logic_error("a cell without pixels: " + cell.id);
  }
}

}  // namespace lobelia::fuzz

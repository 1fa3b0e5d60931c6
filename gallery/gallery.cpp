#include "gallery/gallery.hpp"

#include <string_view>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/interrupt.hpp"
#include "gallery/cell_page.hpp"
#include "gallery/cell_summary.hpp"
#include "gallery/cost_page.hpp"
#include "gallery/index_page.hpp"
#include "gallery/page.hpp"

namespace lobelia {

namespace embedded {
extern const std::string_view gallery_style;
extern const std::string_view gallery_script;
}  // namespace embedded

namespace gallery {
namespace {

/// Whether costs were measured. A record that cannot be read is said on their page.
bool write_cost_page(const std::filesystem::path& directory) {
  if (!std::filesystem::exists(directory / kCostRecord)) return false;
  std::string page;
  try {
    page = cost_page(read_cost(directory));
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    page = absent_cost_page(error.what());
  }
  write_file(directory / kCostPage, page);
  return true;
}

}  // namespace

std::filesystem::path write_gallery(const std::filesystem::path& directory) {
  const FarmData farm = read_farm(directory);
  write_file(directory / kStyleFile, embedded::gallery_style);
  write_file(directory / kScriptFile, embedded::gallery_script);
  std::vector<CellSummary> summaries;
  summaries.reserve(farm.cells.size());
  // One cell at a time: thousands of profiles need not be in memory together.
  for (const CellEntry& entry : farm.cells) {
    throw_if_interrupted();
    const CellData cell = read_cell(directory, entry);
    const auto here = directory / "cells" / entry.id;
    make_directories(here);
    write_file(here / "index.html", cell_page(farm, entry, cell));
    summaries.push_back(summarise(farm, entry, cell));
  }
  const bool has_cost = write_cost_page(directory);
  // Last, so that an index never names a page that is not there.
  write_file(directory / "index.html", index_page(farm, summaries, has_cost));
  return directory / "index.html";
}

}  // namespace gallery
}  // namespace lobelia

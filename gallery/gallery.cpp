#include "gallery/gallery.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <regex>

#include "core/interrupt.hpp"
#include "core/text.hpp"
#include "gallery/cell_page.hpp"
#include "gallery/derived_pictures.hpp"
#include "gallery/index_page.hpp"
#include "gallery/report.hpp"
#include "gallery/views.hpp"

namespace lobelia {

namespace embedded {
extern const std::string_view gallery_style;
extern const std::string_view gallery_script;
}  // namespace embedded

namespace gallery {
namespace {

namespace fs = std::filesystem;

/// The URL with a slash at its end. Throws Error(kUsage).
std::string checked_base_url(const std::string& url) {
  static const std::regex kUrl(
      R"re(https?://[A-Za-z0-9.-]+(:[0-9]{1,5})?(/[A-Za-z0-9._~%-]+)*/?)re");
  if (url.empty()) return url;
  if (url.size() > 1000 || !std::regex_match(url, kUrl))
    throw Error(
        ExitCode::kUsage,
        fmt::format("--base-url: '{}' must be like https://example.org/a/folder", printable(url)));
  return url.back() == '/' ? url : url + '/';
}

/// What is made of the cell's float pictures, and its page.
CellSummary publish_page(const GalleryOptions& options, const SiteFrame& site,
                         const ShownFarm& farm, const CellEntry& entry, CheckedCell& cell,
                         CellPictures pictures, Publisher& publisher) {
  if (!options.metrics_only) {
    publish_float_pictures(pictures, options, cell, publisher);
    publish_difference_maps(pictures, options, cell, publisher);
  }
  const std::string folder = "cells/" + entry.id + "/";
  publisher.write(folder + kCellData,
                  data_script("page", records::record_line(cell_page_data(farm, entry, cell))));
  publisher.write(folder + "index.html", cell_page(site, farm, entry, cell));
  return summarise(farm, entry, cell);
}

CellSummary publish_cell(const fs::path& run, const GalleryOptions& options, const SiteFrame& site,
                         const ShownFarm& farm, const CellEntry& entry, Publisher& publisher) {
  CheckedCell cell = check_cell(run, entry, farm.metrics, farm.hub);
  if (options.metrics_only)
    for (EnginePicture& image : cell.images) image.exr.clear();
  publish_small_pictures(run, cell, options.metrics_only, publisher);
  for (const std::string& file : files_of(cell))
    publisher.copy(run, "cells/" + entry.id + "/" + file);
  return publish_page(options, site, farm, entry, cell, CellPictures(run / "cells" / cell.id),
                      publisher);
}

CellSummary publish_pair(const Report& report, const GalleryOptions& options, const SiteFrame& site,
                         const CellEntry& entry, Publisher& publisher) {
  ReportCell made = report.cell(entry);
  CheckedCell& cell = made.cell;
  const auto publish = [&](Picture& picture) {
    const auto at = made.shown.find(picture.file);
    if (at != made.shown.end())
      picture =
          publish_shown(entry.id, picture.file, at->second, report.only_small_pictures, publisher);
  };
  for (EnginePicture& image : cell.images) publish(image.png);
  for (CheckedComparison& comparison : cell.comparisons) publish(comparison.png);
  return publish_page(options, site, report.farm, entry, cell,
                      CellPictures(std::move(made.pictures)), publisher);
}

/// The page of every cell, and then the index.
std::vector<CellSummary> publish_cells(
    const SiteFrame& site, const ShownFarm& farm, Publisher& publisher,
    const std::function<CellSummary(const CellEntry&)>& publish_one) {
  std::vector<CellSummary> summaries(farm.cells.size());
  // Only the summaries are kept: thousands of cells do not fit into memory together.
  oneapi::tbb::parallel_for(std::size_t{0}, farm.cells.size(), [&](std::size_t i) {
    throw_if_interrupted();
    summaries[i] = publish_one(farm.cells[i]);
  });
  // The index comes last, so that it never names a page that is not there.
  publisher.write(kGridData,
                  data_script("page", records::record_line(grid_page_data(farm, summaries))));
  publisher.write("index.html", index_page(site, farm, summaries));
  const EndDelay delay;
  throw_if_interrupted();
  publisher.finish();
  interrupts_come_too_late();
  return summaries;
}

void require_short_title(const GalleryOptions& options) {
  if (options.title.size() > 300) throw Error(ExitCode::kUsage, "--title: at most 300 bytes");
}

void write_frame(Publisher& publisher) {
  publisher.write(kStyleFile, embedded::gallery_style);
  publisher.write(kScriptFile, embedded::gallery_script);
}

std::vector<std::string> doubts_of(const std::vector<CellSummary>& cells) {
  std::vector<std::string> doubts;
  for (const CellSummary& cell : cells)
    if (!cell.is_as_written)
      doubts.push_back(fmt::format("{}: {}: {}", cell.entry->id, info(cell.status).word,
                                   cell.reasons.empty() ? "" : cell.reasons.front()));
  return doubts;
}

}  // namespace

PublishedGallery write_gallery(const fs::path& run, const GalleryOptions& options) {
  SiteFrame site{options.title, checked_base_url(options.base_url), {{"index.html", "Grid"}}};
  require_short_title(options);
  ShownFarm farm = read_farm(run, Metrics(options.metrics));
  if (site.title.empty()) site.title = farm.record.title;
  farm.record.title = site.title;
  Publisher publisher(options.site.empty() ? run : options.site);
  write_frame(publisher);

  std::vector<std::pair<const View*, ViewPage>> pages;
  for (const View* view : views()) {
    auto page = view->draw(run);
    if (!page) continue;
    site.pages.push_back({std::string(view->file), std::string(view->title)});
    pages.emplace_back(view, std::move(*page));
  }
  for (const auto& [view, page] : pages) {
    PageFrame frame{
        page.title, std::string(view->name), "", std::string(view->file), page.made_by, "", ""};
    if (!page.data.empty()) {
      frame.data = std::string(view->name) + ".data.js";
      publisher.write(frame.data, data_script("page", page.data));
    }
    for (const std::string& file : page.files) publisher.copy(run, file);
    publisher.write(frame.path, finish_page(site, frame, page.main));
  }

  const std::vector<CellSummary> summaries =
      publish_cells(site, farm, publisher, [&](const CellEntry& entry) {
        return publish_cell(run, options, site, farm, entry, publisher);
      });
  return {publisher.site() / "index.html", summaries.size(), doubts_of(summaries)};
}

fs::path write_report(const Report& report, const GalleryOptions& options) {
  require_short_title(options);
  const SiteFrame site{report.farm.record.title, "", {{"index.html", "Pairs"}}};
  Publisher publisher(options.site);
  write_frame(publisher);
  for (const auto& [name, text] : report.files) publisher.write(name, text);
  publish_cells(site, report.farm, publisher, [&](const CellEntry& entry) {
    return publish_pair(report, options, site, entry, publisher);
  });
  return publisher.site() / "index.html";
}

}  // namespace gallery
}  // namespace lobelia

#include "gallery/site/gallery.hpp"

#include <fmt/format.h>

#include <regex>
#include <set>

#include "base/system/for_each_whole.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/sha256.hpp"
#include "base/words/text.hpp"
#include "gallery/cells/cell_page.hpp"
#include "gallery/packed/packed_cells.hpp"
#include "gallery/pages/index_page.hpp"
#include "gallery/pages/report.hpp"
#include "gallery/pages/views.hpp"
#include "gallery/site/derived_pictures.hpp"

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
    throw Error(ExitCode::kUsage, "--base-url: '{}' must be like https://example.org/a/folder",
                printable(url));
  return url.back() == '/' ? url : url + '/';
}

/// Publishes the files made from the cell's float pictures, and its page.
CellSummary publish_page(const GalleryOptions& options, const SiteFrame& site,
                         const ShownFarm& farm, const History& history, const CellEntry& entry,
                         CheckedCell& cell, CellPictures pictures, Publisher& publisher) {
  if (!options.metrics_only) {
    publish_float_pictures(pictures, options, cell, publisher);
    publish_difference_maps(pictures, options, cell, publisher);
  }
  return publish_with_history(farm, history, entry, cell, [&](std::optional<CellHistory>& past) {
    CheckedCell* before = past && past->before ? &*past->before : nullptr;
    if (before)
      publish_before_pictures(history.baseline().directory, pictures, options, cell, *before,
                              publisher);
    const std::string folder = "cells/" + entry.id + "/";
    publisher.write(
        folder + kCellData,
        data_script("page", records::record_line(cell_page_data(farm, entry, cell, before))));
    publisher.write(folder + "index.html", cell_page(site, farm, entry, cell, history, past));
  });
}

CellSummary publish_cell(const fs::path& run, const GalleryOptions& options, const SiteFrame& site,
                         const ShownFarm& farm, const History& history, const CellEntry& entry,
                         Publisher& publisher) {
  CheckedCell cell = check_cell(run, entry, farm.metrics, farm.hub, farm.texts.get());
  if (options.metrics_only)
    for (EnginePicture& image : cell.images) image.exr.clear();
  publish_small_pictures(run, cell, options.metrics_only, publisher);
  publish_thumbnail(run, options.surface, cell, publisher);
  for (const std::string& file : files_of(cell))
    publisher.copy(run, "cells/" + entry.id + "/" + file);
  return publish_page(options, site, farm, history, entry, cell,
                      CellPictures(run / "cells" / cell.id), publisher);
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
  return publish_page(options, site, report.farm, {}, entry, cell,
                      CellPictures(std::move(made.pictures)), publisher);
}

/// The page of every cell.
std::vector<CellSummary> publish_cells(
    const ShownFarm& farm, const std::function<CellSummary(const CellEntry&)>& publish_one) {
  std::vector<CellSummary> summaries(farm.cells.size());
  // Only the summaries are kept: thousands of cells do not fit into memory together.
  for_each_whole(farm.cells.size(), [&](std::size_t i) {
    throw_if_interrupted();
    summaries[i] = publish_one(farm.cells[i]);
  });
  return summaries;
}

/// It comes last, so that it never names a page that is not there.
void publish_index(const SiteFrame& site, const ShownFarm& farm,
                   const std::vector<Finding>& findings, const History& history,
                   const std::vector<CellSummary>& summaries, bool is_part, Publisher& publisher) {
  const GridData data = grid_data(farm, summaries);
  for (const auto& [name, columns] : data.columns)
    publisher.write(name + ".data.js", data_script(name, records::record_line(columns)));
  publisher.write(kGridData, data_script("page", records::record_line(data.page)));
  publisher.write("index.html", index_page(site, farm, summaries, findings, history));
  const EndDelay delay;
  throw_if_interrupted();
  publisher.finish();
  if (!is_part) interrupts_come_too_late();
}

std::vector<std::string> worse_of(const std::vector<CellSummary>& cells) {
  std::vector<std::string> worse;
  for (const CellSummary& cell : cells)
    if (cell.change && cell.change->change == Change::kWorse)
      worse.push_back(fmt::format("{}: {}", cell.entry->id, cell.change->reason));
  return worse;
}

void check(const GalleryOptions& options) {
  if (options.title.size() > 300) throw Error(ExitCode::kUsage, "--title: at most 300 bytes");
  if (options.packed.value_or(false) && !options.metrics_only)
    throw Error(ExitCode::kUsage, "--packed has no room for float pictures: add --metrics-only");
}

/// "gallery-0123456789.js"
std::string named_by_content(const fs::path& file, std::string_view content) {
  return file.stem().string() + "-" + hex(sha256(content)).substr(0, 10) +
         file.extension().string();
}

void write_frame(Publisher& publisher, const SiteFrame& site) {
  publisher.write(site.style, embedded::gallery_style);
  publisher.write(site.script, embedded::gallery_script);
}

/// Null if all texts are published as they are.
std::shared_ptr<const PublishedTexts> texts_of(const fs::path& run, const GalleryOptions& options) {
  if (!options.scrubbed) return nullptr;
  const records::Farm farm = read_farm(run).record;
  auto texts = std::make_shared<PublishedTexts>(farm.host ? std::vector{farm.host->name}
                                                          : std::vector<std::string>());
  texts->keep_apart(farm.axes);
  return texts;
}

/// With that cell alone. Throws Error(kUsage) if there is none.
ShownFarm only(const std::string& id, ShownFarm farm) {
  if (id.empty()) return farm;
  std::vector<std::string_view> ids;
  for (const CellEntry& cell : farm.cells) ids.push_back(cell.id);
  if (std::ranges::find(ids, id) == ids.end())
    throw Error(ExitCode::kUsage, "--cell: '{}' is no cell of the run{}", printable(id),
                did_you_mean(id, ids));
  records::Farm record = std::move(farm.record);
  std::erase_if(record.cells, [&](const records::FarmCell& cell) { return cell.id != id; });
  ShownFarm one = show(std::move(record), farm.metrics);
  one.made_by = farm.made_by;
  one.texts = farm.texts;
  return one;
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
  check(options);
  ShownFarm farm =
      only(options.only_cell, read_farm(run, Metrics(options.metrics), texts_of(run, options)));
  if (site.title.empty()) site.title = farm.record.title;
  farm.record.title = site.title;
  const History history = read_history(run, farm, options.baselines);
  site.is_packed = options.packed.value_or(options.metrics_only && farm.cells.size() >= kManyCells);
  if (options.for_host) {
    site.style = named_by_content(kStyleFile, embedded::gallery_style);
    site.script = named_by_content(kScriptFile, embedded::gallery_script);
  }
  Publisher publisher(options.site.empty() ? run : options.site);
  publisher.set_texts(farm.texts);
  write_frame(publisher, site);
  // Without it GitHub Pages leaves files out.
  if (options.for_host) publisher.write(".nojekyll", "");

  std::vector<std::pair<const View*, ViewPage>> pages;
  for (const View* view : views()) {
    if (options.only_cells) break;
    auto page = view->draw({run, farm.texts.get()});
    if (!page) continue;
    site.pages.push_back({std::string(view->file), std::string(view->title)});
    pages.emplace_back(view, std::move(*page));
  }
  std::vector<Finding> findings;
  for (const auto& [view, page] : pages) {
    if (!page.finding.empty())
      findings.push_back({{std::string(view->file), std::string(view->title)}, page.finding});
    PageFrame frame{
        page.title, std::string(view->name), "", std::string(view->file), page.made_by, "", ""};
    frame.runs_web_assembly = view == &explorer_view;
    if (!page.data.empty()) {
      frame.data = std::string(view->name) + ".data.js";
      publisher.write(frame.data, data_script("page", page.data));
    }
    for (const std::string& file : page.files) publisher.copy(run, file);
    publisher.write(frame.path, finish_page(site, frame, page.main));
  }

  const std::vector<CellSummary> summaries =
      site.is_packed ? publish_packed_cells(run, options, site, farm, history, publisher)
                     : publish_cells(farm, [&](const CellEntry& entry) {
                         return publish_cell(run, options, site, farm, history, entry, publisher);
                       });
  publish_index(site, farm, findings, history, summaries, options.is_part, publisher);
  return {publisher.site() / "index.html", summaries.size(), site.title, doubts_of(summaries),
          worse_of(summaries)};
}

fs::path write_report(const Report& report, const GalleryOptions& options) {
  check(options);
  const SiteFrame site{report.farm.record.title, "", {{"index.html", "Pairs"}}};
  std::set<std::string> own{"index.html"};
  for (const auto& [name, text] : report.files) own.insert(name);
  Publisher publisher(options.site, std::move(own));
  write_frame(publisher, site);
  for (const auto& [name, text] : report.files) publisher.write(name, text);
  const std::vector<CellSummary> summaries =
      publish_cells(report.farm, [&](const CellEntry& entry) {
        return publish_pair(report, options, site, entry, publisher);
      });
  publish_index(site, report.farm, {}, {}, summaries, options.is_part, publisher);
  return publisher.site() / "index.html";
}

}  // namespace gallery
}  // namespace lobelia

#include "gallery/packed/packed_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "base/records/record.hpp"
#include "base/system/for_each_whole.hpp"
#include "base/system/interrupt.hpp"
#include "gallery/cells/cell_chunk.hpp"
#include "gallery/cells/cell_page.hpp"
#include "gallery/packed/packed_pixels.hpp"
#include "gallery/packed/packing.hpp"
#include "gallery/site/derived_pictures.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

constexpr int kPictureSide = 48, kThumbnailSide = 64;  // pixels

/// The cells in the order of their ids as links have them, which is the same for the script.
std::vector<std::size_t> sorted(const ShownFarm& farm, std::vector<std::string>& links) {
  for (const CellEntry& entry : farm.cells) links.push_back(link_to({entry.id}));
  std::vector<std::size_t> order(farm.cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) -> const std::string& { return links[i]; });
  return order;
}

/// Adds what is left of the picture, and says so in it. Returns the whole, if there is one that can be decoded.
std::optional<ShownPicture> shrink(const fs::path& folder, Picture& picture,
                                   std::vector<NamedPicture>& pictures) {
  if (!picture.shown()) return {};
  std::optional<ShownPicture> whole = ShownPicture::read(folder / picture.file);
  if (!whole) {
    picture.why_not = "The picture " + picture.file + " cannot be read.";
    return {};
  }
  DisplayImage image = whole->within(kPictureSide);
  picture.small = {picture.file, image.width, image.height};
  picture.is_published = false;
  pictures.push_back({link_to({picture.file}), std::move(image)});
  return whole;
}

struct ShrunkPictures {
  std::vector<NamedPicture> of_page;
  DisplayImage thumbnail{};  ///< no pixels if there is no picture
};

/// Ours first: the others are kept as their differences from it.
ShrunkPictures shrink_pictures(const fs::path& run, const SurfaceOf& surface_of,
                               CheckedCell& cell) {
  const fs::path folder = run / "cells" / cell.id;
  ShrunkPictures shrunk;
  for (EnginePicture& image : cell.images)
    if (image.engine == cell.hub)
      if (const auto ours = shrink(folder, image.png, shrunk.of_page))
        shrunk.thumbnail =
            small_thumbnail(ours->light(), run, surface_of, cell, kThumbnailSide).image;
  for (EnginePicture& image : cell.images)
    if (image.engine != cell.hub) shrink(folder, image.png, shrunk.of_page);
  for (CheckedComparison& comparison : cell.comparisons)
    shrink(folder, comparison.png, shrunk.of_page);
  return shrunk;
}

records::Thumbnails packed_thumbnails(const std::vector<DisplayImage>& images) {
  PackedPixels packed = packed_pixels(images);
  records::Thumbnails thumbnails{{}, {}, std::move(packed.ways), packed_bytes(packed.bytes)};
  for (const DisplayImage& image : images) {
    thumbnails.widths.push_back(image.width);
    thumbnails.heights.push_back(image.height);
  }
  return thumbnails;
}

void write_page(const SiteFrame& site, const ShownFarm& farm, records::CellIndex index,
                Publisher& publisher) {
  Html html;
  html.element("h1", "A cell");
  html.element("p", {{"class", "absent"}},
               "This page needs its script: allow scripts to see the cell.");
  publisher.write("cell.data.js", data_script("page", records::record_line(index)));
  publisher.write(
      "cell.html",
      finish_page(site, {"Cell", "packed", "", "cell.html", farm.made_by, "cell.data.js", ""},
                  html));
}

}  // namespace

std::vector<CellSummary> publish_packed_cells(const fs::path& run, const GalleryOptions& options,
                                              const SiteFrame& site, const ShownFarm& farm,
                                              const History& history, Publisher& publisher) {
  std::vector<CellSummary> summaries(farm.cells.size());
  std::vector<std::string> links;
  const std::vector<std::size_t> order = sorted(farm, links);
  const std::size_t chunks = (order.size() + kCellsOfChunk - 1) / kCellsOfChunk;
  for_each_whole(chunks, [&](std::size_t number) {
    CellChunk chunk;
    std::vector<DisplayImage> thumbnails;
    const std::size_t end = std::min(order.size(), (number + 1) * kCellsOfChunk);
    for (std::size_t place = number * kCellsOfChunk; place < end; ++place) {
      throw_if_interrupted();
      const CellEntry& entry = farm.cells[order[place]];
      CheckedCell cell = check_cell(run, entry, farm.metrics, farm.hub, farm.texts.get());
      ShrunkPictures pictures = shrink_pictures(run, options.surface, cell);
      thumbnails.push_back(std::move(pictures.thumbnail));
      CellSummary& summary = summaries[order[place]] = publish_with_history(
          farm, history, entry, cell, [&](const std::optional<CellHistory>& past) {
            chunk.add(entry.id, cell_main(site, farm, entry, cell, history, past).str(),
                      cell_page_data(farm, entry, cell, nullptr), std::move(pictures.of_page));
          });
      summary.place = int(place);
    }
    const auto write = [&](const char* kind, const std::string& line) {
      publisher.write(fmt::format("packed/{}.{}.data.js", number, kind),
                      data_script(fmt::format("{}.{}", kind, number), line));
    };
    write("cells", records::record_line(chunk.packed()));
    write("thumbnails", records::record_line(packed_thumbnails(thumbnails)));
  });
  records::CellIndex index;
  for (std::size_t place = 0; place < order.size(); place += kCellsOfChunk)
    index.first.push_back(links[order[place]]);
  write_page(site, farm, std::move(index), publisher);
  return summaries;
}

}  // namespace lobelia::gallery

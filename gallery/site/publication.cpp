#include "gallery/site/publication.hpp"

#include <fmt/format.h>

#include <fstream>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/no_resources.hpp"
#include "base/system/removal.hpp"
#include "base/words/text.hpp"
#include "gallery/cells/shown_farm.hpp"
#include "gallery/pages/single_file.hpp"
#include "gallery/site/publisher.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

/// Limits on float pictures and maps, which GalleryOptions::share_of_bytes scales down.
constexpr double kBytesOfPixels = 40 << 20, kBytesOfComparison = 512 << 10;

enum class Form { kFolder, kPage };

Form form_of(const fs::path& out) {
  const std::string ending = lower_case(out.extension().string());
  if (ending == ".zip")
    throw Error(ExitCode::kUsage,
                "{}: no zip is written: publish a folder, then type zip -r {} FOLDER",
                printable_path(out.string()), shell_quote(out.string()));
  return ending == ".html" ? Form::kPage : Form::kFolder;
}

[[noreturn]] void refuse(const fs::path& out, const std::string& why) {
  throw Error(ExitCode::kOutput, "{}: {}", printable_path(out.string()), why);
}

bool is_our_page(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string begin(4096, '\0');
  file.read(begin.data(), std::streamsize(begin.size()));
  return begin.find(kSingleFileMark) != begin.npos;
}

/// A publication that was killed at its first file leaves that unfinished.
bool is_empty_but_for_parts(const fs::path& directory) {
  std::error_code error;
  fs::directory_iterator entry(directory, error);
  for (const fs::directory_iterator end; !error && entry != end; entry.increment(error))
    if (!is_part_name(entry->path().filename().native())) return false;
  return !error;
}

/// Refuses what is there and is not ours.
void check_place(const fs::path& run, const fs::path& out, Form form) {
  std::error_code error;
  const fs::path real_run = fs::canonical(run, error);
  if (error && !tells_of_file(error.value()))
    throw failure_of(run.string() + ": cannot read", error.value(), ExitCode::kInput);
  const fs::path real_out = fs::weakly_canonical(out, error);
  if (error) refuse(out, error.message());
  if (!real_run.empty() && is_below(real_out, real_run))
    refuse(out, "is RUN or in it, which publishing must not change; give another name");
  const fs::file_status status = fs::symlink_status(out, error);
  if (status.type() == fs::file_type::none) refuse(out, error.message());
  if (!fs::exists(status)) return;
  if (fs::is_symlink(status)) refuse(out, "is a link, which is not followed; give another name");
  const bool is_ours = form == Form::kFolder
                           ? fs::is_directory(status) && (kind_of_site(out) == SiteKind::kGallery ||
                                                          is_empty_but_for_parts(out))
                           : fs::is_regular_file(status) && is_our_page(out);
  if (!is_ours)
    refuse(out, "is there already, and is not a gallery that was published; give another name");
  if (form == Form::kFolder && fs::exists(out / "farm.json", error))
    refuse(out, "is the directory of a farm, which publishing must not change");
}

/// "out/gallery" for "out/gallery/".
fs::path without_slash(const fs::path& out) { return out.has_filename() ? out : out.parent_path(); }

PublishedGallery write_folder(const fs::path& run, GalleryOptions options, const fs::path& out) {
  const fs::path parent = out.has_parent_path() ? out.parent_path() : fs::path(".");
  make_directories(parent);
  remove_dead_temporaries(parent);
  if (file_type_at(out, ExitCode::kOutput) != fs::file_type::not_found)
    return write_gallery(run, options);
  const TemporaryDirectory unfinished(parent);
  options.is_part = true;
  options.site = unfinished.path() / "site";
  PublishedGallery made = write_gallery(run, options);
  const EndDelay delay;
  throw_if_interrupted();
  std::error_code error;
  fs::rename(options.site, out, error);
  if (error) refuse(out, error.message());
  interrupts_come_too_late();
  made.index = out / "index.html";
  return made;
}

PublishedGallery write_page(const fs::path& run, GalleryOptions options, const fs::path& out) {
  const records::Farm farm = read_farm(run).record;
  const std::size_t count = options.only_cell.empty() ? farm.cells.size() : 1;
  const std::string instead = "publish a folder, with --metrics-only --packed if it is to be small";
  if (count > kMostCellsOfPage)
    refuse(out, fmt::format("one file holds at most {} cells, and the run has {}: {}",
                            kMostCellsOfPage, count, instead));
  options.only_cells = true;
  options.for_host = false;
  options.packed = false;
  options.is_part = true;
  options.share_of_bytes = std::min(
      1.0, kBytesOfPixels / (kBytesOfComparison * double(count * farm.engines.size() + 1)));
  const TemporaryDirectory site;
  options.site = site.path();
  PublishedGallery made = write_gallery(run, options);
  const std::string page =
      single_file(site.path(), options.title.empty() ? made.title : options.title,
                  options.only_cell.empty() ? "" : "cells/" + options.only_cell + "/index.html");
  if (page.size() > kMostBytesOfPage)
    refuse(out, fmt::format("one file holds at most {} MiB, and this would have {}: {}",
                            kMostBytesOfPage >> 20, page.size() >> 20, instead));
  write_file(out, page, AtLink::kReplace);
  interrupts_come_too_late();
  made.index = out;
  return made;
}

}  // namespace

PublishedGallery write_publication(const fs::path& run, const GalleryOptions& given) {
  GalleryOptions options = given;
  const fs::path out = without_slash(options.site);
  const Form form = form_of(out);
  if (!options.only_cell.empty() && form != Form::kPage)
    throw Error(ExitCode::kUsage, "--cell is for one HTML file: give -o OUT.html");
  check_place(run, out, form);
  options.for_host = true;
  if (form == Form::kFolder) return write_folder(run, std::move(options), out);
  if (out.has_parent_path()) make_directories(out.parent_path());
  require_writable(out);
  return write_page(run, std::move(options), out);
}

}  // namespace lobelia::gallery

#include "gallery/cells/checked_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/pictures/image_io.hpp"
#include "base/records/record.hpp"
#include "base/system/error.hpp"
#include "base/system/sha256.hpp"
#include "base/words/text.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::size_t count_nonfinite_pixels(const Image& image) {
  std::size_t count = 0;
  const auto values = image.values();
  for (std::size_t i = 0; i < values.size(); i += 3)
    count += !std::all_of(&values[i], &values[i] + 3, [](float v) { return std::isfinite(v); });
  return count;
}

/// Why a file with another hash is not even a whole file of its kind; empty if it is one.
std::string damage_of(const fs::path& directory, const std::string& file) {
  try {
    if (file.ends_with(".png")) return inspect_picture(directory, file).why_not;
    if (file.ends_with(".exr")) {
      const std::size_t count = count_nonfinite_pixels(read_image(directory / file));
      if (count > 0)
        return fmt::format("{} has {} {} that {} not finite.", file, count,
                           count == 1 ? "pixel" : "pixels", count == 1 ? "is" : "are");
    }
    if (file.ends_with(".json") &&
        !records::is_json(read_file(directory / file, records::kMaxRecordBytes)))
      return file + " is not JSON.";
    return "";
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    return file + " cannot be read: it is damaged or incomplete.";
  }
}

/// The SHA-256; empty for a file that cannot be read.
std::string hash_now(const fs::path& path) {
  try {
    return hex(sha256_of_file(path));
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    return "";
  }
}

/// Messages name files with the path we opened; a page that may be moved must not.
std::string without_directory(std::string message, const fs::path& directory) {
  const std::string prefix = directory.string() + "/";
  for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix, at)) {
    message.erase(at, prefix.size());
  }
  return message;
}

/// Reads the files that cell.json names, unless they have a flaw; adds every flaw to the cell.
class CellReader {
 public:
  CellReader(fs::path directory, const PublishedTexts* texts, CheckedCell& cell)
      : directory_(std::move(directory)), texts_(texts), cell_(cell) {}

  void read();

 private:
  void check_hashes();
  EnginePicture read_image(const records::CellImage& entry);
  CheckedComparison read_comparison(const records::CellComparison& entry);
  const Flaw* flaw_of(const std::string& file) const;
  /// `file` if it is there and has no flaw, otherwise "".
  std::string use(const std::string& file);
  Picture picture(const std::string& file);
  /// Returns why it cannot be read; empty if it can.
  template <class T>
  std::string read_named(const std::string& file, T& record, std::string* made_by = nullptr);

  fs::path directory_;
  const PublishedTexts* texts_;
  std::map<std::string, std::string> hashes_;  ///< SHA-256 in cell.json, by file name
  CheckedCell& cell_;
};

/// Hashes every file that the record lists. Throws Error(kInput) if it lists one twice.
void CellReader::check_hashes() {
  for (const auto& [file, sealed] : cell_.record.files) {
    if (!hashes_.emplace(file, sealed).second)
      throw Error(ExitCode::kInput, "cell.json: files: {} stands there twice", file);
    if (!is_file(directory_ / file)) {
      cell_.flaws.push_back({file, CellStatus::kLost, file + " is missing."});
      continue;
    }
    const std::string now = hash_now(directory_ / file);
    if (now == sealed) continue;
    const std::string damage = damage_of(directory_, file);
    if (!damage.empty())
      cell_.flaws.push_back({file, CellStatus::kDamaged, damage});
    else
      cell_.flaws.push_back(
          {file, CellStatus::kChanged,
           fmt::format("{} is not the file that the farm wrote (SHA-256 {}…, was {}…).", file,
                       now.substr(0, 12), sealed.substr(0, 12))});
  }
}

const Flaw* CellReader::flaw_of(const std::string& file) const {
  const auto at = std::ranges::find(cell_.flaws, file, &Flaw::file);
  return at == cell_.flaws.end() ? nullptr : &*at;
}

std::string CellReader::use(const std::string& file) {
  if (file.empty() || flaw_of(file)) return "";
  const bool is_listed = hashes_.contains(file);
  if (!is_listed && !is_file(directory_ / file)) {
    cell_.flaws.push_back({file, CellStatus::kLost, file + " is missing."});
    return "";
  }
  cell_.is_sealed = cell_.is_sealed && is_listed;
  return file;
}

Picture CellReader::picture(const std::string& file) {
  const std::string whole = use(file);
  if (whole.empty() && !file.empty()) return {file, 0, 0, flaw_of(file)->message};
  Picture picture = inspect_picture(directory_, whole);
  if (!whole.empty() && !picture.shown())
    cell_.flaws.push_back({file, CellStatus::kDamaged, picture.why_not});
  return picture;
}

template <class T>
std::string CellReader::read_named(const std::string& file, T& record, std::string* made_by) {
  if (use(file).empty()) return flaw_of(file)->message;
  try {
    records::Origin origin;
    const fs::path path = directory_ / file;
    record = read_published<T>(path, texts_, path.string(), &origin);
    if (made_by) *made_by = origin.made_by;
    return "";
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    cell_.flaws.push_back(
        {file, CellStatus::kDamaged, without_directory(error.what(), directory_)});
    return cell_.flaws.back().message;
  }
}

EnginePicture CellReader::read_image(const records::CellImage& entry) {
  EnginePicture image;
  image.engine = entry.engine;
  image.png = picture(entry.png);
  image.exr = use(entry.exr);
  if (!image.exr.empty())
    image.exr_sha256 = hashes_.contains(image.exr) ? hashes_[image.exr]
                                                   : hex(sha256_of_file(directory_ / image.exr));
  const std::string log = image.engine + ".log";
  if (is_file(directory_ / log) && !flaw_of(log)) image.log = log;
  image.problem = image.engine == kOurEngine
                      ? read_named(entry.record, image.render.emplace(), &image.made_by)
                      : read_named(entry.record, image.reference.emplace(), &image.made_by);
  if (image.problem.empty())
    image.record = entry.record;
  else
    image.render.reset(), image.reference.reset();
  return image;
}

CheckedComparison CellReader::read_comparison(const records::CellComparison& entry) {
  CheckedComparison comparison;
  comparison.entry = entry;
  comparison.png = picture(entry.png);
  comparison.problem = read_named(entry.record, comparison.record);
  comparison.verdict = comparison.record.verdict;
  return comparison;
}

void CellReader::read() {
  const records::Cell& record = cell_.record;
  check_hashes();
  if (record.id != cell_.id)
    throw Error(ExitCode::kInput, "cell.json: id: '{}' is not the name of the cell's directory",
                printable(record.id));
  cell_.status = *find_status(record.status);
  for (const auto& image : record.images) cell_.images.push_back(read_image(image));
  for (const auto& comparison : record.comparisons)
    cell_.comparisons.push_back(read_comparison(comparison));
  if (!record.profile.empty()) {
    cell_.profile_problem = read_named(record.profile, cell_.profile.emplace());
    if (!cell_.profile_problem.empty()) cell_.profile.reset();
  }
  if (flaw_of("scene.xml")) cell_.has_scene = false;
}

}  // namespace

std::optional<double> CheckedComparison::metric(const std::string& id) const {
  const double* value = records::find(record.metrics, id);
  return value ? std::optional(*value) : std::nullopt;
}

const EnginePicture* CheckedCell::find_image(const std::string& engine) const {
  const auto at = std::ranges::find(images, engine, &EnginePicture::engine);
  return at == images.end() ? nullptr : &*at;
}

const CheckedComparison* CheckedCell::find_comparison(const std::string& other) const {
  const auto at = std::ranges::find_if(
      comparisons, [&](const CheckedComparison& one) { return other_of(one) == other; });
  return at == comparisons.end() ? nullptr : &*at;
}

CheckedCell check_cell(const fs::path& directory, const CellEntry& entry, const Metrics& metrics,
                       const std::string& hub, const PublishedTexts* texts) {
  const fs::path here = directory / "cells" / entry.id;
  CheckedCell cell;
  cell.id = entry.id;
  cell.hub = hub;
  cell.status = entry.status;
  cell.has_scene = is_file(here / "scene.xml");
  const bool is_there = is_file(here / "cell.json");
  // A cell that was never begun, or that failed early, has no record.
  if (!is_there && (cell.status == CellStatus::kMissing || cell.status == CellStatus::kFailed))
    return cell;
  records::Origin origin;
  try {
    CheckedCell whole = cell;
    const fs::path file = here / "cell.json";
    whole.record = read_published<records::Cell>(file, texts, file.string(), &origin);
    if (origin.seal != records::Origin::Seal::kBroken) {
      whole.is_sealed = origin.seal == records::Origin::Seal::kFits;
      whole.made_by = origin.made_by;
      CellReader(here, texts, whole).read();
      whole.has_record = true;
      judge_cell(whole, metrics);
      return whole;
    }
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    cell.status = is_there ? CellStatus::kDamaged : CellStatus::kLost;
    cell.unreadable = without_directory(error.what(), here);
  }
  if (origin.seal == records::Origin::Seal::kBroken) {
    cell.status = CellStatus::kChanged;
    cell.unreadable = "cell.json is not the record that the farm wrote: its seal does not fit.";
  }
  return cell;
}

std::vector<std::string> files_of(const CheckedCell& cell) {
  std::vector<std::string> files;
  const auto add = [&](const std::string& file) {
    if (!file.empty()) files.push_back(file);
  };
  if (cell.has_scene) add("scene.xml");
  if (cell.has_record) add("cell.json");
  for (const EnginePicture& image : cell.images) {
    for (const std::string& file : {image.exr, image.record, image.log}) add(file);
    if (image.png.shown() && image.png.is_published) add(image.png.file);
  }
  for (const CheckedComparison& comparison : cell.comparisons) {
    if (comparison.problem.empty()) add(comparison.entry.record);
    if (comparison.png.shown() && comparison.png.is_published) add(comparison.png.file);
  }
  if (cell.profile) add(cell.record.profile);
  return files;
}

}  // namespace lobelia::gallery

#include "gallery/cell_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/seal.hpp"
#include "core/text.hpp"
#include "gallery/judgement.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// Messages name files with the path we opened; a page that may be moved must not.
std::string without_directory(std::string message, const fs::path& directory) {
  const std::string prefix = directory.string() + "/";
  for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix, at)) {
    message.erase(at, prefix.size());
  }
  return message;
}

/// The record's facts that are printed as they stand, in this order where they are there.
constexpr const char* kFacts[][2] = {{"method", "Method"}, {"samples", "Samples per pixel"},
                                     {"rays", "Rays"},     {"instructionSet", "Instruction set"},
                                     {"passes", "Passes"}, {"engineOptions", "Options"}};

void read_engine_record(const Json& record, CellImage& image) {
  const Fields fields(record, image.record);
  image.made_by = fields.text("madeBy");
  if (const auto engine = fields.object("engine")) image.version = engine->text("version");
  const auto command = fields.texts("command");
  if (!command.empty()) image.command = shell_join(command);
  image.engine_commands = fields.texts("engineCommands");
  image.witness = fields.text("witness");
  if (const auto seconds = fields.object("seconds")) image.seconds = seconds->number_members();
  for (const auto& [key, title] : kFacts) {
    if (std::string words = fields.described(key); !words.empty()) {
      image.facts.emplace_back(title, std::move(words));
    }
  }
  if (const auto plan = fields.object("plan")) {
    for (const Fields& effect : plan->objects("effects")) {
      image.effects.push_back({effect.text("name"), effect.flag("on"), effect.text("reason")});
    }
  }
}

void read_comparison_record(const Json& record, CellComparison& comparison) {
  const Fields fields(record, comparison.record);
  comparison.verdict = fields.text("verdict");
  if (const auto counts = fields.object("nonfinite")) {
    comparison.nonfinite_a = counts->number("a");
    comparison.nonfinite_b = counts->number("b");
  }
  if (const auto viewing = fields.object("viewing")) {
    comparison.viewing = viewing->described_members();
    if (!viewing->object("display")) {
      comparison.exposure_stops = viewing->number("exposureStops");
      comparison.pixels_per_degree = viewing->number("pixelsPerDegree");
    }
  }
  if (const auto metrics = fields.object("metrics")) comparison.metrics = metrics->number_members();
  for (const Fields& limit : fields.objects("limits")) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const std::string standing = limit.text("standing");
    comparison.limits.push_back({limit.text("metric"), limit.number("limit").value_or(kNone),
                                 limit.number("value").value_or(kNone), limit.flag("pass"),
                                 !standing.empty(), standing == "open"});
  }
  if (const auto bars = fields.object("errorBars")) {
    for (const auto& [metric, bar] : bars->object_members()) {
      const auto low = bar.number("low"), high = bar.number("high");
      if (low && high)
        comparison.error_bars.push_back(
            {metric, *low, *high, bar.number("noiseFloor").value_or(0)});
    }
  }
  if (const auto tolerance = fields.object("tolerance")) {
    comparison.tolerance = Tolerance{tolerance->number("relative"), tolerance->number("ofPeak"),
                                     tolerance->number("allowedOutliers")};
  }
}

/// Reads what cell.json names, as far as it is as the farm wrote it; notes every flaw in the cell.
class CellReader {
 public:
  CellReader(fs::path directory, const Json& record, CellData& cell)
      : directory_(std::move(directory)),
        fields_(record, "cell.json"),
        evidence_(directory_, fields_),
        cell_(cell) {
    cell_.flaws = evidence_.flaws();
    if (fields_.text("seal").empty()) cell_.is_sealed = false;
  }

  void read();

 private:
  CellImage read_image(const Fields& entry);
  CellComparison read_comparison(const Fields& entry);
  const Flaw* flaw_of(const std::string& file) const;
  /// `file` if it is there and as it was, otherwise nothing.
  std::string use(const std::string& file);
  Picture picture(const std::string& file);
  /// Gives the record to `take`. Returns why it cannot be read; empty if it can.
  template <class Take>
  std::string read_named(const std::string& file, const char* kind, const char* what, Take take);

  fs::path directory_;
  Fields fields_;
  Evidence evidence_;
  CellData& cell_;
};

const Flaw* CellReader::flaw_of(const std::string& file) const {
  const auto at = std::ranges::find(cell_.flaws, file, &Flaw::file);
  return at == cell_.flaws.end() ? nullptr : &*at;
}

std::string CellReader::use(const std::string& file) {
  if (file.empty() || flaw_of(file)) return "";
  if (evidence_.has(file)) return file;
  if (is_file(directory_ / file)) {
    cell_.is_sealed = false;
    return file;
  }
  cell_.flaws.push_back({file, CellStatus::kLost, file + " is missing."});
  return "";
}

Picture CellReader::picture(const std::string& file) {
  const std::string whole = use(file);
  if (whole.empty() && !file.empty()) return {file, 0, 0, flaw_of(file)->message};
  Picture picture = look_at_picture(directory_, whole);
  if (!whole.empty() && !picture.shown())
    cell_.flaws.push_back({file, CellStatus::kDamaged, picture.why_not});
  return picture;
}

template <class Take>
std::string CellReader::read_named(const std::string& file, const char* kind, const char* what,
                                   Take take) {
  const std::string missing = fmt::format("cell.json names no record of this {}.", what);
  if (use(file).empty()) return file.empty() ? missing : flaw_of(file)->message;
  try {
    take(read_record(directory_ / file, kind));
    return "";
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    cell_.flaws.push_back(
        {file, CellStatus::kDamaged, without_directory(error.what(), directory_)});
    return cell_.flaws.back().message;
  }
}

CellImage CellReader::read_image(const Fields& entry) {
  CellImage image;
  image.engine = entry.plain_name("engine");
  if (image.engine.empty()) entry.fail("engine", "must not be empty");
  image.png = picture(entry.plain_name("png"));
  image.exr = use(entry.plain_name("exr"));
  if (!image.exr.empty()) image.exr_sha256 = evidence_.hash_of(image.exr);
  const std::string log = image.engine + ".log";
  if (is_file(directory_ / log) && !flaw_of(log)) image.log = log;
  const std::string record = entry.plain_name("record");
  // Ours is a render, everybody else's a reference.
  image.problem = read_named(record, image.engine == kOurEngine ? "render" : "reference", "picture",
                             [&](const Json& json) {
                               image.record = record;
                               read_engine_record(json, image);
                             });
  return image;
}

CellComparison CellReader::read_comparison(const Fields& entry) {
  CellComparison comparison;
  comparison.a = entry.plain_name("a");
  comparison.b = entry.plain_name("b");
  comparison.png = picture(entry.plain_name("png"));
  if (const auto difference = entry.object("difference")) {
    comparison.white_at = difference->number("whiteAt");
    comparison.relative_to_peak = difference->number("relativeToPeak");
  }
  comparison.record = entry.plain_name("record");
  comparison.problem =
      read_named(comparison.record, "comparison", "comparison",
                 [&](const Json& json) { read_comparison_record(json, comparison); });
  return comparison;
}

void CellReader::read() {
  if (fields_.text("id") != cell_.id) {
    fields_.fail("id", "must be the name of the cell's directory, not '" +
                           printable(fields_.text("id")) + "'");
  }
  if (const auto status = find_status(fields_.text("status"))) {
    cell_.status = *status;
  } else {
    fields_.fail("status", "must be pass, differs, undecided, failed, unchecked or missing");
  }
  cell_.made_by = fields_.text("madeBy");
  if (const auto highlight = fields_.object("highlight")) {
    cell_.highlight = highlight->described_members();
  }
  cell_.exposure_stops = fields_.number("exposureStops");
  for (const Fields& problem : fields_.objects("problems")) {
    cell_.problems.push_back({problem.text("engine"), problem.text("message")});
  }
  for (const Fields& one : fields_.objects("notComparable")) {
    cell_.not_comparable.push_back({one.text("engine"), one.text("because")});
  }
  for (const Fields& image : fields_.objects("images")) cell_.images.push_back(read_image(image));
  for (const Fields& comparison : fields_.objects("comparisons"))
    cell_.comparisons.push_back(read_comparison(comparison));
  const std::string profile = fields_.plain_name("profile");
  if (use(profile).empty()) {
    cell_.profile.file = profile;
    if (!profile.empty()) cell_.profile.problem = flaw_of(profile)->message;
  } else {
    cell_.profile = read_profile(directory_, profile);
    cell_.profile.problem = without_directory(cell_.profile.problem, directory_);
    if (!cell_.profile.problem.empty())
      cell_.flaws.push_back({profile, CellStatus::kDamaged, cell_.profile.problem});
  }
  if (flaw_of("scene.xml")) cell_.has_scene = false;
}

/// Whether its seal fits, and no byte of the file is another than the farm writes.
bool is_sealed(const Json& record, const fs::path& file) {
  const std::string text = record_text(record);
  return record["seal"] == seal_of(record) && read_file(file, text.size() + 1) == text;
}

}  // namespace

std::optional<double> CellComparison::metric(const std::string& id) const {
  const auto at = std::find_if(metrics.begin(), metrics.end(),
                               [&](const auto& metric) { return metric.first == id; });
  if (at == metrics.end()) return std::nullopt;
  return at->second;
}

const CellImage* CellData::find_image(const std::string& engine) const {
  const auto at = std::find_if(images.begin(), images.end(),
                               [&](const CellImage& image) { return image.engine == engine; });
  return at == images.end() ? nullptr : &*at;
}

const CellComparison* CellData::find_comparison(const std::string& b) const {
  const auto at = std::find_if(comparisons.begin(), comparisons.end(),
                               [&](const CellComparison& comparison) { return comparison.b == b; });
  return at == comparisons.end() ? nullptr : &*at;
}

CellData read_cell(const fs::path& directory, const CellEntry& entry) {
  const fs::path here = directory / "cells" / entry.id;
  CellData cell;
  cell.id = entry.id;
  cell.status = entry.status;
  cell.has_scene = is_file(here / "scene.xml");
  // A cell that was never begun, or that failed before it had anything to say, has no record.
  const bool may_be_absent =
      entry.status == CellStatus::kMissing || entry.status == CellStatus::kFailed;
  const bool is_there = is_file(here / "cell.json");
  if (may_be_absent && !is_there) return cell;
  try {
    CellData full = cell;
    const Json record = read_record(here / "cell.json", "cell");
    if (record.contains("seal") && !is_sealed(record, here / "cell.json")) {
      cell.status = CellStatus::kChanged;
      cell.unreadable = "cell.json is not the record that the farm wrote: its seal does not fit.";
    } else {
      CellReader(here, record, full).read();
      full.has_record = true;
      judge_cell(full);
      return full;
    }
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    cell.status = is_there ? CellStatus::kDamaged : CellStatus::kLost;
    cell.unreadable = without_directory(error.what(), here);
  }
  return cell;
}

std::vector<std::string> files_of(const CellData& cell) {
  std::vector<std::string> files;
  const auto add = [&](const std::string& file) {
    if (!file.empty()) files.push_back(file);
  };
  if (cell.has_scene) add("scene.xml");
  if (cell.has_record) add("cell.json");
  for (const CellImage& image : cell.images) {
    for (const std::string& file : {image.exr, image.record, image.log}) add(file);
    if (image.png.shown() && image.png.is_published) add(image.png.file);
  }
  for (const CellComparison& comparison : cell.comparisons) {
    if (comparison.problem.empty()) add(comparison.record);
    if (comparison.png.shown() && comparison.png.is_published) add(comparison.png.file);
  }
  if (cell.profile.problem.empty()) add(cell.profile.file);
  return files;
}

}  // namespace lobelia::gallery

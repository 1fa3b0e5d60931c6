#include "gallery/cell_data.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/sha256.hpp"
#include "core/text.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::string if_there(const fs::path& directory, const std::string& file) {
  return !file.empty() && is_file(directory / file) ? file : "";
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

CellImage read_image(const fs::path& directory, const Fields& entry) {
  CellImage image;
  image.engine = entry.plain_name("engine");
  if (image.engine.empty()) entry.fail("engine", "must not be empty");
  image.png = look_at_picture(directory, entry.plain_name("png"));
  image.exr = if_there(directory, entry.plain_name("exr"));
  image.log = if_there(directory, image.engine + ".log");
  const std::string record = entry.plain_name("record");
  image.record = if_there(directory, record);
  try {
    if (!image.exr.empty()) image.exr_sha256 = hex(sha256_of_file(directory / image.exr));
    if (record.empty()) throw Error(ExitCode::kInput, "cell.json names no record of this picture");
    // Ours is a render, everybody else's a reference.
    const char* kind = image.engine == kOurEngine ? "render" : "reference";
    read_engine_record(read_record(directory / record, kind), image);
  } catch (const Error& error) {
    image.problem = without_directory(error.what(), directory);
  }
  return image;
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
    comparison.limits.push_back({limit.text("metric"), limit.number("limit").value_or(0),
                                 limit.number("value").value_or(0), limit.flag("pass"),
                                 limit.text("standing") == "open"});
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

CellComparison read_comparison(const fs::path& directory, const Fields& entry) {
  CellComparison comparison;
  comparison.a = entry.plain_name("a");
  comparison.b = entry.plain_name("b");
  comparison.png = look_at_picture(directory, entry.plain_name("png"));
  if (const auto difference = entry.object("difference")) {
    comparison.white_at = difference->number("whiteAt");
    comparison.relative_to_peak = difference->number("relativeToPeak");
  }
  const std::string record = entry.plain_name("record");
  comparison.record = if_there(directory, record);
  try {
    if (record.empty())
      throw Error(ExitCode::kInput, "cell.json names no record of this comparison");
    read_comparison_record(read_record(directory / record, "comparison"), comparison);
  } catch (const Error& error) {
    comparison.problem = without_directory(error.what(), directory);
  }
  return comparison;
}

void read_cell_record(const fs::path& directory, const Json& record, CellData& cell) {
  const Fields fields(record, "cell.json");
  if (fields.text("id") != cell.id) {
    fields.fail("id", "must be the name of the cell's directory, not '" +
                          printable(fields.text("id")) + "'");
  }
  if (const auto status = find_status(fields.text("status"))) {
    cell.status = *status;
  } else {
    fields.fail("status", "must be pass, differs, undecided, failed, unchecked or missing");
  }
  cell.made_by = fields.text("madeBy");
  if (const auto highlight = fields.object("highlight")) {
    cell.highlight = highlight->described_members();
  }
  cell.exposure_stops = fields.number("exposureStops");
  for (const Fields& problem : fields.objects("problems")) {
    cell.problems.push_back({problem.text("engine"), problem.text("message")});
  }
  for (const Fields& one : fields.objects("notComparable")) {
    cell.not_comparable.push_back({one.text("engine"), one.text("because")});
  }
  for (const Fields& image : fields.objects("images")) {
    cell.images.push_back(read_image(directory, image));
  }
  for (const Fields& comparison : fields.objects("comparisons")) {
    cell.comparisons.push_back(read_comparison(directory, comparison));
  }
  cell.profile = read_profile(directory, fields.plain_name("profile"));
  cell.profile.problem = without_directory(cell.profile.problem, directory);
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
  if (may_be_absent && !is_file(here / "cell.json")) return cell;
  try {
    CellData full = cell;
    read_cell_record(here, read_record(here / "cell.json", "cell"), full);
    full.has_record = true;
    return full;
  } catch (const Error& error) {
    cell.status = CellStatus::kUnreadable;
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
    add(comparison.record);
    if (comparison.png.shown() && comparison.png.is_published) add(comparison.png.file);
  }
  if (cell.profile.problem.empty()) add(cell.profile.file);
  return files;
}

}  // namespace lobelia::gallery

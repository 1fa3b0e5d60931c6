#include "tests/gallery/fake_farm.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/pictures/image_io.hpp"
#include "base/records/comparison.hpp"
#include "base/records/profile.hpp"
#include "base/records/render.hpp"
#include "base/system/sha256.hpp"

namespace lobelia::gallery {
namespace fs = std::filesystem;
namespace {

records::EngineUsed used(const std::string& engine) { return {engine, "", "1.2.3"}; }
records::ImageFile picture_of(const std::string& engine) { return {engine + ".exr", 2, 2}; }

void write_pictures(const fs::path& cell, const std::string& engine) {
  write_exr(cell / (engine + ".exr"), Image(2, 2), {});
  write_file(cell / (engine + ".png"), tiny_png());
  write_file(cell / (engine + ".log"), "rendered\n");
}

void write_ours(const fs::path& cell) {
  write_pictures(cell, "lobelia");
  records::Render record;
  record.engine = used("lobelia");
  record.command = {"lobelia", "render", "scene with space.xml"};
  record.image = picture_of("lobelia");
  record.samples = 1;
  record.plan.effects = {{"shadows", false, "one convex body", std::nullopt}};
  record.rays.camera = 4;
  record.seconds.total = 0.25;
  records::write_record(cell / "lobelia.json", record);
}

void write_reference(const fs::path& cell) {
  write_pictures(cell, "povray");
  records::Reference record;
  record.engine = used("povray");
  record.command = {"lobelia", "reference", "scene with space.xml"};
  record.image = picture_of("povray");
  record.shading = "native";
  record.method = "one pass";
  record.passes = 1;
  record.engine_commands = {"povray +Iscene.pov"};
  record.seconds.total = 0.25;
  records::write_record(cell / "povray.json", record);
}

void write_comparison(const fs::path& cell, bool pass) {
  write_file(cell / "lobelia-povray.png", tiny_png());
  const double outliers = pass ? 1 : 9;
  records::Comparison record;
  record.verdict = pass ? "pass" : "differs";
  record.a = "lobelia.exr";
  record.b = "povray.exr";
  record.viewing.exposure_stops = -1.5;
  record.viewing.pixels_per_degree = 67.0;
  record.metrics = {{"rmse", 1e-5},       {"max_abs", 2e-3},      {"max_abs.x", 1},
                    {"max_abs.y", 0},     {"max_rel_peak", 4e-4}, {"outliers", outliers},
                    {"some.new.one", 0.5}};
  record.limits = {{"outliers", 3, outliers, pass, "", std::nullopt}};
  record.tolerance = {6e-4, 1e-8, 3, false};
  records::write_record(cell / "lobelia-povray.json", record);
}

records::HighlightShape shape() {
  records::HighlightShape shape;
  shape.peak = 2.7;
  shape.half_width_degrees = 11.8;
  shape.energy = 0.01;
  auto& lobe = shape.highlight.emplace().cosine_lobe;
  shape.highlight->peak.found = "fitted";
  lobe.exponent = 16.25;
  lobe.standard_error = 0.125;
  lobe.coefficient = 2.7;
  lobe.rms_of_peak = 1e-6;
  lobe.pixels = 60;
  return shape;
}

void write_profile(const fs::path& cell) {
  records::Profile record;
  record.angle = "reflection";
  record.zones = {{0, 10}, {10, 20}, {20, 40}};
  std::vector<double> analytic, lobelia, povray;
  for (int i = 0; i < 60; ++i) {
    const double value = 2.7 * std::exp(-i * i / 200.0);
    record.curve.angle_degrees.push_back(i + 0.5);
    record.curve.pixels.push_back(3);
    analytic.push_back(value);
    lobelia.push_back(value * (1 + 1e-7));
    povray.push_back(value * (1 + 3e-4 * std::cos(i)));
  }
  record.curve.radiance = {{"analytic", analytic}, {"lobelia", lobelia}, {"povray", povray}};
  record.images = {{"lobelia", shape()}, {"povray", shape()}};
  const records::ZoneError zone{3, 1e-3, 2e-4, 4e-4};
  record.differences = {{"lobelia-povray", {zone, zone, zone}}};
  records::write_record(cell / "profile.json", record);
}

records::CellImage image_of(const std::string& engine) {
  return {engine, engine + ".exr", engine + ".png", engine + ".json", ""};
}

}  // namespace

FakeFarm::FakeFarm() {
  farm_.title = "A small farm";
  farm_.grid = "small.xml";
  farm_.command = "lobelia farm small.xml -o out";
  farm_.host = {"abacus", 2, "Debian", ""};
  farm_.axes = {{"model", {{"phong_rdf", "Phong (RDF)"}, {"ndf", "Blinn (NDF)"}}},
                {"exponent", {{"16", "n = 16"}, {"128", "128"}}}};
  const auto add_engine = [&](const char* name, const char* title, const char* version) {
    records::FarmEngine& engine = farm_.engines.emplace_back();
    engine.name = name;
    engine.title = title;
    engine.version = version;
    engine.available = !engine.version.empty();
  };
  add_engine("lobelia", "Lobelia", "0.1.0");
  add_engine("povray", "POV-Ray", "3.7");
  add_engine("blender", "Blender Cycles", "");
  farm_.engines.back().why = "no program 'blender' in $PATH";
  farm_.engines.back().install = "sudo apt-get install blender";
  add_cell(kPass, "pass", {{"model", "phong_rdf"}, {"exponent", "16"}});
  add_cell(kDiffers, "differs", {{"model", "phong_rdf"}, {"exponent", "128"}});
  add_cell(kFailed, "failed", {{"model", "ndf"}, {"exponent", "16"}});
  add_cell(kMissing, "missing", {{"model", "ndf"}, {"exponent", "128"}});
}

fs::path FakeFarm::cell_directory(const std::string& id) const {
  return directory() / "cells" / id;
}

void FakeFarm::write() const { records::write_record(directory() / "farm.json", farm_); }

void FakeFarm::leave_out(const std::vector<std::string>& ids) {
  std::erase_if(farm_.cells, [&](const records::FarmCell& cell) {
    return std::ranges::find(ids, cell.id) != ids.end();
  });
  write();
}

void FakeFarm::add_cell(const std::string& id, const std::string& status,
                        const records::Named<std::string>& axes) {
  farm_.cells.push_back({id, status, axes});
  write();
  if (status == "missing") return;
  const bool failed = status == "failed";
  const fs::path cell = cell_directory(id);
  make_directories(cell);
  write_file(cell / "scene.xml", "<scene/>");
  write_ours(cell);
  records::Cell record;
  record.id = id;
  record.axes = axes;
  record.status = status;
  record.highlight = {"phong_rdf", "cosine", "exact", 16, 2.7056, "", ""};
  record.exposure_stops = -1.5;
  record.images = {image_of("lobelia")};
  if (failed) {
    record.problems = {{"povray", "stopped after 600 s", "timed out", 3}};
  } else {
    write_reference(cell);
    write_comparison(cell, status == "pass");
    write_profile(cell);
    record.images.push_back(image_of("povray"));
    record.comparisons = {
        {"lobelia", "povray", "lobelia-povray.json", "lobelia-povray.png", {0.0016, 6e-4}}};
    record.profile = "profile.json";
  }
  records::write_record(cell / kCellRecord, record);
  seal(id);
}

void FakeFarm::seal(const std::string& id) const {
  const fs::path cell = cell_directory(id);
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(cell)) {
    const std::string name = entry.path().filename().string();
    // Files that a gallery put there are not the farm's.
    if (entry.is_regular_file() && name != kCellRecord && name != "index.html" &&
        !name.ends_with(".js"))
      names.insert(name);
  }
  auto record = records::read_record<records::Cell>(cell / kCellRecord);
  record.files.clear();
  for (const std::string& name : names)
    record.files.push_back({name, hex(sha256_of_file(cell / name))});
  records::write_record(cell / kCellRecord, record);
}

std::vector<MetricInfo> some_metrics() {
  return {{"outliers", "Pixels beyond the tolerance", "A few pixels may be.", "count", false},
          {"max_rel_peak", "Largest difference, of the peak", "", "share", false},
          {"psnr", "Peak signal-to-noise ratio", "", "plain", true},
          {"ssim", "SSIM", "", "plain", true}};
}

std::string tiny_png() {
  static constexpr unsigned char kBytes[] = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
      0x44, 0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x08, 0x02, 0x00, 0x00,
      0x00, 0xfd, 0xd4, 0x9a, 0x73, 0x00, 0x00, 0x00, 0x16, 0x49, 0x44, 0x41, 0x54, 0x78,
      0xda, 0x63, 0x60, 0x60, 0x60, 0xb0, 0xb1, 0xb1, 0x61, 0x38, 0x71, 0xe2, 0xc4, 0xff,
      0xff, 0xff, 0x01, 0x18, 0x14, 0x06, 0x0a, 0x05, 0xf5, 0x50, 0x41, 0x00, 0x00, 0x00,
      0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  return {reinterpret_cast<const char*>(kBytes), sizeof kBytes};
}

}  // namespace lobelia::gallery

#include "tests/gallery/fake_farm.hpp"

#include <cmath>
#include <set>

#include "core/seal.hpp"
#include "core/sha256.hpp"

namespace lobelia::gallery {
namespace fs = std::filesystem;
namespace {

void write_images(const fs::path& cell, const std::string& engine, const std::string& kind) {
  write_file(cell / (engine + ".exr"), "v/1\x01");
  write_file(cell / (engine + ".png"), tiny_png());
  write_file(cell / (engine + ".log"), "rendered\n");
  Json record = make_record(kind);
  record["engine"] = {{"name", engine}, {"version", "1.2.3"}};
  record["command"] = {"lobelia", kind, "scene with space.xml"};
  record["seconds"] = {{"total", 0.25}};
  record["image"] = {{"file", engine + ".exr"}, {"width", 2}, {"height", 2}};
  if (kind == "render") {
    record["rays"] = {{"camera", 4}, {"shadow", 0}};
    record["plan"]["effects"] =
        Json::array({{{"name", "shadows"}, {"on", false}, {"reason", "one convex body"}}});
  } else {
    record["witness"] = "native";
    record["engineCommands"] = {"povray +Iscene.pov"};
  }
  write_record(cell / (engine + ".json"), record);
}

void write_comparison(const fs::path& cell, bool pass) {
  write_file(cell / "lobelia-povray.png", tiny_png());
  Json record = make_record("comparison");
  record["verdict"] = pass ? "pass" : "differs";
  record["a"] = "lobelia.exr";
  record["b"] = "povray.exr";
  record["nonfinite"] = {{"a", 0}, {"b", 0}};
  record["viewing"] = {{"exposureStops", -1.5}, {"pixelsPerDegree", 67.0}};
  record["metrics"] = {{"rmse", 1e-5},       {"max_abs", 2e-3},      {"max_abs.x", 1},
                       {"max_abs.y", 0},     {"max_rel_peak", 4e-4}, {"outliers", pass ? 1 : 9},
                       {"some.new.one", 0.5}};
  record["limits"] = Json::array(
      {{{"metric", "outliers"}, {"limit", 3}, {"value", pass ? 1 : 9}, {"pass", pass}}});
  record["tolerance"] = {{"relative", 6e-4}, {"ofPeak", 1e-8}, {"allowedOutliers", 3}};
  write_record(cell / "lobelia-povray.json", record);
}

void write_profile(const fs::path& cell) {
  Json record = make_record("profile");
  record["light"] = 0;
  record["sphere"] = 0;
  record["angle"] = "reflection";
  record["zones"] = {
      {"epicentreDegrees", {0, 10}}, {"flankDegrees", {10, 20}}, {"bloomingDegrees", {20, 40}}};
  Json& curve = record["curve"];
  for (int i = 0; i < 60; ++i) {
    const double value = 2.7 * std::exp(-i * i / 200.0);
    curve["angleDegrees"].push_back(i + 0.5);
    curve["pixels"].push_back(3);
    curve["analytic"].push_back(value);
    curve["lobelia"].push_back(value * (1 + 1e-7));
    curve["povray"].push_back(value * (1 + 3e-4 * std::cos(i)));
  }
  for (const char* engine : {"lobelia", "povray"}) {
    record["images"][engine] = {{"peak", 2.7}, {"halfWidthDegrees", 11.8}, {"energy", 0.01}};
    record["images"][engine]["highlight"]["cosineLobe"] = {{"exponent", 16.25},
                                                           {"standardError", 0.125}};
  }
  const Json zone = {{"maxAbs", 1e-3}, {"rms", 2e-4}, {"maxRelPeak", 4e-4}};
  record["differences"]["lobelia-povray"] = {
      {"epicentre", zone}, {"flank", zone}, {"blooming", zone}};
  write_record(cell / "profile.json", record);
}

}  // namespace

FakeFarm::FakeFarm() {
  farm_ = make_record("farm");
  farm_["title"] = "A small farm";
  farm_["grid"] = "small.xml";
  farm_["command"] = "lobelia farm small.xml -o out";
  farm_["host"] = {{"processor", "abacus"}, {"threads", 2}, {"system", "Debian"}};
  const auto value = [](const char* name, const char* label) {
    return Json{{"value", name}, {"label", label}};
  };
  farm_["axes"] = Json::array();
  farm_["axes"].push_back(
      {{"name", "model"},
       {"values", Json::array({value("phong_rdf", "Phong (RDF)"), value("ndf", "Blinn (NDF)")})}});
  farm_["axes"].push_back({{"name", "exponent"},
                           {"values", Json::array({value("16", "n = 16"), value("128", "128")})}});
  farm_["engines"] = Json::array(
      {{{"name", "lobelia"}, {"title", "Lobelia"}, {"version", "0.1.0"}, {"available", true}},
       {{"name", "povray"}, {"title", "POV-Ray"}, {"version", "3.7"}, {"available", true}},
       {{"name", "blender"},
        {"title", "Blender Cycles"},
        {"available", false},
        {"why", "no program 'blender' in $PATH"},
        {"install", "sudo apt-get install blender"}}});
  farm_["cells"] = Json::array();
  add_cell(kPass, "pass", {{"model", "phong_rdf"}, {"exponent", "16"}});
  add_cell(kDiffers, "differs", {{"model", "phong_rdf"}, {"exponent", "128"}});
  add_cell(kFailed, "failed", {{"model", "ndf"}, {"exponent", "16"}});
  add_cell(kMissing, "missing", {{"model", "ndf"}, {"exponent", "128"}});
}

fs::path FakeFarm::cell_directory(const std::string& id) const {
  return directory() / "cells" / id;
}

void FakeFarm::write() const { write_record(directory() / "farm.json", farm_); }

void FakeFarm::add_cell(const std::string& id, const std::string& status, const Json& axes) {
  farm_["cells"].push_back({{"id", id}, {"status", status}, {"axes", axes}});
  write();
  if (status == "missing") return;
  const bool failed = status == "failed";
  const fs::path cell = cell_directory(id);
  make_directories(cell);
  write_file(cell / "scene.xml", "<scene/>");
  write_images(cell, "lobelia", "render");
  if (!failed) {
    write_images(cell, "povray", "reference");
    write_comparison(cell, status == "pass");
    write_profile(cell);
  }
  Json record = make_record("cell");
  record["id"] = id;
  record["axes"] = axes;
  record["status"] = status;
  record["highlight"] = {{"model", "phong_rdf"}, {"exponent", 16}, {"coefficient", 2.7056}};
  record["exposureStops"] = -1.5;
  record["images"] = Json::array();
  for (const std::string engine : {"lobelia", "povray"}) {
    if (failed && engine == "povray") continue;
    record["images"].push_back({{"engine", engine},
                                {"exr", engine + ".exr"},
                                {"png", engine + ".png"},
                                {"record", engine + ".json"}});
  }
  record["comparisons"] = Json::array();
  record["problems"] = Json::array();
  if (failed) {
    record["problems"].push_back({{"engine", "povray"}, {"message", "stopped after 600 s"}});
  } else {
    record["comparisons"].push_back(
        {{"a", "lobelia"},
         {"b", "povray"},
         {"record", "lobelia-povray.json"},
         {"png", "lobelia-povray.png"},
         {"difference", {{"whiteAt", 0.0016}, {"relativeToPeak", 6e-4}}}});
    record["profile"] = "profile.json";
  }
  write_record(cell / "cell.json", record);
  seal(id);
}

void FakeFarm::seal(const std::string& id) const {
  const fs::path cell = cell_directory(id);
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(cell)) {
    const std::string name = entry.path().filename().string();
    // Files that a gallery put there are not the farm's.
    if (entry.is_regular_file() && name != "cell.json" && name != "index.html" &&
        !name.ends_with(".js"))
      names.insert(name);
  }
  Json record = read_record(cell / "cell.json", "cell");
  record["files"] = Json::array();
  for (const std::string& name : names)
    record["files"].push_back({{"name", name}, {"sha256", hex(sha256_of_file(cell / name))}});
  record = Json::parse(record_text(record));
  record["seal"] = seal_of(record);
  write_record(cell / "cell.json", record);
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

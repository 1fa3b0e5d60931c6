// The records in a farm's directory, and those that `lobelia farm` prints.
#pragma once

#include "base/records/highlight.hpp"
#include "base/records/result.hpp"
#include "base/records/struct_type.hpp"

namespace lobelia::records {

struct AxisValue {
  std::string value, label;
};

struct Axis {
  std::string name;
  std::vector<AxisValue> values;
};

struct FarmEngine {
  std::string name, title;
  bool available = false;
  std::string state, version, content, why, install;
  std::optional<std::size_t> refused_cells;
  std::vector<EngineModel> models;
};

struct FarmCell {
  std::string id, status;
  Named<std::string> axes;
};

struct Locks {
  bool shared = false;
  std::string why;
};

struct Farm {
  std::string title, authors, url, grid, command;
  std::optional<Host> host;
  std::string cache;
  std::optional<Locks> locks;
  std::vector<Axis> axes;
  std::vector<FarmEngine> engines;
  std::string reference;
  std::vector<FarmCell> cells;
};

struct CellImage {
  std::string engine, exr, png, record, sha256;
};

struct NotComparable {
  std::string engine, because;
};

struct CellProblem {
  std::string engine, message, failure;
  int attempts = 0;
};

struct MadeFrom {
  std::string program, libraries;
  Arithmetic arithmetic;
  std::string scene;
  Named<std::string> contents, engines;
  bool operator==(const MadeFrom&) const = default;
};

struct CellFile {
  std::string name, sha256;
  bool operator==(const CellFile&) const = default;
};

struct Cell {
  std::string id;
  Named<std::string> axes;
  std::string status;
  std::optional<Highlight> highlight;
  std::optional<double> exposure_stops;
  std::vector<CellImage> images;
  std::vector<CellComparison> comparisons;
  std::string profile;
  std::vector<NotComparable> not_comparable;
  std::vector<std::string> missing_engines;
  std::vector<CellProblem> problems;
  MadeFrom made_from;
  Named<std::string> results;
  std::vector<CellFile> files;
};

struct StatusCounts {
  std::size_t failed = 0, differs = 0, undecided = 0, missing = 0, unchecked = 0, pass = 0;
};

struct FailureOfCell {
  std::string cell, engine, failure;
  int attempts = 0;
  std::string message;
};

struct FarmStatus {
  std::string title;
  std::size_t cells = 0;
  StatusCounts status;
  std::string cache;
  bool cache_is_there = false, at_work = false;
  std::vector<FailureOfCell> failures;
};

struct ExplainedPart {
  std::string part, was, now;
  bool same = false;
  std::vector<std::string> files;
};

struct ExplainedJob {
  std::string job, key;
  bool in_cache = false;
  std::string why;
  std::vector<ExplainedPart> parts;
};

struct FarmExplanation {
  std::string cell, status;
  std::vector<ExplainedJob> jobs;
  std::vector<std::string> without;
};

struct GalleryList {
  std::vector<std::string> files;
  Named<std::string> made_of;
};

void define_farm_tables(Tables& tables);

}  // namespace lobelia::records

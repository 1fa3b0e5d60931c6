// Pictures: plans, renders and references.
#pragma once

#include "base/records/highlight.hpp"
#include "base/records/struct_type.hpp"

namespace lobelia::records {

/// The states of an engine: not installed, not usable, usable.
inline constexpr std::string_view kEngineStates[] = {"absent", "broken", "ready"};

struct Work {
  std::string unit;
  std::uint64_t count = 0;
};

struct Effect {
  std::string name;
  bool on = false;
  std::string reason;
  std::optional<Work> work;
};

struct ExpectedRays {
  std::uint64_t camera = 0, shadow_at_most = 0, mirror_at_most = 0, scattered_at_most = 0;
};

struct Plan {
  std::vector<Effect> effects;
  std::string precision, kernel;
  ExpectedRays expected_rays;
};

/// The plan in the record of a render.
struct PlanOfRender {
  std::vector<Effect> effects;
  std::string precision, kernel;
};

struct Rays {
  std::uint64_t camera = 0, shadow = 0, mirror = 0, scattered = 0;
};

struct EngineUsed {
  std::string name, title, version;
};

struct ImageFile {
  std::string file;
  int width = 0, height = 0;
};

struct AccuracyChoice {
  std::string lobe;  ///< empty if the highlights keep their own lobes
  std::string precision;
  std::optional<int> samples;
};

struct AccuracyOperations {
  double chosen = 0, own_in_float64 = 0;
};

struct AccuracySeconds {
  double chosen = 0, own_in_float64 = 0;
};

struct AccuracyReached {
  double value = 0;
  bool held = false;
  std::string against;
  double seconds = 0;
};

struct Accuracy {
  double asked = 0;
  std::string unit, measure;
  AccuracyChoice chose;
  std::string why;
  AccuracyOperations operations;
  std::optional<AccuracySeconds> value_seconds;
  std::string basis;
  double predicted = 0;
  std::optional<AccuracyReached> reached;
};

struct RenderSeconds {
  double plan = 0, render = 0, total = 0;
  std::optional<double> read, pack, write;
};

struct Render {
  EngineUsed engine;
  std::vector<std::string> command;
  ImageFile image;
  std::vector<Highlight> highlights;
  int samples = 0;
  std::uint64_t seed = 0;
  std::optional<double> estimated_error;
  std::string stopped;
  std::vector<std::string> remarks;
  PlanOfRender plan;
  Rays rays;
  std::string instruction_set;
  RenderSeconds seconds;
  std::string standard_error;
  std::optional<Accuracy> accuracy;
};

struct EngineSeconds {
  double total = 0;
};

struct Reference {
  EngineUsed engine;
  ImageFile image;
  std::string shading, method;
  std::size_t passes = 0;
  std::optional<int> points;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> engine_commands, engine_options;
  std::optional<bool> writes_limited;
  std::string contained;
  EngineSeconds seconds;
  std::optional<double> cpu_seconds;
  std::optional<std::uint64_t> peak_memory_bytes;
  std::optional<int> threads;
  std::vector<std::string> command;
  std::string standard_error;
  std::vector<Highlight> highlights;
};

/// An engine on this machine.
struct EngineFound {
  std::string name, title;
  bool available = false;
  std::string state, program, version, why, supported_versions, shading, precision, effects,
      install;
  std::vector<EngineModel> models;
};

struct Engines {
  std::vector<EngineFound> engines;
};

void define_render_tables(Tables& tables);

}  // namespace lobelia::records
